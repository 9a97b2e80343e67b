#pragma once

#include "modes/roots/roots.h"

#include <complex>
#include <functional>
#include <vector>

namespace whirl::modes {

/// All roots of a rotor at one value of a parameter, the spin speed mostly.
struct RootsAt {
    double speed = 0; ///< rad/s
    std::vector<Root> roots;
};

/// One motion over a step of speed: eigenvalues and rates at both ends, a cubic between them.
struct Branch {
    const Root *from = nullptr, *to = nullptr;
    double step = 0; ///< rad/s
    int cluster = 0; ///< of motions not distinguished that stay off the axis together, or none

    /// @param t  from 0 to 1
    [[nodiscard]] std::complex<double> at(double t) const;
    /// Its change with t there, 1/s.
    [[nodiscard]] std::complex<double> slope(double t) const;
    /// How far the value at the end is from a parabola, whose rates are linear: what may be wrong
    /// of the cubic.
    [[nodiscard]] std::complex<double> off_parabola() const;
    /// Where the real part passes zero; the end at which it is zero within rounding.
    [[nodiscard]] double zero() const;
};

/// The motions of a step, followed as far as values and rates at its ends identify them. Those that
/// cannot be distinguished are left out where this does not matter: all of them die out, or all
/// grow, by far more than they differ.
struct Branches {
    std::vector<Branch> branches;
    int clusters = 0;
    bool clear = true; ///< false: some that matter could not be followed
    double middle =
        0.5; ///< where to split the step; long ones near rest at the mean of the logarithms
};

/// @param matters  of a root at one of the ends: it may not be left out; none: all of them
[[nodiscard]] Branches
followed(const RootsAt &from, const RootsAt &to,
         const std::function<bool(const Root &, const RootsAt &)> &matters = {});

} // namespace whirl::modes
