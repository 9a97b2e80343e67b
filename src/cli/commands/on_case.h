#pragma once

#include "analyses/case_with.h"
#include "cli/commands.h"
#include "input/case_file.h"
#include "report/reports.h"

#include <string>
#include <vector>

namespace whirl::cli {

/// A command that reports what an analysis answers. @param analysis  of the run
template <class Analysis> auto on_run(const Analysis &analysis) {
    return [analysis](const Run &run) {
        const auto result = run.timed([&] { return analysis(run); });
        run.deliver(report::describe(run.scene, result));
    };
}

/// The same of an analysis that needs the case alone.
template <class Result> auto on_case(Result (*analysis)(const model::Case &)) {
    return on_run([analysis](const Run &run) { return analysis(run.scene); });
}

/// The case of a run with other values beside those of the command line.
inline analyses::CaseWith case_with(const Run &run) {
    return [&run](const std::vector<std::string> &more) {
        std::vector<std::string> overrides = run.arguments.overrides;
        overrides.insert(overrides.end(), more.begin(), more.end());
        return run.file.load(overrides);
    };
}

/// The same of one that reads the case again with other values.
template <class Result>
auto on_cases(Result (*analysis)(const model::Case &, const analyses::CaseWith &)) {
    return on_run([analysis](const Run &run) { return analysis(run.scene, case_with(run)); });
}

} // namespace whirl::cli
