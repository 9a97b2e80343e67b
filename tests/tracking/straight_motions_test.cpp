// Rotors and bearings both anisotropic (form hill): a motion that the rotor's anisotropy leaves
// alone is a vibration in one fixed direction, shown once and by the name that it has without the
// anisotropy.

#include "analyses/campbell.h"
#include "results/campbell.h"
#include "results/formulation.h"
#include "support/written_case.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace straight_motions_test {

using namespace whirl;

constexpr double mass = 20;
constexpr double kx = 8e5, ky = 12e5, c = 40; ///< of both bearings

/// In the middle between two equal bearings: translation and tilt do not know of each other, and
/// dI is a matter of the tilt.
model::Case rigid_scene(double dI, double from, double to) {
    std::string text = R"(
[material.light]
E = 2e11
nu = 0.3
rho = 1e-9
[shaft]
rigid = true
segments = [{length = 1, outer = 0.05, material = "light"}]
[[disc]]
z = 0.5
mass = 20
Id = 0.8
Ip = 0.5
)";
    if (dI > 0)
        text += "[[anisotropy]]\nz = 0.5\ndI = " + std::to_string(dI) + "\n";
    for (const char *z : {"0", "1"})
        text +=
            std::string("[[bearing]]\nz = ") + z + "\nkxx = 4e5\nkyy = 6e5\ncxx = 20\ncyy = 20\n";
    text += "[campbell]\nmodes = 3\n[speeds]\nfrom = " + std::to_string(from) +
            "\nto = " + std::to_string(to) + "\ncount = 4\n";
    return tests::written_case(text);
}

std::vector<std::string> labels(const results::CampbellResult &diagram) {
    std::vector<std::string> out;
    for (const results::CampbellMode &mode : diagram.modes)
        out.push_back(mode.label);
    return out;
}

void expect_each_once(bool reduction) {
    for (const bool backwards : {false, true}) {
        model::Case scene = rigid_scene(0.08, backwards ? -400 : 100, backwards ? -100 : 400);
        scene.reduction = reduction;
        const results::CampbellResult found = analyses::campbell(scene);
        ASSERT_EQ(found.model.formulation.form, results::Form::hill);
        ASSERT_EQ(labels(found), (std::vector<std::string>{"1M", "2M", "1B"})) << backwards;
        const double decay = c / (2 * mass);
        for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
            const double omega = std::sqrt((i == 0 ? kx : ky) / mass - decay * decay);
            for (std::size_t k = 0; k < found.speeds.size(); ++k) {
                EXPECT_NEAR(*found.modes[i].frequency[k], omega, 1e-9 * omega);
                EXPECT_NEAR(*found.modes[i].real[k], -decay, 1e-9 * omega);
                EXPECT_EQ(found.modes[i].whirl[k], results::Whirl::mixed);
                EXPECT_EQ(found.modes[i].forward_fraction[k], 0.5);
            }
            int crossings = 0;
            for (const results::Crossing &crossing : found.crossings)
                if (crossing.multiple == 1 && crossing.mode == static_cast<int>(i)) {
                    ++crossings;
                    EXPECT_NEAR(std::abs(crossing.speed), omega, 1e-9 * omega);
                }
            EXPECT_EQ(crossings, 1) << i;
        }
    }
}

TEST(StraightMotions, AreListedOnceWithTheNextMotionsBesideThem) { expect_each_once(true); }

TEST(StraightMotions, AreListedOnceByHillsSeries) { expect_each_once(false); }

TEST(NamesOfPeriodicMotions, AreThoseWithoutAnisotropy) {
    model::Case plain = rigid_scene(0, 200, 1400);
    model::Case hardly = rigid_scene(1e-5, 200, 1400);
    for (model::Case *scene : {&plain, &hardly})
        scene->campbell.modes = 4;
    const results::CampbellResult without = analyses::campbell(plain);
    const results::CampbellResult with = analyses::campbell(hardly);
    ASSERT_NE(without.model.formulation.form, results::Form::hill);
    ASSERT_EQ(with.model.formulation.form, results::Form::hill);
    ASSERT_EQ(labels(with), labels(without));
    for (std::size_t i = 0; i < with.modes.size(); ++i)
        for (std::size_t k = 0; k < with.speeds.size(); ++k) {
            EXPECT_EQ(with.modes[i].whirl[k], without.modes[i].whirl[k]) << i;
            EXPECT_NEAR(with.modes[i].forward_fraction[k], without.modes[i].forward_fraction[k],
                        1e-12);
        }
}

} // namespace straight_motions_test
