#include "cli/manual.h"

#include "report/report.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cctype>

namespace whirl::cli {

namespace {

/// Text as man(7) wants it: hyphens that are minus signs, no line that is taken for a request.
std::string roff(const std::string &text) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool line_start = i == 0 || text[i - 1] == '\n';
        if (line_start && (text[i] == '.' || text[i] == '\''))
            out += "\\&";
        if (text[i] == '-')
            out += "\\-";
        else if (text[i] == '\\')
            out += "\\e";
        else
            out += text[i];
    }
    return out;
}

std::string upper(std::string text) {
    for (char &letter : text)
        letter = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
    return text;
}

std::string begin_page(const std::string &name, const std::string &answer,
                       const std::string &synopsis) {
    return fmt::format(".TH {} 1 \"\" \"whirl {}\" \"Rotordynamics\"\n.SH NAME\n{} \\- {}\n"
                       ".SH SYNOPSIS\n{}\n",
                       upper(roff(name)), report::program_version(), roff(name), roff(answer),
                       synopsis);
}

/// The options that --help shows, each with its argument.
std::string options_of(const CLI::App &app) {
    std::string text;
    for (const CLI::Option *option : app.get_options()) {
        if (option->get_group().empty())
            continue;
        text += ".TP\n";
        text += option->get_positional()
                    ? fmt::format(".I {}", roff(option->get_name()))
                    : fmt::format(".B {}", roff(option->get_name(false, true)));
        const bool takes = option->get_items_expected_max() > 0 && !option->get_positional();
        text += takes ? fmt::format(" \\fI{}\\fR", roff(option->get_type_name())) : "";
        text += "\n" + roff(option->get_description()) + "\n";
    }
    return text;
}

const std::string exit_status = ".SH EXIT STATUS\n0: done; 1: the analysis failed; 2: bad case or "
                                "arguments; 128 + the signal that ended it.\n";

} // namespace

std::string manual_page(const CLI::App &command, const std::string &reads,
                        const std::vector<std::string> &examples) {
    const std::string &name = command.get_name();
    const bool of_results = name == "compare";
    std::string page = begin_page("whirl-" + name, command.get_description(),
                                  fmt::format(".B whirl {}\n.I {}\n[\\fIoptions\\fR]", roff(name),
                                              of_results ? "RESULT..." : "CASE"));
    page += ".SH DESCRIPTION\n";
    page += of_results
                ? "Every further result is compared with the first.\n"
                : "Text goes to standard output; picture, report, JSON and CSV to a folder.\n";
    page += reads.empty() ? "" : roff(reads) + "\n";
    page += ".SH OPTIONS\n" + options_of(command) + ".SH EXAMPLES\n.nf\n";
    for (const std::string &example : examples)
        page += roff("whirl " + name + " " + example) + "\n";
    return page + ".fi\n" + exit_status + ".SH SEE ALSO\n.BR whirl (1)";
}

std::string manual_of_program(const CLI::App &program) {
    std::string page =
        begin_page("whirl", "how flexible rotors vibrate",
                   ".B whirl\n.I COMMAND CASE\n[\\fIoptions\\fR]\n.br\n.B whirl compare\n"
                   ".I RESULT...\n[\\fIoptions\\fR]");
    page += ".SH DESCRIPTION\nA case is a folder with a case.toml, or a .toml file.\n"
            ".SH COMMANDS\n";
    for (const CLI::App *command : program.get_subcommands({}))
        page += fmt::format(".TP\n.BR whirl\\-{} (1)\n{}\n", roff(command->get_name()),
                            roff(command->get_description()));
    return page + ".SH OPTIONS\n" + options_of(program) + exit_status +
           ".SH NOTES\nmpirun \\-n N whirl ... shares the work among N processes.";
}

} // namespace whirl::cli
