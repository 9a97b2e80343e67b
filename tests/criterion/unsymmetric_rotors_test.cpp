// The criterion of rotors that are not axisymmetric: whatever the direction of the imbalance.

#include "analyses/balance.h"
#include "input/case_file.h"
#include "oracles/rigid_rotor.h"
#include "oracles/rotor_axes.h"
#include "support/random.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace {

using namespace whirl;
using results::BalanceResult;
using results::Interval;
using tests::Random;

using std::numbers::pi;

/// The same rotor for the oracles.
oracles::CaseRotor for_oracles(const model::Rotor &rotor) {
    oracles::CaseRotor out;
    for (const model::Segment &s : rotor.shaft.segments) {
        oracles::Segment segment;
        segment.left = {s.length,     s.outer_start, s.inner_start,
                        s.material.E, s.material.G,  s.material.rho};
        segment.left.kappa = rotor.shaft.shear_coefficient;
        segment.outer_end = s.outer_end;
        segment.inner_end = s.inner_end;
        segment.elements = s.elements;
        segment.asymmetry = s.asymmetry;
        segment.asymmetry_angle = s.asymmetry_angle;
        out.shaft.push_back(segment);
    }
    const auto block = [](const Eigen::Matrix2d &a) {
        return oracles::Block{{{a(0, 0), a(0, 1)}, {a(1, 0), a(1, 1)}}};
    };
    for (const model::Disc &d : rotor.discs)
        out.discs.push_back({d.z, d.mass, d.Id, d.Ip});
    for (const model::Bearing &b : rotor.bearings) {
        oracles::Support support;
        support.z = b.z;
        support.k = block(b.rows[0].k);
        support.c = block(b.rows[0].c);
        support.kt = block(b.rows[0].kt);
        support.ct = block(b.rows[0].ct);
        out.supports.push_back(support);
    }
    for (const model::Anisotropy &a : rotor.anisotropies)
        out.anisotropies.push_back({a.z, a.dI, a.angle});
    for (const model::CorrectionPlane &plane : rotor.planes)
        out.planes.push_back(plane.z);
    return out;
}

/// @param relative  of each end
void expect_bands(const std::vector<Interval> &found, const std::vector<oracles::Band> &expected,
                  double relative, const std::string &what) {
    ASSERT_EQ(found.size(), expected.size()) << what;
    for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_NEAR(found[i].from / static_cast<double>(expected[i].first), 1, relative)
            << what << ", band " << i;
        EXPECT_NEAR(found[i].to / static_cast<double>(expected[i].second), 1, relative)
            << what << ", band " << i;
    }
}

/// Two-node elements, as the oracle has them: what differs is the formulation alone.
model::Case random_scene(Random &random) {
    model::Case scene;
    const int segments = 1 + static_cast<int>(random(0, 3));
    for (int i = 0; i < segments; ++i) {
        const double diameter = random(0.03, 0.08);
        model::Segment segment{random(0.3, 0.6), diameter, diameter, 0, 0, tests::steel(), 1};
        segment.elements = 1 + static_cast<int>(random(0, 2));
        if (random.coin()) {
            segment.asymmetry = random(0.001, 0.4);
            segment.asymmetry_angle = random(-pi, pi);
        }
        scene.rotor.shaft.segments.push_back(segment);
    }
    scene.rotor.shaft.order = 1;
    const double length = scene.rotor.shaft.length();
    const int discs = 1 + static_cast<int>(random(0, 3));
    for (int i = 0; i < discs; ++i) {
        const double Id = random(0.05, 0.3);
        const double Ip = Id * random(0.1, 1.9);
        const double z = random(0, length);
        scene.rotor.discs.push_back(tests::disc_at(z, random(5, 40), Id, Ip));
        if (i == 0 || random.coin())
            scene.rotor.anisotropies.push_back(
                {"", z, 0.5 * Ip * std::pow(10, random(-4, 0)), random(-pi, pi)});
    }
    if (scene.rotor.shaft.asymmetric() && random.coin())
        scene.rotor.anisotropies.clear();
    const bool damped = random.coin();
    for (const double z : {random(0, 0.3), random(0.7, 1)}) {
        const double k = std::pow(10, random(6, 8));
        model::Bearing bearing = tests::isotropic_bearing(z * length, k);
        if (damped)
            bearing.rows[0].c = k * std::pow(10, random(-7, -3)) * Eigen::Matrix2d::Identity();
        scene.rotor.bearings.push_back(bearing);
    }
    const int planes = 1 + static_cast<int>(random(0, 4));
    for (int i = 0; i < planes; ++i)
        scene.rotor.planes.push_back({"", length * (i + random(0.05, 0.95)) / planes});
    scene.speeds = model::SpeedRange{0, random(1000, 4000), 31};
    return scene;
}

/// Every band of each plane and of all together.
void expect_oracle(const model::Case &scene, double relative, const std::string &what) {
    const oracles::RotorAxes exact(for_oracles(scene.rotor));
    const BalanceResult result = analyses::balance(scene);
    const double from = 1e-6 * scene.speeds->to;
    std::vector<double> all;
    for (const results::BalancePlane &plane : result.planes) {
        all.push_back(plane.z);
        expect_bands(plane.bands.bands, exact.bands(from, scene.speeds->to, {plane.z}), relative,
                     what + ", z = " + std::to_string(plane.z));
    }
    expect_bands(result.joint.bands.bands, exact.bands(from, scene.speeds->to, all), relative,
                 what + ", joint");
}

TEST(UnsymmetricRotors, RandomOnesHaveTheBandsOfTheDenseRealForm) {
    // 1e-6 of the speed is the promise; ends are roots of one matrix, of condition 1e8 at most.
    Random random(32);
    for (int i = 0; i < 100; ++i)
        expect_oracle(random_scene(random), 1e-6, "scene " + std::to_string(i));
}

/// cases/keyway_shaft with a plane beside its disc.
model::Case keyway_scene() {
    model::Case scene = input::load_case(std::string(WHIRL_ROOT) + "/cases/keyway_shaft", {});
    scene.rotor.planes = {{"", 0.3}};
    return scene;
}

TEST(UnsymmetricRotors, KeywayBalancesAboveTheHigherCriticalSpeed) {
    const BalanceResult result = analyses::balance(keyway_scene());
    const results::BalanceBands &bands = result.planes[0].bands;
    oracles::CaseRotor rotor =
        oracles::read_case(std::string(WHIRL_ROOT) + "/cases/keyway_shaft/case.toml", {});
    rotor.planes = {0.3};
    // Two-node elements are exact for a shaft without mass.
    const oracles::RotorAxes exact(rotor);
    const std::vector<double> critical = exact.critical_speeds(10, 600);
    ASSERT_EQ(critical.size(), 2U);
    EXPECT_NEAR(critical[0], 197.69, 5e-3); // by an independent real form, in digits
    EXPECT_NEAR(critical[1], 209.81, 5e-3);
    ASSERT_EQ(bands.bands.size(), 1U);
    EXPECT_NEAR(bands.bands[0].from / critical[1], 1, 1e-8);
    EXPECT_EQ(bands.bands[0].to, 600);
    ASSERT_TRUE(bands.errors[0].first);
    EXPECT_LT(*bands.errors[0].first, 1e-6);
    // Between the two a complex form would see a mean: the stiff direction, 30 degrees, is still
    // below its resonance, the soft one above.
    const Eigen::MatrixXd form = exact.form(206, {0.3});
    const Eigen::Vector2d stiff(std::cos(pi / 6), std::sin(pi / 6));
    const Eigen::Vector2d soft(-stiff(1), stiff(0));
    EXPECT_GT(stiff.dot(form * stiff), 0);
    EXPECT_LT(soft.dot(form * soft), 0);
    ASSERT_EQ(bands.ends.size(), 1U);
    ASSERT_TRUE(bands.ends[0].direction);
    EXPECT_NEAR(*bands.ends[0].direction, pi / 6, 1e-4); // looked at 1e-6 beside the end
}

/// Three discs on a shaft without mass, the middle one anisotropic.
model::Case three_discs(double dI) {
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(1.4, 0.055, {"", 207e9, 207e9 / 2.58, 1e-9});
    scene.rotor.shaft.order = 3;
    scene.rotor.discs = {tests::disc_at(0.25, 18, 0.12, 0.2), tests::disc_at(0.7, 31, 1.33, 0.55),
                         tests::disc_at(1.1, 12, 0.09, 0.05)};
    if (dI > 0)
        scene.rotor.anisotropies = {{"", 0.7, dI, 0}};
    scene.rotor.bearings = {tests::isotropic_bearing(0, 3e6), tests::isotropic_bearing(1.4, 5e6)};
    scene.rotor.planes = {{"", 0.5}, {"", 0.9}};
    scene.speeds = model::SpeedRange{0, 1500, 61};
    return scene;
}

TEST(UnsymmetricRotors, AnisotropicDiscCounts) {
    const model::Case scene = three_discs(0.25);
    expect_oracle(scene, 1e-8, "three discs"); // exact elements on both sides
    // By an independent real form, to the digits it printed.
    const BalanceResult result = analyses::balance(scene);
    const auto &joint = result.joint.bands.bands;
    ASSERT_EQ(joint.size(), 3U);
    const std::vector<double> printed{561.03, 970.85, 1123.20, 1447.25, 1462.35, 1500};
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(joint[i].from, printed[2 * i], 5.1e-3);
        EXPECT_NEAR(joint[i].to, printed[2 * i + 1], 5.1e-3);
    }
    EXPECT_NEAR(result.planes[0].bands.bands.at(0).to, 463.11, 5.1e-3);
    // All four eigenvalues negative inside a band, not all outside.
    for (const results::SignaturePoint &point : result.joint.signature) {
        ASSERT_EQ(point.eigenvalues.size(), 4U);
        const bool inside = std::ranges::any_of(joint, [&](const Interval &band) {
            return band.from < point.speed && point.speed < band.to;
        });
        if (point.speed > 0 && point.speed < 1500)
            EXPECT_EQ(point.negative == 4, inside) << point.speed;
    }
}

TEST(UnsymmetricRotors, WithoutAnisotropyTheBandsAreThoseOfTheComplexForm) {
    for (const double damping : {0.0, 400.0})
        for (const double dI : {1e-6, 1e-9, 1e-12}) {
            model::Case round = three_discs(0);
            model::Case slightly = three_discs(dI);
            for (model::Case *scene : {&round, &slightly})
                for (model::Bearing &bearing : scene->rotor.bearings)
                    bearing.rows[0].c = damping * Eigen::Matrix2d::Identity();
            const BalanceResult complex = analyses::balance(round);
            const BalanceResult real = analyses::balance(slightly);
            EXPECT_EQ(complex.model.formulation.form, results::Form::planar);
            EXPECT_EQ(real.model.formulation.form, results::Form::rotating);
            for (const auto &[a, b] : {std::pair(&complex.planes[0].bands, &real.planes[0].bands),
                                       std::pair(&complex.planes[1].bands, &real.planes[1].bands),
                                       std::pair(&complex.joint.bands, &real.joint.bands)}) {
                ASSERT_EQ(a->bands.size(), b->bands.size()) << dI;
                // An end moves with dI over the inertias, here 0.05 to 1.3 kg m2.
                const double tolerance = 1e-9 + 30 * dI;
                for (std::size_t i = 0; i < a->bands.size(); ++i) {
                    EXPECT_NEAR(b->bands[i].from / a->bands[i].from, 1, tolerance);
                    EXPECT_NEAR(b->bands[i].to / a->bands[i].to, 1, tolerance);
                }
            }
            // Each eigenvalue twice.
            const auto &one = complex.joint.signature[20].eigenvalues;
            const auto &two = real.joint.signature[20].eigenvalues;
            ASSERT_EQ(two.size(), 2 * one.size());
            for (std::size_t i = 0; i < two.size(); ++i)
                EXPECT_NEAR(two[i] / one[i / 2], 1, 1e-9 + 1e3 * dI); // near a resonance
        }
}

TEST(UnsymmetricRotors, TurnedInTheRotorTheBandsStayAndTheDirectionsTurn) {
    const double angle = 0.4;
    model::Case scene = three_discs(0.25);
    scene.rotor.shaft.segments[0].asymmetry = 0.1;
    scene.rotor.shaft.segments[0].asymmetry_angle = 0.3;
    model::Case turned = scene;
    turned.rotor.anisotropies[0].angle += angle;
    turned.rotor.shaft.segments[0].asymmetry_angle += angle;
    const BalanceResult a = analyses::balance(scene);
    const BalanceResult b = analyses::balance(turned);
    for (std::size_t plane = 0; plane < 2; ++plane) {
        const auto &ends = a.planes[plane].bands.ends;
        ASSERT_EQ(ends.size(), b.planes[plane].bands.ends.size());
        EXPECT_GE(ends.size(), 4U);
        for (std::size_t i = 0; i < ends.size(); ++i) {
            const results::BandEnd &other = b.planes[plane].bands.ends[i];
            EXPECT_NEAR(other.speed / ends[i].speed, 1, 1e-10);
            const double turn = *other.direction - *ends[i].direction - angle;
            EXPECT_NEAR(std::sin(turn), 0, 1e-8); // directions are lines: half turns do not count
        }
    }
}

/// Principal planes by the oracles' own closed form: with diametral inertias A - |a| and A + |a|.
std::vector<oracles::Band>
in_both(const oracles::RigidRotor &body,
        const std::function<std::vector<oracles::Band>(const oracles::RigidRotor &)> &bands) {
    oracles::RigidRotor less = body;
    oracles::RigidRotor more = body;
    less.A -= std::abs(body.a);
    more.A += std::abs(body.a);
    std::vector<oracles::Band> out;
    for (const oracles::Band &x : bands(less))
        for (const oracles::Band &y : bands(more)) {
            const oracles::Band both{std::max(x.first, y.first), std::min(x.second, y.second)};
            if (both.first < both.second)
                out.push_back(both);
        }
    return out;
}

TEST(UnsymmetricRotors, RigidOnesAreTwoPlaneRotorsOfFilimonikhin) {
    Random random(7);
    int split = 0;
    for (int i = 0; i < 40; ++i) {
        model::Case scene;
        scene.rotor.shaft = tests::uniform_shaft(0.9, 0.2, tests::weightless_steel());
        scene.rotor.shaft.rigid = true;
        const double A = random(1, 3);
        scene.rotor.discs = {tests::disc_at(random(0.2, 0.7), 60, A, A * random(0.3, 1.6))};
        for (int k = 0; k < 3; ++k) // what counts is their sum, with twice the angles
            scene.rotor.anisotropies.push_back(
                {"", random(0.1, 0.8), 0.15 * A * random(0, 1), random(-pi, pi)});
        scene.rotor.bearings = {tests::isotropic_bearing(0, random(1e6, 4e6)),
                                tests::isotropic_bearing(0.9, random(1e6, 4e6))};
        const int planes = 1 + static_cast<int>(random(0, 4));
        for (int k = 0; k < planes; ++k)
            scene.rotor.planes.push_back({"", 0.9 * (k + random(0.1, 0.9)) / planes});
        scene.speeds = model::SpeedRange{0, 3000, 11};
        const BalanceResult result = analyses::balance(scene);
        const oracles::RigidRotor body = oracles::bare_rotor(for_oracles(scene.rotor));
        ASSERT_TRUE(result.rigid);
        EXPECT_NEAR(result.rigid->anisotropy / static_cast<double>(std::abs(body.a)), 1, 1e-9);
        // Rounding of roots; 1e-12 of the mass is the shaft's.
        const double tolerance = 1e-8;
        for (const results::BalancePlane &plane : result.planes) {
            const auto expected = in_both(body, [&](const oracles::RigidRotor &one) {
                return oracles::rigid_bands(one, plane.z, 3000);
            });
            const std::string what = "rotor " + std::to_string(i);
            expect_bands(plane.bands.bands, expected, tolerance, what);
            expect_bands(*plane.bands.rigid_bands, expected, tolerance, what + " rigid");
            split += expected.size() > 1 ? 1 : 0;
        }
        if (planes > 1) {
            const auto expected = in_both(body, [](const oracles::RigidRotor &one) {
                return oracles::rigid_joint_bands(one, 3000);
            });
            expect_bands(result.joint.bands.bands, expected, tolerance, "joint");
            expect_bands(*result.joint.bands.rigid_bands, expected, tolerance, "joint rigid");
        }
        EXPECT_EQ(result.joint.rank, std::min(planes, 2));
    }
    EXPECT_GT(split, 10);
}

TEST(UnsymmetricRotors, GapsNarrowerThanAnyGridAreFound) {
    // One damper holds its bearing, the other hardly acts: a resonance that the rotor has neither
    // without dampers nor with both locked, and a gap of 3.5e-4 of the speed in a band.
    Random random(32);
    model::Case scene;
    for (int i = 0; i <= 323; ++i)
        scene = random_scene(random);
    const BalanceResult result = analyses::balance(scene);
    double narrowest = 1;
    const auto &bands = result.planes.back().bands.bands;
    for (std::size_t i = 1; i < bands.size(); ++i)
        narrowest = std::min(narrowest, bands[i].from / bands[i - 1].to - 1);
    EXPECT_LT(narrowest, 4e-4);
    expect_oracle(scene, 1e-6, "narrow gap");
}

TEST(UnsymmetricRotors, MapAgreesWithPlanesThatStandThere) {
    model::Case scene = three_discs(0.25);
    scene.rotor.planes = {{"", 0.35}, {"", 1.05}}; // stations 20 and 60 of 81
    const BalanceResult result = analyses::balance(scene, true);
    ASSERT_TRUE(result.placement);
    const results::Placement &map = *result.placement;
    const double mass = result.rigid->mass;
    for (const auto &[plane, station] : {std::pair(0U, 20U), std::pair(1U, 60U)}) {
        EXPECT_NEAR(map.criterion.back()[station] / (mass * result.planes[plane].criterion.back()),
                    1, 1e-9);
        double covered = 0;
        for (const Interval &band : result.planes[plane].bands.bands)
            covered += band.to - band.from;
        EXPECT_NEAR(map.share[station], covered / 1500, 0.02); // straight lines between 81 speeds
    }
    EXPECT_NEAR(map.pair_value[20][60] / (mass * result.joint.signature.back().eigenvalues.back()),
                1, 1e-9);
}

/// Composite rotor of Gorbenko: the criterion counts balls that are held, and their anisotropy.
TEST(UnsymmetricRotors, HeldBallsBelongToTheRotor) {
    const std::string name = std::string(WHIRL_ROOT) + "/cases/centrifuge_two_balls";
    const std::vector<std::string> settings{"shaft.rigid=true", "bearing[0].c=0", "bearing[1].c=0",
                                            "speeds.to=3000"};
    std::vector<std::string> held = settings;
    held.emplace_back("balancer[0].held=true");
    model::Case scene = input::load_case(name, held);
    scene.rotor.planes = {{"", 0.1}, {"", 0.5}};
    const BalanceResult result = analyses::balance(scene);
    EXPECT_EQ(result.model.formulation.form, results::Form::rotating);
    oracles::CaseRotor rotor = oracles::read_case(name + "/case.toml", settings);
    const oracles::RigidRotor body = oracles::composite_rotor(rotor);
    EXPECT_NEAR(result.rigid->anisotropy / static_cast<double>(std::abs(body.a)), 1, 1e-9);
    for (const results::BalancePlane &plane : result.planes)
        expect_bands(plane.bands.bands,
                     in_both(body,
                             [&](const oracles::RigidRotor &one) {
                                 return oracles::rigid_bands(one, plane.z, 3000);
                             }),
                     1e-9, "plane " + std::to_string(plane.z));
}

} // namespace
