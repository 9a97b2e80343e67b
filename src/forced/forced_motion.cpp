#include "forced/forced_motion.h"

#include "assembly/planar_part.h"
#include "assembly/planes.h"
#include "assembly/system.h"
#include "linalg/check.h"
#include "model/errors.h"
#include "modes/formulation.h"
#include "results/formulation.h"
#include "synchronous/parts.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

namespace whirl::forced {

std::complex<double> reading(const Phasor &motion, double angle) {
    return motion.x * std::cos(angle) + motion.y * std::sin(angle);
}

Eigen::VectorXcd imbalance_loads(const assembly::Discretization &discretization) {
    return imbalance_loads(discretization, discretization.rotor().imbalances);
}

Eigen::VectorXcd imbalance_loads(const assembly::Discretization &discretization,
                                 const std::vector<model::Imbalance> &imbalances) {
    Eigen::VectorXcd out = Eigen::VectorXcd::Zero(discretization.planar_size());
    for (const model::Imbalance &imbalance : imbalances)
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

assembly::Combination stretch_of_probe(const assembly::Discretization &discretization,
                                       const model::Probe &probe) {
    const auto on = discretization.rotor().pedestal_of(probe);
    if (probe.on_pedestal && on)
        return {{discretization.pedestal_unknown(static_cast<int>(*on)), 1.0}};
    assembly::Combination stretch = discretization.deflection_at(probe.z);
    if (on && probe.relative.value_or(false))
        stretch.emplace_back(discretization.pedestal_unknown(static_cast<int>(*on)), -1.0);
    return stretch;
}

assembly::Combination stretch_of(const assembly::Discretization &discretization,
                                 const Quantity &quantity) {
    if (quantity.film)
        return stretch_of_bearing(discretization, *quantity.film);
    if (quantity.pedestal)
        return {{discretization.pedestal_unknown(*quantity.pedestal), 1.0}};
    if (quantity.probe)
        return stretch_of_probe(discretization, *quantity.probe);
    return discretization.deflection_at(quantity.z);
}

Eigen::Matrix2d all_round(const Eigen::Matrix2d &block) {
    const double along = block.trace() / 2;
    const double across = (block(1, 0) - block(0, 1)) / 2;
    return Eigen::Matrix2d{{along, -across}, {across, along}};
}

Eigen::Matrix2d quarter_turned(const Eigen::Matrix2d &block) {
    return Eigen::Matrix2d{{-block(1, 0), -block(1, 1)}, {block(0, 0), block(0, 1)}};
}

ForcedMotion::ForcedMotion(const assembly::Discretization &discretization, results::Form form,
                           Drive drive, bool smooth)
    : _discretization(discretization), _drive(std::move(drive)),
      _planar(_drive.imbalances() && form == results::Form::planar),
      _rotating(form == results::Form::rotating), _smooth(smooth) {
    const std::vector<model::Bearing> &bearings = discretization.rotor().bearings;
    for (int i = 0; i < static_cast<int>(bearings.size()); ++i)
        if (bearings[static_cast<std::size_t>(i)].depends_on_speed())
            _tabled.push_back(i);
    if (_drive.weight())
        _weight = weight_loads(discretization);
    if (!_drive.forces.empty() && form != results::Form::general)
        throw std::logic_error("forces of one frequency are solved in x and y of the fixed frame");
}

void ForcedMotion::add_films(const std::vector<int> &bearings, double coefficients_at, double spin,
                             double frequency, double share,
                             linalg::HarmonicSolver::Entries &out) const {
    const auto add = [&](assembly::Term term, int i, int j, const Eigen::Matrix2d &block) {
        Eigen::Matrix2cd A = Eigen::Matrix2cd::Zero();
        const Eigen::Matrix2d b = _rotating ? all_round(block) : block;
        if (term == assembly::Term::stiffness)
            A = b.cast<std::complex<double>>();
        if (term == assembly::Term::mass)
            A = (-frequency * frequency * b).cast<std::complex<double>>();
        if (term == assembly::Term::damping) {
            A = imaginary_unit * frequency * b.cast<std::complex<double>>();
            if (_rotating) // the axes turn
                A += (spin * quarter_turned(b)).cast<std::complex<double>>();
        }
        if (_planar)
            out.emplace_back(i, j, share * A(0, 0));
        for (int k = 0; k < (_planar ? 0 : 4); ++k)
            out.emplace_back(2 * i + k / 2, 2 * j + k % 2, share * A(k / 2, k % 2));
    };
    for (const int bearing : bearings)
        assembly::assemble_film(_discretization, bearing, coefficients_at, add);
}

linalg::HarmonicSolver::Entries ForcedMotion::films(const std::vector<int> &bearings, double spin,
                                                    double speed) const {
    linalg::HarmonicSolver::Entries out;
    add_films(bearings, spin, _drive.sweep.spin_at(speed), frequency(speed), 1, out);
    return out;
}

linalg::HarmonicSolver::Entries ForcedMotion::table_changes(double spin, double frequency) const {
    linalg::HarmonicSolver::Entries out;
    add_films(_tabled, spin, spin, frequency, 1, out);
    add_films(_tabled, 0, spin, frequency, -1, out);
    return out;
}

namespace {

/// x and y move each other. Where they do not, one that is not driven stays at zero to the last
/// digit if the two are solved for as they are.
bool couples(const linalg::HarmonicTerms &terms, bool at_rest,
             const linalg::HarmonicSolver::Entries &changes) {
    const auto of = [](const linalg::Matrix &A) {
        const linalg::SparseView view = A.view();
        for (Eigen::Index i = 0; i < view.outerSize(); ++i)
            for (linalg::SparseView::InnerIterator entry(view, i); entry; ++entry)
                if (entry.value() != 0 && entry.row() % 2 != entry.col() % 2)
                    return true;
        return false;
    };
    return of(terms.K) || of(terms.C) || of(terms.M) ||
           (!at_rest && (of(terms.G) || of(terms.Kc))) ||
           std::ranges::any_of(changes, [](const auto &change) {
               return change.value() != 0.0 && change.row() % 2 != change.col() % 2;
           });
}

} // namespace

void ForcedMotion::assemble(double spin) {
    constexpr double any = 1; // rad/s: no frequency that a coefficient is not multiplied by
    const linalg::HarmonicSolver::Entries changes = table_changes(spin, any);
    _at_rest = spin == 0;
    if (!_rotating) {
        const linalg::HarmonicTerms terms = synchronous::turned_system(_discretization, _planar, 0);
        _solver = std::make_unique<linalg::HarmonicSolver>(
            terms, !_planar && couples(terms, _at_rest, changes), changes, _smooth);
        return;
    }
    assembly::RotatingSystem s = assembly::assemble_rotating(_discretization, 0, {});
    const linalg::HarmonicTerms terms{std::move(s.M), std::move(s.C),  std::move(s.Cs),
                                      std::move(s.K), std::move(s.Ks), std::move(s.Kss)};
    _solver = std::make_unique<linalg::HarmonicSolver>(terms, false, changes, _smooth);
}

Eigen::MatrixXcd ForcedMotion::forces(double speed) const {
    if (_drive.sets.empty())
        return forces_of(speed, _discretization.rotor().imbalances);
    Eigen::MatrixXcd out;
    for (const auto &set : _drive.sets) {
        const Eigen::VectorXcd own = forces_of(speed, set);
        out.conservativeResize(own.size(), out.cols() + 1);
        out.rightCols(1) = own;
    }
    return out;
}

/// Imbalances: speed^2 on w, standing still in rotating axes. Weight: -i g on w, in rotating axes
/// -i g exp(-i Omega t) on u: x = Re(conj(-i g) exp(i Omega t)), y 90° ahead.
Eigen::VectorXcd ForcedMotion::forces_of(double speed,
                                         const std::vector<model::Imbalance> &imbalances) const {
    if (_drive.weight()) {
        const Eigen::VectorXcd load = imaginary_unit * _drive.gravity * _weight;
        return assembly::in_pairs((_rotating ? 1 : 0) * load, imaginary_unit * load);
    }
    const Eigen::VectorXcd w = (speed * speed) * imbalance_loads(_discretization, imbalances);
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
        _displacements = Eigen::VectorXcd::Zero(planes() * _discretization.planar_size());
        _solutions.resize(0, 0);
        _rounding = 0;
        return;
    }
    const double spin = _drive.sweep.spin_at(speed);
    if (!_solver || _at_rest != (spin == 0))
        assemble(spin);
    _loads = forces(speed);
    _solutions =
        _solver->solve(spin, frequency(speed), _loads, table_changes(spin, frequency(speed)));
    _rounding.reset();
    look_at(0);
}

void ForcedMotion::look_at(std::size_t set) {
    if (_solutions.size() == 0) // at rest none moves
        return;
    _displacements = _solutions.col(static_cast<Eigen::Index>(set));
}

Eigen::MatrixXcd ForcedMotion::under(const Eigen::MatrixXcd &forces) {
    const double spin = _drive.sweep.spin_at(_speed);
    return _solver->solve(spin, frequency(_speed), forces, table_changes(spin, frequency(_speed)));
}

double ForcedMotion::rounding() const {
    if (_rounding)
        return *_rounding;
    double largest = 0;
    for (Eigen::Index set = 0; set < _loads.cols(); ++set)
        largest = std::max(largest, _solver->rounding(_loads.col(set), _solutions.col(set)));
    _rounding = largest;
    return largest;
}

Phasor ForcedMotion::as_solved(const assembly::Combination &combination,
                               const Eigen::Ref<const Eigen::VectorXcd> &displacements) const {
    Phasor out;
    for (const auto &[unknown, value] : combination) {
        out.x += value * displacements(planes() * unknown);
        if (!_planar)
            out.y += value * displacements(2 * unknown + 1);
    }
    return out;
}

Phasor ForcedMotion::in_fixed_frame(const Phasor &as_solved) const {
    const auto circle = [](std::complex<double> w) { return Phasor{w, -imaginary_unit * w}; };
    if (_planar)
        return circle(as_solved.x);
    if (stands_still()) // w = x + i y
        return circle(as_solved.x + imaginary_unit * as_solved.y);
    if (_drive.weight())
        return circle(_rotating ? WhirlParts(as_solved).a : 0);
    return as_solved;
}

Phasor ForcedMotion::motion(const assembly::Combination &combination) const {
    return in_fixed_frame(as_solved(combination, _displacements));
}

Phasor ForcedMotion::of(const Quantity &quantity) const {
    return quantity.bearing == Quantity::deflection
               ? quantity.seen(motion(stretch_of(_discretization, quantity)))
               : bearing_force(quantity.bearing);
}

std::complex<double> ForcedMotion::at_rest(const assembly::Combination &combination) const {
    const Phasor q = as_solved(combination, _displacements);
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
    const Eigen::MatrixXcd pairs =
        _displacements.reshaped<Eigen::RowMajor>(_displacements.size() / 2, 2);
    if (stands_still()) // w = x + i y
        return pairs.col(0) + imaginary_unit * pairs.col(1);
    return pairs;
}

Phasor ForcedMotion::bearing_force(int bearing, const Phasor &stretch, double speed) const {
    const model::BearingCoefficients at =
        _discretization.rotor().bearings[static_cast<std::size_t>(bearing)].at(
            _drive.sweep.spin_at(speed));
    const double w = _drive.frequency_at(speed);
    const Eigen::Vector2cd force =
        (at.k - w * w * at.m + imaginary_unit * w * at.c) * Eigen::Vector2cd(stretch.x, stretch.y);
    return {force(0), force(1)};
}

results::Formulation response_formulation(const model::Case &scene) {
    model::Case without = scene; // the response leaves balancers out
    without.rotor.balancers.clear();
    if (without.rotor.rotating_anisotropy() || scene.formulation == model::FormChoice::rotating) {
        const results::Formulation formulation = modes::choose_formulation(without);
        if (formulation.form == results::Form::hill)
            throw model::AnalysisFailure(
                "an asymmetric rotor on anisotropic bearings responds at many "
                "frequencies, which only `response` computes");
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
