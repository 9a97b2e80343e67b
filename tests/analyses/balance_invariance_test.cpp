// Bands of the criterion do not depend on the axes in which the bearings are written, nor on the
// units of length, mass and time.

#include "analyses/balance.h"
#include "analyses/critical.h"
#include "results/critical.h"
#include "support/random.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace whirl;
using results::BalanceResult;
using results::Interval;
using tests::Random;

model::Case random_scene(Random &random) {
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(1.0, random(0.04, 0.09), tests::steel());
    scene.rotor.shaft.segments[0].elements = 2;
    for (int i = 0; i < 3; ++i)
        scene.rotor.discs.push_back(tests::disc_at(random(0.1, 0.95), random(5, 30),
                                                   random(0.05, 0.2), random(0.05, 0.25)));
    for (const double z : {random(0, 0.3), random(0.7, 1)}) {
        model::Bearing bearing = tests::isotropic_bearing(z, std::pow(10, random(6, 7)));
        bearing.rows[0].k(1, 1) *= random(0.3, 3);
        scene.rotor.bearings.push_back(bearing);
    }
    scene.rotor.planes = {{"", random(0.05, 0.45)}, {"", random(0.55, 0.95)}};
    scene.speeds = model::SpeedRange{0, 2500, 41};
    return scene;
}

void turn(Eigen::Matrix2d &a, double angle) {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const double xx = c * c * a(0, 0) - 2 * c * s * a(0, 1) + s * s * a(1, 1);
    const double yy = s * s * a(0, 0) + 2 * c * s * a(0, 1) + c * c * a(1, 1);
    const double xy = c * s * (a(0, 0) - a(1, 1)) + (c * c - s * s) * a(0, 1);
    a << xx, xy, xy, yy;
}

model::Case turned(model::Case scene, double angle) {
    for (model::Bearing &bearing : scene.rotor.bearings)
        for (model::BearingCoefficients &row : bearing.rows)
            for (Eigen::Matrix2d *a : {&row.k, &row.c, &row.kt, &row.ct})
                turn(*a, angle);
    return scene;
}

/// @param unit  of speed in the second list
void expect_same(const std::vector<Interval> &a, const std::vector<Interval> &b, double tolerance,
                 const std::string &what, double unit = 1) {
    ASSERT_EQ(a.size(), b.size()) << what;
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_NEAR(b[i].from * unit / a[i].from, 1, tolerance) << what << " band " << i;
        EXPECT_NEAR(b[i].to * unit / a[i].to, 1, tolerance) << what << " band " << i;
    }
}

void expect_same(const BalanceResult &a, const BalanceResult &b, double tolerance,
                 const std::string &what, double unit = 1) {
    for (std::size_t i = 0; i < a.planes.size(); ++i)
        expect_same(a.planes[i].bands.bands, b.planes[i].bands.bands, tolerance,
                    what + " plane " + std::to_string(i), unit);
    expect_same(a.joint.bands.bands, b.joint.bands.bands, tolerance, what + " joint", unit);
    EXPECT_EQ(a.joint.rank, b.joint.rank) << what;
    ASSERT_EQ(a.joint.bands.rigid_bands.has_value(), b.joint.bands.rigid_bands.has_value());
    if (a.joint.bands.rigid_bands)
        expect_same(*a.joint.bands.rigid_bands, *b.joint.bands.rigid_bands, tolerance,
                    what + " rigid", unit);
}

TEST(BalanceInvariance, TurnedAxesOfTheBearingsChangeNothing) {
    Random random(3);
    for (int rotor = 0; rotor < 12; ++rotor) { // 2.5 s each
        const model::Case scene = random_scene(random);
        const BalanceResult straight = analyses::balance(scene);
        // Roots refined to 1e-13; the narrowest bands tell between 1e-8 of the speed.
        expect_same(straight, analyses::balance(turned(scene, random(0.1, 3))), 1e-8,
                    "rotor " + std::to_string(rotor));
    }
}

TEST(BalanceInvariance, TurnedAxesOfDampedBearingsChangeNothing) {
    Random random(4);
    for (int rotor = 0; rotor < 6; ++rotor) {
        model::Case scene = random_scene(random);
        for (model::Bearing &bearing : scene.rotor.bearings)
            bearing.rows[0].c = random(1e-4, 1e-3) * bearing.rows[0].k;
        expect_same(analyses::balance(scene), analyses::balance(turned(scene, random(0.1, 3))),
                    1e-8, "rotor " + std::to_string(rotor));
    }
}

TEST(BalanceInvariance, SymmetricCouplingIsCounted) {
    const model::Material steel{"steel", 210e9, 210e9 / 2.6, 7850};
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(1.0, 0.07342224166289257, steel);
    scene.rotor.shaft.segments[0].elements = 3;
    scene.rotor.discs = {
        tests::disc_at(0.764, 12.964157286915055, 0.20092475479561206, 0.16155894147002917),
        tests::disc_at(0.318, 14.680662857383435, 0.12274144562818022, 0.17926925494112705),
        tests::disc_at(0.834, 26.709579494113786, 0.07408866527794115, 0.07625390120758306)};
    scene.rotor.bearings = {tests::isotropic_bearing(0.2752, 1),
                            tests::isotropic_bearing(0.9452, 1)};
    scene.rotor.bearings[0].rows[0].k << 6104414.780251996, -3093718.1588950083,
        -3093718.1588950083, 4194674.761153959;
    scene.rotor.bearings[1].rows[0].k << 3897387.5848873183, 4667749.715942147, 4667749.715942147,
        6778771.076799236;
    scene.rotor.planes = {{"", 0.153}, {"", 0.74}};
    // No end may depend on the grid.
    for (const int count : {41, 201}) {
        scene.speeds = model::SpeedRange{0, 2500, count};
        const BalanceResult result = analyses::balance(scene);
        EXPECT_TRUE(result.sharp);
        std::vector<double> ends;
        for (const auto *bands :
             {&result.planes[0].bands, &result.planes[1].bands, &result.joint.bands})
            for (const Interval &band : bands->bands)
                ends.insert(ends.end(), {band.from, band.to});
        // By spectral elements of degree 5 and a dense complex receptance, bisection to 1e-12; the
        // three elements of order 4 are off by some 1e-8.
        for (const double expected : {111.16654810, 113.83331195, 502.10709141, 516.51185072})
            EXPECT_TRUE(std::any_of(ends.begin(), ends.end(), [&](double end) {
                return std::abs(end / expected - 1) < 1e-6;
            })) << expected;
    }
}

/// The same rotor where a unit of length, mass and time is a power of two of the old one.
struct Units {
    double length, mass, time;

    void apply(model::Case &scene) const {
        const double force = mass * length / (time * time);
        model::Shaft &shaft = scene.rotor.shaft;
        for (model::Segment &segment : shaft.segments) {
            for (double *size : {&segment.length, &segment.outer_start, &segment.outer_end,
                                 &segment.inner_start, &segment.inner_end})
                *size *= length;
            segment.material.E *= force / (length * length);
            segment.material.G *= force / (length * length);
            segment.material.rho *= mass / (length * length * length);
        }
        shaft.internal_damping *= time;
        for (model::Disc &disc : scene.rotor.discs) {
            disc.z *= length;
            disc.mass *= mass;
            disc.Id *= mass * length * length;
            disc.Ip *= mass * length * length;
        }
        for (model::Bearing &bearing : scene.rotor.bearings) {
            bearing.z *= length;
            for (double &speed : bearing.speeds)
                speed /= time;
            for (model::BearingCoefficients &row : bearing.rows) {
                row.k *= force / length;
                row.c *= force / length * time;
                row.kt *= force * length;
                row.ct *= force * length * time;
            }
            if (bearing.pedestal) {
                bearing.pedestal->mass *= mass;
                bearing.pedestal->k *= force / length;
                bearing.pedestal->c *= force / length * time;
            }
        }
        for (model::CorrectionPlane &plane : scene.rotor.planes)
            plane.z *= length;
        scene.speeds->from /= time;
        scene.speeds->to /= time;
    }
};

/// Rigid, flexible, orthotropic, coupled, damped, on pedestals, free.
std::vector<std::pair<std::string, model::Case>> scenes() {
    Random random(5);
    model::Case orthotropic = random_scene(random);
    model::Case flexible = orthotropic;
    for (model::Bearing &bearing : flexible.rotor.bearings)
        bearing.rows[0].k(1, 1) = bearing.rows[0].k(0, 0);
    model::Case rigid = flexible;
    rigid.rotor.shaft.rigid = true;
    rigid.rotor.planes.push_back({"", 0.5});
    model::Case damped = orthotropic;
    for (model::Bearing &bearing : damped.rotor.bearings) {
        bearing.rows[0].c = 3e-4 * bearing.rows[0].k;
        bearing.rows[0].kt = 1e-3 * bearing.rows[0].k;
    }
    damped.rotor.shaft.internal_damping = 1e-6;
    model::Case pedestals = flexible;
    for (model::Bearing &bearing : pedestals.rotor.bearings)
        bearing.pedestal = model::Pedestal{5, 2e7, 0};
    model::Case free = flexible;
    free.rotor.bearings.clear();
    return {{"rigid", rigid},
            {"flexible", flexible},
            {"orthotropic", orthotropic},
            {"damped", damped},
            {"coupled", turned(orthotropic, 0.7)},
            {"pedestals", pedestals},
            {"free", free}};
}

TEST(BalanceInvariance, UnitsOfLengthMassAndTimeDoNotMatter) {
    const double big = std::ldexp(1.0, 30);
    for (const auto &[name, scene] : scenes()) {
        const BalanceResult given = analyses::balance(scene);
        const results::CriticalResult critical = analyses::critical_speeds(scene);
        for (const Units &units : {Units{big, 1, 1},
                                   {1 / big, 1, 1},
                                   {1, big, 1},
                                   {1, 1 / big, 1},
                                   {1, 1, big},
                                   {1, 1, 1 / big}}) {
            model::Case scaled = scene;
            units.apply(scaled);
            const std::string what = name + " " + std::to_string(units.length) + " " +
                                     std::to_string(units.mass) + " " + std::to_string(units.time);
            // Only the order of sums can differ: rounding, times the condition of the roots.
            expect_same(given, analyses::balance(scaled), 1e-9, what, units.time);
            const auto again = analyses::critical_speeds(scaled);
            ASSERT_EQ(again.critical_speeds.size(), critical.critical_speeds.size()) << what;
            for (std::size_t i = 0; i < critical.critical_speeds.size(); ++i) {
                const auto &a = critical.critical_speeds[i];
                const auto &b = again.critical_speeds[i];
                EXPECT_NEAR(b.speed * units.time / a.speed, 1, 1e-9) << what;
                EXPECT_EQ(a.whirl, b.whirl) << what;
            }
            EXPECT_EQ(again.model.notes, critical.model.notes) << what;
        }
    }
}

} // namespace
