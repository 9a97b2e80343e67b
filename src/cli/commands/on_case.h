#pragma once

#include "analyses/case_with.h"
#include "cli/commands.h"
#include "input/case_file.h"
#include "report/reports.h"

#include <string>
#include <vector>

namespace whirl::cli {

/// A command whose analysis needs the case alone.
template <class Result> auto on_case(Result (*analysis)(const model::Case &)) {
    return [analysis](const Run &run) {
        const Result result = run.timed([&] { return analysis(run.scene); });
        run.deliver(report::describe(run.scene, result));
    };
}

/// A command whose analysis reads the case again with other values.
template <class Result>
auto on_cases(Result (*analysis)(const model::Case &, const analyses::CaseWith &)) {
    return [analysis](const Run &run) {
        const analyses::CaseWith with = [&run](const std::vector<std::string> &more) {
            std::vector<std::string> overrides = run.arguments.overrides;
            overrides.insert(overrides.end(), more.begin(), more.end());
            return input::load_case(run.arguments.scene, overrides);
        };
        const Result result = run.timed([&] { return analysis(run.scene, with); });
        run.deliver(report::describe(run.scene, result));
    };
}

} // namespace whirl::cli
