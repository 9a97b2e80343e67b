#include "simulation/ode/ode_solver.h"

#include "linalg/check.h"
#include "simulation/ode/adams_weights.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

namespace whirl::simulation {
namespace {

constexpr double tolerance = 1e-9;

/// x'' = -x from (1, 0).
OdeProblem oscillator() {
    return {2,
            [](double, const double *y, double *rates) {
                rates[0] = y[1];
                rates[1] = -y[0];
            },
            [](const double *, double *allowed) { allowed[0] = allowed[1] = tolerance; }};
}

double run(OdeSolver &solver, double from, double end) {
    double t = from;
    while (t < end)
        t = solver.step(end);
    return t;
}

class OdeMethods : public testing::TestWithParam<OdeMethod> {};

TEST_P(OdeMethods, FollowAnOscillation) {
    const auto solver = ode_solver(oscillator(), GetParam());
    const std::array<double, 2> start{1, 0};
    solver->start(0, start.data());
    EXPECT_EQ(run(*solver, 0, 20), 20); // met exactly
    // Some hundred steps with errors up to the tolerance.
    EXPECT_NEAR(solver->state()[0], std::cos(20), 1e3 * tolerance);
    EXPECT_NEAR(solver->state()[1], -std::sin(20), 1e3 * tolerance);
    EXPECT_GT(solver->counts().steps, 0);
    EXPECT_GE(solver->counts().rates, solver->counts().steps);
}

// The force jumps at t = 1: x'' = 0 before, 1 after.
TEST_P(OdeMethods, StartAgainWhereTheRatesJump) {
    double force = 0;
    OdeProblem problem = oscillator();
    problem.rates = [&force](double, const double *y, double *rates) {
        rates[0] = y[1];
        rates[1] = force;
    };
    const auto solver = ode_solver(problem, GetParam());
    const std::array<double, 2> start{0, 1};
    solver->start(0, start.data());
    run(*solver, 0, 1);
    const long steps = solver->counts().steps;
    force = 1;
    const std::array<double, 2> middle{solver->state()[0], solver->state()[1]};
    solver->start(1, middle.data(), solver->next_step());
    run(*solver, 1, 3);
    EXPECT_NEAR(solver->state()[0], 3 + 2, 1e-8); // exact for these methods but for rounding
    EXPECT_GT(solver->counts().steps, steps);     // counted on
}

TEST_P(OdeMethods, GiveUpInWordsWhereTheRatesAreNoNumbers) {
    OdeProblem problem = oscillator();
    problem.rates = [](double t, const double *y, double *rates) {
        rates[0] = y[1];
        rates[1] = t > 0.5 ? NAN : 0;
    };
    const auto solver = ode_solver(problem, GetParam());
    const std::array<double, 2> start{0, 1};
    solver->start(0, start.data());
    EXPECT_THROW(run(*solver, 0, 1), linalg::SolverError);
}

INSTANTIATE_TEST_SUITE_P(Both, OdeMethods,
                         testing::Values(OdeMethod::explicit_high_order,
                                         OdeMethod::implicit_stiff));

/// A fast vector x, which a slow oscillator y makes softer, and which drives that: in resting axes
/// x'' = (-1e6 + 1e3 y^2) x - 40 x', y'' = -4 y + 1e-3 |x|^2; followed in axes that turn with
/// 3 rad/s. State: both components of x; y; those of x'; y'.
class Driven {
  public:
    static constexpr int size = 6;
    static constexpr double fast = 1e6, damping = 40, drive = 1e3, back = 1e-3;

    [[nodiscard]] OdeProblem problem() const {
        OdeProblem problem;
        problem.size = size;
        problem.rates = rates;
        problem.allowed_error = [](const double *, double *allowed) {
            std::fill_n(allowed, size, tolerance);
        };
        problem.axes.speed = 3;
        problem.axes.count = 1;
        problem.axes.first = {0, 3};
        return problem;
    }
    /// Its linear part: x' = v - 3i x, v' = -fast x - damping v - 3i v.
    [[nodiscard]] OdeProblem with_linear_part() const {
        OdeProblem with = problem();
        const std::complex<double> turning(0, 3);
        Eigen::MatrixXcd A(2, 2);
        A << -turning, 1, -fast, -damping - turning;
        const Eigen::ComplexEigenSolver<Eigen::MatrixXcd> eigen(A);
        with.axes.linear = {eigen.eigenvalues(), eigen.eigenvectors(),
                            eigen.eigenvectors().inverse()};
        return with;
    }

  private:
    /// Alike from axes turned by any angle: y drives along x itself.
    static void rates(double /*t*/, const double *y, double *out) {
        const double square = y[0] * y[0] + y[1] * y[1];
        out[0] = y[3];
        out[1] = y[4];
        out[2] = y[5];
        const double factor = -fast + drive * y[2] * y[2];
        out[3] = factor * y[0] - damping * y[3];
        out[4] = factor * y[1] - damping * y[4];
        out[5] = -4 * y[2] + back * square;
    }
};

TEST(OdeSolver, ExponentialMethodAgreesWithTheExplicitOneInLongerSteps) {
    const Driven scene;
    const std::array<double, Driven::size> start{1, 0, 1, 0, 500, 0};
    const auto explicit_one = ode_solver(scene.problem(), OdeMethod::explicit_high_order);
    const auto exponential = ode_solver(scene.with_linear_part(), OdeMethod::exponential);
    for (OdeSolver *solver : {explicit_one.get(), exponential.get()}) {
        solver->start(0, start.data());
        run(*solver, 0, 1);
        run(*solver, 1, 2); // another stop
    }
    for (int i = 0; i < Driven::size; ++i) {
        const double size = i == 3 || i == 4 ? 1e3 : 1;
        EXPECT_NEAR(exponential->state()[i], explicit_one->state()[i], 1e4 * tolerance * size) << i;
    }
    EXPECT_LT(exponential->counts().rates, explicit_one->counts().rates / 4);
    EXPECT_EQ(exponential->counts().rates - 1,
              2 * exponential->counts().steps + exponential->counts().failed);
}

// x alone is linear: exact in whatever steps, and within them.
TEST(OdeSolver, ExponentialMethodIsExactWhereAllIsLinear) {
    const auto solver = ode_solver(Driven{}.with_linear_part(), OdeMethod::exponential);
    const std::array<double, Driven::size> start{1, 0, 0, 0, 0, 0};
    solver->start(0, start.data());
    double before = 0;
    double t = 0;
    const double decay = Driven::damping / 2;
    const double frequency = std::sqrt(Driven::fast - decay * decay);
    const auto exact = [&](double at) {
        return std::exp(-decay * at) *
               (std::cos(frequency * at) + decay / frequency * std::sin(frequency * at));
    };
    while (t < 0.1) {
        before = t;
        t = solver->step(0.1);
        EXPECT_NEAR(solver->state()[0], exact(t), 1e-3 * Driven::back);
        EXPECT_NEAR(solver->within(0.3)[0], exact(before + 0.3 * (t - before)),
                    1e-3 * Driven::back);
    }
}

TEST(OdeSolver, ExponentialMethodGivesUpInWords) {
    OdeProblem problem = Driven{}.with_linear_part();
    problem.rates = [](double, const double *y, double *rates) {
        std::fill_n(rates, Driven::size, 0.0);
        rates[2] = y[2] < 2 ? 1 + y[2] * y[2] : NAN; // tan t: 2 at t = 1.107
    };
    const auto solver = ode_solver(problem, OdeMethod::exponential);
    const std::array<double, Driven::size> start{};
    solver->start(0, start.data());
    EXPECT_THROW(run(*solver, 0, 2), linalg::SolverError);
    EXPECT_NEAR(solver->state()[2], 2, 1e-6);
}

// Adams and Bashforth; and of a = i the integrals by hand.
TEST(AdamsWeights, AreThoseOfTheTextbooks) {
    const std::complex<double> i(0, 1);
    const AdamsWeights w = adams_weights(Eigen::Vector2cd(0, i), 0.5, 5);
    const std::array<double, 5> known{1, 1. / 2, 5. / 12, 3. / 8, 251. / 720};
    for (int j = 0; j < 5; ++j) {
        EXPECT_NEAR(w.own[static_cast<std::size_t>(j)], 0.5 * known[static_cast<std::size_t>(j)],
                    1e-15);
        EXPECT_NEAR(std::abs(w.modal(0, j) - 0.5 * known[static_cast<std::size_t>(j)]), 0, 1e-15);
    }
    const std::complex<double> z = 0.5 * i;
    EXPECT_NEAR(std::abs(w.growth(1) - std::exp(z)), 0, 1e-15);
    EXPECT_NEAR(std::abs(w.modal(1, 0) - 0.5 * (std::exp(z) - 1.) / z), 0, 1e-15);
    EXPECT_NEAR(std::abs(w.modal(1, 1) - 0.5 * (std::exp(z) - 1. - z) / (z * z)), 0, 1e-14);
}

// The integrals by hand on both sides of the |h a| at which the quadrature changes, and at the
// last.
TEST(AdamsWeights, HoldUpToTheirReach) {
    for (const double size : {7.9, 8.1, 29.9})
        for (const double angle : {1.6, 2.2, 3.1}) {
            const std::complex<double> z = std::polar(size, angle);
            const AdamsWeights w = adams_weights(Eigen::VectorXcd::Constant(1, z), 1, 2);
            EXPECT_NEAR(std::abs(w.modal(0, 0) - (std::exp(z) - 1.) / z), 0, 1e-15);
            EXPECT_NEAR(std::abs(w.modal(0, 1) - (std::exp(z) - 1. - z) / (z * z)), 0, 1e-15);
        }
}

// Of t^3 at steps of 1 and of 0.4: differences of its values.
TEST(AdamsWeights, DifferencesAtOtherSteps) {
    const auto differences = [](double h) {
        Eigen::RowVectorXd v(5);
        for (int i = 0; i < 5; ++i)
            v(i) = std::pow(2 - i * h, 3);
        for (int j = 1; j < 5; ++j)
            for (int i = 4; i >= j; --i)
                v(i) = v(i - 1) - v(i);
        return v;
    };
    const Eigen::RowVectorXd shorter = differences(1) * rescaled_differences(0.4, 5);
    EXPECT_LT((shorter - differences(0.4)).cwiseAbs().maxCoeff(), 1e-13);
}

// y' = -1e5 (y - cos t) - sin t, y = cos t: the explicit method needs steps of some 5e-5.
TEST(OdeSolver, ImplicitMethodStridesOverStiffParts) {
    OdeProblem problem = oscillator();
    problem.size = 1;
    problem.rates = [](double t, const double *y, double *rates) {
        rates[0] = -1e5 * (y[0] - std::cos(t)) - std::sin(t);
    };
    problem.allowed_error = [](const double *, double *allowed) { allowed[0] = tolerance; };
    const auto solver = ode_solver(problem, OdeMethod::implicit_stiff);
    const double start = 1;
    solver->start(0, &start);
    run(*solver, 0, 10);
    EXPECT_NEAR(solver->state()[0], std::cos(10), 1e2 * tolerance);
    EXPECT_LT(solver->counts().steps, 20000); // a tenth of what stability would ask for
}

} // namespace
} // namespace whirl::simulation
