// Draws every picture of every case of cases/ by every command that fits it, and checks that no
// text leaves the frame and no two lie on each other.

#include "program_run.h"
#include "support/case_names.h"
#include "support/svg_texts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <unistd.h>

namespace {

namespace fs = std::filesystem;

std::string content_of(const fs::path &path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

std::size_t count(const std::string &text, const std::string &part) {
    std::size_t number = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++number;
    return number;
}

/// A command line behind the case, without what every run has.
struct Drawn {
    std::string command;
    std::vector<std::string> more{};
    bool every_case = false; ///< there is no case that it does not fit
};

/// What there is to draw of a case: few speeds and points, for what is looked at is the layout.
std::vector<Drawn> drawn_of(const std::string &text) {
    const auto has = [&](const char *section) { return text.find(section) != std::string::npos; };
    if (!has("\n[shaft]"))
        return {{"weights", {}, true}};
    std::vector<std::string> few{"--set", "speeds.count=7"};
    if (has("\n[map]"))
        few.insert(few.end(), {"--set", "map.x.count=4", "--set", "map.y.count=4"});
    std::vector<std::string> placement = few;
    placement.insert(placement.end(), {"--map", "--set", "balance.balanced_position=false"});
    if (has("simulated ="))
        placement.insert(placement.end(), {"--set", "balance.simulated=0"});
    std::vector<Drawn> all{{"show", {}, true},
                           {"critical", {"--map", "--set", "critical_map.points=9"}}};
    for (const char *command : {"campbell", "stability", "response", "rigid-limit", "modes"})
        all.push_back({command, few});
    all.push_back({"balance", placement});
    std::erase(placement, "--map");
    placement.insert(placement.end(), {"--units", "mm-rpm"}); // the longest names of places
    all.push_back({"balance", placement});
    if (has("\n[simulate]"))
        all.push_back({"simulate", {"--set", "speeds.count=1"}});
    if (has("\n[samples]"))
        all.push_back({"samples", {"--set", "samples.count=12"}});
    if (has("\n[sweep]"))
        all.push_back({"sweep", {}});
    if (has("\n[operation]")) { // the longest numbers
        all.push_back({"response", {"--set", "speeds.count=7", "--units", "us"}});
        all.push_back({"response", {"--set", "speeds.count=3", "--set", "response.gravity=9.81"}});
    }
    return all;
}

class CasePictures : public testing::TestWithParam<std::string> {
  protected:
    const fs::path scene = fs::path(WHIRL_ROOT) / "cases" / GetParam();
    const fs::path scratch =
        testing::TempDir() + "whirl_pictures_" + GetParam() + "_" + std::to_string(getpid());

    void TearDown() override { fs::remove_all(scratch); }

    /// @returns the exit status
    int run(const std::vector<std::string> &arguments) {
        fs::create_directories(scratch);
        const auto run =
            whirl::tests::run_program(WHIRL_PROGRAM, arguments, (scratch / "errors").string());
        errors = run.errors;
        return run.status;
    }
    /// Checks every picture of a folder. @returns how many there are
    static int check(const fs::path &folder, const std::string &what) {
        int pictures = 0;
        for (const auto &file : fs::directory_iterator(folder)) {
            if (file.path().extension() != ".svg")
                continue;
            ++pictures;
            const std::string svg = content_of(file.path());
            for (const std::string &fault : whirl::tests::layout_faults(svg))
                ADD_FAILURE() << what << ", " << file.path().filename().string() << ": " << fault;
            // gnuplot leaves out the name of an axis that has no room beside its numbers.
            if (what == "campbell")
                EXPECT_EQ(count(svg, "Whirl frequency (Hz)"),
                          count(svg, "Whirl frequency (cycles/min)"));
        }
        return pictures;
    }
    std::string errors;
};

TEST_P(CasePictures, HaveNoTextOutsideTheFrameNorOnAnother) {
    int number = 0;
    for (const Drawn &drawn : drawn_of(content_of(scene / "case.toml"))) {
        const fs::path folder = scratch / std::to_string(++number);
        std::vector<std::string> arguments{drawn.command, scene.string(), "--quiet", "--out",
                                           folder.string()};
        arguments.insert(arguments.end(), drawn.more.begin(), drawn.more.end());
        const int status = run(arguments);
        if (drawn.every_case) {
            EXPECT_EQ(status, 0) << drawn.command << ": " << errors;
        }
        if (status == 0) {
            EXPECT_GE(check(folder, drawn.command), 1) << drawn.command;
        } else {
            EXPECT_FALSE(errors.empty()) << drawn.command << " says why it does not fit";
        }
    }
    if (number > 0 && std::system("gnuplot --version > /dev/null 2>&1") != 0)
        GTEST_SKIP() << "gnuplot is not installed: only drawings were looked at";
}

TEST_P(CasePictures, OfAComparisonAreInOrderToo) {
    if (content_of(scene / "case.toml").find("\n[shaft]") == std::string::npos)
        GTEST_SKIP() << "readings alone: there is no order of elements to compare";
    const fs::path folder = scratch / "compare";
    // `critical` has no answer where rotor and bearings are both anisotropic; `show` always has.
    int done = 0;
    for (const char *command : {"critical", "show"})
        if (run({"compare", command, scene.string(), scene.string() + "@shaft.order=1", "--quiet",
                 "--out", folder.string()}) == 0) {
            ++done;
            check(folder, std::string("compare ") + command);
        }
    EXPECT_GE(done, 1) << errors;
}

INSTANTIATE_TEST_SUITE_P(Cases, CasePictures, testing::ValuesIn(whirl::tests::case_names()),
                         [](const auto &test) { return test.param; });

} // namespace
