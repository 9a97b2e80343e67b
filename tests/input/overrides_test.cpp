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

// Without y the steady states are followed over x: at one speed, and over an entry.
TEST(EntryPaths, OfAMapAloneAreForStates) {
    const auto with = [](const std::string &states, const std::string &path) {
        return two_bearings + "[[balancer]]\nz = 0.3\nmass = 0.1\nradius = 0.1\n" + states +
               "[map]\nx = {path = \"" + path + "\", from = 0.1, to = 9, count = 3}\n";
    };
    const std::string one = "[states]\nspeeds = [300]\n";
    const model::Case scene = load_text(with(one, "balancer[0].mass"));
    ASSERT_TRUE(scene.map);
    EXPECT_TRUE(scene.map->y.values.empty());
    EXPECT_NE(refusal(with("", "balancer[0].mass")).find("map.y: missing"), std::string::npos);
    EXPECT_NE(refusal(with("[states]\nspeeds = [300, 400]\n", "balancer[0].mass"))
                  .find("map.y: missing: without it the states are followed over x at one speed, "
                        "expected one in states.speeds, got 2"),
              std::string::npos);
    EXPECT_NE(refusal(with(one, "speed")).find("map.x: expected an entry of the case"),
              std::string::npos);
    EXPECT_NE(refusal(with(one, "states.speeds[0]")).find("map.x: expected an entry of the rotor"),
              std::string::npos);
}

/// [map] and [samples] name entries in the words of --set: what one override sets, they may vary.
TEST(EntryPaths, OfMapsAndSamplesAreThoseOfOverrides) {
    const std::string balancers = two_bearings +
                                  "[[balancer]]\nz = 0.3\nmass = 0.1\nradius = 0.1\n"
                                  "[[balancer]]\nz = 0.6\nmass = 0.1\nradius = 0.1\n";
    const auto with = [&](const std::string &path, const std::string &to) {
        return balancers +
               "[map]\nx = {path = \"speed\", from = 0, to = 9, count = 3}\ny = {path = '" + path +
               "', from = 0, to = \"" + to + "\", count = 3}\n[samples]\ncount = 3\n" +
               "vary = [{path = '" + path + "', distribution = \"uniform\", from = 0, to = \"" +
               to + "\"}]\n";
    };
    struct Entry {
        const char *path, *to;
        double value; ///< of `to` in SI
    };
    const std::vector<Entry> entries{{"balancer[*].mass", "50 g", 0.05},
                                     {"bearing[left].k", "2 kN/mm", 2e6},
                                     {"bearing[\"right end\"].k", "2 kN/mm", 2e6},
                                     {"material.steel.E", "200 GPa", 2e11},
                                     {"shaft.segments.outer", "20 mm", 0.02},
                                     {"shaft.segments[0].outer", "20 mm", 0.02},
                                     // entries that the case leaves at their defaults
                                     {"bearing[0].c", "3 N s/mm", 3e3},
                                     {"bearing[*].clearance", "20 um", 2e-5},
                                     {"shaft.internal_damping", "2 ms", 2e-3},
                                     {"balancer[*].damping", "3 N s/m", 3}};
    for (const auto &[path, to, value] : entries) {
        const model::Case scene = load_text(with(path, to));
        ASSERT_TRUE(scene.map && scene.samples) << path;
        EXPECT_EQ(scene.map->y.label, path);
        EXPECT_EQ(scene.map->y.values.back(), value) << path;
        EXPECT_EQ(scene.samples->vary.at(0).to, value) << path;
        // and an override sets it
        EXPECT_NO_THROW((void)load_text(with(path, to), {std::string(path) + "=1e-3"})) << path;
    }
    for (const char *path :
         {"bearing.k", "bearing[7].k", "bearing[middle].k", "bearing[0].q", "bearing[0].name",
          "bearing", "bearing[0]", "map.x.count", "samples.count", "nothing", "a..b", "format"}) {
        const std::string said = refusal(with(path, "1"));
        EXPECT_NE(said.find("map.y.path: expected \"speed\" or a numeric entry of the case, got"),
                  std::string::npos)
            << path << ": " << said;
        EXPECT_NE(said.find("samples.vary[0].path: expected a numeric entry of the case, got"),
                  std::string::npos)
            << path << ": " << said;
    }
}

TEST(EntryPaths, OfSamplesDoNotOverlap) {
    const auto with = [&](const std::string &vary) {
        return two_bearings + "[samples]\ncount = 3\nvary = [" + vary + "]\n";
    };
    const std::string all = "{path = \"bearing[*].k\", distribution = \"normal\", mean = 1e6, "
                            "deviation = 1e5}";
    EXPECT_EQ(load_text(with(all)).samples->vary.at(0).mean, 1e6);
    const std::string twice = refusal(
        with(all + ", {path = \"bearing[left].k\", distribution = \"values\", values = [1]}"));
    EXPECT_NE(twice.find("expected each entry once, got \"bearing[0].k\" twice"), std::string::npos)
        << twice;
    // Without a mean it is that of the case, where all have the same.
    const std::string relative = "{path = \"bearing[*].k\", distribution = \"normal\", relative = "
                                 "true, deviation = 0.1}";
    const std::string differ = refusal(with(relative));
    EXPECT_NE(differ.find("samples.vary[0].mean: missing"), std::string::npos) << differ;
    EXPECT_EQ(load_text(with(relative), {"bearing[*].k=3e6"}).samples->vary.at(0).mean, 3e6);
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
