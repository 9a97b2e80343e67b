#include "process/child.h"

#include "model/errors.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

namespace whirl::process {

namespace {

constexpr double long_enough = 60; // s, for a shell on a machine that is busy

Child shell(const std::string &script, const std::string &input = "") {
    return Child::start({"sh", "-c", script}, input).value();
}

/// Whether the process of this number is gone, or soon is; one that nobody has waited for counts as
/// gone.
bool ends_soon(const std::string &pid) {
    for (int i = 0; i < 2000; ++i) {
        std::ifstream stat("/proc/" + pid + "/stat");
        std::string number, name, state;
        if (!(stat >> number >> name >> state) || state == "Z")
            return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return false;
}

} // namespace

TEST(Child, ReadsItsInputAndItsOutputIsKept) {
    const std::string text(300000, 'x'); // more than a pipe holds
    Child child = shell("cat; echo words >&2; cat", text);
    ASSERT_TRUE(child.ended_within(long_enough));
    EXPECT_EQ(child.failure(), "");
    EXPECT_EQ(child.output(), text);
    EXPECT_EQ(child.errors(), "words\n");
}

TEST(Child, TellsHowItEnded) {
    Child failed = shell("exit 3");
    ASSERT_TRUE(failed.ended_within(long_enough));
    EXPECT_EQ(failed.failure(), "exit status 3");
    Child killed = shell("kill -TERM $$");
    ASSERT_TRUE(killed.ended_within(long_enough));
    EXPECT_NE(killed.failure().find("signal 15"), std::string::npos) << killed.failure();
}

TEST(Child, OneThatIsNotInstalledIsNone) {
    EXPECT_FALSE(Child::start({"no program has this name"}, ""));
    EXPECT_THROW((void)Child::start({"/"}, ""), model::AnalysisFailure); // a folder
}

/// What it has started itself ends with it: it would hold what it has written open, and the
/// machine.
TEST(Child, ItsGroupEndsWithIt) {
    Child child = shell("sleep 1000 & echo $!");
    ASSERT_TRUE(child.ended_within(long_enough));
    std::string pid = child.output();
    pid.pop_back();
    EXPECT_TRUE(ends_soon(pid)) << pid;
}

TEST(Child, IsWaitedForNoLongerThanAsked) {
    std::string pid;
    {
        Child child = shell("echo $$; exec sleep 1000");
        EXPECT_FALSE(child.ended_within(0.05));
        while (pid.empty() || pid.back() != '\n')
            pid = child.output();
        pid.pop_back();
    }
    EXPECT_TRUE(ends_soon(pid)) << pid;
}

/// A parent may have this program started so that the system forgets how children have ended.
TEST(Child, EndsWhereTheSystemForgetsChildren) {
    const auto before = std::signal(SIGCHLD, SIG_IGN);
    Child child = shell("echo done");
    EXPECT_TRUE(child.ended_within(long_enough));
    EXPECT_EQ(child.output(), "done\n");
    std::signal(SIGCHLD, before);
}

} // namespace whirl::process
