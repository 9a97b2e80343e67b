// The command balance against the closed form of the rigid rotor, its limit, and independent ways
// to the same numbers.

#include "analyses/balance.h"
#include "model/errors.h"
#include "oracles/criterion.h"
#include "support/balancer_scenes.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace whirl;
using results::BalanceResult;
using results::Interval;

/// Rotor of theory.md 5.3: a body of 60 kg, its centre 0.4 m and 0.5 m from the supports, on a
/// shaft without mass.
model::Case two_support_scene(double A, double C, std::vector<double> planes) {
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(0.9, 0.2, tests::weightless_steel());
    scene.rotor.shaft.rigid = true;
    scene.rotor.discs = {tests::disc_at(0.4, 60, A, C)};
    scene.rotor.bearings = {tests::isotropic_bearing(0, 2e6), tests::isotropic_bearing(0.9, 3e6)};
    for (const double z : planes) // from the centre of mass
        scene.rotor.planes.push_back({"", 0.4 + z});
    scene.speeds = model::SpeedRange{0, 3000, 13};
    return scene;
}

/// w1, w2 and additional speeds from their formulas, independent of the program's closed form.
struct TwoSupport {
    double A, C, M = 60, k11 = 5e6, k14 = 3e6 * 0.5 - 2e6 * 0.4, k33 = 2e6 * 0.16 + 3e6 * 0.25;
    [[nodiscard]] double resonance(int which) const {
        const double a = M * (A - C);
        const double b = (A - C) * k11 + M * k33;
        const double c = k11 * k33 - k14 * k14;
        if (a == 0)
            return std::sqrt(c / b);
        const double root = std::sqrt(b * b - 4 * a * c);
        // A short rotor has one positive square: (b - root) / (2 a).
        return std::sqrt((b + (which == 2 ? root : -root)) / (2 * a));
    }
    [[nodiscard]] double additional(double z) const {
        return std::sqrt((k33 + k11 * z * z - 2 * k14 * z) / (A + M * z * z - C));
    }
};

void expect_bands(const std::vector<Interval> &found, const std::vector<Interval> &expected,
                  double relative) {
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_NEAR(found[i].from / expected[i].from, 1, relative) << "band " << i;
        EXPECT_NEAR(found[i].to / expected[i].to, 1, relative) << "band " << i;
    }
}

TEST(Balance, LongRigidRotorHasTheBandsOfTheClosedForm) {
    const std::vector<double> z{-0.3, 0, 0.2, 0.45};
    const BalanceResult result = analyses::balance(two_support_scene(3, 1, z));
    const TwoSupport rotor{3, 1};
    // theory.md 5.3, digits printed there.
    const std::vector<double> printed{512.017736, 731.436942, 474.341649, 320.390663};
    ASSERT_EQ(result.planes.size(), z.size());
    for (std::size_t i = 0; i < z.size(); ++i) {
        const std::vector<Interval> expected{{rotor.resonance(1), rotor.additional(z[i])},
                                             {rotor.resonance(2), 3000}};
        // Rounding of roots; a mass of 1e-12 of the rotor's is left in the shaft.
        expect_bands(result.planes[i].bands.bands, expected, 1e-9);
        expect_bands(*result.planes[i].bands.rigid_bands, expected, 1e-9);
        EXPECT_NEAR(result.planes[i].bands.bands[0].to, printed[i], 5.1e-7);
    }
    EXPECT_NEAR(result.joint.bands.bands.at(0).from, 737.473073, 5.1e-7);
    // Four planes of a rigid rotor: two too many change nothing.
    EXPECT_EQ(result.joint.rank, 2);
    expect_bands(result.joint.bands.bands, {{rotor.resonance(2), 3000}}, 1e-9);
    for (const auto &point : result.joint.signature)
        EXPECT_EQ(std::count(point.eigenvalues.begin(), point.eigenvalues.end(), 0.0),
                  point.speed == 0 ? 4 : 2);
}

TEST(Balance, FrequenciesOfThePapers) {
    model::Case scene = two_support_scene(3, 1, {0.2});
    scene.rotor.balancers = {tests::ball_balancer(0.2, 3, 0.5, 0.1, 0.1, 0.05)};
    scene.rotor.balancers[0].imbalance_radius = 0.1; // a point mass of 0.5 kg
    scene.balance.balanced_position = false;
    const BalanceResult result = analyses::balance(scene);
    ASSERT_TRUE(result.rigid);
    // M = 60 kg, k11 = 5e6 N/m, k33 = 1.07e6 N m, A - C = 2 kg m2; with balls and mass 62 kg. A
    // mass of 1e-12 of the rotor's is left in the shaft.
    ASSERT_EQ(result.rigid->partial_frequencies.size(), 2U);
    EXPECT_NEAR(result.rigid->partial_frequencies[0], std::sqrt(5e6 / 60), 1e-7);
    EXPECT_NEAR(result.rigid->partial_frequencies[1], std::sqrt(1.07e6 / 2), 1e-7);
    EXPECT_NEAR(result.rigid->omega_0, std::sqrt(5e6 / 62), 1e-7);
    EXPECT_FALSE(result.rigid->z_max);
}

TEST(Balance, SphericalAndShortRigidRotors) {
    const TwoSupport spherical{2, 2};
    const BalanceResult sphere = analyses::balance(two_support_scene(2, 2, {0, 0.25}));
    const double w1 = spherical.resonance(1);
    // In the plane of the centre of mass the additional speed is infinite.
    expect_bands(sphere.planes[0].bands.bands, {{w1, 3000}}, 1e-9);
    expect_bands(sphere.planes[1].bands.bands, {{w1, spherical.additional(0.25)}}, 1e-9);
    EXPECT_TRUE(sphere.joint.bands.bands.empty());
    EXPECT_EQ(sphere.rigid->type, "spherical");

    const TwoSupport rotor{1, 1.9}; // sqrt((C - A)/M) = 0.1225 m
    const BalanceResult flat = analyses::balance(two_support_scene(1, 1.9, {0.12, 0.2, -0.3}));
    ASSERT_TRUE(flat.rigid->z_max);
    EXPECT_NEAR(*flat.rigid->z_max, std::sqrt(0.9 / 60), 1e-9);
    expect_bands(flat.planes[0].bands.bands, {{rotor.resonance(1), 3000}}, 1e-9);
    for (const std::size_t i : {1U, 2U})
        expect_bands(flat.planes[i].bands.bands,
                     {{rotor.resonance(1), rotor.additional(i == 1 ? 0.2 : -0.3)}}, 1e-9);
    EXPECT_TRUE(flat.joint.bands.bands.empty());
    EXPECT_EQ(flat.rigid->type, "short");
}

/// Two discs on a stout shaft in soft bearings: bearing criticals far below the bending one.
model::Case two_disc_scene(double E) {
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(1.1, 0.09, {"steel", E, E / 2.6, 7800});
    scene.rotor.shaft.segments[0].elements = 3;
    scene.rotor.shaft.order = 6;
    scene.rotor.discs = {tests::disc_at(0.3, 15, 0.08, 0.15), tests::disc_at(0.75, 20, 0.1, 0.18)};
    scene.rotor.bearings = {tests::isotropic_bearing(0.1, 1e6),
                            tests::isotropic_bearing(1.0, 1.2e6)};
    scene.rotor.planes = {{"left", 0.15}, {"right", 0.95}};
    scene.speeds = model::SpeedRange{0, 4500, 46};
    return scene;
}

/// two_disc_scene(2e11) for the exact continuum of tests/oracles.
oracles::SteppedRotor exact_two_discs(bool supported = true) {
    oracles::SteppedRotor rotor;
    rotor.shaft = {{1.1, 0.09, 0, 2e11, 2e11 / 2.6, 7800, 0}};
    rotor.discs = {{0.3, 15, 0.08, 0.15}, {0.75, 20, 0.1, 0.18}};
    for (const auto &[z, k] : {std::pair(0.1, 1e6), std::pair(1.0, 1.2e6)}) {
        oracles::Support support;
        support.z = z;
        support.k = {{{k, 0}, {0, k}}};
        if (supported)
            rotor.supports.push_back(support);
    }
    return rotor;
}

std::vector<Interval> as_bands(const std::vector<oracles::Band> &bands) {
    std::vector<Interval> out;
    for (const auto &[from, to] : bands)
        out.push_back({static_cast<double>(from), static_cast<double>(to)});
    return out;
}

TEST(Balance, JointBandOfAFlexibleRotorEndsAtThePinnedCriticalSpeed) {
    const model::Case scene = two_disc_scene(2e11);
    const BalanceResult result = analyses::balance(scene);
    const auto &bands = result.joint.bands.bands;
    const auto &critical = result.critical_speeds;
    ASSERT_GE(critical.size(), 3U);
    ASSERT_GE(bands.size(), 2U);
    // From the second bearing critical to the pinned one, well below the bending critical, and
    // again from that one: theory.md, section 6.
    EXPECT_NEAR(bands[0].from / critical[1], 1, 1e-12);
    EXPECT_LT(bands[0].to, 0.9 * critical[2]);
    EXPECT_NEAR(bands[1].from / critical[2], 1, 1e-12);
    // Every band of the whole range by the exact continuum, looked for at speeds of its own. Three
    // elements of order 6 are exact to far less than 1e-8 up to the fifth of these speeds.
    const auto continuum = oracles::criterion_bands(exact_two_discs(), 0, 4500, {0.15, 0.95});
    expect_bands(bands, as_bands(continuum), 1e-8);
    const auto pinned = oracles::pinned_speeds(exact_two_discs(), 0, 4500, {0.15, 0.95});
    ASSERT_EQ(result.joint.bands.pinned.size(), pinned.size());
    for (std::size_t i = 0; i < pinned.size(); ++i)
        EXPECT_NEAR(result.joint.bands.pinned[i] / static_cast<double>(pinned[i]), 1, 1e-8);
    EXPECT_TRUE(result.joint.bands.rigid_bands->at(0).to == 4500);
}

TEST(Balance, AdditionalSpeedIsThePinnedCriticalSpeedOfOnePlane) {
    const BalanceResult result = analyses::balance(two_disc_scene(2e11));
    ASSERT_EQ(result.planes.size(), 2U);
    for (const auto &plane : result.planes) {
        const auto bands = oracles::criterion_bands(exact_two_discs(), 0, 4500, {plane.z});
        expect_bands(plane.bands.bands, as_bands(bands), 1e-8);
        const auto pinned = oracles::pinned_speeds(exact_two_discs(), 0, 4500, {plane.z});
        ASSERT_EQ(plane.bands.pinned.size(), pinned.size());
        std::size_t uppers = 0;
        for (const auto &end : plane.bands.ends)
            if (end.upper) {
                ASSERT_LT(uppers, pinned.size());
                EXPECT_NEAR(end.speed / static_cast<double>(pinned[uppers++]), 1, 1e-8);
            }
        EXPECT_EQ(uppers, pinned.size()); // each pinned speed below the border ends a band
    }
}

TEST(Balance, FlexibleBandsConvergeToTheRigidOnesAsTheShaftStiffens) {
    // The stiffness of the bearings over that of the shaft falls with 1/E, and so does the error.
    std::vector<std::vector<double>> errors; // [E][end]
    for (const double E : {2e12, 2e13, 2e14}) {
        model::Case scene = two_disc_scene(E);
        scene.speeds = model::SpeedRange{0, 1000, 11};
        const BalanceResult result = analyses::balance(scene);
        errors.emplace_back();
        for (const auto *bands :
             {&result.planes[0].bands, &result.planes[1].bands, &result.joint.bands})
            for (const auto &end : bands->ends) {
                ASSERT_TRUE(end.relative_difference);
                errors.back().push_back(*end.relative_difference);
            }
    }
    ASSERT_EQ(errors[0].size(), 7U); // three ends of each plane, one of both
    ASSERT_EQ(errors[2].size(), 7U);
    for (std::size_t k = 0; k < errors[0].size(); ++k)
        for (const std::size_t step : {1U, 2U}) {
            const double rate = std::log10(std::abs(errors[step][k] / errors[step - 1][k]));
            EXPECT_NEAR(rate, -1, 0.02) << "end " << k; // next term: 1e-3 of the first at 2e12
        }
}

TEST(Balance, AThirdPlaneMakesTheFlexibleFormIndefiniteByLittle) {
    model::Case scene = two_disc_scene(2e12);
    scene.rotor.planes.push_back({"middle", 0.55});
    scene.speeds = model::SpeedRange{400, 900, 6}; // between the rigid-body and bending criticals
    const BalanceResult result = analyses::balance(scene);
    EXPECT_EQ(result.joint.rank, 3);
    EXPECT_TRUE(result.joint.bands.bands.empty());
    EXPECT_FALSE(result.joint.bands.rigid_bands->empty());
    for (const auto &point : result.joint.signature) {
        EXPECT_EQ(point.negative, 2);
        EXPECT_GT(point.relative, 0);
        EXPECT_LT(point.relative, 0.05);
        // Imbalances that bend: the middle against both ends, without resultant to speak of.
        const auto &s = point.worst;
        EXPECT_LT(s[0].real() * s[2].real(), 0);
        EXPECT_LT(s[1].real() * s[2].real(), 0);
        EXPECT_LT(std::abs(s[0] + s[1] + s[2]), 0.1);
    }
    const auto mentions = [&](const std::string &text) {
        return std::any_of(result.findings.begin(), result.findings.end(),
                           [&](const std::string &f) { return f.find(text) != std::string::npos; });
    };
    EXPECT_TRUE(mentions("3 planes"));
}

TEST(Balance, WithoutPlanesThoseOfTheBalancersCount) {
    model::Case scene = two_disc_scene(2e11);
    const BalanceResult planes = analyses::balance(scene);
    for (const auto &plane : scene.rotor.planes) {
        model::Balancer balancer;
        balancer.name = plane.name;
        balancer.z = plane.z;
        tests::row(balancer).mass =
            5; // must not count; one ball without imbalance has no balanced position
        tests::row(balancer).n = 1;
        tests::row(balancer).radius = 0.1;
        scene.rotor.balancers.push_back(balancer);
    }
    scene.rotor.planes.clear();
    const BalanceResult balancers = analyses::balance(scene);
    ASSERT_EQ(balancers.planes.size(), 2U);
    EXPECT_EQ(balancers.planes[1].name, "right");
    expect_bands(balancers.joint.bands.bands, planes.joint.bands.bands, 1e-12);
    EXPECT_FALSE(balancers.balanced_position);
}

TEST(Balance, FreeRotorIsBalancedFromTheStart) {
    model::Case scene = two_disc_scene(2e11);
    scene.rotor.bearings.clear();
    const BalanceResult result = analyses::balance(scene);
    EXPECT_FALSE(result.rigid);
    EXPECT_FALSE(result.joint.bands.rigid_bands);
    ASSERT_FALSE(result.joint.bands.bands.empty());
    EXPECT_LT(result.joint.bands.bands[0].from, 0.01);
    // Looked for from 1 rad/s on: below, the receptance of a free rotor has no digits.
    const auto exact = oracles::criterion_bands(exact_two_discs(false), 1, 4500, {0.15, 0.95});
    ASSERT_EQ(result.joint.bands.bands.size(), exact.size());
    for (std::size_t i = 0; i < exact.size(); ++i) {
        EXPECT_NEAR(result.joint.bands.bands[i].to / static_cast<double>(exact[i].second), 1, 1e-8);
        if (i > 0) {
            EXPECT_NEAR(result.joint.bands.bands[i].from / static_cast<double>(exact[i].first), 1,
                        1e-8);
        }
    }
}

TEST(Balance, RefusesScenesWithoutPlanesAndWithoutSpeeds) {
    model::Case scene = two_disc_scene(2e11);
    const auto complaint = [](const model::Case &bad) -> std::string {
        try {
            (void)analyses::balance(bad);
        } catch (const model::BadInput &error) {
            return error.what();
        }
        return "";
    };
    model::Case without = scene;
    without.rotor.planes.clear();
    EXPECT_NE(complaint(without).find("[[plane]]"), std::string::npos);
    without = scene;
    without.speeds.reset();
    EXPECT_NE(complaint(without).find("[speeds]"), std::string::npos);
    without = scene;
    without.speeds = model::SpeedRange{-100, 100, 11};
    EXPECT_NE(complaint(without).find("-100"), std::string::npos);
}

TEST(Balance, OneSpeedAloneGivesItsSignature) {
    model::Case scene = two_disc_scene(2e11);
    scene.speeds = model::SpeedRange{500, 0, 1};
    const BalanceResult result = analyses::balance(scene);
    ASSERT_EQ(result.joint.signature.size(), 1U);
    EXPECT_EQ(result.joint.signature[0].negative, 2);
    EXPECT_TRUE(result.joint.bands.bands.empty());
}

TEST(Balance, MapAgreesWithPlanesThatStandThere) {
    model::Case scene = two_disc_scene(2e11);
    scene.rotor.planes = {{"", 0.275}, {"", 0.825}}; // stations 20 and 60 of 81
    const BalanceResult result = analyses::balance(scene, true);
    ASSERT_TRUE(result.placement);
    const results::Placement &map = *result.placement;
    const double mass = result.rigid->mass;
    for (const auto &[plane, station] : {std::pair(0U, 20U), std::pair(1U, 60U)}) {
        EXPECT_NEAR(map.z[station], scene.rotor.planes[plane].z, 1e-12);
        EXPECT_NEAR(map.criterion.back()[station] / (mass * result.planes[plane].criterion.back()),
                    1, 1e-9);
        double covered = 0;
        for (const Interval &band : result.planes[plane].bands.bands)
            covered += band.to - band.from;
        EXPECT_NEAR(map.share[station], covered / 4500, 0.01); // straight lines between 81 speeds
    }
    EXPECT_NEAR(map.pair_value[20][60] / (mass * result.joint.signature.back().eigenvalues.back()),
                1, 1e-9);
    for (const double share : map.share)
        EXPECT_LE(share, map.best.share + 1e-3);
}

} // namespace
