#include "cli/commands.h"

#include "analyses/machine_report.h"
#include "cli/commands/on_case.h"

namespace whirl::cli {

namespace {

void report_of_machine(const Run &run) {
    const bool writes = !run.arguments.json || run.arguments.out;
    const results::MachineReport result =
        run.timed([&] { return analyses::machine_report(run.scene, case_with(run)); });
    report::Report report = report::describe(run.scene, result);
    report.pdf = run.arguments.pdf && writes;
    run.deliver(std::move(report));
}

} // namespace

Command report_command() {
    return {"report",
            "whether the machine passes: all analyses, checks and a verdict on one page",
            {"speeds", "operation", "limits", "imbalance", "probe", "campbell", "level1"},
            {"--pdf"},
            {"cases/compressor_margins", "cases/compressor_margins --pdf --out signed"},
            report_of_machine};
}

} // namespace whirl::cli
