// A scene that looks the same in every frame has the same whirl speeds in every frame: the rotating
// form against the planar and the general one. And a flexible rotor that stiffens becomes a rigid
// one.

#include "analyses/campbell.h"
#include "analyses/stability.h"
#include "closed_form/anisotropic_rotor.h"
#include "modes/rotating_spectrum.h"
#include "results/campbell.h"
#include "results/whirl.h"
#include "rigid/projection.h"
#include "support/rotating_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace {

using namespace whirl;
using model::FormChoice;

struct Whirling {
    double frequency, real;
    results::Whirl whirl;
};

/// The six lowest modes at each speed, by frequency.
std::vector<std::vector<Whirling>> modes_of(model::Rotor rotor, FormChoice form, double from,
                                            double to) {
    model::Case scene = tests::scene_of(std::move(rotor), from, to, 3);
    scene.formulation = form;
    scene.campbell.modes = 6;
    const results::CampbellResult result = analyses::campbell(scene);
    std::vector<std::vector<Whirling>> out;
    for (std::size_t k = 0; k < result.speeds.size(); ++k) {
        std::vector<Whirling> modes;
        for (const results::CampbellMode &mode : result.modes)
            if (mode.frequency[k])
                modes.push_back({*mode.frequency[k], *mode.real[k], mode.whirl[k]});
        std::sort(modes.begin(), modes.end(),
                  [](const auto &a, const auto &b) { return a.frequency < b.frequency; });
        modes.resize(std::min<std::size_t>(modes.size(), 6));
        out.push_back(modes);
    }
    return out;
}

void expect_same(const model::Rotor &rotor, FormChoice reference, double from = 60,
                 double to = 700) {
    const auto expected = modes_of(rotor, reference, from, to);
    const auto found = modes_of(rotor, FormChoice::rotating, from, to);
    for (std::size_t k = 0; k < expected.size(); ++k) {
        ASSERT_EQ(found[k].size(), 6U);
        for (std::size_t i = 0; i < 6; ++i) {
            const Whirling &e = expected[k][i];
            EXPECT_NEAR(found[k][i].frequency, e.frequency, 1e-10 * e.frequency) << k << " " << i;
            EXPECT_NEAR(found[k][i].real, e.real, 1e-10 * e.frequency) << k << " " << i;
            EXPECT_EQ(found[k][i].whirl, e.whirl) << k << " " << i;
        }
    }
}

TEST(Frames, PlanarAndRotatingAgree) {
    expect_same(tests::two_disc_rotor(1e6, 1e6), FormChoice::planar);
    expect_same(tests::two_disc_rotor(1e6, 1e6), FormChoice::planar, -700, -60);
}

TEST(Frames, ExternalDamping) {
    expect_same(tests::two_disc_rotor(1e6, 1e6, 0, 300), FormChoice::general);
}

TEST(Frames, InternalDamping) {
    model::Rotor rotor = tests::two_disc_rotor(1e6, 1e6, 0, 300);
    rotor.shaft.internal_damping = 2e-5;
    rotor.shaft.axial_force = 5e4;
    expect_same(rotor, FormChoice::general);
}

TEST(Frames, Pedestals) {
    model::Rotor rotor = tests::two_disc_rotor(2e6, 2e6, 0, 200);
    rotor.bearings[0].pedestal = model::Pedestal{20, 3e6, 400};
    rotor.bearings[1].pedestal = model::Pedestal{10, 5e6, 100};
    expect_same(rotor, FormChoice::general);
}

TEST(Frames, BearingsThatCoupleButAreTheSameFromEveryDirection) {
    model::Rotor rotor = tests::two_disc_rotor(1e6, 1e6, 0, 3000);
    for (model::Bearing &bearing : rotor.bearings) {
        bearing.rows[0].k(0, 1) = 2e5;
        bearing.rows[0].k(1, 0) = -2e5;
        bearing.rows[0].c(0, 1) = -100;
        bearing.rows[0].c(1, 0) = 100;
        bearing.rows[0].kt = 1e4 * Eigen::Matrix2d::Identity();
        bearing.rows[0].ct = 10 * Eigen::Matrix2d::Identity();
    }
    expect_same(rotor, FormChoice::general);
}

TEST(Frames, BearingTables) {
    model::Rotor rotor = tests::two_disc_rotor(1e6, 1e6, 0, 300);
    for (model::Bearing &bearing : rotor.bearings) {
        bearing.speeds = {0, 500};
        bearing.rows.push_back(bearing.rows[0]);
        bearing.rows[1].k *= 2;
    }
    expect_same(rotor, FormChoice::general);
}

TEST(Frames, EigenvaluesAreShiftedByTheSpin) {
    const model::Rotor rotor = tests::two_disc_rotor(1e6, 1e6);
    const double speed = 410;
    const auto planar = modes_of(rotor, FormChoice::planar, speed, speed + 1);
    const assembly::Discretization d(rotor, 4);
    const modes::RotatingSpectrum spectrum(d, 0, {}, 0);
    const auto found = spectrum.eigenvalues(speed, 2000, 1).pairs;
    for (const Whirling &mode : planar[0]) {
        const double shifted = mode.whirl == results::Whirl::forward
                                   ? std::abs(mode.frequency - speed)
                                   : mode.frequency + speed;
        const bool there = std::any_of(found.begin(), found.end(), [&](const auto &pair) {
            return std::abs(pair.value - std::complex<double>(0, shifted)) < 1e-10 * speed;
        });
        EXPECT_TRUE(there) << mode.frequency;
    }
}

/// Two discs on a shaft, one of them anisotropic, damped bearings; symmetric about its middle.
model::Rotor flexible_rotor(double stiffer) {
    model::Rotor rotor = tests::uniform_shaft(1, 0.1, 2);
    rotor.shaft.order = 1;
    rotor.shaft.segments[0].material.E *= stiffer;
    rotor.shaft.segments[0].material.G *= stiffer;
    rotor.discs = {tests::disc(0.5, 40, 3, 2.2)};
    rotor.anisotropies = {{"", 0.5, 0.3, 0.2}};
    rotor.bearings = {tests::round_bearing(0, 1e6, 60), tests::round_bearing(1, 1e6, 60)};
    return rotor;
}

TEST(RigidLimit, EndsOfTheUnstableBandConvergeAsOneOverTheStiffness) {
    // From the shaft's and the disc's inertias.
    model::Rotor bare = flexible_rotor(1);
    bare.anisotropies.clear();
    const auto body = rigid::rigid_projection(bare).value();
    const auto exact = closed_form::unstable_band({body.C / body.A, 0.3 / body.A,
                                                   std::sqrt(body.supports.c_beta / body.A),
                                                   body.supports.h_beta / body.A});
    ASSERT_TRUE(exact && exact->to);
    const auto ends = [&](double stiffer, bool rigid) {
        model::Rotor rotor = flexible_rotor(stiffer);
        rotor.shaft.rigid = rigid;
        const model::Case scene = tests::scene_of(rotor, 0.6 * exact->from, 1.5 * *exact->to, 41);
        const auto bands = analyses::unstable_bands_of(scene, {}, false).bands;
        EXPECT_EQ(bands.size(), 1U);
        return bands.at(0);
    };
    const auto limit = ends(1, true);
    EXPECT_NEAR(limit.from, exact->from, 1e-9 * exact->from);
    EXPECT_NEAR(limit.to, *exact->to, 1e-9 * *exact->to);
    auto before = ends(16, false);
    for (const double stiffer : {32.0, 64.0, 128.0}) {
        const auto now = ends(stiffer, false);
        EXPECT_NEAR(std::log2((before.from - limit.from) / (now.from - limit.from)), 1, 0.05);
        EXPECT_NEAR(std::log2((before.to - limit.to) / (now.to - limit.to)), 1, 0.05);
        before = now;
    }
}

} // namespace
