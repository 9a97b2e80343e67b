#include "periodic/triangular_turn.h"

#include "linalg/check.h"
#include "linalg/dense/general_eigen.h"
#include "linalg/dense/orthogonal_factors.h"
#include "linalg/dense/products.h"
#include "periodic/fourier.h"
#include "periodic/half_turn.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

namespace whirl::periodic {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using linalg::Rows;

/// Decay over half a turn, as a logarithm, by which motions in one block may differ: exp(-18) of a
/// multiplier is 1e8 times its rounding.
constexpr double together = 18;

/// Q_k+1 R_k = A_k Q_k over groups of parts of half a turn, R_k triangular. The last basis is the
/// first one again but for what turns within blocks.
class TriangularTurn {
  public:
    /// @param groups  none of which leads motions too far apart
    /// @param least   logarithm of what is left after half a turn of motions that matter
    /// @param columns  directions to begin with
    TriangularTurn(const std::vector<Rows> &parts, std::size_t groups, double least, Index columns)
        : _least(least) {
        const Index size = parts.front().rows();
        Rows next(size, size);
        for (std::size_t g = 0; g < groups; ++g) {
            _begins.push_back(g * parts.size() / groups);
            Rows map = parts[_begins.back()];
            for (std::size_t k = _begins.back() + 1; k < (g + 1) * parts.size() / groups; ++k) {
                next.noalias() = parts[k] * map;
                std::swap(map, next);
            }
            _maps.push_back(std::move(map));
        }
        _begins.push_back(parts.size());
        _settled = (columns < size && settle(columns)) || settle(size);
    }

    /// Whether motions that matter are separated.
    [[nodiscard]] bool settled() const { return _settled; }
    [[nodiscard]] std::size_t groups() const { return _R.size(); }
    /// The first part of a group; of the end the number of all.
    [[nodiscard]] std::size_t begin(std::size_t group) const { return _begins[group]; }
    [[nodiscard]] const Rows &basis(std::size_t group) const { return _Q[group]; }
    [[nodiscard]] const MatrixXd &factor(std::size_t group) const { return _R[group]; }
    /// The last basis in coordinates of the first.
    [[nodiscard]] const MatrixXd &turned() const { return _turned; }
    /// Where blocks begin, and the end of the last one.
    [[nodiscard]] const std::vector<Index> &borders() const { return _borders; }

    /// A block of half a turn, exp(logarithm) times that.
    [[nodiscard]] std::pair<MatrixXd, double> block(Index begin, Index end) const {
        const Index size = end - begin;
        MatrixXd product = MatrixXd::Identity(size, size);
        double logarithm = 0;
        for (const MatrixXd &R : _R) {
            product = linalg::times(MatrixXd(R.block(begin, begin, size, size)), product);
            const double length = std::max(product.norm(), 1e-300);
            product /= length;
            logarithm += std::log(length);
        }
        return {linalg::times(MatrixXd(_turned.block(begin, begin, size, size)), product),
                logarithm};
    }

  private:
    double _least;
    bool _settled = false;
    std::vector<std::size_t> _begins;
    std::vector<Rows> _maps, _Q;
    std::vector<MatrixXd> _R;
    MatrixXd _turned;
    Eigen::VectorXd _left; ///< logarithms of what is left of each direction
    std::vector<Index> _borders;

    /// @param columns  directions that are followed; fewer than all settle where there is a gap
    ///                 between what is left of them and of the others
    bool settle(Index columns) {
        const Index size = _maps.front().rows();
        const int sweeps = columns < size ? 10 : 20;
        Rows Q = Rows::Identity(size, size).leftCols(columns);
        for (int sweep = 0; sweep < sweeps; ++sweep) {
            Q = iterate(std::move(Q));
            take_blocks();
            if (sweep > 0 && worst_spread() <= together)
                return true;
            // What is left of a direction hardly changes after two sweeps.
            if (sweep > 1 && leaves_some_out())
                return false;
        }
        return false;
    }

    Rows iterate(Rows Q) {
        _Q.assign(1, Q);
        _R.clear();
        _left = Eigen::VectorXd::Zero(Q.cols());
        Rows image = Q;
        for (const Rows &map : _maps) {
            image.noalias() = map * Q;
            auto [basis, R] = linalg::orthogonal_factors(image);
            _left.array() += R.diagonal().array().abs().max(1e-300).log();
            Q = basis;
            _R.push_back(std::move(R));
            _Q.push_back(Q);
        }
        _turned = linalg::transposed_times(MatrixXd(_Q.front()), MatrixXd(Q));
        return Q;
    }

    /// Blocks end where the directions before them do not mix into those behind or into dropped
    /// ones: neglecting the rest is a relative error of that size in one group's map.
    void take_blocks() {
        // Of the length of a map: what eigenvalues are then off by beside the largest in
        // the group.
        constexpr double nothing = 1e-10;
        const MatrixXd first = _Q.front();
        const MatrixXd outside = MatrixXd(_Q.back()) - linalg::times(first, _turned);
        const Index size = _turned.cols();
        _borders.assign(1, 0);
        for (Index border = 1; border <= size; ++border)
            if (std::hypot(_turned.bottomLeftCorner(size - border, border).norm(),
                           outside.leftCols(border).norm()) <= nothing)
                _borders.push_back(border);
    }

    /// All directions that are followed matter, so that others may.
    [[nodiscard]] bool leaves_some_out() const {
        return _left.size() < _maps.front().rows() && _left.minCoeff() > _least;
    }

    /// Within a block, of motions that matter; infinite where some are in none.
    [[nodiscard]] double worst_spread() const {
        if ((_left.tail(_left.size() - _borders.back()).array() > _least).any() ||
            leaves_some_out())
            return std::numeric_limits<double>::infinity();
        double worst = 0;
        for (std::size_t b = 0; b + 1 < _borders.size(); ++b) {
            const auto block = _left.segment(_borders[b], _borders[b + 1] - _borders[b]);
            worst = std::max(worst, block.maxCoeff() - std::max(block.minCoeff(), _least));
        }
        return worst;
    }
};

/// Multipliers of one block with their vectors in it.
struct Multiplier {
    Complex value; ///< l, 1/s
    double noise = 0;
    Eigen::VectorXcd vector;
};

std::vector<Multiplier> multipliers(const TriangularTurn &turn, Index begin, Index end,
                                    double half_turn) {
    const auto [matrix, logarithm] = turn.block(begin, end);
    const linalg::GeneralEigen found = linalg::general_eigen(matrix, linalg::Vectors::both);
    constexpr double rounding = std::numeric_limits<double>::epsilon();
    std::vector<Multiplier> out;
    for (Index i = 0; i < matrix.cols(); ++i) {
        if (found.values(i).imag() < 0)
            continue;
        const Eigen::VectorXcd right = vector_of(found, found.right, i);
        const Eigen::VectorXcd left = vector_of(found, found.left, i);
        const double sharp = std::abs(found.products(i)) / (right.norm() * left.norm());
        const double size = std::abs(found.values(i));
        const double rounding_of_value = 10 * rounding * matrix.norm() / std::max(sharp, rounding);
        constexpr double known = 1e-3; // of a multiplier
        if (rounding_of_value < known * size)
            out.push_back({(std::log(found.values(i)) + logarithm) / half_turn,
                           rounding_of_value / size / half_turn, right.normalized()});
    }
    return out;
}

/// Parts of motions in the blocks before theirs that half a turn backwards, without growth and
/// turn, leaves as they were.
/// @param alone  what it makes of none, of each motion two columns: real and imaginary part
MatrixXd repeating(const TriangularTurn &turn, Index size, const std::vector<Multiplier> &motions,
                   double half_turn, const MatrixXd &alone) {
    double growth = -std::numeric_limits<double>::infinity(); // 1/s
    for (const Multiplier &motion : motions)
        growth = std::max(growth, motion.value.real());
    MatrixXd back = turn.turned().topLeftCorner(size, size).transpose();
    const auto all = static_cast<double>(turn.begin(turn.groups()));
    for (std::size_t group = turn.groups(); group-- > 0;) {
        turn.factor(group)
            .topLeftCorner(size, size)
            .triangularView<Eigen::Upper>()
            .solveInPlace(back);
        back *= std::exp(growth * half_turn *
                         static_cast<double>(turn.begin(group + 1) - turn.begin(group)) / all);
    }
    MatrixXd out(size, alone.cols());
    for (std::size_t i = 0; i < motions.size(); ++i) {
        const auto own = alone.middleCols(2 * static_cast<Index>(i), 2);
        MatrixXcd rest = -std::exp((motions[i].value - growth) * half_turn) * back;
        rest.diagonal().array() += 1;
        const Eigen::VectorXcd parts =
            linalg::solved(Eigen::PartialPivLU<MatrixXcd>(rest),
                           Eigen::VectorXcd(own.col(0) + Complex(0, 1) * own.col(1)));
        out.middleCols(2 * static_cast<Index>(i), 2) << parts.real(), parts.imag();
    }
    return out;
}

/// States of motions over half a turn at the beginnings of its parts, without their growth and
/// turn: of each motion a column for each part.
/// @param begin,end  of their block
std::vector<MatrixXcd> over_half_turn(const TriangularTurn &turn, const std::vector<Rows> &parts,
                                      Index begin, Index end,
                                      const std::vector<Multiplier> &motions, double half_turn) {
    const Index columns = 2 * std::ssize(motions); // real and imaginary parts
    const double length = half_turn / static_cast<double>(parts.size());
    // Without growth and turn of each over some parts, backwards with a minus.
    const auto undone = [&motions, length](auto &states, double count) {
        for (std::size_t i = 0; i < motions.size(); ++i) {
            const Complex factor = std::exp(-motions[i].value * length * count);
            Eigen::Matrix2d turned;
            turned << factor.real(), factor.imag(), -factor.imag(), factor.real();
            auto pair = states.middleCols(2 * static_cast<Index>(i), 2);
            pair = (pair * turned).eval();
        }
    };
    const auto parts_of = [&turn](std::size_t group) {
        return static_cast<double>(turn.begin(group + 1) - turn.begin(group));
    };
    // In their block forwards, where what dies out faster stays small, in those before backwards.
    std::vector<MatrixXd> z(turn.groups(), MatrixXd::Zero(end, columns));
    MatrixXd own(end - begin, columns);
    for (std::size_t i = 0; i < motions.size(); ++i)
        own.middleCols(2 * static_cast<Index>(i), 2) << motions[i].vector.real(),
            motions[i].vector.imag();
    for (std::size_t group = 0; group < turn.groups(); ++group) {
        z[group].bottomRows(end - begin) = own;
        own = linalg::times(
            MatrixXd(turn.factor(group).block(begin, begin, end - begin, end - begin)), own);
        undone(own, parts_of(group));
    }
    const auto backwards = [&](MatrixXd before) {
        before =
            linalg::times(MatrixXd(turn.turned().topLeftCorner(begin, begin).transpose()), before);
        for (std::size_t group = turn.groups(); group-- > 0;) {
            undone(before, -parts_of(group));
            before -=
                linalg::times(MatrixXd(turn.factor(group).block(0, begin, begin, end - begin)),
                              MatrixXd(z[group].bottomRows(end - begin)));
            turn.factor(group)
                .topLeftCorner(begin, begin)
                .triangularView<Eigen::Upper>()
                .solveInPlace(before);
            z[group].topRows(begin) = before;
        }
    };
    if (begin > 0) {
        backwards(MatrixXd::Zero(begin, columns));
        backwards(repeating(turn, begin, motions, half_turn, z.front().topRows(begin)));
    }
    std::vector<MatrixXcd> out(motions.size(), MatrixXcd(parts.front().rows(), std::ssize(parts)));
    Rows states(parts.front().rows(), columns);
    Rows next = states;
    for (std::size_t group = 0; group < turn.groups(); ++group) {
        states.noalias() = turn.basis(group).leftCols(end) * Rows(z[group]);
        for (std::size_t part = turn.begin(group); part < turn.begin(group + 1); ++part) {
            for (std::size_t i = 0; i < motions.size(); ++i)
                out[i].col(static_cast<Index>(part)) =
                    states.col(2 * static_cast<Index>(i)) +
                    Complex(0, 1) * states.col(2 * static_cast<Index>(i) + 1);
            if (part + 1 < turn.begin(group + 1)) {
                next.noalias() = parts[part] * states;
                undone(next, 1);
                std::swap(states, next);
            }
        }
    }
    return out;
}

/// All terms of a motion that so many places resolve, the middle one that of its mean rate; nothing
/// where there are more.
/// @param states  with entries as they are
std::optional<FloquetSeries> terms_of(const System &system, const MatrixXd &M, double speed,
                                      const Multiplier &motion, const MatrixXcd &states) {
    constexpr double nothing = 1e-6; // its square is what the motion lacks
    const Index middle = motion.value.imag() == 0 ? 0 : mean_term(M, states, motion.value, speed);
    const Index wide = (states.cols() - 1) / 2;
    const MatrixXcd q = states.topRows(M.rows());
    const MatrixXcd terms =
        linalg::times(q, fourier(states.cols(), middle - wide, middle + wide, speed < 0));
    const Eigen::VectorXd sizes = terms.colwise().norm();
    if (!(std::max(sizes(0), sizes(2 * wide)) <= nothing * sizes.maxCoeff()))
        return std::nullopt;
    return FloquetSeries{motion.value + Complex(0, 2 * speed * static_cast<double>(middle)),
                         motion.noise, system.scales().asDiagonal() * terms};
}

/// @returns nothing where some need more parts
std::optional<std::vector<FloquetSeries>> series_by(const System &system, double speed, int steps,
                                                    int parts, std::size_t groups, double least,
                                                    Index columns, double fastest) {
    const System::Steady steady = system.steady(speed);
    const Eigen::VectorXd unweighted = weights_of(steady, speed).cwiseInverse();
    const std::vector<Rows> maps = turn_in_parts(system, speed, steps, parts);
    const TriangularTurn turn(maps, groups, least,
                              std::min(columns, 2 * static_cast<Index>(system.size())));
    if (!turn.settled())
        return std::nullopt;
    const std::vector<Index> &borders = turn.borders();
    std::vector<FloquetSeries> out;
    for (std::size_t b = 0; b + 1 < borders.size(); ++b) {
        const auto motions = multipliers(turn, borders[b], borders[b + 1], period(speed));
        const auto states =
            over_half_turn(turn, maps, borders[b], borders[b + 1], motions, period(speed));
        for (std::size_t i = 0; i < motions.size(); ++i) {
            const MatrixXcd own = unweighted.asDiagonal() * states[i];
            if (!own.allFinite() || frequency_of(steady.M, own) > fastest)
                continue;
            std::optional<FloquetSeries> series =
                terms_of(system, steady.M, speed, motions[i], own);
            if (!series)
                return std::nullopt;
            out.push_back(*std::move(series));
        }
    }
    return out;
}

} // namespace

std::optional<std::vector<FloquetSeries>> damped_series(const System &system, double speed,
                                                        int steps, double spread, int columns,
                                                        double fastest) {
    constexpr int fewest = 24;        // parts of half a turn: enough for the windows' interpolation
    constexpr int most = 400;         // parts: the cost grows with their number
    constexpr double in_a_group = 10; // of the spread: rounding is small beside exp(-10)
    const int groups = std::max(1, static_cast<int>(std::ceil(spread / in_a_group)));
    const int first = std::max(fewest, groups);
    for (int parts = first; parts <= most; parts *= 2)
        if (auto found = series_by(system, speed, std::max(steps, parts), parts,
                                   static_cast<std::size_t>(groups), -spread, columns, fastest))
            return found;
    return std::nullopt;
}

} // namespace whirl::periodic
