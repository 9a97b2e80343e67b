#pragma once

#include "model/case.h"
#include "results/critical.h"
#include "results/formulation.h"
#include "results/response.h"
#include "results/stability.h"

#include <cmath>
#include <memory>
#include <optional>
#include <vector>

namespace whirl::modes {
class SpectrumSolver;
struct WhirlMode;
} // namespace whirl::modes

namespace whirl::analyses {

/// Whirl modes of the rotor of a case for what is said beside its numbers: names, and whether
/// motions grow. Damped ones are those of the reduced rotor, refined only where that decides
/// something; by `reduction = "off"` of the whole one. Of periodic equations those of the reduced
/// rotor's monodromy matrix, as long as the case has a range of speeds.
class ModesBeside {
  public:
    /// @param scene  must outlive this
    /// @param order  of the shaft elements
    ModesBeside(const model::Case &scene, int order);
    ~ModesBeside();
    ModesBeside(const ModesBeside &) = delete;
    ModesBeside &operator=(const ModesBeside &) = delete;
    ModesBeside(ModesBeside &&) = delete;
    ModesBeside &operator=(ModesBeside &&) = delete;

    [[nodiscard]] const model::Case &scene() const { return _scene; }
    /// Made for the form that is asked for last.
    [[nodiscard]] const modes::SpectrumSolver &in(results::Form form) const;
    /// A mode of that solver on the whole rotor; nothing where it is not found.
    [[nodiscard]] std::optional<modes::WhirlMode> refined(double speed,
                                                          const modes::WhirlMode &mode) const;

  private:
    const model::Case &_scene;
    int _order;
    mutable std::unique_ptr<modes::SpectrumSolver> _solver;
    mutable std::unique_ptr<modes::SpectrumSolver> _whole; ///< none: that itself
};

/// Names the mode of each critical speed, where its line of the Campbell diagram is sure; none in
/// rotating axes, nor with balancers, where following the lines takes seconds.
void name_modes(std::vector<results::CriticalSpeed> &critical_speeds, const ModesBeside &modes);

/// What drives the peaks whose modes are to be named.
struct PeakDrive {
    double multiple = 1;    ///< frequency over spin speed, of a fixed one 0
    double frequency = 0;   ///< rad/s, where it is fixed
    bool imbalances = true; ///< alone: what turns with the rotor drives forward whirl
    /// More of the motion, as a multiple of the spin speed: resonances with it are as wide as the
    /// peaks; 0: none.
    double also = 0;

    [[nodiscard]] double frequency_at(double speed) const {
        return multiple * std::abs(speed) + frequency;
    }
};
/// Names the mode that is nearest to resonance at each peak: the least |l - i frequency|; none
/// where critical speeds get none, but of periodic equations.
void name_modes(std::vector<results::ResponsePeak> &peaks, const ModesBeside &modes,
                const PeakDrive &drive = {});

/// Names the mode that passes the imaginary axis at each end of kind pair; none at other ends,
/// where a motion stands still or two meet, nor where critical speeds get none, nor where the lines
/// of a large rotor can be followed neither on few shapes nor through few speeds.
/// @param form  in which the lines are followed
void name_modes(std::vector<results::StabilityEnd> &ends, const ModesBeside &modes,
                results::Form form);

} // namespace whirl::analyses
