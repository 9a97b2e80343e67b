#include "cli/arguments.h"

#include "cli/messages.h"
#include "report/json.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <array>
#include <utility>

namespace whirl::cli {

namespace {

constexpr std::array<std::pair<const char *, const char *>, 10> commands{{
    {"show", "what the scene is: drawing, masses, inertias, formulations"},
    {"campbell", "whirl speeds and damping over the spin speed"},
    {"critical", "critical speeds directly, without a sweep"},
    {"stability", "where motion is unstable"},
    {"response", "unbalance response over speed, forces at bearings"},
    {"balance", "where correction planes can balance the rotor"},
    {"rigid-limit", "flexible model against rigid closed forms as the shaft stiffens"},
    {"simulate", "nonlinear motion in time with real balls or pendulums"},
    {"accuracy", "wall time and error over element family, order and mesh"},
    {"modes", "mode shapes as pictures and for ParaView"},
}};

void add_options(CLI::App &app, Arguments &arguments) {
    app.add_option("CASE", arguments.scene, "case folder (its case.toml) or .toml file")
        ->required()
        ->type_name("");
    app.add_option("--out", arguments.out, "folder for the results (default out/<case>/<command>)")
        ->type_name("DIR");
    app.add_flag("--json", arguments.json,
                 "the JSON result alone on standard output; files only with --out");
    app.add_option("--set", arguments.overrides,
                   "override an entry of the case, e.g. --set speeds.count=11; repeatable")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
    app.add_flag("--map", arguments.map,
                 "balance: where along the shaft balancers work; other commands ignore it");
    app.add_flag("--quiet", arguments.quiet, "no text on standard output");
    app.set_version_flag("--version", "whirl " + report::program_version());
}

/// One message for whatever CLI11 found wrong.
std::string message_of(const CLI::App &app, const CLI::ParseError &error) {
    const std::vector<std::string> rest = app.remaining();
    if (app.get_subcommands().empty() && !rest.empty() && rest.front().front() != '-')
        return fmt::format("whirl: unknown command \"{}\"; the commands are {}", rest.front(),
                           command_list());
    std::string text = error.what();
    if (text == "CASE is required")
        text = "a case folder or .toml file is missing";
    const std::string command =
        app.get_subcommands().empty() ? "" : " " + app.get_subcommands().front()->get_name();
    return fmt::format("whirl: {} (\"whirl{} --help\" shows the options)", text, command);
}

} // namespace

std::string command_list() {
    std::string list;
    for (const auto &[name, answer] : commands)
        list += fmt::format("{}{}", list.empty() ? "" : ", ", name);
    return list;
}

Parsed parse_arguments(int argc, const char *const *argv) {
    CLI::App app("Whirl: how flexible rotors vibrate", "whirl");
    app.set_version_flag("--version", "whirl " + report::program_version());
    app.footer("Exit status: 0 done, 1 the analysis failed, 2 bad case or arguments.\n"
               "mpirun -n N whirl ... shares the work among N processes.");
    Arguments arguments;
    for (const auto &[name, answer] : commands)
        add_options(*app.add_subcommand(name, answer), arguments);
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp &) {
        say(app.help());
        return {};
    } catch (const CLI::CallForVersion &version) {
        say(fmt::format("{}\n", version.what()));
        return {};
    } catch (const CLI::ParseError &error) {
        complain(message_of(app, error));
        return {{}, exit_bad_input};
    }
    if (app.get_subcommands().empty()) {
        complain(fmt::format("whirl: a command is missing: {} (\"whirl --help\" explains them)",
                             command_list()));
        return {{}, exit_bad_input};
    }
    if (app.get_subcommands().size() > 1 || (arguments.out && arguments.out->empty())) {
        complain(arguments.out ? "whirl: --out: the name of a folder is missing"
                               : "whirl: give one command");
        return {{}, exit_bad_input};
    }
    arguments.command = app.get_subcommands().front()->get_name();
    return {arguments, exit_done};
}

} // namespace whirl::cli
