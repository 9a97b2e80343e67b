#include "simulation/steady_start.h"

#include "linalg/dense/products.h"
#include "model/errors.h"

#include <Eigen/LU>
#include <fmt/format.h>

#include <complex>

namespace whirl::simulation {

Eigen::VectorXd steady_motion(const MovingParts &parts) {
    using Complex = std::complex<double>;
    const reduction::ReducedRotor &rotor = parts.rotor;
    const Eigen::Index r = rotor.size();
    const double speed = parts.spin.at(0, 0).speed;
    const Complex i(0, 1);
    const reduction::ReducedRotor::Supports at = rotor.supports_at(speed);
    Eigen::MatrixXcd A = at.stiffness.cast<Complex>() + i * speed * at.damping;
    if (rotor.mass_beside.size() > 0)
        A -= speed * speed * rotor.mass_beside;
    for (const Eigen::Index plane : {Eigen::Index{0}, r}) {
        A.block(plane, plane, r, r) += rotor.elastic + i * speed * rotor.internal;
        A.block(plane, plane, r, r).diagonal().array() -= speed * speed;
    }
    const Eigen::MatrixXcd across = i * speed * speed * rotor.gyroscopic + speed * rotor.internal;
    A.topRightCorner(r, r) += across;
    A.bottomLeftCorner(r, r) -= across;
    Eigen::VectorXcd load = Eigen::VectorXcd::Zero(2 * r);
    for (const FixedMass &mass : parts.fixed) {
        if (mass.from > 0)
            continue;
        const Complex force = mass.mass.moment * speed * speed * std::exp(i * mass.phase);
        load.head(r) += force * mass.row;
        load.tail(r) -= i * force * mass.row;
    }
    const Eigen::PartialPivLU<Eigen::MatrixXcd> factors(A);
    const Eigen::VectorXcd p = linalg::solved(factors, load);
    constexpr double resonance = 1e-13; // of the condition: no digit is left
    if (!p.allFinite() || linalg::reciprocal_condition(factors) < resonance)
        throw model::AnalysisFailure(fmt::format(
            "no steady motion to start from at {:.6g} rad/s: the rotor is at a resonance without "
            "damping, or free to move",
            speed));
    Eigen::VectorXd state(4 * r);
    state << p.real(), (i * speed * p).real();
    return state;
}

} // namespace whirl::simulation
