// The criterion of rotors that are not axisymmetric: whatever the direction of the imbalance.

#include "analyses/balance.h"
#include "oracles/rotor_axes.h"
#include "support/random.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace {

using namespace whirl;
using results::BalanceResult;
using results::Interval;
using tests::Random;

constexpr double pi = std::numbers::pi;

/// The same rotor for the oracles.
oracles::CaseRotor for_oracles(const model::Rotor &rotor) {
    oracles::CaseRotor out;
    for (const model::Segment &s : rotor.shaft.segments) {
        oracles::Segment segment;
        segment.left = {s.length, s.outer_start, s.inner_start, s.material.E, s.material.G,
                        s.material.rho};
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
    Random random(std::getenv("SEED") ? atoi(std::getenv("SEED")) : 32);
    const int only = std::getenv("ONLY") ? atoi(std::getenv("ONLY")) : -1;
    const int count = std::getenv("COUNT") ? atoi(std::getenv("COUNT")) : 100;
    for (int i = 0; i < std::max(count, only + 1); ++i) {
        const model::Case scene = random_scene(random);
        if (only >= 0 && i != only) continue;
        if (only >= 0 && std::getenv("SHOW")) {
            const oracles::RotorAxes exact(for_oracles(scene.rotor));
            const BalanceResult result = analyses::balance(scene);
            for (const auto &plane : result.planes) {
                std::printf("plane %.6f\n", plane.z);
                for (auto &b : plane.bands.bands) std::printf("   %.12g %.12g  [%g %g]\n", b.from, b.to, exact.largest(b.from*(1-1e-6),{plane.z}), exact.largest(b.from*(1+1e-6),{plane.z}));
                for (auto &b : exact.bands(1e-6*scene.speeds->to, scene.speeds->to,{plane.z})) std::printf(" o %.12Lg %.12Lg\n", b.first, b.second);
                for (int k = 0; k <= 40; ++k) { double w = scene.speeds->to*k/40; std::printf("%g:%.3g ", w, k? exact.largest(w,{plane.z}):0);} 
                std::printf("\n");
            }
            for (auto&b : scene.rotor.bearings) std::printf("bearing %g k %g c %g\n", b.z, b.rows[0].k(0,0), b.rows[0].c(0,0));
        }
        try { expect_oracle(scene, 1e-6, "scene " + std::to_string(i) + (scene.rotor.damped() ? " damped" : "")); } catch (const std::exception &e) { ADD_FAILURE() << i << " " << e.what(); std::printf("L %.17g\n", scene.rotor.shaft.length());
 for (auto &x: scene.rotor.shaft.segments) std::printf("seg %.17g %.17g el %d as %.17g %.17g\n", x.length,x.outer_start,x.elements,x.asymmetry,x.asymmetry_angle);
 for (auto &x: scene.rotor.discs) std::printf("disc %.17g %.17g %.17g %.17g\n", x.z,x.mass,x.Id,x.Ip);
 for (auto &x: scene.rotor.anisotropies) std::printf("ani %.17g %.17g %.17g\n", x.z,x.dI,x.angle);
 for (auto &x: scene.rotor.bearings) std::printf("bear %.17g %.17g %.17g\n", x.z,x.rows[0].k(0,0),x.rows[0].c(0,0));
 for (auto &x: scene.rotor.planes) std::printf("plane %.17g \n", x.z);
 std::printf("to %.17g\n", scene.speeds->to);
 }
    }
}

} // namespace
