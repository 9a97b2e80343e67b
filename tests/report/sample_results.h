#pragma once

#include "model/case.h"
#include "report/common/files.h"
#include "report/reports.h"
#include "results/campbell.h"
#include "results/formulation.h"
#include "results/modes.h"
#include "results/whirl.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace whirl::report {

/// A title with everything that could break a script, a page or a table.
inline const std::string wicked_title = "it's <b>\"odd\"</b> & {a_b^2} `touch x` $(y), @z\nend";

inline model::Case sample_case() {
    model::Case scene;
    scene.name = "sample";
    scene.title = wicked_title;
    model::Segment segment;
    segment.length = 1.5;
    segment.outer_start = segment.outer_end = 0.05;
    scene.rotor.shaft.segments = {segment};
    scene.rotor.discs = {model::disc_from_geometry(0.5, 0.28, 0.05, 0.07, 7810)};
    model::Bearing bearing;
    bearing.rows.resize(1);
    bearing.rows[0].k = 1e6 * Eigen::Matrix2d::Identity();
    scene.rotor.bearings = {bearing, bearing};
    scene.rotor.bearings[1].z = 1.5;
    return scene;
}

/// Two modes at three speeds; the second has no frequency at the second speed, a real part that is
/// not a number and grows at the third.
inline results::CampbellResult sample_campbell() {
    using results::Whirl;
    results::CampbellResult result;
    result.model = {{results::Form::planar, "isotropic & undamped"}, 4, 6, 50, 0.01, {"a note"}};
    result.speeds = {0, 100, 200};
    result.modes.resize(2);
    result.modes[0] = {"1B",
                       {85.389371234123, 80., 75.},
                       {"", "", ""},
                       {0., 0., 0.},
                       {0., 0., 0.},
                       {0., 0., 0.},
                       {Whirl::mixed, Whirl::backward, Whirl::backward},
                       {0.5, 0., 0.},
                       {1e-12, 1e-12, 1e-12},
                       {1e-15, 1e-15, 1e-15},
                       {}};
    result.modes[1] = {"1F",
                       {90., std::nullopt, 110.},
                       {"", "overdamped", ""},
                       {-1., std::numeric_limits<double>::quiet_NaN(), 2.},
                       {0.1, std::nullopt, -0.02},
                       {0.6, std::nullopt, -0.1},
                       {Whirl::forward, Whirl::forward, Whirl::forward},
                       {1., 1., 1.},
                       {1e-12, std::nullopt, std::numeric_limits<double>::infinity()},
                       {1e-15, 1e-15, 1e-15},
                       {}};
    result.modes[0].error_parts.resize(3);
    result.modes[1].error_parts = {std::nullopt, std::nullopt, results::ErrorParts{0.5, 0, 0.25}};
    result.crossings = {{1, 82.5, 82.5, 0, results::damping_of({-33, 82.5})}};
    result.locked = {{1, 1, 90, 110}};
    return result;
}

inline results::ModesResult sample_modes() {
    const std::complex<double> i(0, 1);
    results::ModesResult result;
    result.speed = 100;
    result.z = {0, 0.75, 1.5};
    result.modes.resize(2);
    result.modes[0] = {
        "1B", 100, {0, 80}, results::Whirl::backward, 0, {0.3, 1., 0.3}, {0.3 * i, i, 0.3 * i}, {}};
    result.modes[1] = {"1F",
                       100,
                       {-2, 90},
                       results::Whirl::forward,
                       1,
                       {0.3, 1., 0.3},
                       {-0.3 * i, -i, -0.3 * i},
                       {{"bearing", 0, "left", 0.75}, {"internal damping", {}, "", 0.25}}};
    return result;
}

template <class Result>
Files write_report(const model::Case &scene, const Result &result,
                   const std::filesystem::path &folder) {
    return write_report(describe(scene, result), folder);
}
template <class Result> std::string to_json(const model::Case &scene, const Result &result) {
    return to_json(describe(scene, result));
}
template <class Result>
std::string to_html(const model::Case &scene, const Result &result, const std::string &still) {
    return to_html(describe(scene, result), still);
}
template <class Result> std::string to_csv(const Result &result) {
    const model::Case scene;
    return describe(scene, result).csv({});
}

/// Lines of a text, the last one with or without its end.
inline std::vector<std::string> lines_of(const std::string &text) {
    std::vector<std::string> out;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
        out.push_back(line);
    return out;
}

/// A folder of a test's own, removed with everything in it.
class ScratchFolder : public testing::Test {
  protected:
    ScratchFolder()
        : folder(std::filesystem::temp_directory_path() /
                 ("whirl_report_" + std::to_string(getpid()) + "_" +
                  testing::UnitTest::GetInstance()->current_test_info()->name())) {
        std::filesystem::create_directories(folder);
    }
    ~ScratchFolder() override {
        std::error_code ignored;
        std::filesystem::remove_all(folder, ignored);
    }
    std::filesystem::path folder;
};

} // namespace whirl::report
