#include "cli/commands.h"
#include "cli/messages.h"
#include "cli/progress_display.h"
#include "input/case_file.h"
#include "input/size.h"
#include "linalg/session.h"
#include "model/errors.h"
#include "model/rpm.h"
#include "process/memory.h"
#include "process/processes.h"
#include "process/progress.h"
#include "report/common/files.h"
#include "report/common/units.h"
#include "report/report.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <optional>
#include <string_view>
#include <vector>

#include <unistd.h>

namespace whirl::cli {

namespace {

/// Where the rest is, and what is missing there.
std::string files_text(const report::Files &files) {
    std::string text;
    for (const std::string &note : files.notes)
        text += "note: " + note + "\n";
    for (const std::filesystem::path &path : files.paths)
        if (path.extension() == ".html")
            text += "report:  " + path.string();
    for (const std::filesystem::path &path : files.paths)
        if (path.extension() == ".pdf")
            text += "\nprint:   " + path.string();
    return text;
}

/// What the run starts from.
report::Provenance provenance_of(const input::CaseFile &file, const Arguments &arguments) {
    report::Provenance from{fmt::format("{:%FT%TZ}", fmt::gmtime(std::time(nullptr))),
                            file.text(),
                            arguments.overrides,
                            {}};
    for (const auto &[path, text] : file.files())
        from.files.push_back({path, text});
    return from;
}

report::TextStyle style_of(const Arguments &arguments) {
    constexpr int lines = 25; // of a terminal
    return {arguments.digits, arguments.errors, arguments.all ? 0 : lines};
}

/// Files, and text or JSON on standard output, from the first process.
void deliver(const Run &run, const report::Report &report) {
    if (process::process_rank() != 0)
        return;
    const Arguments &arguments = run.arguments;
    if (arguments.parts && !report.document) {
        say(report::page_parts(report));
        return;
    }
    report::Files files;
    if (!arguments.json || arguments.out)
        files = report::write_report(report, run.folder());
    if (arguments.json)
        say(report::to_json(report));
    else if (!arguments.quiet)
        say(report::to_text(report, style_of(arguments), files_text(files)));
    if (!files.failure.empty())
        throw model::AnalysisFailure(files.failure);
}

/// An option of other commands changes nothing here: better said than found out.
void note_idle_map(const Arguments &arguments) {
    const auto has_map = [](const Command &command) {
        return std::count(command.options.begin(), command.options.end(), "--map") > 0;
    };
    if (!arguments.map || has_map(*command_named(arguments.command)))
        return;
    std::vector<std::string_view> names;
    for (const Command &command : commands())
        if (has_map(command))
            names.push_back(command.name);
    complain(fmt::format("note: --map does nothing in {}; it is of {}", arguments.command,
                         fmt::join(names, " and ")));
}

/// A number alone on the command line, of which the case has no remark of its own.
void note_plain_speed(const Arguments &arguments, const model::Case &scene) {
    const bool told =
        std::any_of(scene.remarks.begin(), scene.remarks.end(), [](const model::Sentence &remark) {
            return remark.starts_with("modes.speed = ");
        });
    const std::string &text = arguments.speed;
    if (told || text.empty() || text.find_first_not_of("0123456789.eE+-_ ") != std::string::npos ||
        !scene.modes.speed || *scene.modes.speed == 0)
        return;
    complain(fmt::format("note: --speed {0} is in rad/s, {1:.6g} rpm; with a unit, \"{0} rpm\", it "
                         "is that speed",
                         text, *scene.modes.speed * model::rpm));
}

/// Reads the case, runs the analysis and delivers the result.
void run_command(const Arguments &arguments) {
    const input::CaseFile file(arguments.scene);
    const model::Case scene = file.load(arguments.overrides);
    check_same_case(arguments, file, scene);
    refuse_without_shaft(scene, arguments);
    refuse_too_large(file, scene, arguments);
    note_idle_map(arguments);
    note_plain_speed(arguments, scene);
    const Run checked{arguments, file, scene, {}};
    if (!(arguments.json || arguments.parts) || arguments.out)
        report::check_folder(checked.folder());
    const report::Provenance provenance = provenance_of(file, arguments);
    std::optional<ProgressDisplay> display;
    if (!arguments.quiet && !command_named(arguments.command)->lasts &&
        process::process_rank() == 0 && isatty(STDERR_FILENO) != 0)
        display.emplace(stderr, ProgressDisplay::Pace{}, report::Units::of_readers(scene.units));
    const process::Stage stage(model::Sentence(arguments.command), 0, 1);
    work_on(*command_named(arguments.command),
            {arguments, file, scene, [&](report::Report report) {
                 display.reset(); // its line must be gone before others are written
                 report.provenance = provenance;
                 deliver(checked, report);
             }});
}

} // namespace

const Command *command_named(const std::string &name) {
    const auto found = std::find_if(commands().begin(), commands().end(),
                                    [&name](const Command &at) { return at.name == name; });
    return found == commands().end() ? nullptr : &*found;
}

void work_on(const Command &command, const Run &run) {
    const std::string file = run.file.path().generic_string();
    bool answered = false; // what fails after it is no fault of the case
    try {
        command.run({run.arguments, run.file, run.scene, [&](report::Report report) {
                         answered = true;
                         run.deliver(std::move(report));
                     }});
    } catch (const model::BadInput &problem) { // found late: say where the key stands
        throw model::BadInput(run.file.with_place(problem.what(), run.arguments.overrides));
    } catch (const model::Failure &failure) { // what looks like a slip may be why
        const report::Units units = report::Units::of_readers(run.scene.units);
        std::string message = (answered ? "" : file + ": ") + units.text(failure.sentence());
        for (const model::Sentence &remark : run.scene.remarks)
            message += "\nnote: " + units.text(remark);
        throw model::AnalysisFailure(message);
    }
}

void refuse_too_large(const input::CaseFile &file, const model::Case &scene,
                      const Arguments &arguments) {
    input::refuse_too_large(scene, arguments.command, process::memory_of_machine(),
                            file.tree(arguments.overrides));
}

void refuse_without_shaft(const model::Case &scene, const Arguments &arguments) {
    if (arguments.command != "weights" && !model::has_shaft(scene))
        throw model::BadInput(fmt::format(
            "{}:1: shaft: missing, expected a section [shaft]: without one a case has measurements "
            "alone, of which weights makes correction weights, and {} has nothing to compute",
            scene.file.generic_string(), arguments.command));
}

std::filesystem::path Run::folder() const {
    return arguments.out.value_or(std::filesystem::path("out") / scene.name / arguments.command);
}

void check_same_case(const Arguments &arguments, const input::CaseFile &file,
                     const model::Case &scene) {
    if (process::process_count() == 1 ||
        process::same_everywhere(arguments.command + '\n' + file.text(arguments.overrides) + '\n' +
                                 file.all_texts()))
        return;
    throw model::BadInput(fmt::format("{}: expected the same case on every process, with the same "
                                      "tables; this one reads another text",
                                      scene.file.generic_string()));
}

void run(const Arguments &arguments) {
    process::use_huge_pages();
    const linalg::Session session;
    process::together([&arguments] {
        if (arguments.command == "compare")
            comparison()(arguments);
        else
            run_command(arguments);
    });
}

} // namespace whirl::cli
