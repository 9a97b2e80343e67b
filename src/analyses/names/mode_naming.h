#pragma once

#include "model/case.h"
#include "results/critical.h"
#include "results/formulation.h"
#include "results/response.h"
#include "results/stability.h"

#include <cmath>
#include <vector>

namespace whirl::analyses {

/// Names the mode of each critical speed, where its line of the Campbell diagram is sure; none in
/// rotating axes, nor with balancers, where following the lines takes seconds.
/// @param order  of the shaft elements
void name_modes(std::vector<results::CriticalSpeed> &critical_speeds, const model::Case &scene,
                int order);

/// What drives the peaks whose modes are to be named.
struct PeakDrive {
    double multiple = 1;    ///< frequency over spin speed, of a fixed one 0
    double frequency = 0;   ///< rad/s, where it is fixed
    bool imbalances = true; ///< alone: what turns with the rotor drives forward whirl

    [[nodiscard]] double frequency_at(double speed) const {
        return multiple * std::abs(speed) + frequency;
    }
};
/// Names the mode that is nearest to resonance at each peak: the least |l - i frequency|; none
/// where critical speeds get none.
/// @param order  of the shaft elements
void name_modes(std::vector<results::ResponsePeak> &peaks, const model::Case &scene, int order,
                const PeakDrive &drive = {});

/// Names the mode that passes the imaginary axis at each end of kind pair; none at other ends,
/// where a motion stands still or two meet, nor where critical speeds get none, nor where the lines
/// of a large rotor can be followed neither on few shapes nor through few speeds.
/// @param form   in which the lines are followed
/// @param order  of the shaft elements
void name_modes(std::vector<results::StabilityEnd> &ends, const model::Case &scene,
                results::Form form, int order);

} // namespace whirl::analyses
