#include "scratch_case.h"

#include <numbers>

namespace whirl::tests {
namespace {

const std::string base = sound_case + "[[bearing]]\nz = 0\nk = 1e6\n";

TEST(Overrides, ReplaceValues) {
    const model::Case scene =
        load_text(base, {"shaft.order=8", "bearing[0].k = 1e7", "shaft.segments[0].outer=\"25 mm\"",
                         "material.steel.E=1e11", "formulation=general", "bearing[0].z=50 cm"});
    EXPECT_EQ(scene.rotor.shaft.order, 8);
    EXPECT_EQ(scene.rotor.bearings.at(0).rows.at(0).k(0, 0), 1e7);
    EXPECT_EQ(scene.rotor.bearings.at(0).z, 0.5);
    EXPECT_EQ(scene.rotor.shaft.segments.at(0).outer_start, 0.025);
    EXPECT_EQ(scene.rotor.shaft.segments.at(0).material.E, 1e11);
    EXPECT_EQ(scene.formulation, model::FormChoice::general);
}

TEST(Overrides, MakeMissingKeysAndSections) {
    const model::Case scene =
        load_text(base, {"campbell.modes=12", "speeds.to=600 rpm", "speeds.count=3",
                         "disc=[{z = 0.5, mass = 3}]", "disc[0].mass=4"});
    EXPECT_EQ(scene.campbell.modes, 12);
    ASSERT_TRUE(scene.speeds);
    EXPECT_DOUBLE_EQ(scene.speeds->to, 20 * std::numbers::pi);
    EXPECT_EQ(scene.speeds->count, 3);
    ASSERT_EQ(scene.rotor.discs.size(), 1U);
    EXPECT_EQ(scene.rotor.discs[0].mass, 4);
}

TEST(Overrides, TheLastOneCounts) {
    EXPECT_EQ(load_text(base, {"shaft.order=8", "shaft.order=3"}).rotor.shaft.order, 3);
}

const std::string two_bearings =
    base + "name = \"left\"\n[[bearing]]\nname = \"right end\"\nz = 1\nk = 2e6\nc = 50\n";

std::vector<double> stiffnesses(const std::vector<std::string> &overrides) {
    std::vector<double> out;
    for (const model::Bearing &bearing : load_text(two_bearings, overrides).rotor.bearings)
        out.push_back(bearing.rows.at(0).k(0, 0));
    return out;
}

TEST(Overrides, SpeakOfAllItemsOfNamedOnesAndOfTheOnlyOne) {
    using Numbers = std::vector<double>;
    EXPECT_EQ(stiffnesses({"bearing[*].k=3"}), (Numbers{3, 3}));
    EXPECT_EQ(stiffnesses({"bearing[left].k=3"}), (Numbers{3, 2e6}));
    EXPECT_EQ(stiffnesses({"bearing[\"right end\"].k=3"}), (Numbers{1e6, 3}));
    EXPECT_EQ(load_text(base, {"bearing.k=5"}).rotor.bearings.at(0).rows.at(0).k(0, 0), 5);
    const std::string which = refusal(two_bearings, {"bearing.k=3"});
    EXPECT_NE(which.find("bearing[0].k, or all of them: bearing[*].k"), std::string::npos) << which;
}

TEST(Overrides, TakeEntriesAndItemsOut) {
    const model::Case without = load_text(two_bearings, {"bearing[1].c="});
    EXPECT_EQ(without.rotor.bearings.at(1).rows.at(0).c(0, 0), 0);
    EXPECT_EQ(without.rotor.bearings.at(1).rows.at(0).k(0, 0), 2e6);
    EXPECT_EQ(stiffnesses({"bearing[left]="}), std::vector<double>{2e6});
    EXPECT_TRUE(load_text(two_bearings, {"bearing="}).rotor.bearings.empty());
    const std::string nothing = refusal(base, {"bearing[0].c="});
    EXPECT_NE(nothing.find("there is no such entry"), std::string::npos) << nothing;
}

TEST(Overrides, MistakesAreNamedByTheOption) {
    const std::vector<std::pair<std::string, std::string>> mistakes{
        {"shaft.order=abc", "--set shaft.order=abc: shaft.order: expected a whole number"},
        {"shaft.ordr=3", "--set shaft.ordr=3: shaft.ordr: unknown key, did you mean \"order\"?"},
        {"shaft.order", "--set shaft.order: expected path.to.key=value"},
        {"=3", "--set =3: expected a path"},
        {"bearing[x].k=3", "bearing[x].k: expected the name of an item of bearing"},
        {"bearing[].k=3", "--set bearing[].k=3: expected a path"},
        {"bearing[0]k=3", "--set bearing[0]k=3: expected a path"},
        {"bearing[1].k=3", "bearing[1].k: expected an index below 1, got 1"},
        {"disc[0].z=3", "disc[0].z: expected a list of the case, there is no disc"},
        {"shaft[0].z=3", "shaft[0].z: expected a list at shaft, got a table"},
        {"bearings[0].z=3", "there is no bearings in the case, did you mean \"bearing\"?"},
        {"E=3", "E: unknown key, did you mean \"material.steel.E\"?"},
        {"material.E=3", "material.E: expected a table, got 3, did you mean \"material.steel.E\"?"},
        {"imbalance=[{z = 0, mr = \"50 gmm\"}]",
         "expected an imbalance in kg m, got \"50 gmm\", did you mean \"50 g mm\"?"},
        {"format.x=3", "format.x: expected a table at format, got 1"},
        {"bearing[0].z=7", "--set bearing[0].z=7: bearing[0].z: expected a place on the shaft"},
        {"speeds.from=1\nto=2", "speeds.from: expected an angular speed in rad/s"}};
    for (const auto &[option, start] : mistakes) {
        const std::string message = refusal(base, {option});
        EXPECT_NE(message.find(start), std::string::npos) << message;
        EXPECT_EQ(message.find('\n', message.find(": ")), std::string::npos) << message;
    }
    // The unit fits, the number does not.
    const std::string negative = refusal(base, {"bearing[0].c=-1.5 kN s/m"});
    EXPECT_NE(negative.find("0 or more, got \"-1.5 kN s/m\""), std::string::npos) << negative;
    EXPECT_EQ(negative.find("did you mean"), std::string::npos) << negative;
}

} // namespace
} // namespace whirl::tests
