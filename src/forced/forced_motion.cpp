#include "forced/forced_motion.h"

#include "assembly/planar_part.h"
#include "assembly/planes.h"
#include "assembly/system.h"
#include "linalg/check.h"
#include "linalg/sparse_factor.h"
#include "linalg/unit_scales.h"
#include "model/errors.h"
#include "modes/formulation.h"
#include "results/formulation.h"
#include "synchronous/parts.h"

#include <cmath>
#include <limits>
#include <vector>

namespace whirl::forced {

std::complex<double> reading(const Phasor &motion, double angle) {
    return motion.x * std::cos(angle) + motion.y * std::sin(angle);
}

Eigen::VectorXcd imbalance_loads(const assembly::Discretization &discretization) {
    Eigen::VectorXcd out = Eigen::VectorXcd::Zero(discretization.planar_size());
    for (const model::Imbalance &imbalance : discretization.rotor().imbalances)
        for (const auto &[unknown, value] : discretization.deflection_at(imbalance.z))
            out(unknown) += value * imbalance.mr * std::polar(1.0, imbalance.phase);
    return out;
}

Eigen::VectorXd weight_loads(const assembly::Discretization &discretization) {
    return assembly::planar_part(discretization, assembly::Term::mass) *
           discretization.rigid_motion(false);
}

assembly::Combination stretch_of_bearing(const assembly::Discretization &discretization,
                                         int bearing) {
    const model::Bearing &b = discretization.rotor().bearings[static_cast<std::size_t>(bearing)];
    assembly::Combination stretch = discretization.deflection_at(b.z);
    if (b.pedestal)
        stretch.emplace_back(discretization.pedestal_unknown(bearing), -1.0);
    return stretch;
}

ForcedMotion::ForcedMotion(const assembly::Discretization &discretization, results::Form form,
                           Drive drive)
    : _discretization(discretization), _drive(drive),
      _planar(!drive.weight() &&
              (form == results::Form::planar || form == results::Form::rotating)),
      _rotating(form == results::Form::rotating),
      _rows(synchronous::table_speeds(discretization.rotor())) {
    if (drive.weight())
        _weight = weight_loads(discretization);
}

namespace {

/// Takes what is multiplied by the speed out of A, which is linear between two speeds, into
/// `per_speed`.
void split(double from, linalg::Matrix &A, double to, const linalg::Matrix &A_to,
           linalg::Matrix &per_speed) {
    const double width = to - from;
    const linalg::Matrix slope = linalg::Matrix::sum(-1 / width, A, 1 / width, A_to);
    A = linalg::Matrix::sum(to / width, A, -from / width, A_to);
    per_speed = linalg::Matrix::sum(1, per_speed, 1, slope);
}

} // namespace

assembly::RotatingSystem ForcedMotion::rotating_system(double from, double to) const {
    assembly::RotatingSystem out = assembly::assemble_rotating(_discretization, from, {});
    if (to > from) { // (K + s dK) + s (Ks + s dKs) + s^2 Kss, C + s (Cs + dC)
        const assembly::RotatingSystem end = assembly::assemble_rotating(_discretization, to, {});
        split(from, out.Ks, to, end.Ks, out.Kss);
        split(from, out.K, to, end.K, out.Ks);
        split(from, out.C, to, end.C, out.Cs);
    }
    return out;
}

assembly::FixedSystem ForcedMotion::fixed_system(double from, double to) const {
    assembly::FixedSystem out = synchronous::turned_system(_discretization, _planar, from);
    if (to > from) { // (K + s dK) + s Kc + i s (C + s dC + s G) - s^2 M
        const assembly::FixedSystem end = synchronous::turned_system(_discretization, _planar, to);
        split(from, out.K, to, end.K, out.Kc);
        split(from, out.C, to, end.C, out.G);
    }
    if (_drive.weight()) // stands still
        for (linalg::Matrix *moving : {&out.M, &out.C, &out.G})
            *moving = linalg::Matrix::from_entries(out.K.size(), {});
    return out;
}

void ForcedMotion::assemble(double from, double to) {
    if (!_rotating) {
        _solver = std::make_unique<linalg::HarmonicSolver>(fixed_system(from, to));
        return;
    }
    assembly::RotatingSystem s = rotating_system(from, to);
    if (!_drive.weight()) {
        _turning = std::make_unique<assembly::RotatingSystem>(std::move(s));
        return;
    }
    _solver = std::make_unique<linalg::HarmonicSolver>(
        linalg::HarmonicTerms{linalg::Matrix::sum(1, s.M, -1, s.Kss), std::move(s.C),
                              std::move(s.Cs), std::move(s.K), std::move(s.Ks)});
}

void ForcedMotion::enter_piece(double speed) {
    const synchronous::TablePiece piece = synchronous::table_piece(_rows, speed);
    if (piece.index == _piece)
        return;
    assemble(piece.from, piece.to);
    _piece = piece.index;
}

int ForcedMotion::size() const { return (_planar ? 1 : 2) * _discretization.planar_size(); }

Eigen::VectorXcd ForcedMotion::imbalance_forces(double speed) const {
    const Eigen::VectorXcd planar = (speed * speed) * imbalance_loads(_discretization);
    if (_planar)
        return planar;
    return assembly::in_pairs(planar, -imaginary_unit * planar); // sin = Re(-i exp)
}

/// -i g on w, in rotating axes -i g exp(-i Omega t) on u: x = Re(conj(-i g) exp(i Omega t)), y a
/// quarter turn ahead.
Eigen::VectorXcd ForcedMotion::weight_forces() const {
    const Eigen::VectorXcd load = imaginary_unit * _drive.gravity * _weight;
    return assembly::in_pairs((_rotating ? 1 : 0) * load, imaginary_unit * load);
}

void ForcedMotion::solve_in_rotating_axes(double speed) {
    const Eigen::VectorXcd f = imbalance_forces(speed);
    Eigen::VectorXd real(2 * f.size());
    real(Eigen::seqN(0, f.size(), 2)) = f.real();
    real(Eigen::seqN(1, f.size(), 2)) = f.imag();
    const linalg::Matrix stiffness = _turning->stiffness(speed);
    const Eigen::VectorXd scales = linalg::unit_scales(_turning->K, _turning->M);
    const Eigen::SparseMatrix<double> K =
        linalg::scaled(Eigen::SparseMatrix<double>(stiffness.view()), scales);
    real.array() *= scales.array();
    linalg::SparseFactor<double> factors;
    if (!factors.factorize(K))
        throw linalg::SolverError("singular stiffness in rotating axes");
    const Eigen::VectorXd u = factors.solution(real);
    // A small change of the entries of K by rounding moves u by so much of itself.
    const Eigen::VectorXd change = factors.solution(K.cwiseAbs() * u.cwiseAbs());
    _rounding = std::numeric_limits<double>::epsilon() * change.norm() /
                std::max(u.norm(), std::numeric_limits<double>::min());
    const Eigen::VectorXd motion = scales.cwiseProduct(u);
    _displacements.resize(f.size());
    _displacements.real() = motion(Eigen::seqN(0, f.size(), 2));
    _displacements.imag() = motion(Eigen::seqN(1, f.size(), 2));
}

void ForcedMotion::solve(double speed) {
    _speed = speed;
    if (speed == 0 && !_drive.weight()) { // no force; a free rotor's matrix would be singular
        _displacements = Eigen::VectorXcd::Zero(size());
        _rounding = 0;
        return;
    }
    enter_piece(speed);
    if (_rotating && !_drive.weight()) {
        solve_in_rotating_axes(speed);
        return;
    }
    const Eigen::VectorXcd forces = _drive.weight() ? weight_forces() : imbalance_forces(speed);
    _displacements = _solver->solve(speed, forces);
    _rounding = _solver->rounding(forces, _displacements);
}

Phasor ForcedMotion::pair(const assembly::Combination &combination) const {
    Phasor out;
    for (const auto &[unknown, value] : combination) {
        out.x += value * _displacements(2 * unknown);
        out.y += value * _displacements(2 * unknown + 1);
    }
    return out;
}

Phasor ForcedMotion::motion(const assembly::Combination &combination) const {
    if (!_planar && !_drive.weight())
        return pair(combination);
    std::complex<double> w;
    if (_planar)
        for (const auto &[unknown, value] : combination)
            w += value * _displacements(unknown);
    else if (_rotating)
        w = WhirlParts(pair(combination)).a;
    return {w, -imaginary_unit * w};
}

std::complex<double> ForcedMotion::at_rest(const assembly::Combination &combination) const {
    const Phasor q = pair(combination);
    return _rotating ? std::conj(WhirlParts(q).d) : q.x.real() + imaginary_unit * q.y.real();
}

std::complex<double> ForcedMotion::bearing_force_at_rest(int bearing) const {
    const std::complex<double> u = at_rest(stretch_of_bearing(_discretization, bearing));
    const Eigen::Vector2d force =
        _discretization.rotor().bearings[static_cast<std::size_t>(bearing)].at(_speed).k *
        Eigen::Vector2d(u.real(), u.imag());
    return {force(0), force(1)};
}

Eigen::MatrixXcd ForcedMotion::planar_motion() const {
    if (_planar)
        return _displacements;
    return _displacements.reshaped<Eigen::RowMajor>(_displacements.size() / 2, 2);
}

Phasor ForcedMotion::bearing_force(int bearing) const {
    const Phasor u = motion(stretch_of_bearing(_discretization, bearing));
    const model::BearingCoefficients at =
        _discretization.rotor().bearings[static_cast<std::size_t>(bearing)].at(_speed);
    const double frequency = (_drive.weight() ? 2 : 1) * _speed;
    const Eigen::Vector2cd force =
        (at.k - frequency * frequency * at.m + imaginary_unit * frequency * at.c) *
        Eigen::Vector2cd(u.x, u.y);
    return {force(0), force(1)};
}

results::Formulation response_formulation(const model::Case &scene) {
    model::Case without = scene; // the response leaves balancers out
    without.rotor.balancers.clear();
    if (without.rotor.rotating_anisotropy() || scene.formulation == model::FormChoice::rotating) {
        const results::Formulation formulation = modes::choose_formulation(without);
        if (formulation.form == results::Form::hill)
            throw model::AnalysisFailure(
                "the response of an asymmetric rotor on bearings that differ between their "
                "directions has many frequencies and is not computed; use bearings that are the "
                "same from every direction, or remove the asymmetry");
        return formulation;
    }
    const bool torque = scene.rotor.shaft.axial_torque != 0;
    const bool isotropic = scene.rotor.bearings_isotropic() && !torque;
    const std::string couples = torque ? "axial torque couples x and y"
                                       : "a bearing differs between x and y or couples them";
    if (scene.formulation == model::FormChoice::planar && !isotropic)
        throw model::BadInput("formulation: expected one that can describe the scene, got "
                              "\"planar\": " +
                              couples);
    if (scene.formulation == model::FormChoice::planar)
        return {results::Form::planar, "asked for by the case"};
    if (scene.formulation != model::FormChoice::automatic)
        return {results::Form::general, "asked for by the case: forced motion in x and y"};
    if (isotropic)
        return {results::Form::planar,
                "isotropic bearings, axisymmetric rotor: the motion is circular and "
                "w = x + i y halves the unknowns"};
    return {results::Form::general, couples + ": forced motion in x and y"};
}

} // namespace whirl::forced
