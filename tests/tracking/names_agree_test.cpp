// One name for one motion, whatever the grid of speeds, the number of modes and the command: on
// bearings whose damping changes with speed, so that lines end and begin on the real axis.

#include "analyses/campbell.h"
#include "analyses/critical.h"
#include "analyses/modes.h"
#include "results/campbell.h"
#include "results/critical.h"
#include "results/modes.h"
#include "support/scenes.h"
#include "support/written_case.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace whirl;

constexpr double slow = 50, fast = 1250; // rad/s

model::BearingCoefficients row(double kxx, double kyy, double cross, double c) {
    model::BearingCoefficients out;
    out.k << kxx, cross, -cross, kyy;
    out.c << c, 0, 0, 1.5 * c;
    return out;
}

/// A rotor with one disc off its middle.
/// @param first, last  coefficients at both ends of the range
model::Case rotor_on(const model::BearingCoefficients &first,
                     const model::BearingCoefficients &last) {
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(1, 0.05, tests::steel());
    scene.rotor.shaft.order = 2;
    scene.rotor.shaft.segments[0].elements = 4;
    scene.rotor.discs = {tests::disc_at(0.4, 20, 0.1, 0.18)};
    for (const double z : {0.0, 1.0}) {
        model::Bearing bearing;
        bearing.z = z;
        bearing.speeds = {slow, fast};
        for (const model::BearingCoefficients *end : {&first, &last}) {
            bearing.rows.push_back(*end);
            bearing.rows.back().c *= 1 + z / 3; // no two lines alike
        }
        scene.rotor.bearings.push_back(bearing);
    }
    return scene;
}

/// Damping that grows, so that low lines end; that dies away, so that they begin.
std::vector<std::pair<std::string, model::Case>> rotors() {
    const auto damped = row(3e7, 6e7, 4e6, 3e5);
    const auto light = row(2e7, 4e7, 2e6, 6e3);
    return {{"ends", rotor_on(light, damped)}, {"begins", rotor_on(damped, light)}};
}

struct Named {
    std::complex<double> value;
    std::string name;
};

/// The modes of a diagram at its speed k.
std::vector<Named> at(const results::CampbellResult &diagram, std::size_t k) {
    std::vector<Named> out;
    for (const results::CampbellMode &mode : diagram.modes)
        if (mode.frequency[k])
            out.push_back({{*mode.real[k], *mode.frequency[k]}, mode.label});
    return out;
}

results::CampbellResult diagram(model::Case scene, int count, int modes) {
    scene.speeds = model::SpeedRange{slow, fast, count};
    scene.campbell.modes = modes;
    return analyses::campbell(scene);
}

/// What has a name in both has the same. @returns how many these are
int agree(const std::vector<Named> &some, const std::vector<Named> &others,
          const std::string &where) {
    int both = 0;
    for (const Named &one : some)
        for (const Named &other : others)
            // Both are the solver's: its rounding.
            if (std::abs(one.value - other.value) < 1e-7 * std::abs(one.value) &&
                !one.name.empty() && !other.name.empty()) {
                EXPECT_EQ(one.name, other.name) << where << ", at " << one.value;
                ++both;
            }
    return both;
}

TEST(NamesAgree, over_all_grids_and_numbers_of_modes) {
    for (const auto &[what, scene] : rotors()) {
        const results::CampbellResult fine = diagram(scene, 61, 8);
        int absent = 0;
        for (const results::CampbellMode &mode : fine.modes)
            for (const std::string &why : mode.absent)
                absent += why == "overdamped" ? 1 : 0;
        ASSERT_GT(absent, 0) << what; // else there is nothing to it
        for (const auto &[count, modes] : {std::pair{2, 8}, {25, 8}, {41, 6}, {11, 12}}) {
            const results::CampbellResult other = diagram(scene, count, modes);
            const std::string where = what + ": " + std::to_string(count) + " speeds, " +
                                      std::to_string(modes) + " modes";
            EXPECT_GE(agree(at(fine, 0), at(other, 0), where), 4);
            EXPECT_GE(agree(at(fine, 60), at(other, static_cast<std::size_t>(count) - 1), where),
                      4);
            if (count % 2 == 1)
                EXPECT_GE(
                    agree(at(fine, 30), at(other, static_cast<std::size_t>(count) / 2), where), 4);
        }
    }
}

TEST(NamesAgree, in_all_commands) {
    for (auto [what, scene] : rotors()) {
        const results::CampbellResult fine = diagram(scene, 61, 8);
        for (const int count : {4, 31})
            for (const int modes : {6, 10}) {
                scene.speeds = model::SpeedRange{slow, fast, count};
                scene.campbell.modes = modes;
                for (const std::size_t k : {0U, 35U, 60U}) {
                    scene.modes.speed = fine.speeds[k];
                    std::vector<Named> found;
                    for (const auto &shape : analyses::mode_shapes(scene).modes)
                        found.push_back({shape.eigenvalue, shape.label});
                    EXPECT_GE(agree(found, at(fine, k), what + ": modes"), 3);
                }
                for (const auto &critical : analyses::critical_speeds(scene).critical_speeds) {
                    if (critical.mode.empty() || critical.speed > fast)
                        continue;
                    scene.modes.speed = critical.speed;
                    const std::complex<double> value(critical.real, critical.speed);
                    Named next{INFINITY, ""};
                    for (const auto &shape : analyses::mode_shapes(scene).modes)
                        if (std::abs(shape.eigenvalue - value) < std::abs(next.value - value))
                            next = {shape.eigenvalue, shape.label};
                    EXPECT_EQ(critical.mode, next.name) << what << ": critical " << critical.speed;
                }
                scene.modes.speed.reset();
            }
    }
}

// A critical speed far beyond the range has the name that its mode has in a diagram that reaches
// there.
void expect_names_of_shapes_beyond(model::Case scene, double last) {
    scene.speeds = model::SpeedRange{0, last, 5};
    scene.campbell.modes = 8;
    int beyond = 0;
    for (const auto &critical : analyses::critical_speeds(scene).critical_speeds) {
        if (critical.speed < last || critical.damping.heavy())
            continue;
        model::Case far = scene;
        far.modes.speed = critical.speed;
        const std::complex<double> value(critical.real, critical.speed);
        Named next{INFINITY, ""};
        for (const auto &shape : analyses::mode_shapes(far).modes)
            if (std::abs(shape.eigenvalue - value) < std::abs(next.value - value) &&
                shape.whirl == critical.whirl)
                next = {shape.eigenvalue, shape.label};
        if (next.name.empty())
            continue;
        ++beyond;
        EXPECT_EQ(critical.mode, next.name) << critical.speed;
    }
    EXPECT_GE(beyond, 3);
}

TEST(NamesAgree, beyond_the_range_too_on_isotropic_bearings) {
    model::Case scene = rotors().front().second;
    scene.rotor.bearings = {tests::isotropic_bearing(0, 2e7, 5e3),
                            tests::isotropic_bearing(1, 3e7, 4e3)};
    expect_names_of_shapes_beyond(scene, 100);
}

TEST(NamesAgree, beyond_the_range_too_on_bearings_that_differ_between_directions) {
    model::Case scene = rotors().front().second;
    for (model::Bearing &bearing : scene.rotor.bearings) {
        bearing.speeds.clear();
        bearing.rows = {row(2e7, 4e7, 2e6, 3e3)};
    }
    expect_names_of_shapes_beyond(scene, 100);
}

/// Overhung discs on pedestals that differ in x and y: of two lines that come near within a tenth
/// of the range, one forward and one backward, each goes on as the other was.
constexpr const char *pump = R"(
[shaft]
order = 3
segments = [
  {length = 0.08, outer = 0.04},
  {length = 0.16, outer = 0.052},
  {length = 0.09, outer = 0.045},
]
axial_torque = 900
torque_kind = "tangential"
[[disc]]
z = 0.03
mass = 4.5
Id = 0.0085
Ip = 0.0125
[[disc]]
z = 0.31
mass = 7.2
Id = 0.025
Ip = 0.046
[[bearing]]
z = 0.09
k = 60e6
c = 900
pedestal_kx = 110e6
pedestal_ky = 170e6
pedestal_mass_x = 3.0
pedestal_mass_y = 3.6
pedestal_cx = 500
pedestal_cy = 700
[[bearing]]
z = 0.23
k = 70e6
c = 900
pedestal_kx = 130e6
pedestal_ky = 200e6
pedestal_mass = 4
pedestal_c = 600
[[seal]]
z = 0.03
k = 4e6
kxy = 1.5e6
c = 600
m = 0.4
[speeds]
from = 0
to = "45000 rpm"
)";

TEST(NamesAgree, where_a_coarse_step_holds_a_veering) {
    model::Case scene = tests::written_case(pump);
    const auto at_the_end = [&scene](int count) {
        scene.speeds->count = count;
        return at(analyses::campbell(scene), static_cast<std::size_t>(count) - 1);
    };
    const std::vector<Named> fine = at_the_end(401);
    ASSERT_GE(fine.size(), 8U);
    for (const int count : {3, 11, 46})
        EXPECT_GE(agree(fine, at_the_end(count), std::to_string(count) + " speeds"), 8);
}

} // namespace
