#include "analyses/forced_motion.h"

#include "assembly/system.h"

#include <vector>

namespace whirl::analyses {

namespace {

constexpr std::complex<double> imaginary_unit(0, 1);

/// Damping of the supports in one plane; that of the shaft does not act in circular whirl.
linalg::Matrix planar_support_damping(const assembly::Discretization &d, double speed) {
    std::vector<Eigen::Triplet<double>> entries;
    assembly::assemble_supports(
        d, speed, [&entries](assembly::Term term, int i, int j, const Eigen::Matrix2d &block) {
            if (term == assembly::Term::damping)
                entries.emplace_back(i, j, block(0, 0));
        });
    return linalg::Matrix::from_entries(d.planar_size(), entries);
}

} // namespace

ForcedMotion::ForcedMotion(const assembly::Discretization &discretization, Form form)
    : _discretization(discretization), _planar(form == Form::planar) {
    assemble(0);
}

void ForcedMotion::assemble(double bearing_speed) {
    if (_planar) {
        const assembly::PlanarSystem system =
            assembly::assemble_planar(_discretization, bearing_speed);
        const linalg::Matrix M_G = linalg::Matrix::sum(1, system.M, -1, system.G);
        const linalg::Matrix C = planar_support_damping(_discretization, bearing_speed);
        _solver = std::make_unique<linalg::HarmonicSolver>(
            linalg::HarmonicTerms{&M_G, &C, nullptr, &system.K, nullptr});
    } else {
        const assembly::FixedSystem system =
            assembly::assemble_fixed(_discretization, bearing_speed);
        _solver = std::make_unique<linalg::HarmonicSolver>(
            linalg::HarmonicTerms{&system.M, &system.C, &system.G, &system.K, &system.Kc});
    }
}

Eigen::VectorXcd ForcedMotion::imbalance_forces(double speed) const {
    Eigen::VectorXcd f = Eigen::VectorXcd::Zero(_solver->size());
    for (const model::Imbalance &imbalance : _discretization.rotor().imbalances) {
        const std::complex<double> force =
            imbalance.mr * speed * speed * std::polar(1.0, imbalance.phase);
        for (const auto &[unknown, value] : _discretization.deflection_at(imbalance.z)) {
            if (_planar) {
                f(unknown) += value * force;
            } else {
                f(2 * unknown) += value * force;
                f(2 * unknown + 1) -= value * imaginary_unit * force; // sin = Re(-i exp)
            }
        }
    }
    return f;
}

void ForcedMotion::solve(double speed) {
    _speed = speed;
    if (speed == 0) { // no force; a free rotor's matrix would be singular
        _displacements = Eigen::VectorXcd::Zero(_solver->size());
        _rounding = 0;
        return;
    }
    if (_discretization.rotor().bearings_depend_on_speed())
        assemble(speed);
    const linalg::HarmonicSolution solution = _solver->solve(speed, imbalance_forces(speed));
    _displacements = solution.displacements.col(0);
    _rounding = solution.rounding;
}

Phasor ForcedMotion::motion(const assembly::Combination &combination) const {
    Phasor out;
    for (const auto &[unknown, value] : combination) {
        if (_planar) {
            out.x += value * _displacements(unknown);
        } else {
            out.x += value * _displacements(2 * unknown);
            out.y += value * _displacements(2 * unknown + 1);
        }
    }
    if (_planar)
        out.y = -imaginary_unit * out.x;
    return out;
}

Phasor ForcedMotion::bearing_force(int bearing) const {
    const model::Bearing &b = _discretization.rotor().bearings[static_cast<std::size_t>(bearing)];
    assembly::Combination stretch = _discretization.deflection_at(b.z);
    if (b.pedestal)
        stretch.emplace_back(_discretization.pedestal_unknown(bearing), -1.0);
    const Phasor u = motion(stretch);
    const model::BearingCoefficients at = b.at(_speed);
    const Eigen::Vector2cd force =
        (at.k + imaginary_unit * _speed * at.c) * Eigen::Vector2cd(u.x, u.y);
    return {force(0), force(1)};
}

} // namespace whirl::analyses
