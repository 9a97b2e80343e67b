// Rigid scenes in rotating axes against closed forms: composite rotor with balls, anisotropic
// rotor on symmetric supports.

#include "analyses/critical.h"
#include "analyses/stability.h"
#include "balancers/arrangement.h"
#include "closed_form/balanced_position.h"
#include "closed_form/composite_rotor_matrices.h"
#include "closed_form/composite_rotor_scales.h"
#include "modes/rotating_spectrum.h"
#include "results/critical.h"
#include "results/whirl.h"
#include "support/dense_eigenvalues.h"
#include "support/periodic_system.h"
#include "support/rotating_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace {

using namespace whirl;
using Values = std::vector<std::complex<double>>;

results::StabilityResult stability_of(const model::Case &scene) {
    return analyses::stability(scene, [&](const auto &) { return scene; });
}

std::vector<balancers::BalancerElement> elements_of(const model::Rotor &rotor) {
    return balancers::balancer_elements(rotor, balancers::arrangement_at_balance(rotor));
}

Values exact_eigenvalues(closed_form::FixedFrameRotor rotor, double speed) {
    rotor.physical.spin_speed = speed;
    return closed_form::eigenvalues(
        closed_form::rotating_frame_matrices(closed_form::rotating_coefficients(rotor.physical)));
}

/// Every value of each list lies within a share of its modulus from one of the other list.
void expect_same(const Values &found, const Values &expected, double tolerance) {
    ASSERT_EQ(found.size(), expected.size());
    for (const auto value : expected)
        EXPECT_LT(tests::largest_distance({value}, found), tolerance * std::abs(value)) << value;
    for (const auto value : found)
        EXPECT_LT(tests::largest_distance({value}, expected), tolerance * std::abs(value)) << value;
}

std::vector<tests::CompositeScene> composite_scenes() {
    return {
        tests::composite_scene({}, closed_form::symmetric_position(2, 1.6).value()),
        tests::composite_scene({}, tests::unsymmetric_position(1.6)),
        tests::composite_scene({}, closed_form::symmetric_position(4, 1.6).value()),
    };
}

TEST(RigidRotating, SpectrumIsThatOfTheClosedForm) {
    for (const tests::CompositeScene &scene : composite_scenes()) {
        const assembly::Discretization d(scene.rotor, 1);
        const modes::RotatingSpectrum spectrum(d, 0, elements_of(scene.rotor), 0);
        for (const double speed : {11.0, 37.0, 260.0}) {
            const Values exact = exact_eigenvalues(scene.exact, speed);
            expect_same(tests::dense_eigenvalues(spectrum.system(), speed), exact, 1e-9);
            Values found; // by the program's own solver, conjugates added
            for (const auto &pair : spectrum.eigenvalues(speed, 1e9, 1).pairs) {
                found.push_back(pair.value);
                if (pair.value.imag() != 0)
                    found.push_back(std::conj(pair.value));
            }
            expect_same(found, exact, 1e-9);
        }
    }
}

TEST(RigidRotating, SpectrumIsThatOfTheDimensionlessClosedForm) {
    const tests::CompositeScene scene =
        tests::composite_scene({}, tests::unsymmetric_position(1.6));
    const assembly::Discretization d(scene.rotor, 1);
    const auto system = assembly::assemble_rotating(d, 0, elements_of(scene.rotor));
    for (const double speed : {11.0, 37.0, 260.0}) {
        auto physical = scene.exact.physical;
        physical.spin_speed = speed;
        const auto scaled = closed_form::to_dimensionless(physical);
        Values found = tests::dense_eigenvalues(system, speed);
        for (auto &value : found)
            value /= closed_form::scales_of(physical).frequency;
        expect_same(found,
                    closed_form::eigenvalues(closed_form::rotating_frame_matrices(
                        closed_form::rotating_coefficients(scaled))),
                    1e-9);
    }
}

// The rotor's own eccentricity has a moment but neither mass nor inertia.
TEST(RigidRotating, OwnEccentricityAddsNoMass) {
    tests::CompositeScene scene = tests::composite_scene({}, tests::unsymmetric_position(1.6));
    scene.rotor.balancers[0].imbalance_radius.reset();
    // The bare rotor of the scene keeps its place; only the common centre of mass moves.
    const auto &balancer = scene.rotor.balancers[0];
    const double arm = balancer.z - scene.rotor.discs[0].z;
    const closed_form::BareRotor bare{57.83, 1.413, 0.889, arm};
    const auto &balls = scene.exact.physical.balls;
    const closed_form::PlaneImbalance imbalance{0.5, 0};
    const auto D = closed_form::second_harmonic(balancer.position);
    const auto body = closed_form::composite_rotor(bare, balls, imbalance, D);
    const double centre = scene.rotor.discs[0].z - body.rotor_position;
    const auto supports =
        closed_form::reduced_supports({3e4, 40, scene.rotor.bearings[0].z - centre},
                                      {5e4, 90, scene.rotor.bearings[1].z - centre});
    const closed_form::FixedFrameRotor exact{
        closed_form::physical_parameters(bare, balls, imbalance, D, supports, 1),
        balancer.position};
    const assembly::Discretization d(scene.rotor, 1);
    const auto system = assembly::assemble_rotating(d, 0, elements_of(scene.rotor));
    expect_same(tests::dense_eigenvalues(system, 37), exact_eigenvalues(exact, 37), 1e-9);
}

// Undamped bearings; E small enough that the tilt is long about both axes.
TEST(RigidRotating, CriticalAndAdditionalSpeedsOfTwoBalls) {
    tests::CompositeInput in;
    in.left_c = in.right_c = 0;
    const tests::CompositeScene scene =
        tests::composite_scene(in, closed_form::symmetric_position(2, in.E).value());
    const auto coefficients = closed_form::rotating_coefficients(scene.exact.physical);
    const auto critical = closed_form::critical_speeds(coefficients);
    const auto additional = closed_form::additional_speeds(coefficients);
    ASSERT_GE(critical.size(), 3U);
    ASSERT_EQ(additional.size(), 2U);
    const model::Case at = tests::scene_of(scene.rotor, 0, 1.2 * critical.back(), 51);
    const results::CriticalResult direct = analyses::critical_speeds(at);
    const results::StabilityResult found = stability_of(at);
    ASSERT_EQ(direct.critical_speeds.size(), critical.size());
    ASSERT_EQ(found.critical_speeds.size(), critical.size());
    for (std::size_t i = 0; i < critical.size(); ++i) {
        EXPECT_NEAR(direct.critical_speeds[i].speed, critical[i], 1e-9 * critical[i]);
        EXPECT_NEAR(found.critical_speeds[i], critical[i], 1e-9 * critical[i]);
        EXPECT_EQ(direct.critical_speeds[i].whirl, results::Whirl::forward);
    }
    ASSERT_EQ(found.additional_speeds.size(), additional.size());
    for (std::size_t i = 0; i < additional.size(); ++i)
        EXPECT_NEAR(found.additional_speeds[i], additional[i], 1e-9 * additional[i]);
}

// Damping makes the roots complex: the additional speeds are those without it, and the real parts
// stand beside them, apart by the square of the damping.
TEST(RigidRotating, AdditionalSpeedsAreThoseWithoutDamping) {
    const auto scene_with = [](double share) {
        tests::CompositeInput in;
        in.left_c *= share;
        in.right_c *= share;
        return tests::composite_scene(in, closed_form::symmetric_position(2, in.E).value());
    };
    const auto exact = closed_form::additional_speeds(
        closed_form::rotating_coefficients(scene_with(0).exact.physical));
    ASSERT_EQ(exact.size(), 2U);
    double larger = 0; // relative difference with the larger damping
    for (const double share : {0.1, 0.01}) {
        const auto found =
            stability_of(tests::scene_of(scene_with(share).rotor, 0, 1.5 * exact.back(), 51));
        ASSERT_EQ(found.additional_speeds.size(), exact.size());
        ASSERT_EQ(found.additional_speeds_damped.size(), exact.size());
        double apart = 0;
        for (std::size_t i = 0; i < exact.size(); ++i) {
            EXPECT_NEAR(found.additional_speeds[i], exact[i], 1e-9 * exact[i]);
            apart = std::max(apart, std::abs(found.additional_speeds_damped[i] / exact[i] - 1));
        }
        if (larger == 0)
            larger = apart;
        else // a tenth of the damping
            EXPECT_NEAR(apart, 1e-2 * larger, 1e-3 * larger);
    }
    EXPECT_GT(larger, 1e-6);
}

// A zero root with the balls free is one of the body pinned at their plane. Along its principal
// axes [N - A1 W^2, -h W; h W, N - A2 W^2] is singular there, with N and h of the supports and A1,
// A2 of the body about the plane, less C; without damping W^2 = N/A1, N/A2.
TEST(RigidRotating, AdditionalSpeedsOfDrawnDampedRotors) {
    std::mt19937 random(15);
    const auto drawn = [&random](double from, double to) {
        return std::uniform_real_distribution<double>(from, to)(random);
    };
    int complex = 0;
    for (int draw = 0; draw < 24; ++draw) {
        tests::CompositeInput in;
        in.bare = {drawn(40, 80), drawn(1.2, 2), drawn(0.3, 0.8), drawn(0.05, 0.15)};
        in.E = drawn(1.15, 1.9);
        in.damping = drawn(0.1, 2);
        in.left_k = drawn(2e4, 6e4);
        in.right_k = drawn(2e4, 6e4);
        const double damping = std::pow(10, drawn(-4, -2.3)); // over the stiffness, s
        in.left_c = damping * in.left_k;
        in.right_c = damping * in.right_k;
        const auto scene =
            tests::composite_scene(in, closed_form::symmetric_position(2, in.E).value());
        const auto body = closed_form::rotating_coefficients(scene.exact.physical);
        const auto about_plane = [z = body.balancer_position](double x, double beta, double y) {
            return beta + x * z * z - 2 * y * z;
        };
        const closed_form::ReducedSupports &s = body.supports;
        const double N = about_plane(s.c_x, s.c_beta, s.c_y);
        const double h = about_plane(s.h_x, s.h_beta, s.h_y);
        const double mean = body.mean_inertia - body.polar_inertia +
                            body.mass * body.balancer_position * body.balancer_position;
        const double A1 = mean + std::abs(body.anisotropy);
        const double A2 = mean - std::abs(body.anisotropy);
        ASSERT_GT(A2, 0);
        const std::vector<double> undamped{std::sqrt(N / A1), std::sqrt(N / A2)};
        const double b = N * (A1 + A2) - h * h; // A1 A2 x^2 - b x + N^2 = 0, x = W^2
        const std::complex<double> root =
            std::sqrt(std::complex<double>(b * b - 4 * A1 * A2 * N * N));
        std::vector<double> damped;
        for (const double sign : {-1.0, 1.0})
            damped.push_back(std::sqrt((b + sign * root) / (2 * A1 * A2)).real());
        complex += root.imag() != 0 ? 1 : 0;
        const auto found = stability_of(tests::scene_of(scene.rotor, 0, 1.5 * undamped.back(), 31));
        ASSERT_EQ(found.additional_speeds.size(), 2U) << draw;
        for (std::size_t i = 0; i < 2; ++i)
            EXPECT_NEAR(found.additional_speeds[i], undamped[i], 1e-9 * undamped[i]) << draw;
        ASSERT_FALSE(found.additional_speeds_damped.empty()) << draw;
        // One of a conjugate pair, or both.
        for (const double expected : damped) {
            const bool seen =
                std::ranges::any_of(found.additional_speeds_damped, [expected](double speed) {
                    return std::abs(speed - expected) < 1e-8 * expected;
                });
            EXPECT_TRUE(seen) << draw << ": " << expected;
        }
        for (const double speed : found.additional_speeds_damped) {
            const bool right = std::ranges::any_of(damped, [speed](double expected) {
                return std::abs(speed - expected) < 1e-8 * expected;
            });
            EXPECT_TRUE(right) << draw << ": " << speed;
        }
    }
    EXPECT_GE(complex, 6);
    EXPECT_LE(complex, 18);
}

TEST(RigidRotating, TwoBallsOfCapacityTwoLeaveNoAnisotropy) {
    const auto frozen_growth = [](double E) {
        tests::CompositeInput in;
        in.E = E;
        in.imbalance_radius = in.radius; // R0 = R
        in.left = -0.3;
        in.right = 0.3;
        in.right_k = in.left_k;
        in.left_c = in.right_c = 2; // N s/m
        const tests::CompositeScene scene =
            tests::composite_scene(in, closed_form::symmetric_position(2, E).value());
        const auto elements = elements_of(scene.rotor);
        if (E == 2) {
            EXPECT_LT(std::abs(elements[0].anisotropy), 1e-15 * elements[0].polar_inertia);
        }
        const assembly::Discretization d(scene.rotor, 1);
        const auto frozen = assembly::assemble_rotating(d, 0, elements, true);
        double growth = -1e300;
        for (double speed = 20; speed < 300; speed += 0.5)
            growth =
                std::max(growth, tests::largest_real_part(tests::dense_eigenvalues(frozen, speed)));
        return growth;
    };
    EXPECT_LT(frozen_growth(2), -1e-3); // damping alone
    EXPECT_GT(frozen_growth(1.2), 0.1);
}

/// All balls at one place: one of their motions, the two against each other, is neutral, and the
/// rotor does not feel it.
TEST(RigidRotating, FullRaceIsNeutral) {
    for (const double E : {1.0, 1.3}) {
        tests::CompositeInput in;
        in.E = E;
        in.left_c = in.right_c = 2; // N s/m
        const tests::CompositeScene scene =
            tests::composite_scene(in, closed_form::symmetric_position(2, E).value());
        const results::StabilityResult found =
            stability_of(tests::scene_of(scene.rotor, 20, 300, 15));
        EXPECT_GT(std::count(found.verdict.begin(), found.verdict.end(),
                             E == 1 ? results::Verdict::neutral : results::Verdict::stable),
                  0);
        EXPECT_EQ(std::count(found.verdict.begin(), found.verdict.end(),
                             E == 1 ? results::Verdict::stable : results::Verdict::neutral),
                  0);
        for (const double growth : found.growth)
            if (E == 1) {
                EXPECT_GE(growth, 0);
            } else {
                EXPECT_NE(growth, 0);
            }
        if (E == 1) {
            EXPECT_FALSE(found.zero_root_speeds.empty()); // resolved beside the neutral motion
        }
    }
}

// ---- Anisotropic rotor, p = 1.25, h = 0.156, a = 0.1 of the source's figure.

closed_form::AnisotropicRotor exact_tilt(double C, double h = 0.156) { return {C, 0.1, 1.25, h}; }

TEST(AnisotropicRigidRotor, CriticalSpeedsWithoutDamping) {
    const model::Case scene = tests::scene_of(tests::tilt_rotor(0.8, 0.1, 1.25, 0), 0, 6, 61);
    std::vector<double> expected = closed_form::critical_speeds(exact_tilt(0.8, 0));
    expected.insert(expected.begin(), 1.25 / std::sqrt(10.0)); // translation, sqrt(2k/m)
    const auto direct = analyses::critical_speeds(scene).critical_speeds;
    const results::StabilityResult found = stability_of(scene);
    ASSERT_EQ(direct.size(), 3U);
    ASSERT_EQ(found.critical_speeds.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(direct[i].speed, expected[i], 1e-9 * expected[i]);
        EXPECT_NEAR(found.critical_speeds[i], expected[i], 1e-9 * expected[i]);
    }
    ASSERT_EQ(found.unstable.size(), 1U); // between the two of tilt
    EXPECT_NEAR(found.unstable[0].from, expected[1], 1e-9 * expected[1]);
    EXPECT_NEAR(found.unstable[0].to, expected[2], 1e-9 * expected[2]);
}

TEST(AnisotropicRigidRotor, UnstableBandWithDamping) {
    const auto found =
        stability_of(tests::scene_of(tests::tilt_rotor(0.8, 0.1, 1.25, 0.156), 0, 6, 61));
    const auto band = closed_form::unstable_band(exact_tilt(0.8));
    ASSERT_EQ(found.unstable.size(), 1U);
    EXPECT_NEAR(found.unstable[0].from, band->from, 1e-9 * band->from);
    EXPECT_NEAR(found.unstable[0].to, *band->to, 1e-9 * *band->to);
    EXPECT_NEAR(found.unstable[0].from, 2.381264, 0.5e-6);
    EXPECT_NEAR(found.unstable[0].to, 3.788366, 0.5e-6);
}

TEST(AnisotropicRigidRotor, NoUpperEndNearTheSphere) {
    for (const double C : {0.95, 1.0, 1.05}) {
        const auto found =
            stability_of(tests::scene_of(tests::tilt_rotor(C, 0.1, 1.25, 0.156), 0, 40, 81));
        const auto band = closed_form::unstable_band(exact_tilt(C));
        ASSERT_EQ(found.unstable.size(), 1U) << C;
        EXPECT_NEAR(found.unstable[0].from, band->from, 1e-9 * band->from) << C;
        EXPECT_EQ(found.unstable[0].to, 40) << C;
        EXPECT_FALSE(band->to);
    }
}

TEST(AnisotropicRigidRotor, StableWhereTheFormulaSaysSo) {
    const auto found =
        stability_of(tests::scene_of(tests::tilt_rotor(1.15, 0.1, 1.25, 0.156), 0, 40, 81));
    EXPECT_TRUE(found.unstable.empty());
    for (const double growth : found.growth)
        EXPECT_LT(growth, 0);
}

TEST(AnisotropicRigidRotor, PermissibleAnisotropy) {
    struct Range {
        double from, to;
    };
    for (const Range range : {Range{0.5, 6}, Range{0.5, 2}, Range{3.5, 6}, Range{2.8, 2.9}}) {
        const auto found = stability_of(
            tests::scene_of(tests::tilt_rotor(0.8, 0.1, 1.25, 0.156), range.from, range.to, 23));
        const double exact =
            closed_form::permissible_anisotropy(exact_tilt(0.8), range.from, range.to).anisotropy;
        ASSERT_EQ(found.permissible.size(), 1U);
        ASSERT_TRUE(found.permissible[0].dI) << range.to;
        EXPECT_NEAR(*found.permissible[0].dI, exact, 1e-8 * exact) << range.from << " " << range.to;
        ASSERT_TRUE(found.permissible[0].closed_form);
        EXPECT_NEAR(*found.permissible[0].closed_form, exact, 1e-12);
    }
    const auto whole =
        stability_of(tests::scene_of(tests::tilt_rotor(0.8, 0.1, 1.25, 0.156), 0, 6, 61));
    EXPECT_NEAR(*whole.permissible.at(0).dI, 0.055266, 0.5e-6);
}

// Equation (14) of the paper, where a body can have as much anisotropy.
TEST(AnisotropicRigidRotor, PermissibleAnisotropyAtOneSpeed) {
    std::mt19937 random(14);
    const auto drawn = [&random](double from, double to) {
        return std::uniform_real_distribution<double>(from, to)(random);
    };
    int compared = 0;
    for (int draw = 0; draw < 60; ++draw) {
        const double C = drawn(0.5, 1.6);
        const double p = drawn(0.5, 3);
        const double h = drawn(0.01, 0.3) * p;
        const double speed = drawn(0.5, 3) * p;
        const auto found =
            stability_of(tests::scene_of(tests::tilt_rotor(C, 0.01, p, h), speed, speed, 1));
        const double exact = closed_form::permissible_anisotropy({C, 0, p, h}, speed);
        ASSERT_EQ(found.permissible.size(), 1U);
        const auto &permissible = found.permissible.front();
        ASSERT_TRUE(permissible.closed_form);
        EXPECT_NEAR(*permissible.closed_form, exact, 1e-12 * exact);
        if (exact > permissible.most) {
            EXPECT_FALSE(permissible.dI) << C << " " << p << " " << h << " " << speed;
            continue;
        }
        ++compared;
        ASSERT_TRUE(permissible.dI) << C << " " << p << " " << h << " " << speed;
        EXPECT_NEAR(*permissible.dI, exact, 1e-8 * exact);
    }
    EXPECT_GE(compared, 20);
}

// Bands that are narrow beside the steps in which eigenvalues are followed, between speeds at which
// two of them are real: whatever the range is, none is missed.
TEST(AnisotropicRigidRotor, NarrowBandsInRandomRanges) {
    std::mt19937 random(5);
    const auto drawn = [&random](double from, double to) {
        return std::uniform_real_distribution<double>(from, to)(random);
    };
    for (int draw = 0; draw < 100; ++draw) {
        const double C = drawn(0.4, 0.9);
        const double p = drawn(0.5, 3);
        const double h = drawn(0.02, 0.25) * p * std::sqrt(1 - C);
        const double permissible = closed_form::permissible_anisotropy({C, 0, p, h}).anisotropy;
        const double a = permissible * drawn(1.0005, 1.1);
        const double top = drawn(1.3, 15) * p / std::sqrt(1 - C);
        const auto found = stability_of(tests::scene_of(tests::tilt_rotor(C, a, p, h), 0, top, 11));
        const auto band = closed_form::unstable_band({C, a, p, h});
        ASSERT_TRUE(band && band->to);
        ASSERT_EQ(found.unstable.size(), 1U) << C << " " << a << " " << p << " " << h << " " << top;
        // An end is a double root but for the excess over the permissible anisotropy.
        const double rounding = 1e-12 / (a / permissible - 1);
        EXPECT_NEAR(found.unstable[0].from, band->from, rounding * band->from);
        EXPECT_NEAR(found.unstable[0].to, *band->to, rounding * *band->to);
        ASSERT_EQ(found.permissible.size(), 1U);
        EXPECT_NEAR(*found.permissible[0].dI, permissible, 1e-8 * permissible);
    }
}

// The largest anisotropy does not depend on the one in the case, nor on its direction.
TEST(AnisotropicRigidRotor, PermissibleAnisotropyDoesNotDependOnTheCase) {
    model::Rotor rotor = tests::tilt_rotor(0.8, 0.02, 1.25, 0.156);
    rotor.anisotropies[0].angle = 0.7;
    const auto found = stability_of(tests::scene_of(rotor, 0, 6, 61));
    EXPECT_TRUE(found.unstable.empty());
    EXPECT_NEAR(*found.permissible.at(0).dI, 0.055266, 0.5e-6);
}

TEST(AnisotropicRigidRotor, TurnsEitherWay) {
    // The spin reversed: the same band at negative speeds.
    const auto found =
        stability_of(tests::scene_of(tests::tilt_rotor(0.8, 0.1, 1.25, 0.156), -6, -0.5, 61));
    ASSERT_EQ(found.unstable.size(), 1U);
    EXPECT_NEAR(found.unstable[0].from, -3.788366, 0.5e-6);
    EXPECT_NEAR(found.unstable[0].to, -2.381264, 0.5e-6);
}

} // namespace
