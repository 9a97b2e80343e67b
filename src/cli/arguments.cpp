#include "cli/arguments.h"

#include "cli/commands.h"
#include "cli/manual.h"
#include "cli/messages.h"
#include "input/case_file.h"
#include "input/problems.h"
#include "model/errors.h"
#include "report/report.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>

namespace whirl::cli {

namespace {

/// Every command accepts what one of them has; the others ignore it and do not show it.
void add_own_options(CLI::App &app, const Command &command, Arguments &arguments) {
    const auto hide_elsewhere = [&command](CLI::Option *option) {
        if (std::count(command.options.begin(), command.options.end(), option->get_name()) == 0)
            option->group("");
    };
    hide_elsewhere(app.add_flag("--map", arguments.map,
                                command.name == "critical"
                                    ? "also the critical speeds over the stiffness of the supports"
                                    : "also where along the shaft balancers work"));
    hide_elsewhere(app.add_option_function<std::string>(
                          "--map-bearing",
                          [&arguments](const std::string &bearing) {
                              arguments.map = true;
                              arguments.overrides.push_back("critical_map.bearing=" + bearing);
                          },
                          "--map over the stiffness of this bearing alone")
                       ->type_name("NAME|PLACE"));
    hide_elsewhere(app.add_option("--port", arguments.port,
                                  "of the address, 1 to 65535; without it any that is free")
                       ->check(CLI::Range(1, 65535))
                       ->type_name("N"));
    app.add_flag("--parts", arguments.parts)->group(""); // for studio alone
    hide_elsewhere(app.add_flag("--pdf", arguments.pdf,
                                "also a PDF of the page, printed by Chromium or WeasyPrint"));
    hide_elsewhere(app.add_option_function<std::string>(
                          "--speed",
                          [&arguments](const std::string &speed) {
                              arguments.overrides.push_back("modes.speed=" + speed);
                              arguments.speed = speed;
                          },
                          "spin speed of the shapes, e.g. \"3000 rpm\", in place of modes.speed "
                          "and speeds.from")
                       ->type_name("SPEED"));
}

/// What every command ends with: its version, its manual page, examples below its help.
/// @param reads  a sentence for help and manual page, or empty
void finish(CLI::App &app, const std::string &reads, const std::vector<std::string> &examples) {
    app.set_version_flag("--version", "whirl " + report::program_version());
    app.add_flag_callback(
           "--man",
           [&app, reads, examples] {
               throw CLI::CallForVersion(manual_page(app, reads, examples), 0);
           },
           "the manual page of this command, for man -l -")
        ->group(""); // every --help has enough options
    std::string footer = reads.empty() ? "" : reads + "\n\n";
    footer += examples.size() == 1 ? "Example:" : "Examples:";
    for (const std::string &example : examples)
        footer += fmt::format("\n  whirl {} {}", app.get_name(), example);
    app.footer(footer);
}

/// Which sections of a case a command reads.
std::string reads_text(const std::vector<std::string> &settings) {
    return settings.empty()
               ? ""
               : fmt::format("Reads of the case, beside the rotor: {}.", fmt::join(settings, ", "));
}

/// The units of what is written are entries of the case, so that a result says what it is in.
void add_unit_options(CLI::App &app, Arguments &arguments) {
    const auto entry = [&arguments](const std::string &text) {
        arguments.overrides.push_back("units." + text);
    };
    // What is wrong is said of the option, not of the entry that it stands for.
    const auto checked = [entry](const std::string &text) {
        const bool preset = text.find('=') == std::string::npos;
        const std::string own = preset ? "preset=" + text : text;
        try {
            if (!own.ends_with('=')) // which takes the entry out
                (void)input::output_units({"units." + own});
        } catch (const model::BadInput &problem) {
            std::string said = problem.what();
            for (const std::string &start :
                 {"--set units." + own + ": ", "units." + own.substr(0, own.find('=')) + ": "})
                if (said.starts_with(start))
                    said.erase(0, start.size());
            throw CLI::ValidationError(fmt::format(
                "--units {}: {}{}", text, said, preset ? "; one unit alone: QUANTITY=UNIT" : ""));
        }
        entry(own);
    };
    app.add_option_function<std::vector<std::string>>(
           "--units",
           [checked](const std::vector<std::string> &all) { std::ranges::for_each(all, checked); },
           "units of what is written: si, mm-rpm, us, or e.g. speed=Hz, amplitude=mil; repeatable")
        ->type_name("PRESET|QUANTITY=UNIT")
        ->allow_extra_args(false);
    app.add_flag_callback(
        "--peak-to-peak", [entry] { entry("peak_to_peak=true"); },
        "amplitudes of vibration from peak to peak");
}

CLI::Option *add_json_units_option(CLI::App &app, Arguments &arguments) {
    return app.add_flag_callback(
        "--json-units", [&arguments] { arguments.overrides.emplace_back("units.json=true"); },
        "JSON in these units too, instead of SI");
}

void add_options(CLI::App &app, const Command &command, Arguments &arguments) {
    app.add_option("CASE", arguments.scene, "case folder (its case.toml) or .toml file")
        ->required()
        ->type_name("");
    app.add_option("--out", arguments.out, "folder for the results (default out/<case>/<command>)")
        ->type_name("DIR");
    CLI::Option *json =
        app.add_flag("--json", arguments.json,
                     "the JSON result alone on standard output; files only with --out");
    app.add_option("--set", arguments.overrides,
                   "override an entry of the case, e.g. --set speeds.count=11; repeatable")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
    add_own_options(app, command, arguments);
    add_unit_options(app, arguments);
    std::vector<CLI::Option *> of_text{
        json,
        add_json_units_option(app, arguments),
        app.add_option("--digits", arguments.digits,
                       "significant digits of the text on standard output (5)")
            ->check(CLI::Range(2, 15))
            ->type_name("N"),
        app.add_flag("--errors", arguments.errors,
                     "errors in the text, even below the digits shown"),
        app.add_flag("--all", arguments.all, "all rows in the text, not 25 lines"),
        app.add_flag("--quiet", arguments.quiet, "no text on standard output")};
    if (command.lasts) // it writes no result
        for (CLI::Option *option : of_text)
            option->group("");
    finish(app, reads_text(command.settings), command.examples);
}

/// compare has results in place of a case.
void add_compare(CLI::App &root, Arguments &arguments) {
    CLI::App &app = *root.add_subcommand("compare", "differences between results or cases");
    app.add_option(
           "RESULT", arguments.compared,
           "results (JSON), or a command and cases; CASE@key=value: with an entry overridden")
        ->required()
        ->type_name("");
    app.add_option("--name", arguments.names,
                   "name of a result in place of its file or case, in their order; repeatable")
        ->type_name("NAME")
        ->allow_extra_args(false);
    app.add_option("--out", arguments.out, "folder for the comparison (default out/compare)")
        ->type_name("DIR");
    app.add_flag("--json", arguments.json,
                 "the comparison as JSON alone on standard output; files only with --out");
    app.add_option("--set", arguments.overrides, "override an entry of every case; repeatable")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
    add_unit_options(app, arguments);
    app.add_flag("--quiet", arguments.quiet, "no text on standard output");
    finish(app, "",
           {"before.json after.json", "critical cases/nelson_mcvaugh cases/nelson_mcvaugh_b",
            "critical cases/nelson_mcvaugh@shaft.order=1 cases/nelson_mcvaugh@shaft.order=10",
            "response cases/id_fan cases/id_fan@disc[0].mass=4800 --name built --name heavier"});
}

std::vector<std::string> command_names() {
    std::vector<std::string> names;
    for (const Command &command : commands())
        names.push_back(command.name);
    if (comparison())
        names.emplace_back("compare");
    return names;
}

/// ", did you mean ..." of an option that a command does not know.
std::string nearest_option(const CLI::App &command, const std::vector<std::string> &unknown) {
    std::vector<std::string> names;
    for (const CLI::Option *option : command.get_options())
        for (const std::string &name : option->get_lnames())
            names.push_back("--" + name);
    for (const std::string &word : unknown)
        if (std::string hint = input::did_you_mean(word, names);
            word.starts_with("--") && !hint.empty())
            return hint;
    return "";
}

/// One message for whatever CLI11 found wrong.
std::string message_of(const CLI::App &app, const CLI::ParseError &error) {
    const std::vector<std::string> rest = app.remaining();
    if (app.get_subcommands().empty() && !rest.empty() && rest.front().front() != '-') {
        const std::string hint = input::did_you_mean(rest.front(), command_names());
        return fmt::format("whirl: unknown command \"{}\"{} commands are {}", rest.front(),
                           hint.empty() ? "; the" : hint + " The", command_list());
    }
    std::string text = error.what();
    if (text == "RESULT is required")
        text = "results to compare are missing";
    if (text == "CASE is required")
        text = "a case folder or .toml file is missing";
    if (app.get_subcommands().empty())
        return fmt::format("whirl: {} (\"whirl --help\" shows the options)", text);
    const CLI::App &command = *app.get_subcommands().front();
    return fmt::format("whirl: {}{} (\"whirl {} --help\" shows the options)", text,
                       nearest_option(command, command.remaining()), command.get_name());
}

/// An option that takes no value and was given one, "--json=1"; empty: none.
std::string value_of_a_flag(const CLI::App &app, int argc, const char *const *argv) {
    const CLI::App &command = app.get_subcommands().empty() ? app : *app.get_subcommands().front();
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        const std::size_t equals = word.find('=');
        if (!word.starts_with("--") || equals == std::string::npos)
            continue;
        const std::string name = word.substr(0, equals);
        const CLI::Option *option = command.get_option_no_throw(name);
        if (option != nullptr && option->get_expected_max() == 0)
            return fmt::format("{} takes no value, got \"{}\"", name, word.substr(equals + 1));
    }
    return "";
}

} // namespace

std::string command_list() { return fmt::format("{}", fmt::join(command_names(), ", ")); }

Parsed parse_arguments(int argc, const char *const *argv) {
    CLI::App app("Whirl: how flexible rotors vibrate", "whirl");
    app.set_version_flag("--version", "whirl " + report::program_version());
    app.footer("Exit status: 0 done, 1 the analysis failed, 2 bad case or arguments,\n"
               "128 + the signal that ended it.\n"
               "mpirun -n N whirl ... shares the work among N processes.");
    app.add_flag_callback(
           "--man", [&app] { throw CLI::CallForVersion(manual_of_program(app), 0); },
           "the manual page of the program; whirl COMMAND --man: of a command")
        ->configurable(false);
    Arguments arguments;
    for (const Command &command : commands())
        add_options(*app.add_subcommand(command.name, command.answer), command, arguments);
    if (comparison())
        add_compare(app, arguments);
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
    if (const std::string problem = value_of_a_flag(app, argc, argv); !problem.empty()) {
        complain("whirl: " + problem);
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
