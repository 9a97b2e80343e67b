#pragma once

#include "cli/arguments.h"
#include "model/case.h"

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace whirl::input {
class CaseFile;
} // namespace whirl::input

namespace whirl::report {
struct Report;
} // namespace whirl::report

namespace whirl::cli {

/// A command at work: what it is given, and where its report goes.
struct Run {
    const Arguments &arguments;
    const input::CaseFile &file;
    const model::Case &scene; ///< as the arguments ask for it
    std::function<void(report::Report)> deliver;

    /// The result of an analysis, with the wall time it took and what is to be said of the case.
    /// Only here is a result's clock opened and closed.
    template <class Analysis> [[nodiscard]] auto timed(const Analysis &analysis) const {
        const auto start = std::chrono::steady_clock::now();
        auto result = analysis();
        result.model.seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        std::vector<model::Sentence> notes = scene.remarks; // of the case first
        notes.insert(notes.end(), result.model.notes.begin(), result.model.notes.end());
        result.model.notes = std::move(notes);
        return result;
    }

    /// Where the files go: --out, or out/<case>/<command>.
    [[nodiscard]] std::filesystem::path folder() const;
};

/// A row of the table of commands: what --help and the manual page say comes from here.
struct Command {
    std::string name;
    std::string answer;                   ///< one line for --help
    std::vector<std::string> settings;    ///< sections of the case it reads beside the rotor
    std::vector<std::string> options;     ///< beside those that every command has: "--map"
    std::vector<std::string> examples;    ///< what stands behind "whirl NAME "
    std::function<void(const Run &)> run; ///< case to result to report
    bool lasts = false;                   ///< until a signal ends it: there is no progress to show
};

/// A row each, in the source of its name.
Command accuracy_command();
Command balance_command();
Command campbell_command();
Command critical_command();
Command modes_command();
Command report_command();
Command response_command();
Command rigid_limit_command();
Command samples_command();
Command show_command();
Command simulate_command();
Command stability_command();
Command studio_command();
Command sweep_command();
Command weights_command();

/// What this program can do: all commands (commands/all.cpp), or one (commands/one.cpp), in the
/// order of --help.
[[nodiscard]] const std::vector<Command> &commands();
/// Null where there is none of that name.
[[nodiscard]] const Command *command_named(const std::string &name);

/// Of several processes, which ought to have read the same. Collective.
/// @throws model::BadInput on those that have read another case or table than process 0
void check_same_case(const Arguments &arguments, const input::CaseFile &file,
                     const model::Case &scene);

/// Runs the command; of what it finds wrong with the case it names the file, and of an entry the
/// line.
/// @throws model::BadInput, model::AnalysisFailure
void work_on(const Command &command, const Run &run);

/// @throws model::BadInput where the command takes more memory for the case than this machine has
void refuse_too_large(const input::CaseFile &file, const model::Case &scene,
                      const Arguments &arguments);

/// @throws model::BadInput where the case has no shaft and the command needs one
void refuse_without_shaft(const model::Case &scene, const Arguments &arguments);

/// Reads the case, runs the analysis on all processes and delivers the result from the first:
/// files, and text or JSON on standard output. Collective under mpirun.
/// @throws model::BadInput, model::AnalysisFailure, std::exception; nothing is written then.
void run(const Arguments &arguments);

/// Of compare: results that were written before or are computed now, side by side.
/// @throws model::BadInput for results that are of different kinds
using Compare = void (*)(const Arguments &arguments);

/// Null in a program of one command.
[[nodiscard]] Compare comparison();

void compare_results(const Arguments &arguments);

} // namespace whirl::cli
