#pragma once

#include <cmath>
#include <complex>
#include <numbers>
#include <optional>

namespace whirl::results {

/// How fast a whirl dies out, from its eigenvalue.
struct Damping {
    std::optional<double> ratio;   ///< -Re/|lambda|
    std::optional<double> log_dec; ///< -2 pi Re/Im
    /// 1/(2 ratio): how far its resonance rises above the static deflection. None for a motion that
    /// nothing damps (infinite) or that grows.
    std::optional<double> amplification;

    /// Below this amplification factor a critical speed needs no separation margin from the
    /// operating speed: it counts as critically damped (API 617).
    static constexpr double least_amplification = 2.5;
    /// False where it was not determined: neither ratio nor amplification.
    [[nodiscard]] bool known() const { return ratio || amplification; }
    [[nodiscard]] bool heavy() const {
        return amplification && *amplification < least_amplification;
    }
};

[[nodiscard]] inline Damping damping_of(std::complex<double> eigenvalue) {
    const double size = std::abs(eigenvalue);
    const double decay = 0 - eigenvalue.real(); // no negative zero for undamped motion
    Damping out;
    out.ratio = size > 0 ? decay / size : 0;
    out.log_dec = eigenvalue.imag() > 0 ? 2 * std::numbers::pi * decay / eigenvalue.imag() : 0;
    if (decay > 0)
        out.amplification = size / (2 * decay);
    return out;
}

} // namespace whirl::results
