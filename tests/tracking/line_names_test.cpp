// The rule that names modes, against lines that are known beforehand: a line keeps its name where
// it crosses others, whatever the speeds.

#include "analyses/campbell.h"
#include "analyses/critical.h"
#include "analyses/modes.h"
#include "results/campbell.h"
#include "results/critical.h"
#include "results/modes.h"
#include "support/scenes.h"
#include "tracking/line_names.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace {

using namespace whirl;
using results::Whirl;

constexpr double length = 1, mass = 20, stiffness = 1e6; // of each of two bearings
constexpr double Ip = 1.2, Id = 1;

/// A rigid rotor, symmetric about its middle: translation at w = sqrt(2 k / m), whatever the speed,
/// and tilting at the roots of Id w^2 -+ Ip speed w - k L^2 / 2 = 0.
model::Case rigid_rotor(double from, double to, int count) {
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(length, 0.05, tests::weightless_steel());
    scene.rotor.shaft.rigid = true;
    scene.rotor.discs = {tests::disc_at(length / 2, mass, Id, Ip)};
    scene.rotor.bearings = {tests::isotropic_bearing(0, stiffness),
                            tests::isotropic_bearing(length, stiffness)};
    scene.speeds = model::SpeedRange{from, to, count};
    scene.campbell.modes = 4;
    return scene;
}

double translation() { return std::sqrt(2 * stiffness / mass); }

double tilting(double speed, double sense) {
    const double g = sense * Ip * speed / (2 * Id);
    return g + std::sqrt(g * g + stiffness * length * length / (2 * Id));
}

/// The closed form that a name stands for: at rest the translation is slower than tilting, so that
/// both lines of translation have number 1.
double frequency_of(const std::string &name, double speed) {
    if (name == "1F" || name == "1B")
        return translation();
    if (name == "2F")
        return tilting(speed, 1);
    return name == "2B" ? tilting(speed, -1) : NAN;
}

/// Backward tilting falls below the translation: from there on it is the slowest backward mode and
/// keeps its name all the same.
TEST(LineNames, follow_the_line_not_the_rank) {
    ASSERT_LT(translation(), tilting(0, 1));
    ASSERT_LT(tilting(1500, -1), 0.9 * translation());
    for (const int count : {4, 11, 40, 101}) {
        const results::CampbellResult result = analyses::campbell(rigid_rotor(0, 1500, count));
        ASSERT_EQ(result.modes.size(), 4U);
        for (const results::CampbellMode &mode : result.modes)
            for (std::size_t k = 0; k < result.speeds.size(); ++k)
                EXPECT_NEAR(mode.frequency[k].value() / frequency_of(mode.label, result.speeds[k]),
                            1, 1e-9)
                    << mode.label << " at " << result.speeds[k] << ", " << count << " speeds";
    }
}

/// Asked for at one speed behind the crossing the modes have the names of the lines.
TEST(LineNames, of_modes_at_a_speed_are_those_of_the_diagram) {
    for (const double speed : {40.0, 977.0, 1500.0, 2100.0}) { // the last beyond the range
        model::Case scene = rigid_rotor(0, 1500, 21);
        scene.modes.speed = speed;
        const results::ModesResult result = analyses::mode_shapes(scene);
        ASSERT_EQ(result.modes.size(), 4U);
        EXPECT_TRUE(result.critical.empty());
        for (const results::ModeShape &shape : result.modes)
            EXPECT_NEAR(shape.eigenvalue.imag() / frequency_of(shape.label, speed), 1, 1e-9)
                << shape.label << " at " << speed;
    }
}

/// With one speed names are ranks within the sense there.
TEST(LineNames, are_ranks_where_there_is_one_speed) {
    const results::ModesResult result = analyses::mode_shapes(rigid_rotor(1500, 1500, 1));
    ASSERT_EQ(result.modes.size(), 4U);
    for (const results::ModeShape &shape : result.modes) {
        const std::string other = shape.label == "1B"   ? "2B"
                                  : shape.label == "2B" ? "1B"
                                                        : shape.label;
        EXPECT_NEAR(shape.eigenvalue.imag() / frequency_of(other, 1500), 1, 1e-9) << shape.label;
    }
}

/// Critical speeds: of the translation where both senses meet, and of backward tilting; the disc is
/// too thin for forward tilting (Ip > Id).
TEST(LineNames, of_critical_speeds) {
    for (const double to : {300.0, 1500.0}) { // inside the range or beyond it
        const results::CriticalResult result = analyses::critical_speeds(rigid_rotor(0, to, 21));
        ASSERT_EQ(result.critical_speeds.size(), 3U);
        for (const results::CriticalSpeed &critical : result.critical_speeds) {
            EXPECT_NEAR(critical.speed / frequency_of(critical.mode, critical.speed), 1, 1e-9)
                << critical.mode;
            EXPECT_EQ(critical.mode.back(), critical.whirl == Whirl::forward ? 'F' : 'B');
        }
    }
}

/// Spread evenly, whatever the number of speeds.
TEST(LineNames, naming_speeds_are_eleven) {
    for (const int count : {2, 3, 11, 24, 101, 1000}) {
        const std::vector<double> speeds = tracking::naming_speeds({300, 1700, count});
        ASSERT_EQ(speeds.size(), 11U);
        for (std::size_t i = 0; i < speeds.size(); ++i)
            EXPECT_NEAR(speeds[i], 300 + 140.0 * static_cast<double>(i), 1e-12 * 1700);
        EXPECT_EQ(speeds.front(), 300);
        EXPECT_EQ(speeds.back(), 1700);
    }
    EXPECT_EQ(tracking::naming_speeds({300, 300, 1}), (std::vector<double>{300}));
}

/// Lines that begin to whirl late have numbers of their own; one that comes in from beyond has a
/// name that is not sure, and so have those after it.
TEST(LineNames, of_lines_that_begin_later) {
    using tracking::Absence;
    std::vector<modes::Spectrum> spectra(3);
    for (modes::Spectrum &spectrum : spectra)
        spectrum.modes.resize(3);
    for (modes::Spectrum &spectrum : spectra)
        for (modes::WhirlMode &mode : spectrum.modes)
            mode.whirl = Whirl::forward;
    constexpr int no = tracking::Line::absent;
    const tracking::Line first{{0, 1, 1}, {Absence::none, Absence::none, Absence::none}};
    const auto late = [](Absence why) {
        return tracking::Line{{no, 0, 0}, {why, Absence::none, Absence::none}};
    };
    const tracking::Line last{{no, no, 2},
                              {Absence::overdamped, Absence::overdamped, Absence::none}};
    const auto named = [&](Absence why) {
        return tracking::line_names({last, late(why), first}, spectra, {0, 1, 2}, 3);
    };
    for (const Absence why : {Absence::overdamped, Absence::beyond}) {
        const std::vector<tracking::LineName> names = named(why);
        EXPECT_EQ(names[0].label, "e2F");
        EXPECT_EQ(names[1].label, "e1F");
        EXPECT_EQ(names[2].label, "1F");
        EXPECT_EQ(names[0].sure, why == Absence::overdamped);
        EXPECT_EQ(names[1].sure, why == Absence::overdamped);
        EXPECT_TRUE(names[2].sure);
    }
}

} // namespace
