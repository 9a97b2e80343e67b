#include "oracles/forces.h"

#include "oracles/influence.h"

#include <stdexcept>

namespace whirl::oracles {

namespace {

/// Deflection over force of a motion x + i y = u exp(i frequency t), of either sign.
Complex turning(const CaseRotor &rotor, Real speed, Real frequency) {
    const RigidDisc &disc = rotor.discs.front();
    const Support &a = rotor.supports[0];
    const Support &b = rotor.supports[1];
    const Real span = static_cast<Real>(b.z) - a.z;
    // Of the shaft alone: influence coefficients less what its supports, at rest, give.
    const RealMatrix all = MasslessShaft(rotor).coefficients({disc.z});
    // Shares of a force and of a moment at the disc that the supports carry, by the lever.
    const Real on_a[2] = {(static_cast<Real>(b.z) - disc.z) / span, -1 / span};
    const Real on_b[2] = {(static_cast<Real>(disc.z) - a.z) / span, 1 / span};
    Complex F[2][2];
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) {
            const auto of = [&](const Support &s, const Real *share) {
                const Real k = s.k[0][0];
                return share[i] * share[j] *
                       (Complex(1) / Complex(k, frequency * s.c[0][0]) - Complex(1 / k));
            };
            F[i][j] = all(i, j) + of(a, on_a) + of(b, on_b);
        }
    const Real mass = frequency * frequency * disc.mass;
    const Real tilt = frequency * (frequency * disc.Id - speed * disc.Ip);
    // (1 - F inertia) u = F (1, 0)
    const Complex A00 = Complex(1) - F[0][0] * mass;
    const Complex A01 = -F[0][1] * tilt;
    const Complex A10 = -F[1][0] * mass;
    const Complex A11 = Complex(1) - F[1][1] * tilt;
    return (A11 * F[0][0] - A01 * F[1][0]) / (A00 * A11 - A01 * A10);
}

} // namespace

DiscReceptance disc_receptance(const CaseRotor &rotor, Real speed, Real frequency) {
    if (rotor.discs.size() != 1 || rotor.supports.size() != 2)
        throw std::runtime_error("forces: one disc on two supports");
    const Complex forward = turning(rotor, speed, frequency);
    const Complex backward = std::conj(turning(rotor, speed, -frequency));
    return {(forward + backward) / Real(2), (forward - backward) / Complex(0, 2), forward};
}

} // namespace whirl::oracles
