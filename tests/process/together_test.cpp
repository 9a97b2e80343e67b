#include "cases/program_run.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include <unistd.h>

namespace whirl::process {

namespace {

namespace fs = std::filesystem;

tests::ProgramRun on(const std::string &processes, const std::string &how, const std::string &who) {
    const fs::path errors =
        fs::temp_directory_path() / ("whirl_together_" + std::to_string(getpid()));
    // What hangs ends here with exit status 124.
    tests::ProgramRun run =
        tests::run_program("/usr/bin/timeout",
                           {"60", "/usr/bin/mpirun", "--oversubscribe", "--allow-run-as-root", "-n",
                            processes, WHIRL_RANKS, how, who},
                           errors.string());
    fs::remove(errors);
    return run;
}

} // namespace

/// Wherever one of several processes fails, and with whatever exception, all end, and with its
/// words.
TEST(Together, AllEndAlikeWhereOneFails) {
    if (!fs::exists("/usr/bin/mpirun"))
        GTEST_SKIP() << "no mpirun";
    struct Failure {
        std::string how;
        int status;
        std::string words;
    };
    const std::vector<Failure> failures{
        {"input", 2, "case.toml: broken"},        {"analysis", 1, "no convergence"},
        {"memory", 1, "not enough memory"},       {"solver", 1, "a step failed"},
        {"analysis-within", 1, "no convergence"}, {"memory-within", 1, "not enough memory"},
        {"solver-within", 1, "a step failed"},    {"dealt", 1, "no convergence"},
        {"between", 1, "no convergence"},         {"last", 1, "no convergence"}};
    for (const auto &[how, status, words] : failures)
        for (const char *who : {"0", "1", "all"}) {
            const tests::ProgramRun run = on("2", how, who);
            EXPECT_EQ(run.status, 0) << how << " on " << who << ": " << run.errors;
            EXPECT_TRUE(run.output.starts_with(std::to_string(status))) << run.output;
            EXPECT_TRUE(run.output.ends_with(words + "\n")) << how << " on " << who << run.output;
            // Of a piece of work it does not matter whose it was.
            const bool of_piece = how == "analysis-within" || how == "dealt";
            EXPECT_EQ(run.output.find("process 1 of 2") != std::string::npos,
                      who == std::string("1") && !of_piece)
                << run.output;
        }
    EXPECT_TRUE(on("3", "between", "2").output.starts_with("1 process 2 of 3"));
    EXPECT_EQ(on("3", "nothing", "all").output, "0 \n");
}

} // namespace whirl::process
