// How far a long analysis is: shares of parts within parts, and what is written of them.

#include "cli/progress_display.h"
#include "process/progress.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <functional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace {

using namespace whirl;

TEST(Progress, SharesOfPartsWithinParts) {
    std::vector<std::pair<double, std::string>> heard;
    process::on_progress(
        [&](double share, const std::string &doing) { heard.emplace_back(share, doing); });
    {
        const process::Stage half("first half", 0, 0.5);
        process::report_progress(0.5);
        {
            const process::Stage last("its end", 0.8, 1);
            process::report_progress(1);
        }
        process::report_progress(1);
    }
    process::report_progress(0.75);
    process::on_progress(nullptr);
    process::report_progress(1);
    const std::vector<std::pair<double, std::string>> expected{
        {0, "first half"}, {0.25, "first half"}, {0.4, "its end"},
        {0.5, "its end"},  {0.5, "first half"},  {0.75, ""}};
    ASSERT_EQ(heard.size(), expected.size());
    for (std::size_t i = 0; i < heard.size(); ++i) {
        EXPECT_DOUBLE_EQ(heard[i].first, expected[i].first) << i;
        EXPECT_EQ(heard[i].second, expected[i].second) << i;
    }
}

std::string written(const std::function<void()> &work) {
    std::FILE *file = std::tmpfile();
    {
        const cli::ProgressDisplay display(file, {0.02, 0.02});
        work();
    }
    std::rewind(file);
    std::string text;
    for (int c = std::fgetc(file); c != EOF; c = std::fgetc(file))
        text += static_cast<char>(c);
    std::fclose(file);
    return text;
}

void work_for_a_while() {
    const process::Stage stage("motions in time", 0.5, 1);
    process::report_progress(0.5);
    process::report_progress(0.1); // never backwards
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
}

TEST(Progress, OneLineOnATerminalThatIsGoneInTheEnd) {
    const std::string text = written(work_for_a_while);
    EXPECT_NE(text.find("\r\033[K75 %, motions in time, "), std::string::npos) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos);
    ASSERT_GE(text.size(), 4U);
    EXPECT_EQ(text.substr(text.size() - 4), "\r\033[K");
}

TEST(Progress, NothingOfWhatIsQuick) {
    // Sooner than anything is said, by a wide margin on a busy machine.
    std::FILE *file = std::tmpfile();
    {
        const cli::ProgressDisplay display(file, {3600, 3600});
        process::report_progress(0.5);
    }
    EXPECT_EQ(std::ftell(file), 0);
    std::fclose(file);
}

} // namespace
