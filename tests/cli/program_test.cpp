// The program from outside: exit status, what goes to which stream, which files appear.

#include "cases/program_run.h"
#include "support/own_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <unistd.h>

namespace program_test {

namespace fs = std::filesystem;
using whirl::tests::ProgramRun;

const std::string rotor = std::string(WHIRL_ROOT) + "/cases/friswell_5_9_1";

/// Runs the program inside an empty folder of its own.
class Program : public whirl::tests::InOwnFolder {
  protected:
    [[nodiscard]] ProgramRun run(const std::vector<std::string> &arguments) const {
        return whirl::tests::run_program(WHIRL_PROGRAM, arguments, (folder / "errors").string());
    }
    [[nodiscard]] ProgramRun run_on(const std::string &processes,
                                    std::vector<std::string> arguments) const {
        std::vector<std::string> all{"--oversubscribe", "--allow-run-as-root", "-n", processes,
                                     WHIRL_PROGRAM};
        all.insert(all.end(), arguments.begin(), arguments.end());
        return whirl::tests::run_program("/usr/bin/mpirun", all, (folder / "errors").string());
    }
    [[nodiscard]] bool nothing_written() const { return fs::is_empty(folder / "here"); }
};

long lines(const std::string &text) { return std::count(text.begin(), text.end(), '\n'); }

bool contains(const std::string &text, const std::string &part) {
    return text.find(part) != std::string::npos;
}

const std::vector<std::string> few{"--set", "speeds.count=3"};

std::vector<std::string> with_few(std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), few.begin(), few.end());
    return arguments;
}

TEST_F(Program, HelpAndVersionGoToStandardOutput) {
    const ProgramRun help = run({"--help"});
    EXPECT_EQ(help.status, 0);
    for (const char *command :
         {"studio", "show", "campbell", "critical", "stability", "response", "balance",
          "rigid-limit", "simulate", "accuracy", "samples", "sweep", "modes", "weights", "report"})
        EXPECT_TRUE(contains(help.output, command)) << command;
    const ProgramRun of_command = run({"campbell", "--help"});
    EXPECT_EQ(of_command.status, 0);
    for (const char *option : {"CASE", "--out", "--json", "--set", "--quiet", "--version"})
        EXPECT_TRUE(contains(of_command.output, option)) << option;
    const ProgramRun version = run({"--version"});
    EXPECT_EQ(version.status, 0);
    EXPECT_EQ(version.output.substr(0, 6), "whirl ");
    EXPECT_EQ(lines(version.output), 1);
    EXPECT_EQ(run({"critical", "--version"}).output, version.output);
}

TEST_F(Program, SaysWhereAMapIsIdle) {
    const std::string note = "note: --map does nothing in campbell; it is of ";
    const ProgramRun idle = run(with_few({"campbell", rotor, "--map"}));
    EXPECT_EQ(idle.status, 0);
    EXPECT_TRUE(contains(idle.errors, note)) << idle.errors;
    EXPECT_FALSE(contains(run(with_few({"campbell", rotor})).errors, note));
}

TEST_F(Program, WrongArgumentsAreOneMessageAndStatusTwo) {
    const std::vector<std::pair<std::vector<std::string>, std::string>> mistakes{
        {{}, "a command is missing"},
        {{"cambpell", rotor},
         "unknown command \"cambpell\", did you mean \"campbell\"? The commands are report, "
         "studio"},
        {{"campbell"}, "a case folder or .toml file is missing"},
        {{"campbell", rotor, "--fast"}, "--fast"},
        {{"campbell", rotor, "--unit", "us"}, "did you mean \"--units\"?"},
        {{"campbell", rotor, "--units", "foo"},
         "--units foo: expected \"none\" or \"si\" or \"mm-rpm\" or \"us\", got \"foo\"; one "
         "unit alone: QUANTITY=UNIT"},
        {{"campbell", rotor, "--units", "speed=lb"}, "--units speed=lb: expected the unit of an "},
        {{"campbell", rotor, "second_case"}, "second_case"},
        {{"campbell", rotor, "--out"}, "--out"},
        {{"campbell", rotor, "--out", ""}, "--out"},
        {{"campbell", rotor, "--set"}, "--set"},
        {{"campbell", rotor, "--json=1"}, "--json takes no value, got \"1\""},
        {{"campbell", rotor, "--quiet=true"}, "--quiet takes no value, got \"true\""},
    };
    for (const auto &[arguments, expected] : mistakes) {
        const ProgramRun result = run(arguments);
        EXPECT_EQ(result.status, 2) << expected;
        EXPECT_EQ(result.output, "") << expected;
        EXPECT_EQ(lines(result.errors), 1) << result.errors;
        EXPECT_EQ(result.errors.substr(0, 7), "whirl: ") << result.errors;
        EXPECT_TRUE(contains(result.errors, expected)) << result.errors;
    }
    EXPECT_TRUE(nothing_written());
}

TEST_F(Program, BadCaseIsStatusTwoWithPlaceAndNothingWritten) {
    const ProgramRun missing = run({"campbell", "no_such_case"});
    EXPECT_EQ(missing.status, 2);
    EXPECT_TRUE(contains(missing.errors, "no_such_case")) << missing.errors;
    const ProgramRun bad = run({"campbell", rotor, "--set", "bearing[0].k=5 kg", "--json"});
    EXPECT_EQ(bad.status, 2);
    EXPECT_EQ(bad.output, "");
    EXPECT_TRUE(contains(bad.errors, "bearing[0].k")) << bad.errors;
    EXPECT_TRUE(contains(bad.errors, "5 kg")) << bad.errors;
    EXPECT_TRUE(nothing_written());
}

TEST_F(Program, SeveralOverridesAreAllUsed) {
    const ProgramRun result =
        run({"campbell", "--set", "speeds.count=2", "--set", "campbell.modes=4", rotor, "--json"});
    ASSERT_EQ(result.status, 0) << result.errors;
    const auto json = nlohmann::json::parse(result.output);
    EXPECT_EQ(json.at("speeds").size(), 2U);
    EXPECT_EQ(json.at("modes").size(), 4U);
}

TEST_F(Program, ModesAreThoseAtTheSpeedAsked) {
    const ProgramRun modes = run({"modes", rotor, "--json", "--speed", "3000 rpm"});
    ASSERT_EQ(modes.status, 0) << modes.errors;
    const nlohmann::json at = nlohmann::json::parse(modes.output);
    EXPECT_NEAR(at.at("speed"), 100 * std::numbers::pi, 1e-12 * 314);
    // The sweep of campbell from that speed on is another way to the same motions.
    const ProgramRun sweep = run({"campbell", rotor, "--json", "--set", "speeds.from=3000 rpm",
                                  "--set", "speeds.to=3100 rpm", "--set", "speeds.count=2"});
    ASSERT_EQ(sweep.status, 0) << sweep.errors;
    const nlohmann::json over_speed = nlohmann::json::parse(sweep.output);
    std::vector<double> followed;
    for (const nlohmann::json &mode : over_speed.at("modes"))
        followed.push_back(mode.at("frequency").at(0));
    std::sort(followed.begin(), followed.end());
    ASSERT_GE(followed.size(), at.at("modes").size());
    for (std::size_t i = 0; i < at.at("modes").size(); ++i) // both solve to 1e-12
        EXPECT_NEAR(at.at("modes")[i].at("frequency").get<double>() / followed[i], 1, 1e-10);
}

TEST_F(Program, JsonAloneOnStandardOutputAndNoFiles) {
    for (const std::string command : {"show", "critical"}) {
        const ProgramRun result = run({command, rotor, "--json"});
        ASSERT_EQ(result.status, 0) << result.errors;
        EXPECT_EQ(result.errors, "");
        const auto json = nlohmann::json::parse(result.output);
        EXPECT_EQ(json.at("program"), "whirl");
        EXPECT_EQ(json.at("format"), 1);
        EXPECT_EQ(json.at("command"), command);
    }
    EXPECT_TRUE(nothing_written());
}

/// The case in a result is the case that was computed: run again it gives the same numbers.
TEST_F(Program, ResultHoldsTheCaseItWasComputedFrom) {
    const std::string drum = std::string(WHIRL_ROOT) + "/cases/extractor_two_plane";
    const std::vector<std::string> changes{"--set", "bearing[0].k=1.2345678901234567e6", "--set",
                                           "title=\"\\\"odd\\\" <title>\""};
    std::vector<std::string> arguments{"critical", drum, "--json"};
    arguments.insert(arguments.end(), changes.begin(), changes.end());
    const ProgramRun first = run(arguments);
    ASSERT_EQ(first.status, 0) << first.errors;
    const auto json = nlohmann::json::parse(first.output);
    const auto &from = json.at("provenance");
    EXPECT_EQ(from.at("version"), json.at("version"));
    const std::string date = from.at("date");
    EXPECT_EQ(date.size(), std::string("2026-03-01T12:00:00Z").size()) << date;
    EXPECT_EQ(date.back(), 'Z');
    std::ifstream file(drum + "/case.toml", std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    EXPECT_EQ(from.at("case"), text); // as it was written, with its comments
    EXPECT_EQ(from.at("set"), nlohmann::json({changes[1], changes[3]}));
    std::ofstream("again.toml") << from.at("case").get<std::string>();
    std::vector<std::string> repeated{"critical", "again.toml", "--json"};
    for (const nlohmann::json &entry : from.at("set"))
        repeated.insert(repeated.end(), {"--set", entry.get<std::string>()});
    const ProgramRun again = run(repeated);
    ASSERT_EQ(again.status, 0) << again.errors;
    const auto same = nlohmann::json::parse(again.output);
    EXPECT_EQ(same.at("critical_speeds"), json.at("critical_speeds")); // to the last digit
    EXPECT_EQ(same.at("title"), "\"odd\" <title>");
    const ProgramRun units = run({"show", drum, "--json", "--units", "us"});
    EXPECT_EQ(nlohmann::json::parse(units.output).at("provenance").at("case"), text);
}

TEST_F(Program, JsonWithOutGivesBothAndTheSame) {
    const ProgramRun result = run({"critical", rotor, "--json", "--out", "results"});
    ASSERT_EQ(result.status, 0) << result.errors;
    EXPECT_TRUE(fs::exists("results/critical.csv"));
    EXPECT_TRUE(fs::exists("results/report.html"));
    EXPECT_EQ(nlohmann::json::parse(result.output).at("command"), "critical");
    EXPECT_FALSE(fs::exists("out"));
}

TEST_F(Program, TextNamesFormulationPictureAndReport) {
    const ProgramRun result = run(with_few({"campbell", rotor}));
    ASSERT_EQ(result.status, 0) << result.errors;
    EXPECT_EQ(result.errors, "");
    for (const char *part :
         {"13.59", "815.4", "backward", "planar form", "out/friswell_5_9_1/campbell/report.html"})
        EXPECT_TRUE(contains(result.output, part)) << part << "\n" << result.output;
    EXPECT_FALSE(contains(result.output, "13.590")) << result.output;
    EXPECT_FALSE(contains(result.output, "error")) << result.output; // far below these digits
    const ProgramRun precise = run(with_few({"campbell", rotor, "--digits", "10", "--errors"}));
    for (const char *part : {"85.3893712", "error"})
        EXPECT_TRUE(contains(precise.output, part)) << part << "\n" << precise.output;
    EXPECT_EQ(run({"campbell", rotor, "--digits", "99"}).status, 2);
    EXPECT_TRUE(fs::exists("out/friswell_5_9_1/campbell/campbell.json"));
    const ProgramRun quiet = run({"critical", rotor, "--quiet"});
    EXPECT_EQ(quiet.status, 0);
    EXPECT_EQ(quiet.output, "");
    EXPECT_TRUE(fs::exists("out/friswell_5_9_1/critical/critical.csv"));
}

/// The answer fits on a terminal; --all is all there is.
TEST_F(Program, TextHasNoMoreThan25Lines) {
    const std::string compressor = std::string(WHIRL_ROOT) + "/cases/compressor_margins";
    for (const char *command : {"response", "critical", "stability", "campbell", "modes", "show"}) {
        const std::vector<std::string> asked{command, compressor, "--set", "speeds.count=7"};
        const ProgramRun result = run(asked);
        ASSERT_EQ(result.status, 0) << result.errors;
        EXPECT_LE(lines(result.output), 25) << result.output;
        EXPECT_TRUE(contains(result.output, "/report.html\n")) << result.output;
        std::vector<std::string> all = asked;
        all.emplace_back("--all");
        EXPECT_GE(lines(run(all).output), lines(result.output));
        EXPECT_FALSE(contains(run(all).output, "more rows"));
    }
}

TEST_F(Program, StationsWithoutNamesAreListedBesideNamedOnes) {
    // The only disc has no name, both bearings have one.
    const ProgramRun result =
        run(with_few({"response", std::string(WHIRL_ROOT) + "/cases/nelson_mcvaugh", "--all"}));
    ASSERT_EQ(result.status, 0) << result.errors;
    for (const char *station : {"\n  z = 0 m ", "\n  z = 0.0889 m ", "\n  left (z = 0.1651 m) "})
        EXPECT_TRUE(contains(result.output, station)) << station << result.output;
}

TEST_F(Program, FolderThatCannotBeMadeIsStatusTwoInWords) {
    // A file stands where the folder should be: refused for every user, root as well.
    const ProgramRun result = run({"critical", rotor, "--out", rotor + "/case.toml/results"});
    EXPECT_EQ(result.status, 2); // an argument that is wrong
    EXPECT_EQ(result.output, "");
    EXPECT_EQ(lines(result.errors), 1) << result.errors;
    EXPECT_TRUE(contains(result.errors, "case.toml/results")) << result.errors;
    EXPECT_TRUE(contains(result.errors, "case.toml is not a folder")) << result.errors;
}

TEST_F(Program, ASpeedWithoutAUnitIsSaid) {
    const std::string twisted = std::string(WHIRL_ROOT) + "/cases/twisted_shaft"; // in rad/s
    const ProgramRun plain = run({"modes", twisted, "--quiet", "--speed", "30"});
    EXPECT_EQ(plain.status, 0) << plain.errors;
    EXPECT_TRUE(contains(plain.errors, "--speed 30 is in rad/s, 286.479 rpm")) << plain.errors;
    EXPECT_EQ(run({"modes", twisted, "--quiet", "--speed", "30 rpm"}).errors, "");
    // Beside speeds in another unit the case has a remark already.
    const ProgramRun beside = run({"modes", rotor, "--speed", "30"});
    EXPECT_TRUE(contains(beside.output, "modes.speed = 30 is in rad/s")) << beside.output;
    EXPECT_FALSE(contains(beside.errors, "--speed")) << beside.errors;
}

TEST_F(Program, ReadingsAloneAreForWeights) {
    const std::string fan = std::string(WHIRL_ROOT) + "/cases/weights_fan";
    const ProgramRun result = run({"weights", fan});
    EXPECT_EQ(result.status, 0) << result.errors;
    EXPECT_TRUE(fs::exists("out/weights_fan/weights/report.html"));
    for (const std::string command :
         {"show", "campbell", "critical", "stability", "response", "balance", "rigid-limit",
          "simulate", "accuracy", "samples", "modes"}) {
        const ProgramRun refused = run({command, fan});
        EXPECT_EQ(refused.status, 2) << command;
        EXPECT_TRUE(contains(refused.errors, "shaft: missing, expected a section [shaft]"))
            << refused.errors;
    }
    const ProgramRun without = run({"weights", rotor});
    EXPECT_EQ(without.status, 2);
    EXPECT_TRUE(contains(without.errors, "expected a section [weights]")) << without.errors;
}

/// What a command misses is named as an entry that, once it is there, lets the command answer.
TEST_F(Program, CommandsSayWhatTheyNeedOfTheCase) {
    struct Missing {
        const char *command, *key;
        std::string entries; ///< as the message proposes them
        std::string others;  ///< what the command needs beside them
        std::vector<std::string> quick;
    };
    const std::string speeds = "speeds = {from = 100, to = 300, count = 3}\n";
    const std::string imbalance = "imbalance = [{z = 0.5, mr = 1e-4}]\n";
    const std::vector<Missing> all{
        {"campbell", "speeds", "from = 0, to = \"12000 rpm\", count = 101", "", {}},
        {"response", "imbalance", "z = 0.5, mr = \"100 g mm\"", speeds, {}},
        {"balance", "plane", "z = 0.5", speeds, {}},
        {"simulate",
         "simulate",
         "time = 20",
         imbalance + "speeds = {from = 100, count = 1}\n",
         {"--set", "simulate.time=0.01"}},
        {"samples",
         "samples",
         "count = 200, vary = [{path = \"bearing[0].k\", distribution = \"uniform\", from = 1e6, "
         "to = 2e6}]",
         "",
         {"--set", "samples.count=3"}},
        {"sweep",
         "sweep",
         "x = {path = \"bearing[0].k\", from = 1e6, to = 1e8, count = 21}",
         "",
         {"--set", "sweep.x.count=3"}},
        {"weights",
         "weights",
         "speeds = [\"3000 rpm\"]",
         imbalance + "plane = [{name = \"a\", z = 0.5}]\nprobe = [{name = \"p\", z = 0}]\n",
         {}}};
    const auto write = [](const std::string &entries) {
        std::ofstream("case.toml") << "format = 1\n" + entries +
                                          "[material.steel]\nE = 2e11\nnu = 0.3\nrho = 7800\n"
                                          "[shaft]\nsegments = [{length = 1, outer = 0.05}]\n"
                                          "[[bearing]]\nz = 0\nk = 1e6\nc = 100\n"
                                          "[[bearing]]\nz = 1\nk = 1e6\nc = 100\n";
    };
    for (const Missing &missing : all) {
        const std::string key = missing.key;
        write(missing.others);
        const ProgramRun refused = run({missing.command, "case.toml"});
        EXPECT_EQ(refused.status, 2) << refused.errors;
        EXPECT_TRUE(refused.errors.starts_with("case.toml:1: " + key + ": missing, expected "))
            << refused.errors;
        EXPECT_TRUE(contains(refused.errors, "as " + missing.entries)) << refused.errors;
        EXPECT_EQ(lines(refused.errors), 1) << refused.errors;
        const bool list = key == "imbalance" || key == "plane";
        write(missing.others + key + (list ? " = [{" : " = {") + missing.entries +
              (list ? "}]\n" : "}\n"));
        std::vector<std::string> arguments{missing.command, "case.toml", "--json"};
        arguments.insert(arguments.end(), missing.quick.begin(), missing.quick.end());
        const ProgramRun answered = run(arguments);
        EXPECT_EQ(answered.status, 0) << answered.errors;
    }
}

TEST_F(Program, RigidLimitAnswersOrSaysWhyNot) {
    const ProgramRun result = run({"rigid-limit", rotor});
    EXPECT_EQ(result.status, 0) << result.errors;
    EXPECT_TRUE(contains(result.output, "The rigid formulas are within 1 %")) << result.output;
    EXPECT_TRUE(fs::exists("out/friswell_5_9_1/rigid-limit/rigid-limit.json"));
    const std::string anisotropic = std::string(WHIRL_ROOT) + "/cases/friswell_5_9_2";
    const ProgramRun refused = run({"rigid-limit", anisotropic});
    EXPECT_EQ(refused.status, 1);
    EXPECT_TRUE(contains(refused.errors, anisotropic + "/case.toml: the rigid rotor"))
        << refused.errors;
    EXPECT_TRUE(contains(refused.errors, "bearing[0] differs between x and y")) << refused.errors;
    EXPECT_EQ(lines(refused.errors), 1) << refused.errors;
    // What looks like a slip in the case is said with the failure.
    const ProgramRun light = run({"rigid-limit", anisotropic, "--set", "material.steel.rho=7.81"});
    EXPECT_EQ(light.status, 1);
    EXPECT_TRUE(contains(light.errors, "\nnote: a density of 7.81 kg/m³")) << light.errors;
    EXPECT_EQ(lines(light.errors), 2) << light.errors;
    EXPECT_FALSE(fs::exists("out/friswell_5_9_2"));
}

TEST_F(Program, BalanceWantsPlanesAndMapsOnlyWhenAsked) {
    const ProgramRun without = run({"balance", rotor});
    EXPECT_EQ(without.status, 2);
    EXPECT_TRUE(contains(without.errors, "[[plane]]")) << without.errors;
    EXPECT_EQ(lines(without.errors), 1) << without.errors;
    const std::string drum = std::string(WHIRL_ROOT) + "/cases/extractor_two_plane";
    const auto has_placement = [&](const std::vector<std::string> &more) {
        // The criterion alone: the real balancers' stability has no part in maps.
        std::vector<std::string> all =
            with_few({"balance", drum, "--json", "--set", "balance.balanced_position=false"});
        all.insert(all.end(), more.begin(), more.end());
        return nlohmann::json::parse(run(all).output).contains("placement");
    };
    EXPECT_FALSE(has_placement({}));
    EXPECT_TRUE(has_placement({"--map"}));
    EXPECT_TRUE(nothing_written());
}

TEST_F(Program, UnderMpirunSpeaksOnceAndComputesTheSame) {
    if (!fs::exists("/usr/bin/mpirun"))
        GTEST_SKIP() << "no mpirun";
    const auto values = [](const ProgramRun &result) {
        auto json = nlohmann::json::parse(result.output);
        return std::pair(json.at("speeds"), json.at("modes"));
    };
    const ProgramRun alone = run(with_few({"campbell", rotor, "--json"}));
    const ProgramRun three = run_on("3", with_few({"campbell", rotor, "--json"}));
    ASSERT_EQ(alone.status, 0) << alone.errors;
    ASSERT_EQ(three.status, 0) << three.errors;
    // From speed to speed each process begins anew: the same up to rounding, 1e-14.
    const auto followed = values(alone);
    const auto parts = values(three);
    EXPECT_EQ(followed.first, parts.first);
    ASSERT_EQ(followed.second.size(), parts.second.size());
    for (std::size_t i = 0; i < parts.second.size(); ++i) {
        EXPECT_EQ(followed.second[i]["label"], parts.second[i]["label"]);
        for (std::size_t k = 0; k < parts.first.size(); ++k)
            EXPECT_NEAR(followed.second[i]["frequency"][k].get<double>() /
                            parts.second[i]["frequency"][k].get<double>(),
                        1, 1e-12);
    }
    const ProgramRun bad = run_on("3", {"campbell", rotor, "--set", "bearing[0].k=5 kg"});
    EXPECT_EQ(bad.status, 2);
    const std::string message = "expected a stiffness";
    EXPECT_TRUE(contains(bad.errors, message)) << bad.errors;
    EXPECT_EQ(bad.errors.find(message), bad.errors.rfind(message)) << bad.errors;
    EXPECT_TRUE(nothing_written());
}

/// Samples and points of maps are dealt out to whoever is free: in another order every time.
TEST_F(Program, DealtWorkGivesTheSameOnAnyNumberOfProcesses) {
    if (!fs::exists("/usr/bin/mpirun"))
        GTEST_SKIP() << "no mpirun";
    const auto of = [](const ProgramRun &result, const std::vector<std::string> &keys) {
        EXPECT_EQ(result.status, 0) << result.errors;
        const auto json = nlohmann::json::parse(result.output);
        nlohmann::json parts;
        for (const std::string &key : keys)
            parts.push_back(json.at(key));
        return parts;
    };
    const std::string cases = std::string(WHIRL_ROOT) + "/cases/";
    // A fifth of the springs is below zero and fails.
    const std::vector<std::string> samples{
        "samples", cases + "uncertain_jeffcott",   "--json", "--set", "samples.count=40",
        "--set",   "samples.vary[0].deviation=1.2"};
    const std::vector<std::string> keys{"samples", "inputs", "answers", "notes"};
    const nlohmann::json alone = of(run(samples), keys);
    EXPECT_GT(alone.at(0).at("failed"), 0);
    EXPECT_EQ(alone.at(1).at(0).at("values").size(), 40U);
    for (const std::string processes : {"2", "3"})
        EXPECT_EQ(of(run_on(processes, samples), keys), alone) << processes;
    // The response is shared among processes, but not that of one of many rotors.
    const std::vector<std::string> operating{"samples",
                                             cases + "uncertain_jeffcott",
                                             "--json",
                                             "--set",
                                             "samples.count=5",
                                             "--set",
                                             "samples.of=[\"operating\"]",
                                             "--set",
                                             "operation={from=40, to=60}",
                                             "--set",
                                             "imbalance=[{z=0.5, mr=1e-4}]"};
    const nlohmann::json one = of(run(operating), keys);
    EXPECT_FALSE(one.at(2).empty());
    for (const std::string processes : {"2", "3"})
        EXPECT_EQ(of(run_on(processes, operating), keys), one) << processes;
    // An anisotropy of 0.5 kg m2 is no rotor: the reason must arrive from every process.
    const std::vector<std::string> map{
        "stability",
        cases + "anisotropic_rotor",
        "--json",
        "--set",
        "speeds.count=5",
        "--set",
        "map={x = {path = \"anisotropy[0].dI\", from = 0.1, to = 0.5, count = 3}, y = {path = "
        "\"bearing[0].c\", from = 0, to = 1, count = 3}}"};
    EXPECT_EQ(of(run_on("3", map), {"map", "notes"}), of(run(map), {"map", "notes"}));
    // Rows over the spin speed, of an elastic rotor: all rows begin with shapes of the same one.
    const std::vector<std::string> rows{
        "stability",
        cases + "anisotropic_disc_flexible",
        "--json",
        "--set",
        "speeds.count=2",
        "--set",
        "bearing[0].c=300",
        "--set",
        "map={x = {path = \"speed\", from = 10, to = 1600, count = 5}, y = {path = "
        "\"anisotropy[0].dI\", from = 0.001, to = 0.03, count = 4}}"};
    const nlohmann::json rows_alone = of(run(rows), {"map", "growth", "ends", "notes"});
    for (const std::string processes : {"2", "3"})
        EXPECT_EQ(of(run_on(processes, rows), {"map", "growth", "ends", "notes"}), rows_alone)
            << processes;
    EXPECT_TRUE(nothing_written());
}

/// A map over an entry that --set names for several items at once is what runs with --set find.
TEST_F(Program, MapsOverEntriesOfOverridesAreThoseRuns) {
    const std::string scene = std::string(WHIRL_ROOT) + "/cases/rodrigues_two_plane";
    const auto json_of = [&](const std::vector<std::string> &more) {
        std::vector<std::string> arguments{"stability",
                                           scene,
                                           "--json",
                                           "--set",
                                           "balancer[*].imbalance=0.005",
                                           "--set",
                                           "speeds.to=4",
                                           "--set",
                                           "speeds.from=1",
                                           "--set",
                                           "speeds.count=4"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ProgramRun done = run(arguments);
        EXPECT_EQ(done.status, 0) << done.errors;
        return nlohmann::json::parse(done.output);
    };
    const nlohmann::json map =
        json_of({"--set", "map={x = {path = \"speed\", from = 1, to = 4, count = 4}, y = {path = "
                          "\"balancer[*].mass\", from = 0.01, to = \"40 g\", count = 4}}"})
            .at("map");
    const nlohmann::json &masses = map.at("y").at("values");
    ASSERT_EQ(masses.size(), 4U);
    for (std::size_t i = 0; i < masses.size(); ++i) {
        const nlohmann::json alone =
            json_of({"--set", fmt::format("balancer[*].mass={}", masses[i].get<double>())})
                .at("growth");
        for (std::size_t j = 0; j < alone.size(); ++j) // the same eigenvalues by another basis
            EXPECT_NEAR(map.at("growth")[i][j].get<double>(), alone[j].get<double>(), 1e-7)
                << masses[i] << " kg, " << j;
    }
}

TEST_F(Program, SamplesOfNoRotorAreStatusOneOnEveryNumberOfProcesses) {
    const std::vector<std::string> arguments{
        "samples", std::string(WHIRL_ROOT) + "/cases/uncertain_jeffcott",
        "--set",   "samples.count=4",
        "--set",   "samples.vary[0].mean=-1e9"};
    const ProgramRun alone = run(arguments);
    EXPECT_EQ(alone.status, 1);
    EXPECT_TRUE(contains(alone.errors, "each of the 4 samples failed: bearing[0].k: expected a"))
        << alone.errors;
    if (fs::exists("/usr/bin/mpirun")) {
        EXPECT_EQ(run_on("2", arguments).status, 1);
    }
    EXPECT_TRUE(nothing_written());
}

// What is converted into what is compared by tests/cases/units_of_results_test.cpp.
TEST_F(Program, UnitsAreThoseOfTextAndFilesAndOfJsonWhereThatIsAskedFor) {
    const std::string scene = std::string(WHIRL_ROOT) + "/cases/lalanne_three_discs";
    const auto json_with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {"response", scene, "--json", "--set", "speeds.count=3"});
        const ProgramRun done = run(more);
        EXPECT_EQ(done.status, 0) << done.errors;
        auto json = nlohmann::json::parse(done.output, nullptr, false);
        json.erase("seconds");
        json.erase("provenance");
        return json;
    };
    const nlohmann::json si = json_with({});
    EXPECT_EQ(json_with({"--units", "us", "--peak-to-peak"}), si);
    const nlohmann::json us = json_with({"--units", "us", "--peak-to-peak", "--json-units"});
    EXPECT_EQ(us.at("units").at("amplitude"), "mil pk-pk");
    constexpr double mil = 25.4e-6;
    EXPECT_NEAR(us["peaks"][0]["value"].get<double>() / si["peaks"][0]["value"].get<double>(),
                2 / mil, 1e-14 * 2 / mil);
    const ProgramRun text =
        run({"response", scene, "--set", "speeds.count=3", "--units", "us", "--peak-to-peak"});
    EXPECT_TRUE(contains(text.output, "pk-pk mil")) << text.output;
    std::ifstream table("out/lalanne_three_discs/response/response.csv");
    std::string head;
    std::getline(table, head);
    EXPECT_TRUE(contains(head, "pk-pk [mil]")) << head;
}

} // namespace program_test
