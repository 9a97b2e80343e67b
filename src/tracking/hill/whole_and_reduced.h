#pragma once

#include "mesh_error/finer_model.h"
#include "modes/spectrum.h"
#include "tracking/crossings.h"

#include <vector>

namespace whirl::tracking {

/// Refines on the whole rotor what was found on the reduced one; both of form hill.
struct WholeAndReduced {
    const modes::SpectrumSolver &whole;
    const modes::SpectrumSolver &reduced;
    int wanted; ///< modes that are had at each speed

    /// Some of the modes of a spectrum become those of the whole rotor, each that is found; the
    /// others are not confirmed (modes::WhirlMode).
    /// @param all  no others are looked for once one is not found
    /// @returns false where one of them is not found
    [[nodiscard]] bool improve(modes::Spectrum &spectrum, const std::vector<int> &places,
                               bool all) const;

    /// Crossings and ends of intervals. What is not found is said to be unconfirmed.
    /// @param low,high  ends of the range of speeds, which intervals may end at, rad/s
    /// @param finer     of the whole rotor: gives Crossings::by_mesh
    void improve(Crossings &crossed, double low, double high,
                 const mesh_error::FinerModel *finer = nullptr) const;
};

} // namespace whirl::tracking
