#include "forced/forced_motion.h"

#include "assembly/planar_part.h"
#include "assembly/planes.h"
#include "assembly/system.h"
#include "linalg/check.h"
#include "model/errors.h"
#include "modes/formulation.h"
#include "results/formulation.h"
#include "synchronous/parts.h"

#include <cmath>
#include <stdexcept>
#include <utility>
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

Eigen::VectorXcd force_loads(const assembly::Discretization &discretization,
                             const std::vector<Push> &forces) {
    Eigen::VectorXcd out = Eigen::VectorXcd::Zero(2 * discretization.planar_size());
    for (const Push &push : forces)
        for (const auto &[unknown, value] : discretization.deflection_at(push.z)) {
            out(2 * unknown) += value * push.force.x;
            out(2 * unknown + 1) += value * push.force.y;
        }
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
    : _discretization(discretization), _drive(std::move(drive)),
      _planar(_drive.imbalances() &&
              (form == results::Form::planar || form == results::Form::rotating)),
      _rotating(form == results::Form::rotating),
      _rows(synchronous::table_speeds(discretization.rotor())) {
    if (_drive.weight())
        _weight = weight_loads(discretization);
    if (!_drive.forces.empty() && form != results::Form::general)
        throw std::logic_error("forces of one frequency are solved in x and y of the fixed frame");
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

linalg::HarmonicTerms ForcedMotion::terms(double bearing_speed) const {
    if (!_rotating)
        return synchronous::turned_system(_discretization, _planar, bearing_speed);
    assembly::RotatingSystem s = assembly::assemble_rotating(_discretization, bearing_speed, {});
    return {std::move(s.M), std::move(s.C),  std::move(s.Cs),
            std::move(s.K), std::move(s.Ks), std::move(s.Kss)};
}

void ForcedMotion::enter_piece(double speed) {
    const synchronous::TablePiece piece = synchronous::table_piece(_rows, speed);
    if (piece.index == _piece)
        return;
    linalg::HarmonicTerms all = terms(piece.from);
    if (piece.to > piece.from) { // (K + s dK) + s (Kc + s dKc) + s^2 Kss, C + s (G + dC)
        const linalg::HarmonicTerms end = terms(piece.to);
        if (_rotating)
            split(piece.from, all.Kc, piece.to, end.Kc, all.Kss);
        split(piece.from, all.K, piece.to, end.K, all.Kc);
        split(piece.from, all.C, piece.to, end.C, all.G);
    }
    _solver = std::make_unique<linalg::HarmonicSolver>(all);
    _piece = piece.index;
}

int ForcedMotion::size() const { return (_planar ? 1 : 2) * _discretization.planar_size(); }

/// Imbalances: speed^2 on w, standing still in rotating axes. Weight: -i g on w, in rotating axes
/// -i g exp(-i Omega t) on u: x = Re(conj(-i g) exp(i Omega t)), y a quarter turn ahead.
Eigen::VectorXcd ForcedMotion::forces(double speed) const {
    if (_drive.weight()) {
        const Eigen::VectorXcd load = imaginary_unit * _drive.gravity * _weight;
        return assembly::in_pairs((_rotating ? 1 : 0) * load, imaginary_unit * load);
    }
    const Eigen::VectorXcd w = (speed * speed) * imbalance_loads(_discretization);
    if (!_drive.forces.empty()) {
        Eigen::VectorXcd load = force_loads(_discretization, _drive.forces);
        if (_drive.unbalanced)
            load += assembly::in_pairs(w, -imaginary_unit * w);
        return load;
    }
    if (_rotating)
        return assembly::in_pairs(w.real().cast<std::complex<double>>(),
                                  w.imag().cast<std::complex<double>>());
    if (_planar)
        return w;
    return assembly::in_pairs(w, -imaginary_unit * w); // sin = Re(-i exp)
}

void ForcedMotion::solve(double speed) {
    _speed = speed;
    if (speed == 0 && _drive.imbalances()) { // no force; a free rotor's matrix would be singular
        _displacements = Eigen::VectorXcd::Zero(size());
        _rounding = 0;
        return;
    }
    const double spin = _drive.sweep.spin_at(speed);
    enter_piece(spin);
    const Eigen::VectorXcd load = forces(speed);
    _displacements = _solver->solve(spin, frequency(speed), load);
    _rounding = _solver->rounding(load, _displacements);
    if (_rotating && _drive.imbalances()) // (x, y) stand still: w = x + i y
        _displacements = (_displacements(Eigen::seq(0, Eigen::last, 2)) +
                          imaginary_unit * _displacements(Eigen::seq(1, Eigen::last, 2)))
                             .eval();
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

Phasor ForcedMotion::of(const Quantity &quantity) const {
    if (quantity.film)
        return stretch(*quantity.film);
    return quantity.bearing == Quantity::deflection ? quantity.seen(at(quantity.z))
                                                    : bearing_force(quantity.bearing);
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
    const Phasor u = stretch(bearing);
    const model::BearingCoefficients at =
        _discretization.rotor().bearings[static_cast<std::size_t>(bearing)].at(
            _drive.sweep.spin_at(_speed));
    const double frequency = _drive.frequency_at(_speed);
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
