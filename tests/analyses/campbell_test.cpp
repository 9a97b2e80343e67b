#include "analyses/campbell.h"
#include "analyses/critical.h"
#include "model/errors.h"
#include "results/campbell.h"
#include "results/critical.h"
#include "results/formulation.h"
#include "results/whirl.h"
#include "support/scenes.h"
#include "support/test_rotors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>

namespace {

using namespace whirl;

model::Case scene_of(model::Rotor rotor, int order, double to, int count) {
    model::Case scene;
    scene.rotor = std::move(rotor);
    scene.rotor.shaft.order = order;
    scene.speeds = model::SpeedRange{0, to, count};
    return scene;
}

TEST(Campbell, CrossingsAreTheCriticalSpeedsFoundWithoutASweep) {
    // Undamped, both are roots of the same determinant, by two independent ways.
    for (const double kyy : {1e6, 0.8e6}) {
        const model::Case scene = scene_of(tests::two_disc_rotor(1e6, kyy), 8, 1300, 27);
        const results::CampbellResult sweep = analyses::campbell(scene);
        const results::CriticalResult direct = analyses::critical_speeds(scene);
        ASSERT_GE(sweep.crossings.size(), 6U);
        for (std::size_t i = 0; i < sweep.crossings.size(); ++i) {
            const results::Crossing &crossing = sweep.crossings[i];
            EXPECT_NEAR(crossing.speed / direct.critical_speeds.at(i).speed, 1, 1e-9) << i;
            // Of crossing senses: the mode that crosses whirls as the critical speed says.
            const auto &mode = sweep.modes[static_cast<std::size_t>(crossing.mode)];
            EXPECT_EQ(mode.label.back() == 'F',
                      direct.critical_speeds[i].whirl == results::Whirl::forward)
                << mode.label;
        }
    }
}

TEST(Campbell, MultiplesCrossWhereTheFrequencyIsTheMultiple) {
    model::Case scene = scene_of(tests::two_disc_rotor(1e6, 1e6), 8, 600, 13);
    scene.campbell.multiples = {0.5, 2};
    const results::CampbellResult sweep = analyses::campbell(scene);
    ASSERT_FALSE(sweep.crossings.empty());
    for (const results::Crossing &crossing : sweep.crossings) {
        model::Case at = scene;
        at.speeds = model::SpeedRange{crossing.speed, crossing.speed, 1};
        const results::CampbellResult one = analyses::campbell(at);
        const bool met = std::any_of(one.modes.begin(), one.modes.end(), [&](const auto &mode) {
            return std::abs(*mode.frequency[0] / (crossing.multiple * crossing.speed) - 1) < 1e-9;
        });
        EXPECT_TRUE(met) << crossing.multiple << " " << crossing.speed;
    }
}

TEST(Campbell, FollowsEachModeOnceThroughCrossingsAndRefinement) {
    // Forward modes rise and backward ones fall with speed (gyroscopic stiffening), and no two
    // lines share a frequency and a sense at any speed.
    const results::CampbellResult sweep =
        analyses::campbell(scene_of(tests::two_disc_rotor(1e6, 1e6), 8, 4000, 9));
    ASSERT_EQ(sweep.speeds.size(), 9U);
    ASSERT_GE(sweep.modes.size(), 4U); // two pairs at the least
    for (std::size_t k = 0; k < sweep.speeds.size(); ++k) {
        std::set<std::pair<double, results::Whirl>> seen;
        for (const auto &mode : sweep.modes) {
            ASSERT_TRUE(mode.frequency[k]);
            EXPECT_TRUE(seen.emplace(std::round(1e6 * *mode.frequency[k]), mode.whirl[k]).second);
            EXPECT_EQ(mode.whirl[k], mode.whirl[0]);
            if (k > 0 && mode.whirl[k] == results::Whirl::forward) {
                EXPECT_GT(*mode.frequency[k], *mode.frequency[k - 1]);
            } else if (k > 0) {
                EXPECT_LT(*mode.frequency[k], *mode.frequency[k - 1]);
            }
        }
    }
}

/// A rigid rotor on two equal bearings, whose translation m x'' + 2 c x' + 2 k x = 0 does not know
/// the speed.
model::Case translating(double damping_ratio) {
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(1, 0.1, tests::steel());
    scene.rotor.shaft.rigid = true;
    const double mass = tests::steel().rho * 0.01 * std::numbers::pi / 4;
    const double k = 1e6;
    for (const double z : {0.3, 0.7}) // near enough for the rocking motion to whirl
        scene.rotor.bearings.push_back(
            tests::isotropic_bearing(z, k, damping_ratio * std::sqrt(2 * k * mass)));
    scene.speeds = model::SpeedRange{0, 100, 11};
    return scene;
}

bool noted(const results::ModelSummary &model, const std::string &part) {
    return std::any_of(model.notes.begin(), model.notes.end(), [&part](const std::string &note) {
        return note.find(part) != std::string::npos;
    });
}

// Above a damping ratio of 1/sqrt(2) `campbell` alone has a crossing, above 0.9998 nobody has, and
// each says so.
TEST(Campbell, HeavyDampingIsToldTheSameWayAsInCritical) {
    const double mass = tests::steel().rho * 0.01 * std::numbers::pi / 4;
    for (const double ratio : {0.9990, 0.9997, 0.9999}) {
        const model::Case scene = translating(ratio);
        const double crossing = std::sqrt(2e6 / mass * (1 - ratio * ratio));
        const results::CampbellResult sweep = analyses::campbell(scene);
        const bool whirls = ratio < 0.9998;
        const auto there = [&](const auto &speeds) {
            return std::any_of(speeds.begin(), speeds.end(), [&](const auto &at) {
                return std::abs(at.speed - crossing) < 1e-8 * crossing;
            });
        };
        ASSERT_LT(crossing, 100) << ratio;
        EXPECT_EQ(there(sweep.crossings), whirls) << ratio;
        EXPECT_EQ(noted(sweep.model, "damping ratio above 0.9998"), !whirls) << ratio;
        EXPECT_EQ(noted(sweep.model, "`critical` leaves them out"), whirls) << ratio;
        const results::CriticalResult critical = analyses::critical_speeds(scene);
        EXPECT_FALSE(there(critical.critical_speeds)) << ratio;
        EXPECT_TRUE(noted(critical.model, "`campbell` has their crossings")) << ratio;
    }
}

TEST(Campbell, DampedRotorsOfEveryOrderAreSweptToTheEnd) {
    // Modes turn overdamped and back along these sweeps, also at speeds between the given ones.
    for (const int order : {2, 3, 4, 5, 8})
        for (const double c : {300.0, 3e3, 3e4, 1e8}) {
            model::Case scene = scene_of(tests::two_disc_rotor(1e6, 1e6, 0, c), order, 1250, 26);
            scene.campbell.modes = 12;
            const results::CampbellResult sweep = analyses::campbell(scene);
            ASSERT_EQ(sweep.speeds.size(), 26U);
            for (std::size_t k = 0; k < sweep.speeds.size(); ++k) {
                int whirling = 0;
                for (const results::CampbellMode &mode : sweep.modes) {
                    // A mode that is not there says why; it was never lost.
                    EXPECT_EQ(mode.absent.at(k), mode.frequency.at(k) ? "" : "overdamped")
                        << order << " " << c << " " << mode.label << " " << sweep.speeds[k];
                    ASSERT_EQ(mode.real.at(k).has_value(), mode.frequency[k].has_value());
                    if (!mode.frequency[k])
                        continue;
                    ++whirling;
                    EXPECT_LT(*mode.real[k], 1e-6) << order << " " << c; // dissipative
                }
                EXPECT_GE(whirling, 12) << order << " " << c << " " << sweep.speeds[k];
            }
        }
}

TEST(Campbell, UndampedMotionHasNoDampingInAnyForm) {
    // Symmetric coupling and an asymmetric section conserve energy, and where the stiffness in
    // rotating axes is positive (here to the first critical speed, some 80 rad/s) nothing grows.
    model::Rotor coupled = tests::two_disc_rotor(1e6, 0.8e6, 2e5);
    model::Rotor asymmetric = tests::two_disc_rotor(1e6, 1e6);
    asymmetric.shaft.segments[1].asymmetry = 0.2;
    for (const model::Rotor &rotor : {coupled, asymmetric}) {
        const results::CampbellResult result = analyses::campbell(scene_of(rotor, 3, 60, 13));
        EXPECT_NE(results::unknowns_name(result.model.formulation.form), "planar");
        ASSERT_FALSE(result.modes.empty());
        for (const results::CampbellMode &mode : result.modes)
            for (std::size_t k = 0; k < result.speeds.size(); ++k) {
                EXPECT_EQ(mode.real[k], 0.0) << mode.label;
                EXPECT_EQ(mode.damping_ratio[k], 0.0) << mode.label;
                EXPECT_EQ(mode.log_dec[k], 0.0) << mode.label;
            }
    }
}

TEST(Campbell, DampingFarBelowTheDiscretisationErrorIsKept) {
    // Between two bearings k, c the rigid rotor bounces with m l^2 + 2 c l + 2 k = 0.
    model::Rotor rotor = tests::two_disc_rotor(1e6, 1e6, 0, 1e-5);
    rotor.shaft.rigid = true;
    rotor.discs = {tests::disc(0.75, 50, 2, 3)};
    const double mass = 50 + 7810 * 1.5 * M_PI * 0.025 * 0.025;
    const results::CampbellResult result = analyses::campbell(scene_of(rotor, 1, 200, 3));
    const auto bounce = [&](const results::CampbellMode &mode) {
        return std::abs(*mode.frequency[1] / std::sqrt(2e6 / mass) - 1) < 1e-9;
    };
    EXPECT_EQ(std::count_if(result.modes.begin(), result.modes.end(), bounce), 2);
    for (const results::CampbellMode &mode : result.modes)
        if (bounce(mode)) {
            EXPECT_NEAR(*mode.real[1] / (-1e-5 / mass), 1, 1e-3) << mode.label; // 7e-10 of l
        }
}

TEST(Campbell, RefusesFormsInTheFixedFrameForAsymmetricRotors) {
    model::Case scene = scene_of(tests::two_disc_rotor(1e6, 1e6), 4, 400, 3);
    model::Anisotropy part;
    part.z = 0.5;
    part.dI = 0.01;
    scene.rotor.anisotropies.push_back(part);
    for (const auto form :
         {model::FormChoice::planar, model::FormChoice::hyperbolic, model::FormChoice::general}) {
        scene.formulation = form;
        EXPECT_THROW((void)analyses::campbell(scene), model::BadInput);
        EXPECT_THROW((void)analyses::critical_speeds(scene), model::BadInput);
    }
}

} // namespace
