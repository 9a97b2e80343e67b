#include "input/file_text.h"
#include "input/size.h"
#include "scratch_case.h"

#include <sys/stat.h>

#include <fstream>
#include <thread>

namespace whirl::tests::size_test {
namespace {

const std::string long_shaft =
    sound_case + "elements = 10000\n[[bearing]]\nz = 0\nk = 1e7\n[[bearing]]\nz = 1\nk = 1e7\n"
                 "[speeds]\nfrom = 100\ncount = 1\n";

/// Peaks of memory that runs on this rotor had (GNU time, MB), without the 50 MB of any run: the
/// estimate is what they take at least, and not much less.
TEST(Sizes, MemoryIsBelowThatOfMeasuredRuns) {
    struct Measured {
        const char *command;
        int elements, order;
        double peak;
    };
    const std::vector<Measured> runs{
        {"show", 10000, 1, 166},      {"campbell", 10000, 1, 486},  {"show", 10000, 4, 1180},
        {"campbell", 10000, 4, 1196}, {"show", 10000, 10, 4776},    {"campbell", 10000, 10, 3635},
        {"show", 40000, 1, 648},      {"campbell", 40000, 1, 1947}, {"show", 40000, 4, 4494},
        {"campbell", 40000, 4, 4710}, {"critical", 4000, 1, 147},   {"critical", 4000, 4, 351},
        {"response", 4000, 1, 49},    {"response", 4000, 4, 176},   {"modes", 4000, 1, 33},
        {"modes", 4000, 4, 203},      {"stability", 4000, 1, 17},   {"stability", 4000, 4, 137}};
    for (const auto &[command, elements, order, peak] : runs) {
        const model::Case scene =
            load_text(long_shaft, {"shaft.elements=" + std::to_string(elements),
                                   "shaft.order=" + std::to_string(order)});
        const double estimate = input::least_memory(scene, command) / 1e6;
        EXPECT_LE(estimate, 1.15 * peak) << command << " of order " << order;
        EXPECT_GE(estimate, 0.6 * peak) << command << " of order " << order;
    }
}

std::string refused(const std::string &text, const std::vector<std::string> &overrides,
                    const std::string &command, double gigabytes) {
    try {
        const model::Case scene = load_text(text, overrides);
        input::refuse_too_large(scene, command, gigabytes * 1e9,
                                input::CaseFile(scratch_folder()).tree(overrides));
    } catch (const model::BadInput &error) {
        return error.what();
    }
    return "";
}

TEST(Sizes, WhatDoesNotFitIsRefusedWithItsNumbers) {
    EXPECT_EQ(refused(long_shaft, {"shaft.elements=40000"}, "campbell", 8), "");
    EXPECT_EQ(refused(long_shaft, {"shaft.elements=1000000", "shaft.rigid=true"}, "campbell", 8),
              "");
    const std::string shaft = refused(long_shaft, {"shaft.elements=1000000"}, "campbell", 8);
    for (const char *part :
         {"--set shaft.elements=1000000: shaft.elements: ", "memory of this machine, 8 GB",
          "1000000 elements of order 4", "campbell takes 120 GB or more"})
        EXPECT_NE(shaft.find(part), std::string::npos) << shaft;
    const std::string file = (scratch_folder() / "case.toml").generic_string();
    const std::string own = "[shaft]\norder = 8\nsegments = [{length = 1, outer = 0.1},\n"
                            "{length = 1, outer = 0.1, elements = 1000000}]\n";
    const std::string all = "[shaft]\norder = 8\nsegments = [{length = 1, outer = 0.1}]\n";
    for (const auto &[text, place] :
         {std::pair(sound_material + own, ":9: shaft.segments[1].elements: expected what fits"),
          std::pair(sound_material + all + "elements = 1000000\n",
                    ":9: shaft.elements: expected ")})
        EXPECT_TRUE(refused(text, {}, "critical", 8).starts_with(file + place))
            << refused(text, {}, "critical", 8);
    const std::string speeds =
        refused(long_shaft,
                {"shaft.elements=1", "speeds.to=200", "speeds.count=1000000", "campbell.modes=500"},
                "campbell", 8);
    EXPECT_NE(speeds.find("speeds.count: "), std::string::npos) << speeds;
    EXPECT_NE(speeds.find("1000000 speeds with 500 modes each"), std::string::npos) << speeds;
    std::string pairs;
    for (int i = 0; i < 500; ++i)
        pairs += "{from = 0, to = 0.5}, ";
    const std::string frequencies =
        refused(long_shaft,
                {"shaft.elements=1", "response.receptance=[" + pairs + "]",
                 "response.frequencies={to = 200, count = 1000000}"},
                "response", 8);
    EXPECT_NE(frequencies.find("response.frequencies.count: "), std::string::npos) << frequencies;
    EXPECT_NE(frequencies.find("1000000 frequencies of 500 receptances"), std::string::npos)
        << frequencies;
}

TEST(Sizes, CountsThatNoMachineGoesThroughAreRefused) {
    std::string discs = sound_case;
    for (int i = 0; i < 10001; ++i)
        discs += "[[disc]]\nz = 0.5\nmass = 1\n";
    EXPECT_NE(refusal(discs).find("disc: expected up to 10000 places on the shaft where something "
                                  "is attached, got 10001"),
              std::string::npos);
    const std::string axes = "[map]\nx = {path = \"speed\", from = 0, to = 1, count = 100000}\n"
                             "y = {path = \"bearing[0].k\", from = 1, to = 2, count = 100000}\n";
    EXPECT_NE(refusal(long_shaft + axes).find("got 100000 times 100000 = 10000000000"),
              std::string::npos);
    const std::string balls = long_shaft + "[[balancer]]\nz = 0.5\nmass = 0.1\nradius = 0.1\n";
    EXPECT_NE(refusal(balls + "n = 1000000000\n").find("from 1 to 10000, got 1000000000"),
              std::string::npos);
    EXPECT_NE(refusal(balls, {"balancer[0].mass=", "balancer[0].radius=",
                              "balancer[0].rows=[{n = 9000, mass = 1, radius = 1}, {n = 9000, mass "
                              "= 1, radius = 1}]"})
                  .find("balls in all rows together, got 18000"),
              std::string::npos);
}

TEST(Sizes, SplinesThroughTooManyRowsAreRefusedAtOnce) {
    std::string table = "speed [rad/s],k\n";
    for (int i = 0; i < 30000; ++i)
        table += std::to_string(i) + ",1e6\n";
    try {
        (void)load_text(sound_case + "[[bearing]]\nz = 0\ninterpolation = \"spline\"\n"
                                     "table = \"t.csv\"\n",
                        {}, {{"t.csv", table}});
        ADD_FAILURE() << "accepted";
    } catch (const model::BadInput &error) {
        EXPECT_NE(std::string(error.what()).find("use interpolation = \"linear\""),
                  std::string::npos)
            << error.what();
    }
}

/// Deeper ones, in every way in which a document or an override can be.
TEST(Depth, IsBounded) {
    const auto times = [](int count, const std::string &text) {
        std::string out;
        for (int i = 0; i < count; ++i)
            out += text;
        return out;
    };
    constexpr int many = 20000;
    const std::string expected = "expected keys and lists within one another up to 60 deep";
    for (const std::string &text :
         {times(many, "a.") + "a = 1\n", "[" + times(many, "a.") + "a]\n",
          "[[" + times(many, "a.") + "a]]\n", "a = " + times(many, "[") + times(many, "]"),
          "a = " + times(many, "{a = ") + "1" + times(many, "}"),
          "a = " + times(50, "{a.a.a.a = ") + "1" + times(50, "}"),
          "b = \"\"\"\n.....\n\"\"\"\nc = '[[['\na = " + times(many, "[")}) {
        const std::string said = refusal(sound_case + text);
        EXPECT_NE(said.find(expected), std::string::npos) << said.substr(0, 300);
    }
    EXPECT_NE(refusal(sound_case, {"shaft.order=" + times(many, "[")}).find(expected),
              std::string::npos);
    EXPECT_NE(refusal(sound_case, {times(many, "a.") + "a=1"}).find("expected a path such as"),
              std::string::npos);
    EXPECT_NE(
        refusal(sound_case, {"a" + times(many, "[0]") + "=1"}).find("expected a path such as"),
        std::string::npos);
    // Points and brackets in texts and comments are none.
    EXPECT_EQ(
        load_text("title = \"" + times(100, "[.") + "\" # " + times(100, "[.") + "\n" + sound_case)
            .title.size(),
        200U);
}

TEST(Mistakes, BeyondAThousandAreCounted) {
    std::string text = sound_case;
    for (int i = 0; i < 1200; ++i)
        text += "key" + std::to_string(i) + " = 1\n";
    const std::string said = refusal(text);
    EXPECT_NE(said.find("\nand 200 more"), std::string::npos) << said.substr(said.size() - 100);
}

/// A pipe gives what it holds once: the case, its text and every variant come from one reading.
TEST(CaseFiles, AreReadOnce) {
    const std::filesystem::path folder = scratch_folder();
    write_case(folder, {"", 0, "", "", "", {}});
    const std::filesystem::path pipe = folder / "pipe.toml";
    const std::filesystem::path table = folder / "table.csv";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    ASSERT_EQ(::mkfifo(table.c_str(), 0600), 0);
    const std::string text = sound_case + "[[bearing]]\nz = 0\ntable = \"table.csv\"\n";
    std::thread writer([&] {
        std::ofstream(pipe) << text;
        std::ofstream(table) << "speed [rpm],k\n0,1e6\n600,2e6\n";
    });
    const input::CaseFile file(pipe);
    const model::Case scene = file.load();
    writer.join();
    const model::Case other = file.load({"shaft.order=7"});
    EXPECT_EQ(scene.rotor.shaft.order, 4);
    EXPECT_EQ(other.rotor.shaft.order, 7);
    EXPECT_EQ(other.rotor.bearings.at(0).speeds, scene.rotor.bearings.at(0).speeds);
    EXPECT_EQ(file.text(), text);
    EXPECT_EQ(scene.name, "pipe");
    EXPECT_EQ(file.with_place("bearing[0].table: wrong", {}),
              pipe.generic_string() + ":10: bearing[0].table: wrong");
    EXPECT_EQ(file.with_place("bearing[0].kxx: wrong", {}),
              pipe.generic_string() + ":8: bearing[0].kxx: wrong");
    EXPECT_EQ(file.with_place("the rotor is wrong", {}),
              pipe.generic_string() + ": the rotor is wrong");
}

TEST(CaseFiles, AreTextOfAllKinds) {
    const std::filesystem::path file = scratch_folder() / "case.toml";
    write_case(scratch_folder(), {"", 0, "", "", "", {}});
    const auto put = [&](const std::string &bytes) {
        std::ofstream(file, std::ios::binary) << bytes;
    };
    std::string wide = "\xFF\xFE";
    for (const char c : sound_case)
        wide += {c, '\0'};
    for (const std::string &bytes : {sound_case, "\xEF\xBB\xBF" + sound_case, wide}) {
        put(bytes);
        EXPECT_EQ(input::load_case(file).rotor.shaft.length(), 1.0);
    }
    put("PK\x03\x04 xl/workbook.xml");
    try {
        (void)input::load_case(file);
        ADD_FAILURE() << "accepted";
    } catch (const model::BadInput &error) {
        EXPECT_NE(std::string(error.what()).find("an Excel workbook"), std::string::npos);
    }
}

} // namespace
} // namespace whirl::tests::size_test
