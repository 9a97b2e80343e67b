#pragma once

#include <Eigen/Core>

#include <complex>
#include <vector>

namespace whirl::stability {

/// A free motion exp(l t) at one spin speed, in rotating axes. Both conjugates are listed, so that
/// lines can be followed through the real axis.
struct Motion {
    std::complex<double> value; ///< l, 1/s
    Eigen::VectorXcd state;     ///< displacements and velocities, made comparable; length 1
    double noise = 0;           ///< how far Re l can be from the truth by rounding, 1/s
    bool may_meet = true;       ///< slow enough for a combination resonance at this speed
    double repeats = 0;         ///< aliases of l lie i times this apart, rad/s; 0: there are none
    int action = 0;             ///< without damping its sign (FloquetMotion), where it is known

    [[nodiscard]] bool grows() const { return value.real() > noise; }
    [[nodiscard]] bool decays() const { return value.real() < -noise; }
    /// Neither grows nor dies out beyond its noise.
    [[nodiscard]] bool neutral() const { return std::abs(value.real()) <= noise; }
};

/// How far apart two values are where aliases of both lie i times `repeats` apart (0: there are
/// none), 1/s.
[[nodiscard]] double alias_distance(std::complex<double> a, std::complex<double> b, double repeats);

/// The value of a motion at that of its aliases (Motion::repeats) which is next to another value.
[[nodiscard]] std::complex<double> nearest_alias(std::complex<double> other, const Motion &motion);

/// The one of largest real part.
[[nodiscard]] const Motion &fastest_growing(const std::vector<Motion> &motions);

/// Largest real part, 1/s; below the noise of the motions it is 0.
[[nodiscard]] double growth_of(const std::vector<Motion> &motions);

} // namespace whirl::stability
