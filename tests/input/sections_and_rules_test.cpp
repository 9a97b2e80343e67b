#include "scratch_case.h"

#include <cmath>

namespace whirl::tests {
namespace {

TEST(SectionsAndRules, SectionsOfOtherMake) {
    const std::string shaft =
        "shaft.segments=[{length = 1, outer = 0.05, shear = 0.8, mass_outer = "
        "0.07, mass_inner = 0.01, layers = [{outer = 0.06}, {outer = 0.08, "
        "inner = 0.07}]}]";
    const model::Case scene = load_text(sound_case, {shaft, "shaft.rotary_inertia=false"});
    EXPECT_FALSE(scene.rotor.shaft.rotary_inertia);
    const model::Segment &segment = scene.rotor.shaft.segments.at(0);
    EXPECT_EQ(segment.shear_coefficient, 0.8);
    EXPECT_EQ(segment.mass_outer, 0.07);
    EXPECT_EQ(segment.mass_inner, 0.01);
    ASSERT_EQ(segment.layers.size(), 2U);
    EXPECT_EQ(segment.layers[0].inner, 0.05); // it sits on the segment
    EXPECT_EQ(segment.layers[1].inner, 0.07);
    const std::string wrong =
        refusal(sound_case, {"shaft.segments=[{length = 1, outer = 0.05, mass_outer = 0.01, "
                             "mass_inner = 0.02, layers = [{outer = 0.04}]}]"});
    EXPECT_NE(wrong.find("layers[0].outer: expected a diameter above the inner one, 0.05 m"),
              std::string::npos)
        << wrong;
    EXPECT_NE(wrong.find("segments[0].mass_inner: expected mass_inner below mass_outer"),
              std::string::npos)
        << wrong;
}

// Where two tubes overlap, both materials would be counted at one place; in the bore there is room.
TEST(SectionsAndRules, LayersDoNotOverlap) {
    const auto with = [](const std::string &layers) {
        return "shaft.segments=[{length = 1, outer = 0.05, inner = 0.03, layers = [" + layers +
               "]}]";
    };
    for (const auto &[layers, key] : std::vector<std::pair<std::string, std::string>>{
             {"{outer = 0.06, inner = 0.045}", "layers[0].inner"},
             {"{outer = 0.04, inner = 0.02}", "layers[0].inner"},
             {"{outer = 0.07}, {outer = 0.08, inner = 0.06}", "layers[1].inner"},
             {"{outer = 0.07, inner = 0.06}, {outer = 0.065, inner = 0.05}", "layers[1].inner"}}) {
        const std::string wrong = refusal(sound_case, {with(layers)});
        EXPECT_NE(wrong.find(key + ": expected a tube beside what lies from"), std::string::npos)
            << layers << ": " << wrong;
    }
    const model::Case scene = load_text(
        sound_case, {with("{outer = 0.03, inner = 0.01}, {outer = \"60 mm\", inner = \"50 mm\"}, "
                          "{outer = 0.07}")});
    EXPECT_EQ(scene.rotor.shaft.segments.at(0).layers.size(), 3U);
}

// Half the polar inertia of the rotor bounds an anisotropy where no disc stands; a sleeve adds to
// it.
TEST(SectionsAndRules, ASleeveCountsInTheBoundOfAnAnisotropy) {
    const std::string added = "anisotropy=[{z = 0.5, dI = 0.01}]"; // the bare shaft has 0.0024
    EXPECT_NE(refusal(sound_case, {added}).find("half the polar inertia"), std::string::npos);
    const std::string sleeved =
        "shaft.segments=[{length = 1, outer = 0.05, layers = [{outer = 0.1}]}]"; // 0.038
    EXPECT_EQ(load_text(sound_case, {sleeved, added}).rotor.anisotropies.at(0).dI, 0.01);
}

TEST(SectionsAndRules, ImbalanceByTheRulesOfIsoAndApi) {
    // G 2.5 of 100 kg at 3000 rpm: e = 2.5e-3/314.159 m = 7.958 um. 4W/N of 220.46 lb at 3000 rpm:
    // 0.29395 oz in, an ounce of 28.3495 g.
    const model::Case scene = load_text(
        sound_case, {"imbalance=[{z = 0.5, grade = \"G 2.5\", mass = 100, speed = \"3000 rpm\"}, "
                     "{z = 0.5, api = true, mass = 100, speed = \"3000 rpm\", share = 0.5}]"});
    ASSERT_EQ(scene.rotor.imbalances.size(), 2U);
    EXPECT_NEAR(scene.rotor.imbalances[0].mr, 100 * 7.957747e-6, 1e-10);
    EXPECT_NEAR(scene.rotor.imbalances[1].mr, 0.5 * 0.293950 * 28.349523e-3 * 0.0254, 1e-9);
    ASSERT_GE(scene.remarks.size(), 2U);
    EXPECT_NE(scene.remarks[0].find("G 2.5 of 100 kg at 314.159 rad/s"), std::string::npos);
    // Of the rotor itself: steel of sound_case, at the highest speed of the range.
    const model::Case whole = load_text(sound_case, {"imbalance=[{z = 0.5, grade = 6.3}]",
                                                     "speeds={from = 0, to = 200, count = 3}"});
    const model::Segment &segment = whole.rotor.shaft.segments.at(0);
    const double mass = segment.material.rho * M_PI / 4 * segment.outer_start *
                        segment.outer_start * whole.rotor.shaft.length();
    EXPECT_NEAR(whole.rotor.imbalances.at(0).mr / (6.3e-3 * mass / 200), 1, 1e-12);
    for (const auto &[entry, start] : std::vector<std::pair<std::string, std::string>>{
             {"grade = \"fine\", speed = 3", "grade: expected a balance quality grade"},
             {"grade = 2.5", "speed: missing, expected the angular speed"},
             {"grade = 2.5, mr = 1", "grade: expected one of mr, grade and api"}}) {
        const std::string message = refusal(sound_case, {"imbalance=[{z = 0.5, " + entry + "}]"});
        EXPECT_NE(message.find("imbalance[0]." + start), std::string::npos) << message;
    }
}

TEST(SectionsAndRules, WhatIsWrongIsNotMissingBesides) {
    for (const std::vector<std::string> &wrong : std::vector<std::vector<std::string>>{
             {"imbalance=[{z = 0.5, grade = 2.5}]", "operation={from = 1, to = \"24000 1/s\"}"},
             {"imbalance=[{z = 0.5, grade = 2.5, speed = \"fast\"}]"},
             {"speeds={from = 0, to = \"fast\", count = 3}"},
             {"material.steel.nu=fast", "material.steel.G="}}) {
        const std::string message = refusal(sound_case, wrong);
        EXPECT_NE(message, "");
        EXPECT_EQ(message.find("missing"), std::string::npos) << message;
    }
}

} // namespace
} // namespace whirl::tests
