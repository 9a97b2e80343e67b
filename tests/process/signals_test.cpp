#include "process/signals.h"

#include "process/child.h"
#include "process/interruption.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

namespace whirl::process {

using testing::ExitedWithCode;
using testing::KilledBySignal;

// Each in a process of its own: EXPECT_EXIT looks at how that ends, and at what it says.

TEST(Signals, EndTheProgramAsTheyWouldAndAreSaid) {
    for (const int signal : {SIGHUP, SIGINT, SIGTERM, SIGUSR1, SIGALRM})
        EXPECT_EXIT(
            {
                end_in_order_on_signals(true);
                raise(signal);
                std::exit(0);
            },
            KilledBySignal(signal),
            "^whirl: ended by SIG[A-Z0-9]+[^\n]*; no results were written\n$");
    EXPECT_EXIT(
        {
            end_in_order_on_signals(true);
            results_written();
            raise(SIGTERM);
            std::exit(0);
        },
        KilledBySignal(SIGTERM), "^whirl: ended by SIGTERM\n$");
    EXPECT_EXIT(
        {
            end_in_order_on_signals(false);
            raise(SIGTERM);
            std::exit(0);
        },
        KilledBySignal(SIGTERM), "^$");
}

TEST(Signals, NohupIsRespected) {
    EXPECT_EXIT(
        {
            std::signal(SIGHUP, SIG_IGN);
            end_in_order_on_signals(true);
            raise(SIGHUP);
            std::exit(7);
        },
        ExitedWithCode(7), "^$");
}

TEST(Signals, WaitWhileTheyAreHeld) {
    EXPECT_EXIT(
        {
            end_in_order_on_signals(true);
            {
                const SignalsHeld held;
                {
                    const SignalsHeld within;
                    raise(SIGTERM);
                }
                std::fputs("still here\n", stderr);
            }
            std::exit(0);
        },
        KilledBySignal(SIGTERM), "^still here\nwhirl: ended by SIGTERM");
}

TEST(Signals, TheFirstInterruptionIsForTheAnalysisTheSecondForTheProgram) {
    EXPECT_EXIT(
        {
            end_in_order_on_signals(true);
            bool came = false;
            bool taken = false;
            {
                const InterruptionBySignal interruption(came);
                raise(SIGINT);
                taken = take_interruption();
            }
            std::exit(came && taken ? 7 : 1);
        },
        ExitedWithCode(7), "^$");
    EXPECT_EXIT(
        {
            end_in_order_on_signals(true);
            bool came = false;
            const InterruptionBySignal interruption(came);
            raise(SIGINT);
            raise(SIGINT);
            std::exit(0);
        },
        KilledBySignal(SIGINT), "ended by SIGINT");
    EXPECT_EXIT( // and as ever afterwards
        {
            end_in_order_on_signals(true);
            bool came = true;
            { const InterruptionBySignal interruption(came); }
            raise(came ? SIGTERM : SIGINT);
            std::exit(0);
        },
        KilledBySignal(SIGINT), "ended by SIGINT");
}

TEST(Signals, WhatWasStartedEndsToo) {
    const std::filesystem::path file =
        std::filesystem::temp_directory_path() / ("whirl_signals_" + std::to_string(getpid()));
    EXPECT_EXIT(
        {
            end_in_order_on_signals(true);
            // Of the group it leads; what the shell has started is in it too.
            const auto child = Child::start(
                {"sh", "-c",
                 "trap '' TERM INT; sleep 1000 & echo $! > " + file.string() + "; wait"},
                "");
            while (!std::filesystem::exists(file) || std::filesystem::file_size(file) == 0)
                usleep(1000);
            raise(SIGTERM);
            std::exit(0);
        },
        KilledBySignal(SIGTERM), "ended by SIGTERM");
    std::string pid;
    std::ifstream(file) >> pid;
    bool there = true;
    for (int i = 0; i < 2000 && there; ++i, usleep(5000)) {
        std::ifstream stat("/proc/" + pid + "/stat");
        std::string number, name, state;
        there = (stat >> number >> name >> state) && state != "Z";
    }
    EXPECT_FALSE(there) << pid;
    std::filesystem::remove(file);
}

/// Room for what is started at once; beyond that it is not noted, and nothing else happens.
TEST(Signals, NotesAreGivenBack) {
    for (int i = 0; i < 1000; ++i) {
        const int place = note_group(1 << 30);
        EXPECT_GE(place, 0);
        forget_group(place);
    }
}

} // namespace whirl::process
