// Faults around the program, each provoked: settings of the libraries beneath it, a gnuplot that is
// none, targets that cannot be written, signals, too little memory, processes that do not see the
// same case.

#include "cases/program_run.h"
#include "support/own_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <unistd.h>

namespace faults_test {

namespace fs = std::filesystem;
using whirl::tests::ProgramRun;

const std::string cases = std::string(WHIRL_ROOT) + "/cases/";
const std::string rotor = cases + "friswell_5_9_1";

bool contains(const std::string &text, const std::string &part) {
    return text.find(part) != std::string::npos;
}

std::string content_of(const fs::path &path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
}

void write(const fs::path &path, const std::string &content) {
    std::ofstream(path, std::ios::binary) << content;
}

/// What is in a folder by its names, hidden files too: files by size and hash, which are all that a
/// failure has room for.
std::map<std::string, std::string> contents(const fs::path &folder) {
    std::map<std::string, std::string> all;
    for (const auto &entry : fs::directory_iterator(folder)) {
        const std::string content = entry.is_directory() ? "" : content_of(entry.path());
        all[entry.path().filename()] =
            fmt::format("{} {} {:x}", entry.is_directory() ? "folder" : "file", content.size(),
                        std::hash<std::string>()(content));
    }
    return all;
}

/// Runs the program by a shell, in an empty folder of its own.
class Faults : public whirl::tests::InOwnFolder {
  protected:
    /// @param command  of the shell; $WHIRL is the program. What hangs ends with status 124.
    [[nodiscard]] ProgramRun shell(const std::string &command) const {
        return whirl::tests::run_program(
            "/usr/bin/timeout",
            {"120", "sh", "-c",
             "WHIRL='" WHIRL_PROGRAM "' ROTOR='" + rotor + "' CASES='" + cases + "'; " + command},
            (folder / "errors").string());
    }
    /// A script of this name in PATH, before all others.
    void put_program(const std::string &name, const std::string &script) const {
        fs::create_directories(folder / "programs");
        write(folder / "programs" / name, "#!/bin/sh\n" + script + "\n");
        fs::permissions(folder / "programs" / name, fs::perms::owner_all);
    }
};

// --- Settings of the libraries ------------------------------------------------------------------

/// They are of other programs: nothing is overwritten, nothing stands on standard output beside the
/// JSON, no debugger starts.
TEST_F(Faults, OptionsOfPetscAreNotRead) {
    const std::string options = "-log_view :{}/victim -help -options_view -malloc_dump\n";
    fs::create_directories("home");
    write("victim", "mine");
    const std::string here = fs::current_path();
    const auto in_file = [&here](std::string options) {
        return options.replace(options.find("{}"), 2, here);
    };
    for (const char *file : {".petscrc", "petscrc", "home/.petscrc"})
        write(file, in_file(options));
    write("options.yaml", "help:\nlog_view: \":" + here + "/victim\"\n");
    const auto names = contents(".");
    const ProgramRun run =
        shell("HOME=$PWD/home PETSC_OPTIONS='-log_view :victim -help' "
              "PETSC_OPTIONS_YAML='help: ' \"$WHIRL\" critical \"$ROTOR\" --json");
    EXPECT_EQ(run.status, 0);
    EXPECT_EQ(run.errors, "");
    EXPECT_EQ(nlohmann::json::parse(run.output).at("command"), "critical");
    EXPECT_EQ(contents("."), names);
}

// --- gnuplot ------------------------------------------------------------------------------------

/// A gnuplot that fails in any way: exit 1 with one message, and the results of an earlier run are
/// as they were.
TEST_F(Faults, WithoutPicturesThereAreNoResultsBesideOldOnes) {
    if (shell("command -v gnuplot > gnuplot.path").status != 0)
        GTEST_SKIP() << "gnuplot is not installed";
    ASSERT_EQ(shell("\"$WHIRL\" critical \"$ROTOR\" --out results --quiet").status, 0);
    const auto old = contents("results");
    ASSERT_TRUE(old.contains("critical.png"));
    const std::string real = shell("cat gnuplot.path").output;
    const std::string gnuplot = real.substr(0, real.find('\n'));
    for (const std::string &script :
         {std::string("exit 1"), std::string("exit 0"), std::string("echo no picture"),
          std::string("sleep 1000"), gnuplot + " \"$@\" | head -c 3000",
          gnuplot + " \"$@\" | head -c -20"}) {
        put_program("gnuplot", script);
        const ProgramRun run =
            shell("PATH=\"$PWD/../programs:$PATH\" WHIRL_GNUPLOT_SECONDS=" +
                  std::string(script.starts_with("sleep") ? "0.5" : "60") +
                  " \"$WHIRL\" critical \"$ROTOR\" --out results --set speeds.to=3000 --quiet");
        EXPECT_EQ(run.status, 1) << script;
        EXPECT_TRUE(run.errors.starts_with("whirl: picture: gnuplot ")) << run.errors;
        EXPECT_EQ(contents("results"), old) << script;
    }
}

/// Where there is none the rest is written, a note says what is missing, and no old picture stays
/// beside results that it does not show.
TEST_F(Faults, WithoutGnuplotNoOldPictureStays) {
    ASSERT_EQ(shell("\"$WHIRL\" critical \"$ROTOR\" --out results --quiet").status, 0);
    write("results/critical.png", "old");
    write("results/critical.svg", "old");
    const ProgramRun run = shell("PATH=/nonexistent \"$WHIRL\" critical \"$ROTOR\" --out results");
    EXPECT_EQ(run.status, 0) << run.errors;
    EXPECT_TRUE(contains(run.output, "note: gnuplot is not installed")) << run.output;
    const auto files = contents("results");
    EXPECT_FALSE(files.contains("critical.png"));
    EXPECT_NE(content_of("results/critical.svg"), "old");
    EXPECT_TRUE(files.contains("critical.json"));
}

// --- Results, all or none -----------------------------------------------------------------------

TEST_F(Faults, AFolderInThePlaceOfAResultLeavesAllAsItWas) {
    fs::create_directories("results/critical.json/inside");
    write("results/critical.csv", "old");
    const auto old = contents("results");
    const ProgramRun run = shell("\"$WHIRL\" critical \"$ROTOR\" --out results --quiet");
    EXPECT_EQ(run.status, 1);
    EXPECT_TRUE(contains(run.errors, "results/critical.json: Is a directory")) << run.errors;
    EXPECT_EQ(contents("results"), old);
}

/// The system ends a program by a signal where a file becomes too large for its limit, unless it
/// looks at what writing says.
TEST_F(Faults, ALimitOnTheSizeOfFilesLeavesNothing) {
    for (const std::string blocks : {"1", "64", "1000"}) { // of 512 B; the page has a megabyte
        const ProgramRun run =
            shell("ulimit -f " + blocks + "; \"$WHIRL\" critical \"$ROTOR\" --out results --quiet");
        EXPECT_EQ(run.status, 1) << blocks << run.errors;
        EXPECT_FALSE(run.errors.empty());
        EXPECT_FALSE(fs::exists("results"));
    }
}

TEST_F(Faults, StandardOutputThatIsFullIsStatusOne) {
    const ProgramRun run = shell("\"$WHIRL\" critical \"$ROTOR\" --json > /dev/full");
    EXPECT_EQ(run.status, 1);
    EXPECT_TRUE(contains(run.errors, "standard output")) << run.errors;
    EXPECT_TRUE(contents(".").empty());
}

// --- Signals (tests/faults/kills.sh sends many at random times) ---------------------------------

const std::string for_ever = "\"$WHIRL\" simulate \"$CASES/rodrigues_two_plane\" --set "
                             "simulate.time=1e6 --out results --quiet & pid=$!; "
                             "until grep -q '^SigCgt:.*[2367abef]$' /proc/$pid/status 2> /dev/null "
                             "|| ! kill -0 $pid 2> /dev/null; do :; done; ";

TEST_F(Faults, ASignalEndsARunWithAWordAndNothingElse) {
    const ProgramRun run = shell(for_ever + "sleep 0.3; kill -TERM $pid; wait $pid");
    EXPECT_EQ(run.status, 128 + 15);
    // The shell adds a line.
    EXPECT_TRUE(run.errors.starts_with("whirl: ended by SIGTERM; no results were written\n"))
        << run.errors;
    EXPECT_TRUE(contents(".").empty());
}

/// The first Ctrl-C leaves a restart, the second ends at once.
TEST_F(Faults, AnInterruptedMotionCanGoOnAndIsNoSuccess) {
    const ProgramRun run = shell(for_ever + "sleep 1; kill -INT $pid; wait $pid");
    EXPECT_EQ(run.status, 128 + 2);
    EXPECT_TRUE(run.errors.starts_with("whirl: interrupted at ")) << run.errors;
    EXPECT_TRUE(contains(run.errors, "--set simulate.restart=results/restart.json"));
    ASSERT_EQ(contents("results").size(), 1U);
    const double reached =
        nlohmann::json::parse(content_of("results/restart.json")).at("time").get<double>();
    EXPECT_GT(reached, 0);
    const ProgramRun on =
        shell("\"$WHIRL\" simulate \"$CASES/rodrigues_two_plane\" --set "
              "simulate.restart=results/restart.json --json --set simulate.time=" +
              std::to_string(1.01 * reached));
    EXPECT_EQ(on.status, 0) << on.errors;
}

// --- Memory -------------------------------------------------------------------------------------

/// Whatever the limit, a run ends, and says why where it cannot be done. (OpenBLAS asks for ever
/// for a buffer that it cannot have.)
TEST_F(Faults, LittleMemoryIsSaid) {
    int failed = 0;
    for (int kilobytes = 200000; kilobytes <= 400000; kilobytes += 10000) {
        const ProgramRun run = shell("ulimit -v " + std::to_string(kilobytes) +
                                     "; \"$WHIRL\" campbell \"$CASES/friswell_6_8_1\" --json "
                                     "--set speeds.count=3");
        if (run.status == 127) // not even the libraries have room
            continue;
        EXPECT_TRUE(run.status == 0 || run.status == 1) << kilobytes << " kB: " << run.status;
        EXPECT_TRUE(run.status == 0 || !run.errors.empty()) << kilobytes << " kB";
        failed += run.status == 1 ? 1 : 0;
    }
    EXPECT_GT(failed, 0);
}

// --- Several processes --------------------------------------------------------------------------

class Ranks : public Faults {
  protected:
    void SetUp() override {
        Faults::SetUp();
        if (!fs::exists("/usr/bin/mpirun"))
            GTEST_SKIP() << "no mpirun";
        for (const char *place : {"a", "b"}) {
            fs::create_directories(place);
            for (const char *file : {"case.toml", "shaft.csv", "bearing_1.csv", "bearing_2.csv"})
                fs::copy_file(cases + "speed_dependent_bearings/" + file, fs::path(place) / file,
                              fs::copy_options::overwrite_existing);
        }
    }
    /// Process 1 runs in folder b, as on another node, process 0 in a.
    [[nodiscard]] ProgramRun apart(const std::string &before = "") const {
        write("run.sh", "case $OMPI_COMM_WORLD_RANK in 0) cd a ;; *) cd b; " + before +
                            " ;; esac\nexec '" WHIRL_PROGRAM "' campbell case.toml --quiet --json "
                            "--set speeds.count=3\n");
        return shell("/usr/bin/mpirun --oversubscribe --allow-run-as-root -n 2 sh run.sh");
    }
    void expect_one_message(const ProgramRun &run, int status, const std::string &words) const {
        EXPECT_EQ(run.status, status) << run.errors;
        const std::size_t at = run.errors.find(words);
        EXPECT_NE(at, std::string::npos) << run.errors;
        EXPECT_EQ(at, run.errors.rfind(words)) << run.errors;
        EXPECT_TRUE(contains(run.errors, "process 1 of 2")) << run.errors;
    }
};

TEST_F(Ranks, ReadTheSameCase) { EXPECT_EQ(apart().status, 0); }

TEST_F(Ranks, OneThatCannotSeeTheCaseEndsAll) {
    fs::remove("b/case.toml");
    expect_one_message(apart(), 2, "there is no such file");
}

TEST_F(Ranks, OneThatCannotReadTheCaseEndsAll) {
    write("b/case.toml", "format = 2\n");
    expect_one_message(apart(), 2, "format: expected 1");
}

TEST_F(Ranks, OneThatReadsAnotherCaseEndsAll) {
    std::string text = content_of("b/case.toml");
    write("b/case.toml", text.replace(text.find("mass = 17"), 9, "mass = 18"));
    expect_one_message(apart(), 2, "expected the same case on every process");
}

TEST_F(Ranks, OneThatReadsAnotherTableEndsAll) {
    for (const std::string table : {"shaft.csv", "bearing_2.csv"}) {
        const std::string text = content_of("b/" + table);
        write("b/" + table, text + "# another text\n");
        expect_one_message(apart(), 2, "expected the same case on every process");
        write("b/" + table, text);
    }
}

/// The numbers are those of one process to the last digit, whoever computed them: with motions that
/// are followed from speed to speed, on few shapes of a range of speeds, on modes at rest.
TEST_F(Ranks, AnyNumberGivesTheSameToTheLastDigit) {
    const auto numbers = [&](const std::string &processes, const std::string &command) {
        const std::string start =
            processes == "1"
                ? ""
                : "/usr/bin/mpirun --oversubscribe --allow-run-as-root -n " + processes;
        const ProgramRun run = shell(start + " \"$WHIRL\" " + command + " --json --quiet");
        EXPECT_EQ(run.status, 0) << run.errors;
        auto json = nlohmann::json::parse(run.output);
        json.erase("model");
        json.erase("provenance");
        json.erase("seconds");
        return json;
    };
    for (const std::string command :
         {"campbell \"$CASES/pendulum_centrifuge\"", "campbell \"$CASES/friswell_6_8_1\"",
          "campbell \"$CASES/friswell_6_8_1\" --set reduction=off",
          "campbell \"$CASES/friswell_5_9_9\"", "campbell \"$CASES/disc_type_short\"",
          "campbell \"$CASES/overhung_cross_coupled\"", "response \"$CASES/nelson_mcvaugh\"",
          "balance \"$CASES/extractor_two_plane\" --map --set "
          "balance.balanced_position=false --set speeds.count=20"}) {
        const auto alone = numbers("1", command);
        for (const std::string processes : {"2", "3"})
            EXPECT_EQ(numbers(processes, command), alone) << command << " on " << processes;
    }
}

} // namespace faults_test
