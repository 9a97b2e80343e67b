#include "balancing/barrier.h"
#include "balancing/weights.h"
#include "support/random.h"

#include <Eigen/LU>
#include <Eigen/QR>

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

namespace whirl::tests {

namespace {

using balancing::Balance;
using balancing::Solution;
using Complex = std::complex<double>;

constexpr double no_bound = std::numeric_limits<double>::infinity();

Complex drawn(Random &random) { return {random(-1, 1), random(-1, 1)}; }

Balance random_balance(Random &random, Eigen::Index places, Eigen::Index planes) {
    Balance out{Eigen::MatrixXcd(places, planes), Eigen::VectorXcd(places),
                Eigen::VectorXd::Ones(places), Eigen::VectorXd::Constant(planes, no_bound)};
    for (Eigen::Index i = 0; i < places; ++i) {
        out.a(i) = 1e-5 * drawn(random);
        for (Eigen::Index p = 0; p < planes; ++p)
            out.H(i, p) = 0.3 * drawn(random);
    }
    return out;
}

double largest_of(const Balance &balance, const Eigen::VectorXcd &w) {
    return (balance.factors.asDiagonal() * balance.residual(w)).lpNorm<Eigen::Infinity>();
}

/// A number that weights cannot go below, in another way than the program's: of a problem without
/// bounds the circles of vibration are replaced by polygons around them, and the best multipliers
/// of the active corners come from least squares on w's own active set. Here the certificate alone:
/// y of the active places with H^H y = 0, by least squares of the condition that their gradients
/// cancel.
double certificate(const Balance &balance, const Eigen::VectorXcd &w) {
    const Eigen::VectorXcd r = balance.factors.asDiagonal() * balance.residual(w);
    const double largest = r.lpNorm<Eigen::Infinity>();
    std::vector<Eigen::Index> active;
    for (Eigen::Index i = 0; i < r.size(); ++i)
        if (std::abs(r(i)) > largest * (1 - 1e-5))
            active.push_back(i);
    const auto n = static_cast<Eigen::Index>(active.size());
    const Eigen::Index planes = balance.H.cols();
    // sum l_i conj(f H_i) r_i / |r_i| = 0, sum l_i = 1: real unknowns.
    Eigen::MatrixXd A(2 * planes + 1, n);
    for (Eigen::Index k = 0; k < n; ++k) {
        const Eigen::Index i = active[static_cast<std::size_t>(k)];
        const Eigen::VectorXcd pull =
            balance.factors(i) * balance.H.row(i).adjoint() * (r(i) / std::abs(r(i)));
        A.col(k) << pull.real(), pull.imag(), 1;
    }
    Eigen::VectorXd b = Eigen::VectorXd::Zero(2 * planes + 1);
    b(2 * planes) = 1;
    const Eigen::VectorXd l = A.colPivHouseholderQr().solve(b);
    EXPECT_LT((A * l - b).norm(), 1e-4) << "gradients of the active places cancel";
    EXPECT_GT(l.minCoeff(), -1e-4) << "none of them pushes the other way";
    return largest;
}

TEST(Minimax, IsWithinAMillionthOfItsBound) {
    Random random(7);
    for (int draw = 0; draw < 40; ++draw) {
        const Eigen::Index planes = 1 + draw % 4;
        Balance balance = random_balance(random, planes + 3 + draw % 9, planes);
        if (draw % 3 == 1)
            for (Eigen::Index i = 0; i < balance.factors.size(); ++i)
                balance.factors(i) = random(0.2, 3);
        const Solution free = balancing::minimax(balance);
        EXPECT_LE(free.value, free.bound * (1 + 1e-6)) << "draw " << draw;
        EXPECT_LE(free.bound, free.value * (1 + 1e-12));
        EXPECT_NEAR(largest_of(balance, free.w), free.value, 1e-12 * free.value);
        certificate(balance, free.w);
        const Solution squares = balancing::least_squares(balance);
        EXPECT_LE(free.value, largest_of(balance, squares.w) * (1 + 1e-9));
        // Bounds at half of what is wanted.
        balance.largest.setConstant(free.w.lpNorm<Eigen::Infinity>() / 2);
        const Solution held = balancing::minimax(balance);
        EXPECT_LE((held.w.array().abs() / balance.largest.array()).maxCoeff(), 1 + 1e-12);
        EXPECT_LE(held.value, held.bound * (1 + 1e-6)) << "draw " << draw;
        EXPECT_TRUE(balancing::bounds_cost(balance, held, balancing::minimax));
        EXPECT_GE(held.value, free.value * (1 - 1e-9));
    }
}

/// Least value of a convex function between two places, by thirds.
template <class Function> double least_between(double low, double high, const Function &function) {
    for (int i = 0; i < 120; ++i) {
        const double a = low + (high - low) / 3, b = high - (high - low) / 3;
        (function(a) < function(b) ? high : low) = function(a) < function(b) ? b : a;
    }
    return function((low + high) / 2);
}

/// One plane: convex in two real numbers, so that a search over one within a search over the other
/// finds the least.
TEST(Minimax, OfOnePlaneAgreesWithASearchWithinASearch) {
    Random random(11);
    for (int draw = 0; draw < 5; ++draw) {
        const Balance balance = random_balance(random, 6, 1);
        const Solution found = balancing::minimax(balance);
        const double far = 10 * std::abs(balancing::least_squares(balance).w(0));
        const double least = least_between(-far, far, [&](double x) {
            return least_between(-far, far, [&](double y) {
                return largest_of(balance, Eigen::VectorXcd::Constant(1, Complex(x, y)));
            });
        });
        EXPECT_NEAR(found.value, least, 1e-6 * least);
        EXPECT_LE(found.value, least * (1 + 1e-8));
    }
}

TEST(LeastSquares, WithinBoundsIsOptimal) {
    Random random(3);
    for (int draw = 0; draw < 20; ++draw) {
        Balance balance = random_balance(random, 8, 3);
        const Solution free = balancing::least_squares(balance);
        balance.largest.setConstant(0.6 * free.w.lpNorm<Eigen::Infinity>());
        const Solution held = balancing::least_squares(balance);
        EXPECT_LE((held.w.array().abs() / balance.largest.array()).maxCoeff(), 1 + 1e-12);
        EXPECT_GE(held.value, free.value);
        EXPECT_LE(held.value, held.bound * (1 + 1e-6));
        EXPECT_LE(held.bound, held.value * (1 + 1e-12));
        // Conditions of Karush, Kuhn and Tucker: H^H r = -l w with l = 0 inside and l >= 0 on the
        // bound.
        const Eigen::VectorXcd pull = balance.H.adjoint() * balance.residual(held.w);
        const double size = (balance.H.adjoint() * balance.a).norm();
        for (Eigen::Index p = 0; p < 3; ++p) {
            const bool on = std::abs(held.w(p)) > balance.largest(p) * (1 - 1e-6);
            const Complex along = -std::conj(held.w(p)) * pull(p) / std::abs(held.w(p));
            EXPECT_NEAR(along.imag(), 0, 1e-6 * size);
            if (on)
                EXPECT_GT(along.real(), -1e-6 * size);
            else
                EXPECT_NEAR(along.real(), 0, 1e-6 * size);
        }
    }
}

TEST(LeastSquares, OfMorePlanesThanPlacesIsTheShortest) {
    Random random(5);
    const Balance balance = random_balance(random, 2, 4);
    for (const Solution &found : {balancing::least_squares(balance), balancing::minimax(balance)}) {
        EXPECT_FALSE(found.unique);
        EXPECT_LT(balance.residual(found.w).norm(), 1e-12 * balance.a.norm());
        // Orthogonal to all that moves nothing: w = H^H of something.
        const Eigen::MatrixXcd gram = balance.H * balance.H.adjoint();
        const Eigen::VectorXcd shortest = -balance.H.adjoint() * gram.fullPivLu().solve(balance.a);
        EXPECT_LT((found.w - shortest).norm(), 1e-10 * shortest.norm());
    }
}

/// Two planes in one place share what one of them may not hold: bounds cost nothing there.
TEST(Bounds, ThatCostNothingAreNotSaidToCost) {
    Random random(21);
    for (int draw = 0; draw < 10; ++draw) {
        Balance balance = random_balance(random, 6, 2);
        const double alone =
            std::abs(balancing::least_squares(balance.of_planes({0})).w(0)); // within any phase
        balance.H.col(1) = balance.H.col(0);
        balance.largest << 0.8 * alone, 3 * alone;
        for (const auto method : {balancing::least_squares, balancing::minimax}) {
            const Solution found = method(balance);
            EXPECT_FALSE(found.unique);
            EXPECT_FALSE(balancing::bounds_cost(balance, found, method)) << "draw " << draw;
        }
        balance.largest << 0.1 * alone, 0.2 * alone;
        for (const auto method : {balancing::least_squares, balancing::minimax}) {
            const Solution found = method(balance);
            EXPECT_TRUE(balancing::bounds_cost(balance, found, method)) << "draw " << draw;
            EXPECT_FALSE(found.shortest);
        }
    }
}

TEST(LeastSquares, WithFactorsIsThatOfRowsRepeated) {
    Random random(9);
    Balance balance = random_balance(random, 5, 2);
    balance.factors(2) = 2; // as four readings of that place
    const Eigen::Index more = 8;
    Balance repeated{Eigen::MatrixXcd(more, 2), Eigen::VectorXcd(more), Eigen::VectorXd::Ones(more),
                     balance.largest};
    const std::vector<Eigen::Index> rows{0, 1, 2, 2, 2, 2, 3, 4};
    for (Eigen::Index i = 0; i < more; ++i) {
        repeated.H.row(i) = balance.H.row(rows[static_cast<std::size_t>(i)]);
        repeated.a(i) = balance.a(rows[static_cast<std::size_t>(i)]);
    }
    const Eigen::VectorXcd w = balancing::least_squares(repeated).w;
    EXPECT_LT((balancing::least_squares(balance).w - w).norm(), 1e-12 * w.norm());
}

TEST(LeastSquares, OfNothingIsNothing) {
    Balance balance{Eigen::MatrixXcd::Zero(3, 2), Eigen::VectorXcd::Zero(3),
                    Eigen::VectorXd::Ones(3), Eigen::VectorXd::Constant(2, no_bound)};
    for (const Solution &found : {balancing::least_squares(balance), balancing::minimax(balance)}) {
        EXPECT_EQ(found.w.norm(), 0);
        EXPECT_EQ(found.value, 0);
    }
    balance.a.setConstant(1e-5); // planes that move nothing
    for (const Solution &found : {balancing::least_squares(balance), balancing::minimax(balance)}) {
        EXPECT_TRUE(found.w.allFinite());
        EXPECT_EQ(found.w.norm(), 0);
        EXPECT_FALSE(found.unique);
    }
}

} // namespace

} // namespace whirl::tests
