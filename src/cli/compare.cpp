#include "cli/commands.h"
#include "cli/messages.h"
#include "input/case_file.h"
#include "model/errors.h"
#include "process/processes.h"
#include "report/common/files.h"
#include "report/common/json.h"
#include "report/common/units.h"
#include "report/compare/comparison.h"
#include "report/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace whirl::cli {

namespace {

/// "cases/x@shaft.order=1" as the arguments of a command.
Arguments arguments_of(const std::string &scene, const std::string &command,
                       const std::vector<std::string> &overrides) {
    Arguments out;
    out.command = command;
    out.overrides = overrides;
    std::size_t at = scene.find('@');
    out.scene = scene.substr(0, at);
    while (at != std::string::npos) {
        const std::size_t next = scene.find('@', at + 1);
        out.overrides.push_back(
            scene.substr(at + 1, next == std::string::npos ? next : next - at - 1));
        at = next;
    }
    return out;
}

report::ComparedResult computed(const std::string &name, const Command &command,
                                const std::vector<std::string> &overrides) {
    const Arguments arguments = arguments_of(name, command.name, overrides);
    const input::CaseFile file(arguments.scene);
    const model::Case scene = file.load(arguments.overrides);
    check_same_case(arguments, file, scene);
    refuse_without_shaft(scene, arguments);
    refuse_too_large(file, scene, arguments);
    report::ComparedResult result{name, {}};
    work_on(command, {arguments, file, scene, [&](report::Report report) {
                          if (process::process_rank() != 0) // the first has all of it
                              return;
                          report.provenance.case_text = file.text();
                          report.provenance.set = arguments.overrides;
                          result.json = report::Json::parse(report::to_si_json(report));
                      }});
    return result;
}

std::vector<report::ComparedResult> results_of(const Arguments &arguments) {
    std::vector<std::string> names = arguments.compared;
    const Command *command = command_named(names.front());
    if (command)
        names.erase(names.begin());
    std::vector<report::ComparedResult> results;
    for (const std::string &name : names) {
        if (name.ends_with(".json")) {
            results.push_back(report::read_result(name));
            continue;
        }
        if (!command)
            throw model::BadInput(fmt::format(
                "compare: expected a command before the cases (whirl compare critical {0} ...) or "
                "results in files *.json, got \"{0}\"",
                name));
        results.push_back(computed(name, *command, arguments.overrides));
    }
    if (!arguments.names.empty() && arguments.names.size() != results.size())
        throw model::BadInput(fmt::format("--name: expected one for each of {} results, got {}",
                                          results.size(), arguments.names.size()));
    for (std::size_t i = 0; i < arguments.names.size(); ++i) {
        const std::string &name = arguments.names[i];
        if (name.empty() || std::ranges::count(arguments.names, name) > 1)
            throw model::BadInput(
                fmt::format("--name: expected a name of its own for each result, got \"{}\"{}",
                            name, name.empty() ? "" : " again"));
        results[i].name = name;
    }
    return results;
}

/// What is written is in the units that the options ask for, whatever those of the cases.
model::OutputUnits units_of(const std::vector<std::string> &overrides) {
    std::vector<std::string> of_units;
    for (const std::string &text : overrides)
        if (text.starts_with("units."))
            of_units.push_back(text);
    return input::output_units(of_units);
}

} // namespace

void compare_results(const Arguments &arguments) {
    const std::filesystem::path folder =
        arguments.out.value_or(std::filesystem::path("out") / "compare");
    const bool writes = !arguments.json || arguments.out;
    if (writes)
        report::check_folder(folder);
    std::vector<report::ComparedResult> results = results_of(arguments);
    if (process::process_rank() != 0)
        return;
    const report::Comparison comparison = report::compare(std::move(results));
    const model::OutputUnits asked = units_of(arguments.overrides);
    std::vector<std::filesystem::path> files;
    if (writes)
        files = report::write_comparison(comparison, folder, asked);
    if (arguments.json)
        say(report::json_text(report::comparison_json(comparison, report::Units::of_json(asked))));
    else if (!arguments.quiet) {
        const report::TextStyle style{0, true, 0}; // small differences need digits
        say(report::comparison_text(comparison, report::Units::of_readers(asked).styled(style)) +
            (files.front().extension() == ".svg"
                 ? fmt::format("picture: {}\n", files.front().string())
                 : std::string("note: gnuplot is not installed: no picture\n")) +
            fmt::format("report:  {}\n", files.back().string()));
    }
}

} // namespace whirl::cli
