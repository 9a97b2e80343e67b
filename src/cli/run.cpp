#include "cli/run.h"

#include "analyses/accuracy.h"
#include "analyses/balance.h"
#include "analyses/campbell.h"
#include "analyses/critical.h"
#include "analyses/modes.h"
#include "analyses/response.h"
#include "analyses/rigid_limit.h"
#include "analyses/show.h"
#include "analyses/stability.h"
#include "cli/messages.h"
#include "cli/simulate.h"
#include "cli/summary.h"
#include "cli/summary_simulate.h"
#include "input/case_file.h"
#include "model/errors.h"
#include "process/progress.h"
#include "process/session.h"
#include "report/json.h"
#include "report/json_simulate.h"
#include "report/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

#include <unistd.h>

namespace whirl::cli {

namespace {

std::string files_text(const report::Files &files) {
    std::string text;
    for (const std::string &note : files.notes)
        text += fmt::format("note: {}\n", note);
    if (!files.paths.empty())
        text += fmt::format("picture: {}\n", files.paths.front().string());
    const auto page = std::find_if(files.paths.begin(), files.paths.end(),
                                   [](const auto &path) { return path.extension() == ".html"; });
    if (page != files.paths.end())
        text += fmt::format("report:  {}\n", page->string());
    return text;
}

template <class Result>
void deliver(const Arguments &arguments, const model::Case &scene, const Result &result) {
    if (process::process_rank() != 0)
        return;
    report::Files files;
    if (!arguments.json || arguments.out) {
        const auto usual = std::filesystem::path("out") / scene.name / arguments.command;
        files = report::write_report(scene, result, arguments.out.value_or(usual));
    }
    if (arguments.json)
        say(report::to_json(scene, result));
    else if (!arguments.quiet)
        say(summary(scene, result) + files_text(files));
}

/// On a terminal, for anything longer than a second: how far the analysis is.
void show_progress(const Arguments &arguments) {
    if (arguments.quiet || !first_process() || isatty(STDERR_FILENO) == 0)
        return;
    using Clock = std::chrono::steady_clock;
    process::on_progress([start = Clock::now(), last = Clock::now()](double share) mutable {
        const Clock::time_point now = Clock::now();
        const bool end = share >= 1;
        if (now - start < std::chrono::seconds(1) ||
            (!end && now - last < std::chrono::milliseconds(200)))
            return;
        last = now;
        fmt::print(stderr, "\r{:3.0f} %{}", 100 * share, end ? "\r     \r" : "");
        std::fflush(stderr);
    });
}

/// The case of the arguments with more entries overridden.
analyses::CaseWith with_overrides(const Arguments &arguments) {
    return [&arguments](const std::vector<std::string> &more) {
        std::vector<std::string> overrides = arguments.overrides;
        overrides.insert(overrides.end(), more.begin(), more.end());
        return input::load_case(arguments.scene, overrides);
    };
}

void analyse(const Arguments &arguments, const model::Case &scene) {
    const std::string &command = arguments.command;
    if (command == "show")
        deliver(arguments, scene, analyses::show(scene));
    else if (command == "campbell")
        deliver(arguments, scene, analyses::campbell(scene));
    else if (command == "critical")
        deliver(arguments, scene, analyses::critical_speeds(scene));
    else if (command == "response")
        deliver(arguments, scene, analyses::unbalance_response(scene));
    else if (command == "modes")
        deliver(arguments, scene, analyses::mode_shapes(scene));
    else if (command == "stability")
        deliver(arguments, scene, analyses::stability(scene, with_overrides(arguments)));
    else if (command == "accuracy")
        deliver(arguments, scene, analyses::accuracy(scene));
    else if (command == "rigid-limit")
        deliver(arguments, scene, analyses::rigid_limit(scene));
    else if (command == "balance")
        deliver(arguments, scene, analyses::balance(scene, {arguments.map}));
    else if (command == "simulate")
        deliver(arguments, scene, simulate_or_leave_restart(arguments, scene));
}

} // namespace

void run(const Arguments &arguments) {
    const model::Case scene = input::load_case(arguments.scene, arguments.overrides);
    const process::Session session;
    show_progress(arguments);
    try {
        analyse(arguments, scene);
    } catch (const model::BadInput &problem) { // found late: say where the key stands
        throw model::BadInput(
            input::with_place(problem.what(), arguments.scene, arguments.overrides));
    }
}

} // namespace whirl::cli
