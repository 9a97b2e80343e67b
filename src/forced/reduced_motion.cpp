#include "forced/reduced_motion.h"

#include "assembly/planes.h"
#include "assembly/rotating_system.h"
#include "assembly/system.h"
#include "linalg/check.h"
#include "modes/orbits.h"
#include "modes/support_damping.h"
#include "synchronous/parts.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl::forced {

namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Complex = std::complex<double>;

/// Rotors with no more planar unknowns are kept whole.
constexpr int few_unknowns = 24;

double slope_of_modulus(Complex value, Complex slope) {
    const double size = std::abs(value);
    return size > 0 ? (std::conj(value) * slope).real() / size : std::abs(slope);
}

using Wide = long double;

/// A V of the unknowns row, row + step, ... and column, column + step, ..., summed as `Number`.
template <class Number>
Eigen::MatrixXd forces(const Sparse &A, const Eigen::MatrixXd &V, int row, int column, int step) {
    Eigen::MatrixXd out(V.rows(), V.cols());
    std::vector<Number> sums(static_cast<std::size_t>(V.rows()));
    for (Eigen::Index shape = 0; shape < V.cols(); ++shape) {
        std::fill(sums.begin(), sums.end(), Number(0));
        for (int j = 0; j < V.rows(); ++j)
            for (Sparse::InnerIterator entry(A, step * j + column); entry; ++entry)
                if (entry.row() % step == row)
                    sums[static_cast<std::size_t>(entry.row() / step)] +=
                        static_cast<Number>(entry.value()) * static_cast<Number>(V(j, shape));
        for (Eigen::Index i = 0; i < V.rows(); ++i)
            out(i, shape) = static_cast<double>(sums[static_cast<std::size_t>(i)]);
    }
    return out;
}

/// V^T A V. Short elements are stiffer than the rotor by many powers of ten, and all of that
/// cancels in A V, which is the forces on the nodes: in double precision what is left would be off
/// by 1e-10 and peaks by that times their amplification.
/// @param parts  1: over planar unknowns; 2: in pairs (x, y), the shapes for both directions
template <class Number>
Eigen::MatrixXcd shape_product(const Eigen::MatrixXd &V, const linalg::Matrix &A, int parts) {
    const Sparse entries = A.view();
    Eigen::MatrixXcd out(parts * V.cols(), parts * V.cols());
    for (int row = 0; row < parts; ++row)
        for (int column = 0; column < parts; ++column) {
            const Eigen::MatrixXd part =
                V.transpose() * forces<Number>(entries, V, row, column, parts);
            for (Eigen::Index k = 0; k < V.cols(); ++k)
                for (Eigen::Index i = 0; i < V.cols(); ++i)
                    out(parts * i + row, parts * k + column) = part(i, k);
        }
    return out;
}

/// Real and imaginary parts of motions, turned so that the real part is as large as it gets; the
/// other where it is more than that part of the motion.
Eigen::MatrixXd real_parts(const Eigen::MatrixXcd &motions, double part) {
    Eigen::MatrixXd out(motions.rows(), 2 * motions.cols());
    Eigen::Index count = 0;
    for (Eigen::Index j = 0; j < motions.cols(); ++j) {
        const Complex square = (motions.col(j).transpose() * motions.col(j)).value();
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
    : _discretization(discretization), _form(form), _drive(drive),
      _quantities(std::move(quantities)), _rows(synchronous::table_speeds(discretization.rotor())) {
    make_shapes(drive.weight() ? 2 * top : top, reduction);
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
            } else {
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
    _b = _drive.weight() ? weight() : imbalances();
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

std::pair<Eigen::Index, Eigen::Index> ReducedMotion::read_of(int quantity) const {
    if (_drive.weight())
        return {0, _read.rows()};
    const Eigen::Index each = _form == results::Form::planar ? 1 : 2;
    return {each * quantity, each};
}

std::vector<double> ReducedMotion::cuts(double from, double to) const {
    std::vector<double> out{from};
    for (const double row : _rows)
        if (row > from && row < to)
            out.push_back(row);
    out.push_back(to);
    return out;
}

ReducedMotion::Terms ReducedMotion::terms(double bearing_speed) const {
    if (_rows.empty())
        return whole_terms(bearing_speed);
    if (!_at_first_row) // nothing but the bearings changes from row to row
        _at_first_row = whole_terms(_rows.front());
    Terms out = *_at_first_row;
    if (bearing_speed != _rows.front()) {
        add_bearings(_rows.front(), -1, out);
        add_bearings(bearing_speed, 1, out);
    }
    return out;
}

void ReducedMotion::add_bearings(double bearing_speed, double share, Terms &out) const {
    const Eigen::MatrixXd &V = _shapes->matrix();
    const auto add = [&](Eigen::MatrixXcd &target, Complex factor, int i, int j,
                         const Eigen::Matrix2d &block) {
        const Eigen::MatrixXcd product = share * factor * (V.row(i).transpose() * V.row(j));
        const Eigen::Index planes = _form == results::Form::planar ? 1 : 2;
        for (Eigen::Index p = 0; p < planes; ++p)
            for (Eigen::Index q = 0; q < planes; ++q)
                target(Eigen::seqN(p, V.cols(), planes), Eigen::seqN(q, V.cols(), planes)) +=
                    block(p, q) * product;
    };
    assembly::assemble_bearings(
        _discretization, bearing_speed,
        [&](assembly::Term term, int i, int j, Eigen::Matrix2d block) {
            if (_form == results::Form::rotating) { // the part that is the same from all sides
                const double along = block.trace() / 2;
                const double across = (block(1, 0) - block(0, 1)) / 2;
                block << along, -across, across, along;
            }
            if (term == assembly::Term::stiffness)
                add(out.constant, 1, i, j, block);
            if (term != assembly::Term::damping)
                return;
            if (_form != results::Form::rotating || _drive.weight())
                add(out.linear, imaginary_unit, i, j, block);
            if (_form == results::Form::rotating) // of the axes that turn: i times the block
                add(out.linear, 1, i, j,
                    Eigen::Matrix2d{{-block(1, 0), -block(0, 0)}, {block(0, 0), -block(1, 0)}});
        });
}

ReducedMotion::Terms ReducedMotion::whole_terms(double bearing_speed) const {
    const Eigen::MatrixXd &V = _shapes->matrix();
    const int parts = _form == results::Form::planar ? 1 : 2;
    const auto product = [&](const linalg::Matrix &A) { return shape_product<Wide>(V, A, parts); };
    const auto mass = [&](const linalg::Matrix &A) { return shape_product<double>(V, A, parts); };
    if (_form == results::Form::planar) {
        const assembly::PlanarSystem s = assembly::assemble_planar(_discretization, bearing_speed);
        const linalg::Matrix C = linalg::Matrix::from_entries(
            _discretization.planar_size(),
            modes::planar_support_damping(_discretization, bearing_speed));
        return {product(s.K), imaginary_unit * product(C), mass(s.G) - mass(s.M)};
    }
    if (_form == results::Form::rotating) {
        const assembly::RotatingSystem s =
            assembly::assemble_rotating(_discretization, bearing_speed, {});
        if (_drive.weight()) // lambda = i s in rotating axes
            return {product(s.K), product(s.Ks) + imaginary_unit * product(s.C),
                    product(s.Kss) + imaginary_unit * product(s.Cs) - mass(s.M)};
        return {product(s.K), product(s.Ks), product(s.Kss)};
    }
    const assembly::FixedSystem s = assembly::assemble_fixed(_discretization, bearing_speed);
    return {product(s.K), product(s.Kc) + imaginary_unit * product(s.C),
            imaginary_unit * mass(s.G) - mass(s.M)};
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
    const Terms a = terms(from);
    Piece piece;
    piece.from = from;
    piece.to = to;
    piece.P = {a.constant, a.linear, a.quadratic};
    if (to > from) { // the bearings enter the constant and the linear term, both linear in s
        const Terms b = terms(to);
        const Eigen::MatrixXcd change0 = (b.constant - a.constant) / (to - from);
        const Eigen::MatrixXcd change1 = (b.linear - a.linear) / (to - from);
        piece.P.P0 -= from * change0;
        piece.P.P1 += change0 - from * change1;
        piece.P.P2 += change1;
    }
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
    if (!_piece->resolvent || _piece->resolved != std::pair(from, to)) {
        _piece->resolvent = std::make_unique<QuadraticResolvent>(_piece->P, _b, _read, from, to);
        _piece->resolved = {from, to};
    }
    return *_piece->resolvent;
}

std::vector<std::complex<double>> ReducedMotion::poles(double from, double to) {
    return resolvent(from, to).poles();
}

double ReducedMotion::rounding(double speed) const {
    const auto [known, missing] = _piece->roundings.try_emplace(speed, 0.0);
    if (missing)
        known->second =
            std::numeric_limits<double>::epsilon() / std::max(factors(speed).P.rcond(), 1e-300);
    return known->second;
}

const ReducedMotion::Factors &ReducedMotion::factors(double speed) const {
    if (!_piece->factors || _piece->factors->speed != speed)
        _piece->factors =
            std::make_unique<Factors>(Factors{speed, _piece->P.at(speed).partialPivLu()});
    return *_piece->factors;
}

std::vector<Reading> ReducedMotion::at(double speed) const {
    const auto [known, missing] = _piece->readings.try_emplace(speed);
    if (missing) {
        const auto &P = factors(speed).P;
        const Eigen::VectorXcd u = P.solve(_b);
        Eigen::VectorXcd change = _piece->P.P1 * u;
        change += (2 * speed) * Eigen::VectorXcd(_piece->P.P2 * u);
        const Eigen::VectorXcd slope = -Eigen::VectorXcd(P.solve(change));
        known->second = readings({_read * u, _read * slope}, speed);
    }
    return known->second;
}

std::vector<Reading> ReducedMotion::quickly_at(double speed) const {
    return _piece->resolvent ? readings(_piece->resolvent->at(speed, 0, _read.rows()), speed)
                             : at(speed);
}

Reading ReducedMotion::quickly_at(double speed, int quantity) const {
    if (!_piece->resolvent)
        return at(speed)[static_cast<std::size_t>(quantity)];
    const auto [first, count] = read_of(quantity);
    return reading(quantity, _piece->resolvent->at(speed, first, count), speed);
}

std::vector<Reading> ReducedMotion::readings(const QuadraticResolvent::Solution &unit,
                                             double speed) const {
    std::vector<Reading> out;
    for (int i = 0; i < static_cast<int>(_quantities.size()); ++i) {
        const auto [first, count] = read_of(i);
        out.push_back(
            reading(i, {unit.y.segment(first, count), unit.slope.segment(first, count)}, speed));
    }
    return out;
}

Phasor ReducedMotion::stretched(int quantity, const Eigen::VectorXcd &numbers) const {
    const auto circle = [](Complex w) { return Phasor{w, -imaginary_unit * w}; };
    if (_form == results::Form::planar && !_drive.weight())
        return circle(numbers(0));
    if (_drive.weight()) {
        const Eigen::RowVectorXd row = _stretches.row(quantity);
        const Complex x = row * numbers(Eigen::seqN(0, row.size(), 2));
        const Complex y = row * numbers(Eigen::seqN(1, row.size(), 2));
        return circle(WhirlParts({x, y}).a);
    }
    if (_form == results::Form::rotating)
        return circle(numbers(0) + imaginary_unit * numbers(1));
    return {numbers(0), numbers(1)};
}

Reading ReducedMotion::reading(int quantity, const QuadraticResolvent::Solution &unit,
                               double speed) const {
    const double push = _drive.weight() ? 1 : speed * speed;
    const double push_slope = _drive.weight() ? 0 : 2 * speed;
    const Eigen::VectorXcd u = push * unit.y;
    const Phasor value = stretched(quantity, u);
    const Phasor change = stretched(quantity, push * unit.slope + push_slope * unit.y);
    const Quantity &of = _quantities[static_cast<std::size_t>(quantity)];
    const int bearing = of.bearing;
    double cancelled = 0;
    if (_drive.weight())
        cancelled = _stretches.row(quantity).cwiseAbs() *
                    u(Eigen::seqN(0, _stretches.cols(), 2)).cwiseAbs();
    if (bearing == Quantity::deflection)
        return {of.seen(value), of.seen(change), cancelled};
    const model::Bearing &b = _discretization.rotor().bearings[static_cast<std::size_t>(bearing)];
    const model::BearingCoefficients now = b.at(speed);
    const model::BearingCoefficients low = b.at(_piece->from);
    const model::BearingCoefficients high = b.at(_piece->to);
    const double width = _piece->to > _piece->from ? _piece->to - _piece->from : 1;
    const Eigen::Matrix2d k_slope = (high.k - low.k) / width;
    const Eigen::Matrix2d c_slope = (high.c - low.c) / width;
    const Complex turns = (_drive.weight() ? 2.0 : 1.0) * imaginary_unit; // over the spin speed
    const Complex square = turns * turns;
    const Eigen::Matrix2cd z = now.k + turns * speed * now.c + square * speed * speed * now.m;
    const Eigen::Matrix2cd z_slope =
        k_slope + turns * (now.c + speed * c_slope) + 2.0 * square * speed * now.m;
    const Eigen::Vector2cd xy(value.x, value.y);
    const Eigen::Vector2cd force = z * xy;
    const Eigen::Vector2cd force_slope = z_slope * xy + z * Eigen::Vector2cd(change.x, change.y);
    return {{force(0), force(1)}, {force_slope(0), force_slope(1)}, z.norm() * cancelled};
}

} // namespace whirl::forced
