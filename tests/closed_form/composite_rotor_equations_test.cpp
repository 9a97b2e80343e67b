#include "closed_form/composite_rotor_equations.h"

#include "closed_form/balanced_position.h"
#include "closed_form/composite_rotor_matrices.h"
#include "closed_form/composite_rotor_scales.h"
#include "closed_form/floquet.h"
#include "closed_form/two_balls.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace whirl::closed_form {
namespace {

using Spectrum = std::vector<std::complex<double>>;
using std::numbers::pi;

/// Three balls in a position without symmetry: one at 2.6 rad, the other two close the polygon.
std::vector<double> unsymmetric_position(double E) {
    const std::complex<double> rest(-3.0 / E - std::cos(2.6), -std::sin(2.6));
    const double opening = std::acos(0.5 * std::abs(rest));
    return {2.6, std::arg(rest) + opening, std::arg(rest) - opening};
}

FixedFrameRotor example(const std::vector<double> &angles, double speed) {
    const int n = static_cast<int>(angles.size());
    const BallSet balls{n, 6.0 / n / 1.5, 0.2, 0.9};
    const PlaneImbalance imbalance{0.5, 2.0};
    const auto supports = reduced_supports({3e4, 40.0, -0.3}, {5e4, 90.0, 0.35});
    const BareRotor rotor{57.83, 1.413, 0.889, 0.1};
    return {physical_parameters(rotor, balls, imbalance, second_harmonic(angles), supports, speed),
            angles};
}

/// Largest distance of any value of one spectrum from the other, both ways.
double distance(const Spectrum &first, const Spectrum &second) {
    double largest = 0.0;
    const auto one_way = [&](const Spectrum &from, const Spectrum &to) {
        for (const auto value : from) {
            double nearest = 1e300;
            for (const auto other : to)
                nearest = std::min(nearest, std::abs(value - other));
            largest = std::max(largest, nearest);
        }
    };
    one_way(first, second);
    one_way(second, first);
    return largest;
}

double largest_modulus(const Spectrum &values) {
    double largest = 0.0;
    for (const auto value : values)
        largest = std::max(largest, std::abs(value));
    return largest;
}

Eigen::VectorXd random_vector(std::mt19937 &generator) {
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    Eigen::VectorXd vector(6);
    for (double &value : vector)
        value = unit(generator);
    return vector;
}

// A motion given in the rotating frame, carried to the fixed one, leaves the same force there.
TEST(CompositeRotorEquations, FramesAreEquivalent) {
    std::mt19937 generator(17);
    for (const auto &angles : {unsymmetric_position(1.6), symmetric_position(4, 1.3).value(),
                               symmetric_position(2, 1.6).value()}) {
        const auto rotor = example(angles, 41.0);
        const double w = rotor.physical.spin_speed;
        const auto rotating = rotating_frame_matrices(rotating_coefficients(rotor.physical));
        Eigen::MatrixXd J = Eigen::MatrixXd::Zero(6, 6);
        for (int block = 0; block < 6; block += 2)
            J.block<2, 2>(block, block) << 0.0, -1.0, 1.0, 0.0;
        for (int sample = 0; sample < 50; ++sample) {
            const Eigen::VectorXd q = random_vector(generator);
            const Eigen::VectorXd v = 30.0 * random_vector(generator);
            const Eigen::VectorXd a = 900.0 * random_vector(generator);
            const double t = 0.17 * sample;
            const Eigen::MatrixXd T =
                std::cos(w * t) * Eigen::MatrixXd::Identity(6, 6) + std::sin(w * t) * J;
            const auto fixed = fixed_frame_matrices(rotor, t);
            const Eigen::VectorXd force_rotating = rotating.M * a + rotating.C * v + rotating.K * q;
            const Eigen::VectorXd force_fixed = fixed.M * T * (a + 2.0 * w * J * v - w * w * q) +
                                                fixed.C * T * (v + w * J * q) + fixed.K * T * q;
            EXPECT_LT((force_fixed - T * force_rotating).norm(), 1e-12 * force_rotating.norm());
        }
    }
}

TEST(CompositeRotorEquations, DimensionalAndDimensionlessSpectraAgree) {
    for (const double speed : {11.0, 37.0, 260.0}) {
        const auto physical = example(unsymmetric_position(1.6), speed).physical;
        const auto scaled = to_dimensionless(physical);
        auto plain = eigenvalues(rotating_frame_matrices(rotating_coefficients(physical)));
        auto dimensionless = eigenvalues(rotating_frame_matrices(rotating_coefficients(scaled)));
        for (auto &value : dimensionless)
            value *= scales_of(physical).frequency;
        EXPECT_LT(distance(plain, dimensionless), 1e-10 * largest_modulus(plain));
    }
}

TEST(CompositeRotorParameters, PhysicalToDimensionlessAndBack) {
    const auto physical = example(unsymmetric_position(1.6), 52.0).physical;
    const auto scaled = to_dimensionless(physical);
    const auto back = to_physical(scaled, scales_of(physical));
    const auto same = [](double first, double second) {
        EXPECT_NEAR(first, second, 1e-13 * std::abs(second));
    };
    same(back.spin_speed, 52.0);
    same(back.mass, physical.mass);
    same(back.base_inertia, physical.base_inertia);
    same(back.polar_inertia, physical.polar_inertia);
    same(back.balancer_position, physical.balancer_position);
    same(back.supports.c_x, 8e4);
    same(back.supports.c_beta, physical.supports.c_beta);
    same(back.supports.c_y, physical.supports.c_y);
    same(back.supports.h_x, 130.0);
    same(back.supports.h_beta, physical.supports.h_beta);
    same(back.supports.h_y, physical.supports.h_y);
    same(back.imbalance.moment, 0.5);
    same(back.imbalance.mass, 2.0);
    EXPECT_EQ(back.balls.count, 3);
    same(back.balls.mass, physical.balls.mass);
    same(back.balls.radius, 0.2);
    same(back.balls.damping, 0.9);
    EXPECT_EQ(back.second_harmonic, physical.second_harmonic);
}

TEST(CompositeRotorParameters, OwnEccentricityGoesThereAndBack) {
    auto physical = example(unsymmetric_position(1.6), 52.0).physical;
    physical.imbalance.mass = 0.0;
    const auto scaled = to_dimensionless(physical);
    EXPECT_EQ(scaled.imbalance_inertia, 0.0);
    const auto back = to_physical(scaled, scales_of(physical));
    EXPECT_EQ(back.imbalance.mass, 0.0);
    EXPECT_DOUBLE_EQ(back.imbalance.moment, 0.5);
}

TEST(CompositeRotorParameters, EqualSupports) {
    // Overhung too: both supports on one side of the centre of mass.
    for (const double left : {0.3, 0.5, 1.2}) {
        auto physical = example(unsymmetric_position(1.6), 52.0).physical;
        const double span = 0.8;
        physical.supports =
            reduced_supports({3e4, 70.0, -left * span}, {3e4, 70.0, (1.0 - left) * span});
        const auto scaled = to_dimensionless(physical);
        auto expected = scaled;
        set_equal_supports(expected, left, scales_of(physical).radius / span, scaled.h_x);
        EXPECT_NEAR(expected.p, scaled.p, 1e-13);
        EXPECT_NEAR(expected.c_y, scaled.c_y, 1e-13);
        EXPECT_NEAR(expected.h_beta, scaled.h_beta, 1e-13);
        EXPECT_NEAR(expected.h_y, scaled.h_y, 1e-13);
    }
}

TEST(CompositeRotorEquations, FloquetMultipliersEqualTheExponentials) {
    const auto rotor = example(unsymmetric_position(1.6), 41.0);
    const double period = 2.0 * pi / 41.0;
    auto exponentials = eigenvalues(rotating_frame_matrices(rotating_coefficients(rotor.physical)));
    for (auto &value : exponentials)
        value = std::exp(value * period);
    const auto state = [&](double t) { return state_matrix(fixed_frame_matrices(rotor, t)); };
    // The double zero root of the balls' whole turn is absent; simple values to integration
    // accuracy.
    EXPECT_LT(distance(floquet_multipliers(state, period, 120), exponentials), 1e-10);
}

TEST(Floquet, CollocationIsOfOrderEight) {
    const auto rotor = example(unsymmetric_position(1.6), 41.0);
    const double period = 2.0 * pi / 41.0;
    const auto state = [&](double t) { return state_matrix(fixed_frame_matrices(rotor, t)); };
    const Eigen::MatrixXd exact = monodromy_matrix(state, period, 128);
    const double coarse = (monodromy_matrix(state, period, 8) - exact).norm();
    const double fine = (monodromy_matrix(state, period, 16) - exact).norm();
    EXPECT_NEAR(std::log2(coarse / fine), 8.0, 0.6);
}

TEST(Floquet, ConstantSystem) {
    Eigen::MatrixXd constant(2, 2);
    constant << 0.0, 1.0, -4.0, -0.2;
    const auto values = floquet_multipliers([&](double) { return constant; }, 1.3, 40);
    const std::complex<double> root(-0.1, std::sqrt(4.0 - 0.01));
    EXPECT_LT(distance(values, {std::exp(1.3 * root), std::exp(1.3 * std::conj(root))}), 1e-12);
}

// n balls one by one: the spectrum of the form with s, and for each ball beyond two a pair 0, -h_s.
TEST(CompositeRotorEquations, BallByBallAddsNeutralPairsOnly) {
    const std::vector<double> angles = symmetric_position(5, 1.7).value();
    const auto rotor = example(angles, 41.0);
    const auto coefficients = rotating_coefficients(rotor.physical);
    const auto reduced = rotating_frame_matrices(coefficients);
    const BallSet &balls = rotor.physical.balls;

    Eigen::MatrixXd displacement(2, 5);
    Eigen::MatrixXd along(5, 2);
    for (int j = 0; j < 5; ++j) {
        along.row(j) << -std::sin(angles[j]), std::cos(angles[j]);
        displacement.col(j) = balls.mass * balls.radius * along.row(j).transpose();
    }
    const double w = coefficients.spin_speed;
    const double z = coefficients.balancer_position;
    Eigen::Matrix2d J;
    J << 0.0, -1.0, 1.0, 0.0;
    const auto expand = [&](const Eigen::MatrixXd &small, const Eigen::Matrix2d &acceleration,
                            double own) {
        Eigen::MatrixXd large = Eigen::MatrixXd::Zero(9, 9);
        large.topLeftCorner(4, 4) = small.topLeftCorner(4, 4);
        large.topRightCorner(4, 5) = small.topRightCorner(4, 2) * displacement;
        large.block(4, 0, 5, 2) = along * acceleration / balls.radius;
        large.block(4, 2, 5, 2) = z * along * acceleration / balls.radius;
        large.bottomRightCorner(5, 5) = own * Eigen::MatrixXd::Identity(5, 5);
        return large;
    };
    const MotionMatrices full{expand(reduced.M, Eigen::Matrix2d::Identity(), 1.0),
                              expand(reduced.C, 2.0 * w * J, coefficients.h_s),
                              expand(reduced.K, -w * w * Eigen::Matrix2d::Identity(), 0.0)};

    Spectrum expected = eigenvalues(reduced);
    for (int extra = 0; extra < 3; ++extra) {
        expected.emplace_back(0.0);
        expected.emplace_back(-coefficients.h_s);
    }
    const Spectrum found = eigenvalues(full);
    ASSERT_EQ(found.size(), expected.size());
    EXPECT_LT(distance(found, expected), 1e-10 * largest_modulus(expected));
    const auto neutral = std::ranges::count_if(
        found, [&](std::complex<double> value) { return std::abs(value) < 1e-9; });
    EXPECT_EQ(neutral, 3);
}

TEST(CompositeRotorEquations, FullCapacityGivesAZeroRoot) {
    const auto zero_root = [](double E) {
        const auto rotor = example(symmetric_position(2, E).value(), 41.0);
        double smallest = 1e300;
        for (const auto value :
             eigenvalues(rotating_frame_matrices(rotating_coefficients(rotor.physical))))
            smallest = std::min(smallest, std::abs(value));
        return smallest;
    };
    EXPECT_LT(zero_root(1.0), 1e-10);
    EXPECT_GT(zero_root(1.3), 1e-3);
}

TEST(CompositeRotorEquations, CriticalSpeedsAreZeroRootsWithFrozenBalls) {
    auto physical = example(unsymmetric_position(1.6), 1.0).physical;
    const auto speeds = critical_speeds(rotating_coefficients(physical));
    ASSERT_EQ(speeds.size(), 4U);
    physical.supports.h_x = physical.supports.h_y = physical.supports.h_beta = 0.0;
    for (const double speed : speeds) {
        physical.spin_speed = speed;
        const auto frozen = frozen_balls(rotating_frame_matrices(rotating_coefficients(physical)));
        const Eigen::Vector4d singular = frozen.K.jacobiSvd().singularValues();
        EXPECT_LT(singular[3] / singular[0], 1e-13);
    }
}

TEST(CompositeRotorEquations, AdditionalSpeedsAreZeroRootsWithFreeBalls) {
    auto physical = example(unsymmetric_position(1.6), 1.0).physical;
    const auto speeds = additional_speeds(rotating_coefficients(physical));
    ASSERT_EQ(speeds.size(), 2U);
    physical.supports.h_x = physical.supports.h_y = physical.supports.h_beta = 0.0;
    const auto relative_determinant = [&](double speed) {
        physical.spin_speed = speed;
        const auto m = rotating_frame_matrices(rotating_coefficients(physical));
        double scale = 1.0;
        for (int row = 0; row < 6; ++row)
            scale *= m.K.row(row).norm();
        return m.K.determinant() / scale;
    };
    for (const double speed : speeds) {
        EXPECT_NEAR(relative_determinant(speed), 0.0, 1e-13);
        EXPECT_LT(relative_determinant(0.99 * speed) * relative_determinant(1.01 * speed), 0.0);
    }
}

TEST(CompositeRotorEquations, UnstableBandOfASymmetricRotorIsThatOfItsTilt) {
    auto rotor = example(symmetric_position(2, 1.2).value(), 1.0);
    PhysicalParameters &physical = rotor.physical;
    physical.supports.c_y = 0.0;
    physical.supports.h_y = 0.0;
    physical.supports.h_beta = 1.0;
    const auto band = unstable_band(tilt_rotor(rotating_coefficients(physical)));
    ASSERT_TRUE(band && band->to);
    const auto growth = [&](double speed) {
        physical.spin_speed = speed;
        double largest = -1e300;
        for (const auto value :
             eigenvalues(frozen_balls(rotating_frame_matrices(rotating_coefficients(physical)))))
            largest = std::max(largest, value.real());
        return largest;
    };
    EXPECT_LT(growth(band->from * (1.0 - 1e-6)), 0.0);
    EXPECT_GT(growth(band->from * (1.0 + 1e-6)), 0.0);
    EXPECT_GT(growth(*band->to * (1.0 - 1e-6)), 0.0);
    EXPECT_LT(growth(*band->to * (1.0 + 1e-6)), 0.0);
}

TEST(CompositeRotorEquations, IsotropicCompositeHasNoUnstableBand) {
    // n = 2, E = 2, R = R0.
    const BallSet balls{2, 2.0, 0.2, 0.5};
    const auto supports = reduced_supports({4e4, 50.0, -0.3}, {4e4, 50.0, 0.3});
    const auto physical = physical_parameters({57.83, 1.413, 0.289, 0.1}, balls, {0.4, 2.0},
                                              two_ball_second_harmonic(2.0), supports, 1.0);
    auto tilt = tilt_rotor(rotating_coefficients(physical));
    EXPECT_NEAR(tilt.anisotropy, 0.0, 1e-16);
    EXPECT_FALSE(unstable_band(tilt));
}

} // namespace
} // namespace whirl::closed_form
