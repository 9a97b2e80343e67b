#include "balancing/weights.h"

#include "balancing/barrier.h"
#include "linalg/dense/singular_values.h"

#include <algorithm>
#include <cmath>

namespace whirl::balancing {

namespace {

/// Singular values below this share of the largest are rounding: of readings with three digits
/// none is near, of a model's coefficients they are exact to some 1e-14.
constexpr double nothing = 1e-12;

/// Rows times their factors.
Balance weighted(const Balance &balance) {
    Balance out = balance;
    out.H = balance.factors.asDiagonal() * balance.H;
    out.a = balance.factors.asDiagonal() * balance.a;
    return out;
}

/// The shortest w of least |a + H w|, and the rank of H.
struct Shortest {
    Eigen::VectorXcd w;
    Eigen::Index rank = 0;
};
Shortest shortest(const Eigen::MatrixXcd &H, const Eigen::VectorXcd &a) {
    const linalg::SingularValues svd = linalg::singular_values(H);
    Shortest out{Eigen::VectorXcd::Zero(H.cols()), 0};
    while (out.rank < svd.s.size() && svd.s(out.rank) > nothing * svd.s(0))
        ++out.rank;
    const Eigen::VectorXcd along = svd.U.leftCols(out.rank).adjoint() * a;
    out.w = -svd.V.leftCols(out.rank) * (along.array() / svd.s.head(out.rank).array()).matrix();
    return out;
}

bool within(const Eigen::VectorXcd &w, const Eigen::VectorXd &largest) {
    return (w.array().abs() <= largest.array()).all();
}

/// A bound that no sensible weight reaches, for planes that have none where other weights do as
/// well: the barrier then has one middle.
constexpr double far = 1e4;

} // namespace

std::complex<double> without_rounding(std::complex<double> sum, double size) {
    constexpr double rounding = 1e-12; // of solved systems, some digits above that of numbers
    const auto part = [size](double own) { return std::abs(own) <= rounding * size ? 0 : own; };
    return {part(sum.real()), part(sum.imag())};
}

Balance Balance::of_planes(const std::vector<std::size_t> &planes) const {
    Balance out{Eigen::MatrixXcd(H.rows(), static_cast<Eigen::Index>(planes.size())), a, factors,
                Eigen::VectorXd(static_cast<Eigen::Index>(planes.size()))};
    for (Eigen::Index i = 0; const std::size_t plane : planes) {
        out.H.col(i) = H.col(static_cast<Eigen::Index>(plane));
        out.largest(i++) = largest(static_cast<Eigen::Index>(plane));
    }
    return out;
}

Solution least_squares(const Balance &balance) {
    const Balance of = weighted(balance);
    const Shortest free = shortest(of.H, of.a);
    Solution out;
    out.w = free.w;
    out.value = out.bound = of.residual(free.w).norm();
    out.unique = free.rank == of.H.cols();
    out.shortest = true;
    if (within(free.w, of.largest))
        return out;
    out.shortest = false;
    out.w = bounded_least_squares(of, free.w);
    out.value = of.residual(out.w).norm();
    out.bound = std::min(least_squares_bound(of, out.w), out.value); // but for rounding
    return out;
}

Balance reduced(const Balance &balance) {
    const Balance of = weighted(balance);
    const Eigen::Index planes = of.H.cols();
    Eigen::MatrixXcd both(of.H.rows(), planes + 1);
    both << of.H, of.a;
    const linalg::SingularValues svd = linalg::singular_values(both);
    const Eigen::MatrixXcd rows = svd.s.asDiagonal() * svd.V.adjoint();
    return {rows.leftCols(planes), rows.col(planes), Eigen::VectorXd::Ones(rows.rows()),
            Eigen::VectorXd::Constant(planes, std::numeric_limits<double>::infinity())};
}

Solution minimax(const Balance &balance) {
    const Balance of = weighted(balance);
    Solution out = least_squares(balance);
    out.bound = 0;
    out.value = of.residual(out.w).lpNorm<Eigen::Infinity>();
    const double size = of.a.lpNorm<Eigen::Infinity>();
    if (out.value <= nothing * size || of.H.cols() == 0 || of.H.norm() == 0)
        return out; // no weights do better
    Balance held = of;
    if (!out.unique) {
        const double unreached = far * std::max(out.w.lpNorm<Eigen::Infinity>(), 1e-300);
        held.largest = of.largest.cwiseMin(unreached);
    }
    const Certified least = least_largest(held, out.w);
    out.w = least.w;
    out.value = of.residual(out.w).lpNorm<Eigen::Infinity>();
    out.bound = std::min(least.bound, out.value); // but for rounding
    out.shortest = false;
    return out;
}

bool bounds_cost(const Balance &balance, const Solution &solution,
                 Solution (*method)(const Balance &)) {
    constexpr double near_bound = 1 - 1e-6; // a weight that may be held by it
    constexpr double open = 1e-7;           // left by the search, of what is there without weights
    if ((solution.w.array().abs() < near_bound * balance.largest.array()).all())
        return false;
    Balance free = balance;
    free.largest.setConstant(std::numeric_limits<double>::infinity());
    return solution.value > method(free).value + open * weighted(balance).a.norm();
}

Dependence dependence(const Balance &balance) {
    const Balance of = weighted(balance);
    Dependence out;
    out.singular_values = linalg::singular_values(of.H).s;
    const Eigen::Index planes = of.H.cols();
    const bool all = out.singular_values.size() == planes && planes > 0;
    const double least = all ? out.singular_values(planes - 1) : 0;
    out.condition = least > nothing * (all ? out.singular_values(0) : 1)
                        ? out.singular_values(0) / least
                        : std::numeric_limits<double>::infinity();
    out.significance = Eigen::VectorXd::Ones(planes);
    for (Eigen::Index p = 0; p < planes; ++p) {
        Eigen::MatrixXcd others(of.H.rows(), planes - 1);
        others << of.H.leftCols(p), of.H.rightCols(planes - 1 - p);
        const Eigen::VectorXcd own = of.H.col(p);
        const Eigen::VectorXcd beside =
            planes > 1 ? Eigen::VectorXcd(own + others * shortest(others, own).w) : own;
        out.significance(p) = own.norm() > 0 ? beside.norm() / own.norm() : 0;
    }
    return out;
}

std::vector<std::vector<std::size_t>> dependent_sets(const Balance &balance, double least) {
    Eigen::MatrixXcd H = weighted(balance).H;
    for (Eigen::Index p = 0; p < H.cols(); ++p)
        if (const double length = H.col(p).norm(); length > 0)
            H.col(p) /= length;
    const linalg::SingularValues svd = linalg::singular_values(H.adjoint() * H);
    constexpr double takes_part = 0.3; // of the largest share
    std::vector<std::vector<std::size_t>> sets;
    for (Eigen::Index k = 0; k < svd.s.size(); ++k) {
        if (!(svd.s(k) < least * least * svd.s(0)))
            continue;
        std::vector<std::size_t> set;
        const double most = svd.V.col(k).lpNorm<Eigen::Infinity>();
        for (Eigen::Index p = 0; p < H.cols(); ++p)
            if (std::abs(svd.V(p, k)) >= takes_part * most)
                set.push_back(static_cast<std::size_t>(p));
        sets.push_back(std::move(set));
    }
    return sets;
}

} // namespace whirl::balancing
