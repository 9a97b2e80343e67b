#include "forced/reduced_motion.h"

#include "assembly/planes.h"
#include "linalg/check.h"
#include "linalg/dense/products.h"
#include "modes/orbits.h"
#include "synchronous/parts.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl::forced {

namespace {

using Complex = std::complex<double>;

/// Rotors with no more planar unknowns are kept whole.
constexpr int few_unknowns = 24;

double slope_of_modulus(Complex value, Complex slope) {
    const double size = std::abs(value);
    return size > 0 ? (std::conj(value) * slope).real() / size : std::abs(slope);
}

/// Real and imaginary parts of motions, turned so that the real part is as large as it gets; the
/// other where it is more than that part of the motion.
Eigen::MatrixXd real_parts(const Eigen::MatrixXcd &motions, double part) {
    Eigen::MatrixXd out(motions.rows(), 2 * motions.cols());
    Eigen::Index count = 0;
    for (Eigen::Index j = 0; j < motions.cols(); ++j) {
        const Complex square = motions.col(j).cwiseProduct(motions.col(j)).sum();
        const Eigen::VectorXcd turned = motions.col(j) * std::polar(1.0, -std::arg(square) / 2);
        out.col(count++) = turned.real();
        if (turned.imag().norm() > part * turned.norm())
            out.col(count++) = turned.imag();
    }
    return out.leftCols(count);
}

} // namespace

double Reading::major() const { return modes::ellipse_of(value.x, value.y).major; }

double Reading::major_slope() const {
    const WhirlParts of_value(value);
    const WhirlParts of_slope(slope);
    return slope_of_modulus(of_value.a, of_slope.a) + slope_of_modulus(of_value.d, of_slope.d);
}

ReducedMotion::ReducedMotion(const assembly::Discretization &discretization, results::Form form,
                             double top, std::vector<Quantity> quantities, Drive drive,
                             bool reduction)
    : _discretization(discretization), _form(form), _drive(std::move(drive)),
      _quantities(std::move(quantities)) {
    if (_drive.sweep.spin_rate != 0)
        _rows = rows_of_straight_pieces(discretization.rotor());
    make_shapes(std::max(std::abs(_drive.frequency_at(0)), std::abs(_drive.frequency_at(top))),
                reduction);
    take_in(Eigen::MatrixXcd(discretization.planar_size(), 0), 1);
}

/// @param top  rad/s, of the fastest motion in the fixed frame
void ReducedMotion::make_shapes(double top, bool reduction) {
    const int n = _discretization.planar_size();
    _whole = !reduction || n <= few_unknowns;
    if (!_whole)
        try {
            _shapes = std::make_unique<reduction::PlanarShapes>(_discretization, top);
            std::vector<assembly::Combination> loaded;
            if (_drive.weight()) {
                const Eigen::VectorXd load = weight_loads(_discretization);
                loaded.emplace_back();
                for (int i = 0; i < n; ++i)
                    loaded.back().emplace_back(i, load(i));
            }
            for (const Push &push : _drive.forces)
                loaded.push_back(_discretization.deflection_at(push.z));
            if (_drive.imbalances() || _drive.unbalanced) {
                for (const model::Imbalance &imbalance : _discretization.rotor().imbalances)
                    loaded.push_back(_discretization.deflection_at(imbalance.z));
            }
            _shapes->add_static(loaded);
        } catch (const linalg::SolverError &) { // bearings push away
            _whole = true;
        }
    if (_whole)
        _shapes = std::make_unique<reduction::PlanarShapes>(_discretization, top,
                                                            Eigen::MatrixXd::Identity(n, n));
}

bool ReducedMotion::lacks(const Eigen::MatrixXcd &motions, double newness) const {
    reduction::PlanarShapes widened = *_shapes;
    widened.add_newest_first(real_parts(motions, newness), newness);
    return widened.matrix().cols() > _shapes->matrix().cols();
}

void ReducedMotion::take_in(const Eigen::MatrixXcd &motions, double newness) {
    _shapes->add_newest_first(real_parts(motions, newness), newness);
    _pieces.clear();
    _piece = nullptr;
    _at_first_row.reset();
    _terms = std::make_unique<ShapeTerms>(_discretization, _form, _drive, _shapes->matrix());
    _b = loads();
    const Eigen::MatrixXd &V = _shapes->matrix();
    _stretches.setZero(static_cast<Eigen::Index>(_quantities.size()), V.cols());
    for (std::size_t i = 0; i < _quantities.size(); ++i)
        for (const auto &[unknown, value] : _quantities[i].stretch)
            _stretches.row(static_cast<Eigen::Index>(i)) += value * V.row(unknown);
    set_read();
}

void ReducedMotion::set_read() {
    const Eigen::Index shapes = _stretches.cols();
    if (_drive.weight()) {
        _read.setIdentity(2 * shapes, 2 * shapes);
    } else if (_form == results::Form::planar) {
        _read = _stretches;
    } else {
        _read.setZero(2 * _stretches.rows(), 2 * shapes);
        for (Eigen::Index i = 0; i < 2; ++i)
            _read(Eigen::seqN(i, _stretches.rows(), 2), Eigen::seqN(i, shapes, 2)) = _stretches;
    }
}

std::pair<Eigen::Index, Eigen::Index> ReducedMotion::read_of(std::size_t quantity) const {
    if (_drive.weight())
        return {0, _read.rows()};
    const Eigen::Index each = _form == results::Form::planar ? 1 : 2;
    return {each * static_cast<Eigen::Index>(quantity), each};
}

std::vector<double> ReducedMotion::cuts(double from, double to) const {
    std::vector<double> out{from};
    for (const double row : _rows)
        if (row > from && row < to)
            out.push_back(row);
    out.push_back(to);
    return out;
}

QuadraticTerms ReducedMotion::terms(double bearing_speed) const {
    if (_rows.empty()) // constant coefficients, or a constant spin speed
        return _terms->at(_drive.sweep.spin_at(bearing_speed));
    if (!_at_first_row) // nothing but the bearings changes from row to row
        _at_first_row = _terms->at(_rows.front());
    QuadraticTerms out = *_at_first_row;
    if (bearing_speed != _rows.front()) {
        _terms->add_bearings(_rows.front(), -1, out);
        _terms->add_bearings(bearing_speed, 1, out);
    }
    return out;
}

Eigen::MatrixXcd ReducedMotion::loads() const {
    if (_drive.weight())
        return weight();
    if (_drive.imbalances())
        return imbalances();
    Eigen::MatrixXcd out = forces();
    if (_drive.unbalanced) {
        out.conservativeResize(Eigen::NoChange, 2);
        out.col(1) = imbalances();
    }
    return out;
}

std::pair<Eigen::VectorXcd, Eigen::VectorXcd> ReducedMotion::factors_of_loads(double s) const {
    Eigen::VectorXcd value = Eigen::VectorXcd::Ones(_b.cols());
    Eigen::VectorXcd slope = Eigen::VectorXcd::Zero(_b.cols());
    if (_drive.imbalances() || _drive.unbalanced) { // the last
        value(_b.cols() - 1) = s * s;
        slope(_b.cols() - 1) = 2 * s;
    }
    return {value, slope};
}

Eigen::VectorXcd ReducedMotion::forces() const {
    const Eigen::VectorXcd f = force_loads(_discretization, _drive.forces);
    const Eigen::VectorXcd x = f(Eigen::seq(0, Eigen::last, 2));
    const Eigen::VectorXcd y = f(Eigen::seq(1, Eigen::last, 2));
    const Eigen::MatrixXcd across = _shapes->matrix().transpose().cast<Complex>();
    return assembly::in_pairs(linalg::times(across, x), linalg::times(across, y));
}

Eigen::VectorXcd ReducedMotion::imbalances() const {
    Eigen::VectorXcd f = _shapes->matrix().transpose() * imbalance_loads(_discretization);
    if (_form == results::Form::planar)
        return f;
    if (_form == results::Form::rotating) // x + i y stands still
        return assembly::in_pairs(f.real().cast<Complex>(), f.imag().cast<Complex>());
    return assembly::in_pairs(f, -imaginary_unit * f);
}

Eigen::VectorXcd ReducedMotion::weight() const { // as ForcedMotion::weight_forces
    const Eigen::VectorXd load = _shapes->matrix().transpose() * weight_loads(_discretization);
    const Eigen::VectorXcd f = imaginary_unit * _drive.gravity * load.cast<Complex>();
    return assembly::in_pairs(f, imaginary_unit * f);
}

ReducedMotion::Piece ReducedMotion::piece_between(double from, double to) const {
    Piece piece;
    piece.from = from;
    piece.to = to;
    piece.P = terms(from);
    if (!(to > from))
        return piece;
    // the bearings enter the constant and the linear term, both linear in s
    const QuadraticTerms b = terms(to);
    const Eigen::MatrixXcd change0 = (b.P0 - piece.P.P0) / (to - from);
    const Eigen::MatrixXcd change1 = (b.P1 - piece.P.P1) / (to - from);
    piece.P.P0 -= from * change0;
    piece.P.P1 += change0 - from * change1;
    piece.P.P2 += change1;
    auto bent = std::make_unique<BentSupports>(_discretization, *_terms, from, to);
    if (!bent->none())
        piece.bent = std::move(bent);
    return piece;
}

void ReducedMotion::enter_piece(double inside) {
    const synchronous::TablePiece piece = synchronous::table_piece(_rows, inside);
    auto known = _pieces.find(piece.index);
    if (known == _pieces.end())
        known = _pieces.emplace(piece.index, piece_between(piece.from, piece.to)).first;
    _piece = &known->second;
}

const QuadraticResolvent &ReducedMotion::resolvent(double from, double to) {
    if (_piece->resolvent && _piece->resolved == std::pair(from, to))
        return *_piece->resolvent;
    _piece->resolved = {from, to};
    Eigen::MatrixXcd sides = _b;
    Eigen::MatrixXd rows = _read;
    if (_piece->bent) {
        const Eigen::MatrixXd &B = _piece->bent->columns();
        sides.conservativeResize(Eigen::NoChange, _b.cols() + B.cols());
        sides.rightCols(B.cols()) = B.cast<Complex>();
        rows.conservativeResize(rows.rows() + B.cols(), Eigen::NoChange);
        rows.bottomRows(B.cols()) = B.transpose();
    }
    _piece->resolvent = std::make_unique<QuadraticResolvent>(_piece->P, sides, rows, from, to,
                                                             _piece->bent != nullptr);
    _piece->poles = _piece->resolvent->poles();
    if (_piece->bent)
        _piece->poles = _piece->bent->poles(_piece->P, _piece->poles);
    return *_piece->resolvent;
}

std::vector<std::complex<double>> ReducedMotion::poles(double from, double to) {
    (void)resolvent(from, to);
    return _piece->poles;
}

QuadraticResolvent::Solution ReducedMotion::quick(double speed, Eigen::Index first,
                                                  Eigen::Index count) const {
    if (!_piece->bent)
        return _piece->resolvent->at(speed, first, count);
    if (!_piece->stretch || _piece->stretch->first != speed)
        _piece->stretch = {
            speed, _piece->resolvent->at(speed, _read.rows(), _piece->bent->columns().cols())};
    return _piece->bent->solution(speed, _piece->resolvent->at(speed, first, count),
                                  _piece->stretch->second);
}

double ReducedMotion::rounding(double speed) const {
    const auto [known, missing] = _piece->roundings.try_emplace(speed, 0.0);
    if (missing)
        known->second = std::numeric_limits<double>::epsilon() /
                        std::max(linalg::reciprocal_condition(factors(speed).P), 1e-300);
    return known->second;
}

const ReducedMotion::Factors &ReducedMotion::factors(double speed) const {
    if (!_piece->factors || _piece->factors->speed != speed)
        _piece->factors = std::make_unique<Factors>(factors_at(speed));
    return *_piece->factors;
}

ReducedMotion::Factors ReducedMotion::factors_at(double speed) const {
    Eigen::MatrixXcd P = _piece->P.at(speed);
    Eigen::MatrixXcd slope = _piece->P.slope(speed);
    if (_piece->bent) {
        const BentSupports::Change change = _piece->bent->at(speed);
        P += _piece->bent->over_unknowns(change.Z);
        slope += _piece->bent->over_unknowns(change.slope);
    }
    return {speed, Eigen::PartialPivLU<Eigen::MatrixXcd>(P), std::move(slope)};
}

std::vector<Reading> ReducedMotion::at(double speed) const {
    const auto [known, missing] = _piece->readings.try_emplace(speed);
    if (missing) {
        const Factors &of = factors(speed);
        const Eigen::MatrixXcd u = linalg::solved(of.P, _b);
        const Eigen::MatrixXcd slope = -linalg::solved(of.P, linalg::times(of.slope, u));
        known->second = readings({_read * u, _read * slope}, speed);
    }
    return known->second;
}

std::vector<Reading> ReducedMotion::quickly_at(double speed) const {
    return _piece->resolvent ? readings(quick(speed, 0, _read.rows()), speed) : at(speed);
}

Reading ReducedMotion::quickly_at(double speed, std::size_t quantity) const {
    if (!_piece->resolvent)
        return at(speed)[quantity];
    const auto [first, count] = read_of(quantity);
    return reading(quantity, quick(speed, first, count), speed);
}

std::vector<Reading> ReducedMotion::readings(const QuadraticResolvent::Solution &unit,
                                             double speed) const {
    std::vector<Reading> out;
    for (std::size_t i = 0; i < _quantities.size(); ++i) {
        const auto [first, count] = read_of(i);
        out.push_back(reading(
            i, {unit.y.middleRows(first, count), unit.slope.middleRows(first, count)}, speed));
    }
    return out;
}

Phasor ReducedMotion::stretched(std::size_t quantity, const Eigen::VectorXcd &numbers) const {
    const auto circle = [](Complex w) { return Phasor{w, -imaginary_unit * w}; };
    if (_form == results::Form::planar && !_drive.weight())
        return circle(numbers(0));
    if (_drive.weight()) {
        const Eigen::RowVectorXd row = _stretches.row(static_cast<Eigen::Index>(quantity));
        const Complex x = row * numbers(Eigen::seqN(0, row.size(), 2));
        const Complex y = row * numbers(Eigen::seqN(1, row.size(), 2));
        return circle(WhirlParts({x, y}).a);
    }
    if (_form == results::Form::rotating)
        return circle(numbers(0) + imaginary_unit * numbers(1));
    return {numbers(0), numbers(1)};
}

Reading ReducedMotion::reading(std::size_t quantity, const QuadraticResolvent::Solution &unit,
                               double speed) const {
    const auto [push, push_slope] = factors_of_loads(speed);
    const Eigen::VectorXcd u = linalg::times(unit.y, push);
    const Eigen::VectorXcd u_slope =
        linalg::times(unit.slope, push) + linalg::times(unit.y, push_slope);
    const Phasor value = stretched(quantity, u);
    const Phasor change = stretched(quantity, u_slope);
    const Quantity &of = _quantities[quantity];
    const int bearing = of.bearing;
    double cancelled = 0;
    if (_drive.weight())
        cancelled = _stretches.row(static_cast<Eigen::Index>(quantity)).cwiseAbs() *
                    u(Eigen::seqN(0, _stretches.cols(), 2)).cwiseAbs();
    if (bearing == Quantity::deflection)
        return {of.seen(value), of.seen(change), cancelled};
    const model::Bearing &b = _discretization.rotor().bearings[static_cast<std::size_t>(bearing)];
    const double spin = _drive.sweep.spin_at(speed);
    const model::BearingCoefficients now = b.at(spin);
    // At the end of the piece those of its last rows.
    const double inside = std::clamp(speed, _piece->from, std::nextafter(_piece->to, _piece->from));
    const model::BearingCoefficients slope =
        _piece->to > _piece->from ? slope_of(b, inside) : model::BearingCoefficients{};
    const double w = _drive.frequency_at(speed);
    const double w_rate = _drive.frequency_rate();
    const Eigen::Matrix2cd z = now.k + imaginary_unit * w * now.c - w * w * now.m;
    const Eigen::Matrix2cd z_slope =
        slope.k + imaginary_unit * (w_rate * now.c + w * slope.c) - 2 * w * w_rate * now.m;
    const Eigen::Vector2cd xy(value.x, value.y);
    const Eigen::Vector2cd force = z * xy;
    const Eigen::Vector2cd force_slope = z_slope * xy + z * Eigen::Vector2cd(change.x, change.y);
    return {{force(0), force(1)}, {force_slope(0), force_slope(1)}, z.norm() * cancelled};
}

} // namespace whirl::forced
