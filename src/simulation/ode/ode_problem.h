#pragma once

#include "simulation/ode/linear_motion.h"

#include <functional>
#include <vector>

namespace whirl::simulation {

/// Axes that turn, in which a motion that goes round with them stands still, so that it is followed
/// in long steps. The rates must look the same from axes turned by any angle, and not depend on
/// time otherwise: those at t = 0 are then the rates in the turning axes, but for the turning
/// itself. The problem is stated and answered in axes that stand still all the same.
struct TurningAxes {
    double speed = 0; ///< rad/s; 0: integrated as it is
    int count = 0;    ///< of the vectors: x of all, then y of all, from each of `first` on
    std::vector<int> first;
    /// x' = A x + what is left, x of the vectors at the first `first`, then those at the next, seen
    /// from the turning axes. Empty: nothing is known to be linear.
    LinearMotion linear = {};
};

/// An initial value problem of fixed size.
struct OdeProblem {
    int size = 0;
    /// Writes dy/dt; both arrays have `size` entries.
    std::function<void(double t, const double *y, double *rates)> rates;
    /// Writes the error allowed in each entry, > 0; the local error is kept below it in the mean
    /// square over the entries.
    std::function<void(const double *y, double *allowed)> allowed_error;
    TurningAxes axes = {};

    /// dy/dt; in turning axes less i speed y, for these turn away.
    void rates_in_axes(double t, const double *y, double *out) const;
};

struct OdeCounts {
    long steps = 0;
    long failed = 0; ///< steps repeated because their error was too large
    long rates = 0;  ///< evaluations of f
};

} // namespace whirl::simulation
