// A mode has one name in every command: campbell, modes, critical and response of each case agree
// (docs/conventions.md, Names of modes).

#include "program_run.h"
#include "support/case_names.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <unistd.h>
#include <vector>

namespace {

using nlohmann::json;

/// The result of a command, of one run for all who ask; null where the case does not have what it
/// needs.
const json &result_of(const std::string &command, const std::string &name,
                      const std::vector<std::string> &settings = {}) {
    std::vector<std::string> arguments{command, WHIRL_ROOT "/cases/" + name, "--quiet", "--json"};
    for (const std::string &setting : settings)
        arguments.insert(arguments.end(), {"--set", setting});
    static std::map<std::vector<std::string>, json> results;
    if (const auto known = results.find(arguments); known != results.end())
        return known->second;
    const std::string errors = testing::TempDir() + "whirl_names_" + std::to_string(getpid());
    const auto run = whirl::tests::run_program(WHIRL_PROGRAM, arguments, errors);
    std::remove(errors.c_str());
    return results[arguments] = run.status == 0 ? json::parse(run.output) : json();
}

std::string text_of_case(const std::string &name) {
    std::ostringstream text;
    text << std::ifstream(WHIRL_ROOT "/cases/" + name + "/case.toml").rdbuf();
    return text.str();
}

/// Cases with a range of speeds, without those whose diagram takes several seconds.
std::vector<std::string> cases_with_range() {
    const std::set<std::string> slow{"excess_planes", "extractor_two_plane",
                                     "speed_dependent_bearings"};
    const std::set<std::string> without{
        "blade_loss",      "partitioned_race",   "rodrigues_rig", "rodrigues_two_plane",
        "sweep_two_balls", "uncertain_jeffcott", "weights_fan"};
    std::vector<std::string> out;
    for (const std::string &name : whirl::tests::case_names())
        if (slow.count(name) + without.count(name) == 0)
            out.push_back(name);
    return out;
}

bool has_balancers(const std::string &name) {
    return text_of_case(name).find("[[balancer]]") != std::string::npos;
}

std::complex<double> value_of(const json &real, const json &frequency) {
    return {real.get<double>(), frequency.get<double>()};
}

/// The line of a label; null where there is none.
json line_of(const json &campbell, const json &label) {
    for (const json &line : campbell.at("modes"))
        if (line.at("label") == label)
            return line;
    return {};
}

/// Lines of the diagram that are there at all its speeds.
bool is_whole(const json &line) {
    const json &frequency = line.at("frequency");
    return std::none_of(frequency.begin(), frequency.end(),
                        [](const json &value) { return value.is_null(); });
}

class ModeNames : public testing::TestWithParam<std::string> {};

/// Without damping a critical speed is a crossing of the line of its name with 1x; with damping
/// the crossing of that line is the next one, by speed and damping.
TEST_P(ModeNames, of_critical_speeds_are_those_of_crossings) {
    const json critical = result_of("critical", GetParam());
    const json campbell = result_of("campbell", GetParam());
    if (critical.is_null())
        return; // not defined for this rotor
    ASSERT_FALSE(campbell.is_null());
    const bool quick =
        campbell.at("formulation").at("frame") == "fixed" && !has_balancers(GetParam());
    const double from = campbell.at("speeds").front();
    const double to = campbell.at("speeds").back();
    for (const json &speed : critical.at("critical_speeds")) {
        const double omega = speed.at("speed");
        // Of equations periodic in time they are crossings, and have the names of the lines.
        if (!quick && campbell.at("formulation").at("form") != "hill") {
            EXPECT_TRUE(speed.at("mode").is_null()) << omega;
        }
        if (omega < from || omega > to || omega == 0 || speed.at("mode").is_null())
            continue;
        const std::complex<double> value(speed.at("real"), omega);
        double own = INFINITY;
        double other = INFINITY;
        for (const json &crossing : campbell.at("crossings")) {
            if (crossing.at("multiple") != 1)
                continue;
            const double at = crossing.at("speed");
            const double ratio = crossing.at("damping_ratio").is_null()
                                     ? 0.0
                                     : crossing.at("damping_ratio").get<double>();
            const std::complex<double> there(-ratio / std::sqrt(1 - ratio * ratio) * at, at);
            const json &label =
                campbell.at("modes").at(crossing.at("mode").get<std::size_t>()).at("label");
            double &least = label == speed.at("mode") ? own : other;
            least = std::min(least, std::abs(there - value));
        }
        if (value.real() == 0) {
            EXPECT_LE(own, 1e-6 * omega) << speed.at("mode") << " at " << omega;
        } else if (!speed.at("heavily_damped").get<bool>()) {
            // Of lines that cross at the same speed (1B and 1F of a disc that does not tilt) none
            // is nearer but for rounding.
            EXPECT_LE(own, other + 1e-14 * omega) << speed.at("mode") << " at " << omega;
        }
    }
}

/// At a speed of the diagram each mode has the name of the line with its eigenvalue.
TEST_P(ModeNames, of_modes_at_a_speed_are_those_of_lines) {
    const json campbell = result_of("campbell", GetParam(), {"speeds.count=11"});
    ASSERT_FALSE(campbell.is_null());
    for (const std::size_t k : {3U, 10U}) {
        const double speed = campbell.at("speeds").at(k);
        std::ostringstream setting;
        setting.precision(17);
        setting << "modes.speed=" << speed;
        const json modes = result_of("modes", GetParam(), {"speeds.count=11", setting.str()});
        ASSERT_FALSE(modes.is_null());
        EXPECT_TRUE(modes.at("critical_modes").empty());
        std::set<std::string> named;
        for (const json &mode : modes.at("modes")) {
            if (mode.at("label").is_null())
                continue;
            named.insert(mode.at("label").get<std::string>());
            const json line = line_of(campbell, mode.at("label"));
            ASSERT_FALSE(line.is_null()) << mode.at("label") << " at " << speed;
            ASSERT_FALSE(line.at("frequency").at(k).is_null()) << mode.at("label");
            const auto expected = value_of(line.at("real").at(k), line.at("frequency").at(k));
            const auto found = value_of(mode.at("real"), mode.at("frequency"));
            // Both are the solver's, from other numbers of modes: its rounding.
            EXPECT_LE(std::abs(found - expected), 1e-8 * std::abs(expected) + 1e-7)
                << mode.at("label") << " at " << speed;
        }
        if (has_balancers(GetParam()) || modes.at("formulation").at("frame") == "hill")
            continue;
        EXPECT_FALSE(named.empty());
        const double highest = modes.at("modes").back().at("frequency");
        for (const json &line : campbell.at("modes"))
            if (is_whole(line) && line.at("frequency").at(k) < (1 - 1e-9) * highest)
                EXPECT_EQ(named.count(line.at("label").get<std::string>()), 1U)
                    << line.at("label") << " at " << speed;
    }
}

/// A peak has the name of the mode nearest to resonance at its speed, of `modes` there.
TEST_P(ModeNames, of_peaks_are_those_of_modes_there) {
    const json response = result_of("response", GetParam());
    if (response.is_null())
        return; // nothing drives it
    std::set<std::string> seen;
    for (const json &peak : response.at("peaks")) {
        if (peak.at("mode").is_null() || !seen.insert(peak.at("mode").get<std::string>()).second)
            continue;
        const double speed = peak.at("speed");
        std::ostringstream setting;
        setting.precision(17);
        setting << "modes.speed=" << speed;
        const json modes = result_of("modes", GetParam(), {setting.str()});
        const bool planar = modes.at("formulation").at("unknowns") == "planar";
        std::optional<std::pair<double, json>> best;
        for (const json &mode : modes.at("modes")) {
            const double away = std::abs(value_of(mode.at("real"), mode.at("frequency")) -
                                         std::complex<double>(0, speed));
            if ((!planar || mode.at("whirl") == "forward") && (!best || away < best->first))
                best = {away, mode.at("label")};
        }
        ASSERT_TRUE(best);
        EXPECT_EQ(peak.at("mode"), best->second) << "at " << speed;
    }
}

/// Lines have the same names over 11 and over 101 speeds.
TEST_P(ModeNames, do_not_depend_on_the_number_of_speeds) {
    if (has_balancers(GetParam()))
        return; // lines of balls come and go between speeds that lie far apart
    const json few = result_of("campbell", GetParam(), {"speeds.count=11"});
    const json many = result_of("campbell", GetParam(), {"speeds.count=101"});
    for (const json &line : few.at("modes")) {
        const json same = line_of(many, line.at("label"));
        ASSERT_FALSE(same.is_null()) << line.at("label");
        for (std::size_t k = 0; k < 11; ++k) {
            const json &a = line.at("frequency").at(k);
            const json &b = same.at("frequency").at(10 * k);
            if (a.is_null() || b.is_null())
                continue;
            EXPECT_NEAR(a.get<double>(), b.get<double>(), 1e-8 * b.get<double>() + 1e-7)
                << line.at("label") << " at speed " << k;
        }
    }
}

/// Rotors whose damping depends on the speed, by bearings that couple x and y and by damping that
/// turns with the shaft on bearings of both kinds.
class EndsOfCases
    : public testing::TestWithParam<std::pair<std::string, std::vector<std::string>>> {};

/// The mode of an end is the one that neither grows nor dies out there, by `modes` at that speed;
/// its line in the diagram grows on the side on which more motions do.
TEST_P(EndsOfCases, are_those_of_modes_on_the_axis) {
    const std::string &name = GetParam().first;
    const std::vector<std::string> &settings = GetParam().second;
    const json stability = result_of("stability", name, settings);
    ASSERT_FALSE(stability.is_null());
    ASSERT_FALSE(stability.at("ends").empty());
    for (const json &end : stability.at("ends")) {
        ASSERT_EQ(end.at("kind"), "pair");
        const double speed = end.at("speed");
        const auto at = [&](double spin) {
            std::ostringstream setting;
            setting.precision(17);
            setting << "modes.speed=" << spin;
            std::vector<std::string> all = settings;
            all.push_back(setting.str());
            return result_of("modes", name, all);
        };
        std::optional<std::pair<double, json>> best;
        const json there = at(speed);
        for (const json &mode : there.at("modes")) {
            const double off =
                std::abs(mode.at("real").get<double>() / mode.at("frequency").get<double>());
            if (!best || off < best->first)
                best = {off, mode.at("label")};
        }
        ASSERT_TRUE(best);
        EXPECT_LE(best->first, 1e-7); // an end is a root to 1e-8 of the speed
        EXPECT_FALSE(end.at("mode").is_null()) << "at " << speed;
        EXPECT_EQ(end.at("mode"), best->second) << "at " << speed;
        const bool grows_above = end.at("growing_above") > end.at("growing_below");
        for (const double side : {-1.0, 1.0}) {
            const json beside = at(speed * (1 + side * 1e-3));
            for (const json &mode : beside.at("modes"))
                if (mode.at("label") == end.at("mode"))
                    EXPECT_EQ(mode.at("real") > 0, grows_above == (side > 0)) << speed;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(
    Cases, EndsOfCases,
    testing::Values(std::pair{std::string("overhung_cross_coupled"), std::vector<std::string>{}},
                    std::pair{std::string("friswell_taper"),
                              std::vector<std::string>{"shaft.internal_damping=2e-4"}},
                    std::pair{std::string("friswell_5_9_1"),
                              std::vector<std::string>{"shaft.internal_damping=2e-4",
                                                       "campbell.modes=4"}}),
    [](const auto &test) { return test.param.first; });

// Names are counted from the lowest lines on. Of twelve most are damped beyond whirling somewhere.
TEST(EndNames, do_not_depend_on_how_many_lines_the_diagram_has) {
    const auto names = [](const std::string &modes) {
        std::vector<json> out;
        const json all = result_of("stability", "friswell_5_9_1",
                                   {"shaft.internal_damping=2e-4", "campbell.modes=" + modes});
        for (const json &end : all.at("ends"))
            out.push_back(end.at("mode"));
        return out;
    };
    const std::vector<json> few = names("4");
    EXPECT_EQ(few, (std::vector<json>{"1F", "2F"}));
    EXPECT_EQ(names("12"), few);
}

INSTANTIATE_TEST_SUITE_P(Cases, ModeNames, testing::ValuesIn(cases_with_range()),
                         [](const auto &test) { return test.param; });

} // namespace
