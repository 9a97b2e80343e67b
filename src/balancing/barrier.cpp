#include "balancing/barrier.h"

#include "linalg/dense/singular_values.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace whirl::balancing {

namespace {

/// Relative gap at which the path ends: three powers of ten below what is promised of weights.
constexpr double end_of_path = 1e-9;
constexpr double next_step = 10; ///< the weight of what is made small grows by that
constexpr int most_newton_steps = 60;
/// Square of Newton's decrement: on the way along the path a centre is near enough to go on from,
/// at its end the bound by duality wants all digits.
constexpr double on_the_way = 1e-2;
constexpr double at_the_end = 1e-12;

/// A function with its gradient and Hessian; infinite outside its domain.
struct Local {
    double value = 0;
    Eigen::VectorXd gradient;
    Eigen::MatrixXd hessian;
};

/// Real and imaginary part of weights in pairs, and back.
Eigen::VectorXd in_reals(const Eigen::VectorXcd &w) {
    Eigen::VectorXd x(2 * w.size());
    x << w.real(), w.imag();
    return x;
}
Eigen::VectorXcd in_complex(const Eigen::VectorXd &x) {
    const Eigen::Index n = x.size() / 2;
    Eigen::VectorXcd w(n);
    w.real() = x.head(n);
    w.imag() = x.segment(n, n);
    return w;
}

/// The problem as one of what is changed at a start within the bounds, so that no digits are lost
/// where little stays of much vibration; in numbers of the size of one: vibrations over the largest
/// at the start, weights over what makes such a vibration.
struct Scaled {
    Balance balance; ///< a: vibration at the start
    Eigen::VectorXcd start;
    double vibration = 1;
    Eigen::VectorXd weight; ///< of each plane

    Scaled(const Balance &given, const Eigen::VectorXcd &near)
        : balance(given), start(near), weight(given.H.cols()) {
        constexpr double well = 0.9; // within the bounds
        for (Eigen::Index p = 0; p < start.size(); ++p)
            if (std::abs(start(p)) > well * given.largest(p))
                start(p) *= well * given.largest(p) / std::abs(start(p));
        balance.a = given.residual(start);
        vibration = balance.a.lpNorm<Eigen::Infinity>();
        if (!(vibration > 0))
            vibration = 1;
        for (Eigen::Index p = 0; p < weight.size(); ++p) {
            const double influence = given.H.col(p).lpNorm<Eigen::Infinity>();
            weight(p) = influence > 0 ? vibration / influence : 1;
        }
        balance.a /= vibration;
        balance.H = given.H * weight.asDiagonal() / vibration;
        balance.largest = given.largest.cwiseQuotient(weight);
        start = start.cwiseQuotient(weight.cast<std::complex<double>>());
    }
    /// Weights after a change in reals.
    [[nodiscard]] Eigen::VectorXd all(const Eigen::VectorXd &change) const {
        return change + in_reals(start);
    }
    [[nodiscard]] Eigen::VectorXcd back(const Eigen::VectorXcd &w) const {
        return (start + w).cwiseProduct(weight.cast<std::complex<double>>());
    }
};

/// Adds - log(m^2 - |w|^2) of every plane with a bound; false outside.
bool add_bounds(const Eigen::VectorXd &largest, const Eigen::VectorXd &x, Local &f) {
    const Eigen::Index n = largest.size();
    for (Eigen::Index p = 0; p < n; ++p) {
        if (std::isinf(largest(p)))
            continue;
        const Eigen::Vector2d w(x(p), x(n + p));
        const double room = (largest(p) - w.norm()) * (largest(p) + w.norm());
        if (!(room > 0))
            return false;
        f.value -= std::log(room);
        const Eigen::Vector2d slope = 2 * w / room;
        for (Eigen::Index i = 0; i < 2; ++i) {
            f.gradient(p + i * n) += slope(i);
            for (Eigen::Index j = 0; j < 2; ++j)
                f.hessian(p + i * n, p + j * n) += slope(i) * slope(j) + (i == j ? 2 / room : 0.0);
        }
    }
    return true;
}

/// H as it acts on the reals of weights: rows of real parts, then of imaginary ones.
Eigen::MatrixXd real_rows(const Eigen::MatrixXcd &H) {
    Eigen::MatrixXd A(2 * H.rows(), 2 * H.cols());
    A << H.real(), -H.imag(), H.imag(), H.real();
    return A;
}

/// Newton's method with steps halved until they descend; the domain is never left. Near the end,
/// where the function is self-concordant and its value rounded to more than is left, whole steps.
/// @param function  at a place, with its derivatives or without; none outside its domain
/// @param settled  square of Newton's decrement at which it ends
/// @returns the function where it ends
template <class Function>
Local descend(const Function &function, Eigen::VectorXd &x, double settled) {
    constexpr double near = 0.05; // whole steps stay inside and converge below 0.38^2
    constexpr double least_share = 1e-6;
    constexpr double enough = 0.1; // of the descent that the slope promises
    double last = std::numeric_limits<double>::infinity();
    for (int step = 0; step < most_newton_steps; ++step) {
        Local here = *function(x, true);
        const Eigen::VectorXd d = -here.hessian.ldlt().solve(here.gradient);
        const double slope = here.gradient.dot(d);
        const double squared = -slope;
        if (!(squared > settled) || (squared < near && squared > last / 2))
            return here; // done, or rounding is larger than what is left
        last = squared < near ? squared : last;
        double share = 1;
        while (share > least_share) {
            const auto there = function(x + share * d, false);
            if (there && (squared < near || there->value <= here.value + enough * share * slope))
                break;
            share /= 2;
        }
        if (share <= least_share)
            return here;
        x += share * d;
    }
    return *function(x, true);
}

/// t weight - sum log(t^2 - |r|^2) of all places, with the bounds; unknowns are the changes of the
/// weights and t.
std::optional<Local> largest_barrier(const Scaled &scaled, const Eigen::MatrixXd &A, double weight,
                                     const Eigen::VectorXd &x, bool derivatives) {
    const Balance &balance = scaled.balance;
    const Eigen::Index n = x.size() - 1;
    const Eigen::Index rows = balance.a.size();
    const double t = x(n);
    Local f{weight * t, Eigen::VectorXd::Zero(n + 1), Eigen::MatrixXd::Zero(n + 1, n + 1)};
    f.gradient(n) = weight;
    if (!(t > 0) || !add_bounds(balance.largest, scaled.all(x.head(n)), f))
        return std::nullopt;
    const Eigen::VectorXd r = A * x.head(n) + in_reals(balance.a);
    const auto re = r.head(rows).array();
    const auto im = r.tail(rows).array();
    const Eigen::ArrayXd size = (re.square() + im.square()).sqrt();
    const Eigen::ArrayXd room = (t - size) * (t + size);
    if (!(room.minCoeff() > 0))
        return std::nullopt;
    f.value -= room.log().sum();
    if (!derivatives)
        return f;
    // Of each place, u = (Re r, Im r): slope (2 u, -2 t)/room, bend slope slope^T + diag(2, 2,
    // -2)/room. What of the bend is in u is L L^T: one product for all.
    const Eigen::ArrayXd even = 2 / room;
    Eigen::VectorXd slope(2 * rows);
    slope << even * re, even * im;
    const Eigen::ArrayXd first = (even + (even * re).square()).sqrt();
    const Eigen::ArrayXd second = (even * (even + (even * size).square())).sqrt() / first;
    const Eigen::ArrayXd mixed = (even * re) * (even * im) / first;
    Eigen::MatrixXd root(2 * rows, n);
    root << first.matrix().asDiagonal() * A.topRows(rows) +
                mixed.matrix().asDiagonal() * A.bottomRows(rows),
        second.matrix().asDiagonal() * A.bottomRows(rows);
    const Eigen::ArrayXd of_t = -t * even;
    Eigen::MatrixXd sides(2 * rows, 2);
    sides << slope, slope.cwiseProduct(of_t.matrix().replicate(2, 1));
    const Eigen::MatrixXd along = A.transpose() * sides;
    f.gradient.head(n) += along.col(0);
    f.gradient(n) += of_t.sum();
    Eigen::MatrixXd bend = Eigen::MatrixXd::Zero(n, n);
    bend.selfadjointView<Eigen::Lower>().rankUpdate(root.transpose());
    f.hessian.topLeftCorner(n, n) += Eigen::MatrixXd(bend.selfadjointView<Eigen::Lower>());
    f.hessian.col(n).head(n) += along.col(1);
    f.hessian.row(n).head(n) += along.col(1).transpose();
    f.hessian(n, n) += of_t.matrix().squaredNorm() - even.sum();
    return f;
}

/// max |a + H w| is at least Re(y^H (a + H w)) for every y with sum |y| <= 1: of planes with bounds
/// the least of that, of planes without them y must not see them. A y that is right but for
/// rounding is made so: changed at each place in proportion to what it is there, so that places
/// below the largest stay out of it.
/// @param w  whose y this is: planes within their bounds are not seen either
double largest_bound(const Balance &balance, Eigen::VectorXcd y, const Eigen::VectorXcd &w) {
    constexpr double inside = 0.999;
    std::vector<std::size_t> unseen;
    for (Eigen::Index p = 0; p < balance.largest.size(); ++p)
        if (!(std::abs(w(p)) > inside * balance.largest(p)))
            unseen.push_back(static_cast<std::size_t>(p));
    if (!unseen.empty()) {
        y /= y.array().abs().sum();
        const Eigen::VectorXd root = y.cwiseAbs().cwiseSqrt();
        const linalg::SingularValues svd =
            linalg::singular_values(root.asDiagonal() * balance.of_planes(unseen).H);
        Eigen::Index rank = 0;
        while (rank < svd.s.size() && svd.s(rank) > 1e-14 * svd.s(0))
            ++rank;
        const auto U = svd.U.leftCols(rank);
        Eigen::VectorXcd even = y; // root z = y
        for (Eigen::Index i = 0; i < y.size(); ++i)
            even(i) = root(i) > 0 ? std::complex<double>(y(i) / root(i)) : 0.0;
        // Twice: what rounding leaves of the first is gone after the second.
        for (int i = 0; i < 2; ++i)
            even -= U * (U.adjoint() * even).eval();
        y = root.asDiagonal() * even;
    }
    const double sum = y.array().abs().sum();
    if (!(sum > 0))
        return 0;
    y /= sum;
    double bound = y.dot(balance.a).real();
    const Eigen::VectorXcd pull = balance.H.adjoint() * y;
    for (Eigen::Index p = 0; p < pull.size(); ++p)
        if (!std::isinf(balance.largest(p)))
            bound -= balance.largest(p) * std::abs(pull(p));
    return std::max(bound, 0.0);
}

} // namespace

Certified least_largest(const Balance &balance, const Eigen::VectorXcd &start) {
    const Scaled scaled(balance, start);
    const Balance &of = scaled.balance;
    const Eigen::Index n = 2 * of.H.cols();
    const Eigen::Index rows = of.a.size();
    const Eigen::MatrixXd A = real_rows(of.H);
    Eigen::VectorXd x(n + 1);
    x.head(n).setZero();
    constexpr double above = 1.5;
    x(n) = above * of.residual(in_complex(x.head(n))).lpNorm<Eigen::Infinity>();
    const double cones = 2 * static_cast<double>(rows + of.H.cols());
    double weight = cones / x(n);
    Certified out;
    const auto barrier = [&](const Eigen::VectorXd &at, bool derivatives) {
        return largest_barrier(scaled, A, weight, at, derivatives);
    };
    while (true) {
        const Local here = descend(barrier, x, on_the_way);
        if (cones / weight <= end_of_path * x(n))
            break;
        // The path is nearly straight over 1/weight: on along it, as far as is inside.
        const Eigen::VectorXd end =
            -weight * here.hessian.ldlt().solve(Eigen::VectorXd::Unit(n + 1, n));
        constexpr double shortest = 1e-6; // a guard: then there is no way on
        double share = 1 - 1 / next_step;
        while (share > shortest && !barrier(x + share * end, false))
            share /= 2;
        if (share > shortest)
            x += share * end;
        weight *= next_step;
    }
    descend(barrier, x, at_the_end);
    const Eigen::VectorXcd w = in_complex(x.head(n));
    const Eigen::VectorXcd r = of.residual(w);
    Eigen::VectorXcd y = r;
    for (Eigen::Index i = 0; i < rows; ++i)
        y(i) *= 2 / (weight * (x(n) - std::abs(r(i))) * (x(n) + std::abs(r(i))));
    out.w = scaled.back(w);
    out.bound = largest_bound(balance, y, out.w);
    return out;
}

Eigen::VectorXcd bounded_least_squares(const Balance &balance, const Eigen::VectorXcd &start) {
    const Scaled scaled(balance, start);
    const Balance &of = scaled.balance;
    const Eigen::MatrixXd A = real_rows(of.H);
    const Eigen::MatrixXd normal = A.transpose() * A;
    const Eigen::VectorXd b = in_reals(of.a);
    Eigen::VectorXd x = Eigen::VectorXd::Zero(A.cols());
    const double cones = 2 * static_cast<double>(of.H.cols());
    double weight = 1;
    const auto barrier = [&](const Eigen::VectorXd &at, bool) -> std::optional<Local> {
        const Eigen::VectorXd r = A * at + b;
        Local f{weight * r.squaredNorm() / 2, weight * A.transpose() * r, weight * normal};
        if (!add_bounds(of.largest, scaled.all(at), f))
            return std::nullopt;
        return f;
    };
    while (true) {
        descend(barrier, x, on_the_way);
        const double reached = (A * x + b).squaredNorm() / 2;
        if (cones / weight <= end_of_path * std::max(reached, end_of_path * b.squaredNorm()))
            break;
        weight *= next_step;
    }
    descend(barrier, x, at_the_end);
    return scaled.back(in_complex(x));
}

double least_squares_bound(const Balance &balance, const Eigen::VectorXcd &w) {
    // Lagrange's function with multipliers l >= 0: |a + H w|^2 + sum l (|w|^2 - m^2), whose least
    // value bounds the problem. At the end of the path H^H r + l w = 0.
    const Eigen::VectorXcd pull = balance.H.adjoint() * balance.residual(w);
    const Eigen::Index rows = balance.H.rows(), planes = balance.H.cols();
    Eigen::MatrixXcd both = Eigen::MatrixXcd::Zero(rows + planes, planes);
    both.topRows(rows) = balance.H;
    Eigen::VectorXcd right = Eigen::VectorXcd::Zero(rows + planes);
    right.head(rows) = balance.a;
    double taken = 0;
    for (Eigen::Index p = 0; p < planes; ++p) {
        if (std::isinf(balance.largest(p)) || w(p) == 0.0)
            continue;
        const double multiplier =
            std::max(0.0, -(std::conj(w(p)) * pull(p)).real()) / std::norm(w(p));
        both(rows + p, p) = std::sqrt(multiplier);
        taken += multiplier * balance.largest(p) * balance.largest(p);
    }
    const linalg::SingularValues svd = linalg::singular_values(both);
    Eigen::Index rank = 0;
    while (rank < svd.s.size() && svd.s(rank) > 1e-14 * svd.s(0))
        ++rank;
    const Eigen::VectorXcd left =
        right - svd.U.leftCols(rank) * (svd.U.leftCols(rank).adjoint() * right);
    return std::sqrt(std::max(0.0, left.squaredNorm() - taken));
}

} // namespace whirl::balancing
