#include "oracles/weight.h"

#include "oracles/influence.h"

#include <cmath>
#include <complex>
#include <stdexcept>

namespace whirl::oracles {

namespace {

using Complex = std::complex<Real>;
using Complex2 = Eigen::Matrix<Complex, 2, 2>;
using Vector2 = Eigen::Matrix<Complex, 2, 1>;

/// Of the supports alone, on deflection and slope at z: forces by the lever.
Complex2 of_supports(const CaseRotor &rotor, Real z, Real frequency, bool damped) {
    const Support &a = rotor.supports[0];
    const Support &b = rotor.supports[1];
    const Real span = static_cast<Real>(b.z) - a.z;
    Vector2 on_a, on_b; // under a unit force, a unit moment
    on_a << (static_cast<Real>(b.z) - z) / span, -1 / span;
    on_b << (z - a.z) / span, 1 / span;
    const auto stiffness = [&](const Support &s) {
        return Complex(s.k[0][0], damped ? frequency * s.c[0][0] : Real(0));
    };
    return on_a * on_a.transpose() / stiffness(a) + on_b * on_b.transpose() / stiffness(b);
}

} // namespace

WeightMotion disc_under_weight(const CaseRotor &rotor, Real gravity, Real speed) {
    if (rotor.discs.size() != 1 || rotor.supports.size() != 2)
        throw std::runtime_error("weight: one disc on two supports");
    const RigidDisc &disc = rotor.discs.front();
    const Real z = disc.z;
    const RealMatrix stiff = MasslessShaft(rotor, 1, 1).coefficients({z});
    const RealMatrix soft = MasslessShaft(rotor, 1, -1).coefficients({z});
    const Complex2 still = ((stiff + soft) / 2).cast<Complex>(); // with the supports at rest
    const Complex2 half = ((stiff - soft) / 2).cast<Complex>();
    const Complex2 moving =
        still - of_supports(rotor, z, 0, false) + of_supports(rotor, z, 2 * speed, true);
    // Inertia of w and phi ~ exp(2 i Omega t): m 4 Omega^2, (4 Id - 2 Ip) Omega^2.
    Complex2 inertia = Complex2::Zero();
    inertia(0, 0) = 4 * speed * speed * disc.mass;
    inertia(1, 1) = (4 * static_cast<Real>(disc.Id) - 2 * disc.Ip) * speed * speed;
    Vector2 weight;
    weight << Complex(0, -gravity * disc.mass), 0;
    const Vector2 load = half * weight.conjugate();
    const Complex2 dynamic = Complex2::Identity() - moving * inertia;
    const Vector2 A = solve(ComplexMatrix(dynamic), ComplexMatrix(load));
    const Vector2 B = still * weight + half * Vector2(inertia * A).conjugate();
    return {std::abs(B[0]), std::abs(A[0])};
}

std::vector<Real> weight_peaks(const CaseRotor &rotor, Real gravity) {
    constexpr int steps = 4000;
    const auto size = [&](Real speed) { return disc_under_weight(rotor, gravity, speed).twice; };
    const Real step = (static_cast<Real>(rotor.speed_to) - rotor.speed_from) / steps;
    std::vector<Real> out;
    for (int i = 1; i < steps; ++i) {
        const Real at = rotor.speed_from + i * step;
        if (size(at) <= size(at - step) || size(at) < size(at + step))
            continue;
        Real a = at - step;
        Real b = at + step;
        for (int k = 0; k < 100 && b - a > 1e-6L * at; ++k) { // golden sections
            const Real part = (3 - std::sqrt(Real(5))) / 2 * (b - a);
            (size(a + part) > size(b - part) ? b : a) =
                size(a + part) > size(b - part) ? b - part : a + part;
        }
        // A parabola through three points; its error is of fourth order, by Richardson of sixth
        const auto vertex = [&](Real d) {
            const Real middle = (a + b) / 2;
            const Real low = size(middle - d);
            const Real high = size(middle + d);
            return middle + d / 2 * (low - high) / (low - 2 * size(middle) + high);
        };
        const Real d = 1e-4L * at;
        out.push_back((4 * vertex(d / 2) - vertex(d)) / 3);
    }
    return out;
}

} // namespace whirl::oracles
