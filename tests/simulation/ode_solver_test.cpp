#include "simulation/ode_solver.h"

#include "linalg/check.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

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
    OdeSolver solver(oscillator(), GetParam());
    const std::array<double, 2> start{1, 0};
    solver.start(0, start.data());
    EXPECT_EQ(run(solver, 0, 20), 20); // met exactly
    // Some hundred steps with errors up to the tolerance.
    EXPECT_NEAR(solver.state()[0], std::cos(20), 1e3 * tolerance);
    EXPECT_NEAR(solver.state()[1], -std::sin(20), 1e3 * tolerance);
    EXPECT_GT(solver.counts().steps, 0);
    EXPECT_GE(solver.counts().rates, solver.counts().steps);
}

// The force jumps at t = 1: x'' = 0 before, 1 after.
TEST_P(OdeMethods, StartAgainWhereTheRatesJump) {
    double force = 0;
    OdeProblem problem = oscillator();
    problem.rates = [&force](double, const double *y, double *rates) {
        rates[0] = y[1];
        rates[1] = force;
    };
    OdeSolver solver(problem, GetParam());
    const std::array<double, 2> start{0, 1};
    solver.start(0, start.data());
    run(solver, 0, 1);
    const long steps = solver.counts().steps;
    force = 1;
    const std::array<double, 2> middle{solver.state()[0], solver.state()[1]};
    solver.start(1, middle.data(), solver.next_step());
    run(solver, 1, 3);
    EXPECT_NEAR(solver.state()[0], 3 + 2, 1e-8); // exact for these methods but for rounding
    EXPECT_GT(solver.counts().steps, steps);     // counted on
}

TEST_P(OdeMethods, GiveUpInWordsWhereTheRatesAreNoNumbers) {
    OdeProblem problem = oscillator();
    problem.rates = [](double t, const double *y, double *rates) {
        rates[0] = y[1];
        rates[1] = t > 0.5 ? NAN : 0;
    };
    OdeSolver solver(problem, GetParam());
    const std::array<double, 2> start{0, 1};
    solver.start(0, start.data());
    EXPECT_THROW(run(solver, 0, 1), linalg::SolverError);
}

INSTANTIATE_TEST_SUITE_P(Both, OdeMethods,
                         testing::Values(OdeMethod::explicit_high_order,
                                         OdeMethod::implicit_stiff));

// y' = -1e5 (y - cos t) - sin t, y = cos t: the explicit method needs steps of some 5e-5.
TEST(OdeSolver, ImplicitMethodStridesOverStiffParts) {
    OdeProblem problem = oscillator();
    problem.size = 1;
    problem.rates = [](double t, const double *y, double *rates) {
        rates[0] = -1e5 * (y[0] - std::cos(t)) - std::sin(t);
    };
    problem.allowed_error = [](const double *, double *allowed) { allowed[0] = tolerance; };
    OdeSolver solver(problem, OdeMethod::implicit_stiff);
    const double start = 1;
    solver.start(0, &start);
    run(solver, 0, 10);
    EXPECT_NEAR(solver.state()[0], std::cos(10), 1e2 * tolerance);
    EXPECT_LT(solver.counts().steps, 20000); // a tenth of what stability would ask for
}

} // namespace
} // namespace whirl::simulation
