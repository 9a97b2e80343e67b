// What free balancers supply: bounds and angles against least squares with bounds (which an
// undamped rotor makes of it), a closed form and projected steps.

#include "balancing/free_balancers.h"
#include "balancing/weights.h"

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <random>

namespace whirl::balancing {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;

class Random {
  public:
    explicit Random(unsigned seed) : _engine(seed) {}
    Complex complex() { return {_normal(_engine), _normal(_engine)}; }
    double between(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(_engine);
    }
    Eigen::MatrixXcd matrix(Index n) {
        Eigen::MatrixXcd out(n, n);
        for (Complex &value : out.reshaped())
            value = complex();
        return out;
    }
    /// -(B B^H + 1/10), and i times a Hermitian matrix of this size.
    Eigen::MatrixXcd working(Index n, double damping) {
        const Eigen::MatrixXcd B = matrix(n), S = matrix(n);
        return -(B * B.adjoint()) - 0.1 * Eigen::MatrixXcd::Identity(n, n) +
               Complex(0, damping) * (S + S.adjoint());
    }

  private:
    std::mt19937 _engine;
    std::normal_distribution<double> _normal;
};

FreeBalancers random_balancers(Random &random, Index n, double damping) {
    FreeBalancers out{random.working(n, damping), Eigen::VectorXcd(n), Eigen::VectorXd(n)};
    for (Complex &w : out.w)
        w = 3.0 * random.complex();
    for (double &c : out.capacity)
        c = random.between(0.02, 2);
    return out;
}

// Without damping A is Hermitian, and the position is that of least energy: u^H (-A) u/2 -
// Re(w^H u) over |u_j| <= c_j, with -A = L L^H a sum of squares |L^H u - w'|^2, L w' = w.
TEST(FreeBalancers, WithoutDampingTheyAreLeastSquaresWithBounds) {
    Random random(1);
    int full = 0;
    for (int run = 0; run < 60; ++run) {
        const Index n = 1 + run % 5;
        const FreeBalancers of = random_balancers(random, n, 0);
        const Eigen::MatrixXcd L = Eigen::LLT<Eigen::MatrixXcd>(-of.A).matrixL();
        const Balance balance{L.adjoint(), -L.triangularView<Eigen::Lower>().solve(of.w),
                              Eigen::VectorXd::Ones(n), of.capacity};
        const Solution least = least_squares(balance);
        full += bounds_cost(balance, least, least_squares) ? 1 : 0;
        const auto found = best_supply(of);
        ASSERT_TRUE(found) << run;
        // The minimum is known to the gap of the dual bound, the weights to its root.
        EXPECT_NEAR(balance.residual(*found).norm(), least.value, 1e-7 * balance.a.norm()) << run;
        EXPECT_LT((*found - least.w).norm(), 1e-3 * least.w.norm()) << run;
    }
    EXPECT_GT(full, 20);
}

// With damping no energy says it: steps along the motion, cut at the bounds, come to rest there.
TEST(FreeBalancers, WithDampingTheyAreWhereProjectedStepsRest) {
    Random random(2);
    for (int run = 0; run < 40; ++run) {
        const Index n = 1 + run % 4;
        const FreeBalancers of = random_balancers(random, n, 1);
        const auto found = best_supply(of);
        ASSERT_TRUE(found) << run;
        const double size = of.A.norm();
        // A step of the length 2 a/|A|^2 at most comes nearer, a the least work of A.
        const double step = 0.1 / (size * size);
        Eigen::VectorXcd u = *found;
        for (Index j = 0; j < n; ++j)
            u(j) += 0.01 * of.capacity(j);
        const double before = (u - *found).norm();
        for (int i = 0; i < 200000 && (u - *found).norm() > 1e-3 * before; ++i) {
            const Eigen::VectorXcd next = u + step * (of.w + of.A * u);
            for (Index j = 0; j < n; ++j)
                u(j) = next(j) * std::min(1.0, of.capacity(j) / std::abs(next(j)));
        }
        EXPECT_LE((u - *found).norm(), 1e-3 * before) << run;
        const Eigen::VectorXcd left = of.w + of.A * *found;
        for (Index j = 0; j < n; ++j) {
            EXPECT_LE(std::abs((*found)(j)), of.capacity(j) * (1 + 1e-8));
            if (std::abs((*found)(j)) < of.capacity(j) * (1 - 1e-6))
                EXPECT_LT(std::abs(left(j)), 1e-7 * of.w.norm()) << run;
            else
                EXPECT_NEAR(std::arg(left(j) / (*found)(j)), 0, 1e-5) << run;
        }
    }
}

// One plane: b + a c e = l e with l > 0.
TEST(FreeBalancers, OnePlaneBeyondItsCapacity) {
    const Complex a(-2, 0.7), w(1, -3);
    const double c = 0.5;
    const auto found =
        best_supply({Eigen::MatrixXcd::Constant(1, 1, a), Eigen::VectorXcd::Constant(1, w),
                     Eigen::VectorXd::Constant(1, c)});
    ASSERT_TRUE(found);
    const double left = a.real() * c + std::sqrt(std::norm(w) - std::pow(a.imag() * c, 2));
    EXPECT_NEAR(std::abs((*found)(0)), c, 1e-12);
    EXPECT_NEAR(std::abs(w + a * (*found)(0)), left, 1e-12);
}

TEST(FreeBalancers, WithoutBoundsNothingIsLeft) {
    Random random(3);
    FreeBalancers of = random_balancers(random, 4, 0.5);
    of.capacity.setConstant(std::numeric_limits<double>::infinity());
    const auto found = best_supply(of);
    ASSERT_TRUE(found);
    EXPECT_LT((of.w + of.A * *found).norm(), 1e-8 * of.w.norm());
}

TEST(FreeBalancers, NoAnswerWhereTheyDoNotWork) {
    Random random(4);
    FreeBalancers of = random_balancers(random, 3, 0);
    of.A += 50.0 * Eigen::MatrixXcd::Identity(3, 3);
    EXPECT_FALSE(best_supply(of));
}

TEST(FreeBalancers, NothingToDo) {
    Random random(5);
    FreeBalancers of = random_balancers(random, 3, 0);
    of.w.setZero();
    EXPECT_EQ(best_supply(of)->norm(), 0);
}

// Two planes at one place do each other's work: the smaller one gives all, or less, never more.
TEST(FreeBalancers, PlanesAtOnePlace) {
    const FreeBalancers of{Eigen::MatrixXcd::Constant(2, 2, -1.0),
                           Eigen::VectorXcd::Constant(2, Complex(0, 1)), Eigen::Vector2d(0.2, 5)};
    const auto found = best_supply(of);
    ASSERT_TRUE(found);
    EXPECT_LT(std::abs(found->sum() - Complex(0, 1)), 1e-8);
    EXPECT_LE(std::abs((*found)(0)), 0.2 * (1 + 1e-9));
}

} // namespace
} // namespace whirl::balancing
