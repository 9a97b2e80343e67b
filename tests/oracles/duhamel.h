#pragma once

#include <complex>
#include <functional>
#include <vector>

namespace whirl::oracles {

/// A point mass on an isotropic spring and damper, m w'' + c w' + k w = f(t) with w = x + iy, by
/// Duhamel's integral in long double: Gauss-Legendre quadrature of 16 points over short panels.
class Duhamel {
  public:
    using Long = long double;
    using Complex = std::complex<Long>;
    struct Spring {
        Long mass, damping, stiffness; ///< kg, N s/m, N/m
    };
    struct Motion {
        Complex w, v; ///< m, m/s
    };

    /// @param force  N, smooth inside each panel
    /// @param panel  s: the force and the free motion turn by a few radians at most in it
    Duhamel(const Spring &spring, std::function<Complex(Long)> force, Long panel,
            const Motion &start = {0, 0});

    /// Motion at a time >= that of the last call.
    Motion at(Long t);

    struct Peak {
        Long value, time; ///< m, s
    };
    /// Largest |w| until the end: a root of its derivative.
    [[nodiscard]] static Peak largest(const Spring &spring,
                                      const std::function<Complex(Long)> &force, Long panel,
                                      Long end, const Motion &start = {0, 0});

  private:
    Spring _spring;
    std::function<Complex(Long)> _force;
    Long _panel;
    Complex _fast, _slow; ///< roots of the characteristic equation
    Long _t = 0;
    Motion _motion;

    [[nodiscard]] Motion advanced(const Motion &from, Long t, Long step) const;
};

/// Spin that goes from one speed to another at a constant rate, then stays.
struct Ramp {
    long double from, to, duration; ///< rad/s, rad/s, s

    [[nodiscard]] long double speed(long double t) const;
    [[nodiscard]] long double angle(long double t) const;
    /// Of an imbalance: mr (speed^2 - i acceleration) exp(i angle), N.
    [[nodiscard]] std::complex<long double> force(long double mr, long double t) const;
};

} // namespace whirl::oracles
