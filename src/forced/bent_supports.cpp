#include "forced/bent_supports.h"

#include "forced/forced_motion.h"
#include "linalg/dense/products.h"
#include "synchronous/parts.h"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace whirl::forced {

namespace {

using Complex = std::complex<double>;
using model::BearingCoefficients;

/// Changes of P in place of a row or column of k and c.
Eigen::MatrixXcd block_of(const ShapeTerms &terms, const Eigen::Matrix2cd &block) {
    return block.topLeftCorner(terms.planes(), terms.planes());
}

} // namespace

std::vector<double> rows_of_straight_pieces(const model::Rotor &rotor) {
    // Of the coefficients over a row left out: the basis is chosen by it, motions are exact.
    constexpr double straight = 0.01;
    const std::vector<double> rows = synchronous::table_speeds(rotor);
    const std::vector<double> bends = rotor.table_bends();
    std::vector<double> out;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const bool last = i + 1 == rows.size();
        const bool needed = last || std::ranges::binary_search(bends, rows[i]) ||
                            std::ranges::any_of(rotor.bearings, [&](const auto &bearing) {
                                return bearing.depends_on_speed() &&
                                       bearing.bend_between(out.back(), rows[i + 1]) > straight;
                            });
        if (needed)
            out.push_back(rows[i]);
    }
    return out;
}

BearingCoefficients slope_of(const model::Bearing &bearing, double speed) {
    BearingCoefficients out;
    if (!bearing.depends_on_speed() || speed < bearing.speeds.front() ||
        speed >= bearing.speeds.back())
        return out;
    const auto above = std::upper_bound(bearing.speeds.begin(), bearing.speeds.end(), speed);
    const auto i = static_cast<std::size_t>(above - bearing.speeds.begin());
    const double width = bearing.speeds[i] - bearing.speeds[i - 1];
    out.k = (bearing.rows[i].k - bearing.rows[i - 1].k) / width;
    out.c = (bearing.rows[i].c - bearing.rows[i - 1].c) / width;
    return out;
}

BentSupports::BentSupports(const assembly::Discretization &discretization, const ShapeTerms &terms,
                           double from, double to)
    : _discretization(discretization), _terms(terms), _from(from), _to(to) {
    const std::vector<model::Bearing> &bearings = discretization.rotor().bearings;
    for (std::size_t i = 0; i < bearings.size(); ++i) {
        const std::size_t before = _inner.size();
        for (const double row : bearings[i].speeds)
            if (row > from && row < to)
                _inner.push_back(row);
        if (_inner.size() == before)
            continue;
        _bearings.push_back(i);
        const Eigen::MatrixXd more =
            terms.columns_of(stretch_of_bearing(discretization, static_cast<int>(i)));
        _columns.conservativeResize(more.rows(), _columns.cols() + more.cols());
        _columns.rightCols(more.cols()) = more;
    }
    std::ranges::sort(_inner);
    _inner.erase(std::unique(_inner.begin(), _inner.end()), _inner.end());
}

BentSupports::Change BentSupports::at(Complex s) const {
    const Eigen::Index planes = _terms.planes();
    const double place = std::clamp(s.real(), _from, std::nextafter(_to, _from));
    const double t = (place - _from) / (_to - _from);
    Change out{Eigen::MatrixXcd::Zero(_columns.cols(), _columns.cols()), {}};
    out.slope = out.Z;
    Eigen::Index first = 0;
    for (const std::size_t i : _bearings) {
        const model::Bearing &bearing = _discretization.rotor().bearings[i];
        const BearingCoefficients now = bearing.at(place);
        const BearingCoefficients slope = slope_of(bearing, place);
        const BearingCoefficients a = bearing.at(_from);
        const BearingCoefficients b = bearing.at(_to);
        const auto gap = [&](auto part) -> Eigen::Matrix2d {
            return now.*part - (1 - t) * (a.*part) - t * (b.*part);
        };
        const auto rate = [&](auto part) -> Eigen::Matrix2d { // per rad/s
            return slope.*part - (b.*part - a.*part) / (_to - _from);
        };
        constexpr auto k = &BearingCoefficients::k;
        constexpr auto c = &BearingCoefficients::c;
        const Eigen::MatrixXcd Z0 = block_of(_terms, _terms.constant_block(gap(k), gap(c)));
        const Eigen::MatrixXcd Z0_rate = block_of(_terms, _terms.constant_block(rate(k), rate(c)));
        const Eigen::MatrixXcd Z1 = block_of(_terms, _terms.linear_block(gap(c)));
        const Eigen::MatrixXcd Z1_rate = block_of(_terms, _terms.linear_block(rate(c)));
        const Complex off = s - place;
        out.Z.block(first, first, planes, planes) = Z0 + off * Z0_rate + s * (Z1 + off * Z1_rate);
        out.slope.block(first, first, planes, planes) =
            Z0_rate + (Z1 + off * Z1_rate) + s * Z1_rate;
        first += planes;
    }
    return out;
}

Eigen::MatrixXcd BentSupports::over_unknowns(const Eigen::MatrixXcd &Z) const {
    const Eigen::MatrixXcd B = _columns.cast<Complex>();
    return linalg::times(linalg::times(B, Z), Eigen::MatrixXcd(B.transpose()));
}

QuadraticResolvent::Solution
BentSupports::solution(double s, const QuadraticResolvent::Solution &numbers,
                       const QuadraticResolvent::Solution &stretch) const {
    // u = P^-1 (b - B f) with the P of the lines, f = Z a, a = B^T u; the same once more for
    // slopes.
    const Change change = at(s);
    const Eigen::Index n = _columns.cols();
    const Eigen::MatrixXcd A = stretch.y.rightCols(n);
    const Eigen::MatrixXcd A_slope = stretch.slope.rightCols(n);
    Eigen::MatrixXcd equations = linalg::times(change.Z, A);
    equations.diagonal().array() += 1;
    const Eigen::PartialPivLU<Eigen::MatrixXcd> system(equations);
    const Eigen::Index loads = stretch.y.cols() - n;
    Eigen::MatrixXcd a = stretch.y.leftCols(loads);
    const Eigen::MatrixXcd f = linalg::solved(system, linalg::times(change.Z, a));
    a -= linalg::times(A, f);
    const Eigen::MatrixXcd moved = stretch.slope.leftCols(loads) - linalg::times(A_slope, f);
    const Eigen::MatrixXcd forces = linalg::times(change.slope, a) + linalg::times(change.Z, moved);
    const Eigen::MatrixXcd f_slope = linalg::solved(system, forces);
    const Eigen::MatrixXcd read = numbers.y.rightCols(n);
    const Eigen::MatrixXcd read_slope = numbers.slope.rightCols(n);
    QuadraticResolvent::Solution out{numbers.y.leftCols(loads), numbers.slope.leftCols(loads)};
    out.y -= linalg::times(read, f);
    out.slope -= linalg::times(read_slope, f);
    out.slope -= linalg::times(read, f_slope);
    return out;
}

bool BentSupports::in_sight(Complex pole) const {
    constexpr double aside = 0.3; // of the speed: what bends moves poles by far less
    const double margin = aside * std::max(std::abs(_from), std::abs(_to));
    return pole.real() > _from - margin && pole.real() < _to + margin &&
           std::abs(pole.imag()) < margin;
}

std::optional<Complex> BentSupports::pole(const QuadraticTerms &lines, Complex guess) const {
    constexpr int most = 20; // a guard: quadratic
    Complex s = guess;
    // No direction that a pole's vector could be at right angles to.
    Eigen::VectorXcd x(lines.P0.rows());
    for (Eigen::Index i = 0; i < x.size(); ++i)
        x(i) = std::polar(1.0, 0.7 * static_cast<double>(i * i));
    Eigen::VectorXcd y = x;
    double before = std::numeric_limits<double>::infinity();
    for (int step = 0; step < most; ++step) {
        const Change change = at(s);
        const Eigen::MatrixXcd P = lines.at(s) + over_unknowns(change.Z);
        const Eigen::MatrixXcd slope = lines.slope(s) + over_unknowns(change.slope);
        const Eigen::PartialPivLU<Eigen::MatrixXcd> lu(P);
        for (int repeat = 0; repeat < (step == 0 ? 3 : 1); ++repeat) {
            x = linalg::solved(lu, linalg::times(slope, x));
            x.normalize();
            const Eigen::VectorXcd forces = slope.adjoint() * y;
            y = linalg::adjoint_solved(lu, forces);
            y.normalize();
        }
        if (!x.allFinite() || !y.allFinite()) // at the pole itself
            return s;
        const Complex move = -y.dot(linalg::times(P, x)) / y.dot(linalg::times(slope, x));
        const double size = std::abs(move);
        s += move;
        if (!in_sight(s) || std::abs(s - guess) > 0.2 * std::abs(guess))
            return std::nullopt;
        if (size <= 1e-13 * std::abs(s) || (size <= 1e-10 * std::abs(s) && size >= 0.3 * before))
            return s;
        before = size;
    }
    return std::nullopt;
}

std::vector<Complex> BentSupports::row_by_row(const QuadraticTerms &lines) const {
    std::vector<double> ends{_from};
    ends.insert(ends.end(), _inner.begin(), _inner.end());
    ends.push_back(_to);
    std::vector<Complex> out;
    const Eigen::MatrixXcd none = Eigen::MatrixXcd::Zero(lines.P0.rows(), 1);
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        // B Z B^T is quadratic in s between two rows: by values at three speeds.
        const double middle = (ends[i] + ends[i + 1]) / 2;
        const double half = (ends[i + 1] - ends[i]) / 4;
        std::array<Eigen::MatrixXcd, 3> Z;
        for (int k = 0; k < 3; ++k)
            Z[static_cast<std::size_t>(k)] = over_unknowns(at(middle + (k - 1) * half).Z);
        const Eigen::MatrixXcd second = (Z[0] - 2.0 * Z[1] + Z[2]) / (2 * half * half);
        const Eigen::MatrixXcd first = (Z[2] - Z[0]) / (2 * half) - 2 * middle * second;
        const QuadraticTerms terms{lines.P0 + Z[1] - middle * first - middle * middle * second,
                                   lines.P1 + first, lines.P2 + second};
        for (const Complex &pole :
             QuadraticResolvent(terms, none, none.real().transpose(), ends[i], ends[i + 1]).poles())
            if (pole.real() >= ends[i] && pole.real() < ends[i + 1])
                out.push_back(pole);
    }
    return out;
}

std::vector<Complex> BentSupports::poles(const QuadraticTerms &lines,
                                         const std::vector<Complex> &guesses) const {
    constexpr double one = 1e-8; // of the speed: two led to the same
    std::vector<Complex> near, out;
    bool sure = true;
    for (const Complex &guess : guesses) {
        if (!in_sight(guess)) {
            out.push_back(guess);
            continue;
        }
        const std::optional<Complex> found = pole(lines, guess);
        sure = sure && found && std::ranges::none_of(near, [&](const Complex &other) {
                   return std::abs(other - *found) <= one * std::abs(other);
               });
        if (!sure)
            break;
        near.push_back(*found);
    }
    if (!sure) {
        near = row_by_row(lines);
        out.clear();
        std::copy_if(guesses.begin(), guesses.end(), std::back_inserter(out),
                     [this](const Complex &guess) { return !in_sight(guess); });
    }
    out.insert(out.end(), near.begin(), near.end());
    return out;
}

} // namespace whirl::forced
