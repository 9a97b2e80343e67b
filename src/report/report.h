#pragma once

#include "model/case.h"
#include "report/common/drawing.h"
#include "report/common/units.h"
#include "report/pictures/chart.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace whirl::results {
struct ModelSummary;
} // namespace whirl::results

namespace whirl::report {

/// A part of a page.
struct Section {
    std::string heading;
    std::string html;
};

/// A picture beside the main one.
struct Picture {
    std::string name; ///< of its files, without ending
    Chart chart;
    /// Its curves as a table; none: no such file.
    std::function<std::string(const Units &)> csv{};
};

/// A file that a result was computed from.
struct InputFile {
    std::string name; ///< as the user knows it
    std::string text; ///< its bytes
};

/// A table in a file of its own.
struct TableFile {
    std::string name; ///< of the file, without ending
    std::function<std::string(const Units &)> csv;
};

/// What a result was computed from and when; the program's version joins them.
struct Provenance {
    std::string date{};             ///< UTC: "2026-03-01T12:00:00Z"
    std::string case_text{};        ///< the case file, TOML
    std::vector<std::string> set{}; ///< entries overridden: "path.to.key=value"
    std::vector<InputFile> files{}; ///< the case file as it stands, then its tables
};

/// An analysis within a document.
struct Chapter {
    std::string command; ///< that has more of it: "campbell"
    std::string heading;
    model::Sentence answer;           ///< in one sentence, or why there is none
    bool answered = true;             ///< false: the analysis failed
    std::optional<Drawing> drawing{}; ///< in front of the pictures
    std::vector<Picture> pictures{};
    std::vector<Section> tables{}; ///< the most important rows
    std::vector<model::Sentence> notes{};
};

/// Several analyses of one case on one page that can be printed and signed.
struct Document {
    std::string verdict;      ///< in a word: "passes", "fails", "incomplete"
    model::Sentence sentence; ///< the verdict in one sentence
    model::Sentence running;  ///< what the machine does at its running speed, or nothing
    Drawing drawing;          ///< the machine
    std::string checks;       ///< HTML
    std::vector<Chapter> chapters;
    std::vector<model::Sentence> left_out; ///< analyses that the case does not call for, and why
};

/// A result for all its readers. What is written comes from functions of the units in which it is,
/// so that it costs nothing where nobody asks for it; they look at the case and the result, which
/// must outlive the report.
struct Report {
    std::string command{}; ///< "campbell", ...: name of the files
    std::string heading{}; ///< of the page
    const model::Case *scene = nullptr;
    const results::ModelSummary *model = nullptr;
    Provenance provenance{}; ///< from whoever ran the analysis
    std::function<nlohmann::ordered_json(const Units &)>
        json{}; ///< keys beside those of every result
    std::function<std::string(const Units &)> csv{};
    std::function<std::vector<Section>(const Units &)>
        sections{};                                   ///< below the diagram of the page
    std::function<std::string(const Units &)> text{}; ///< for the terminal
    std::function<Chart(const Units &)> chart{};      ///< the main picture
    // What some commands have:
    std::function<Drawing(const Units &)> drawing{}; ///< in place of the chart
    std::function<std::vector<Picture>(const Units &)> pictures{};
    std::function<std::vector<TableFile>()> tables{}; ///< beside <command>.csv
    std::string pictures_heading{}; ///< of their section of the page, after as many others as
    std::size_t pictures_after = 0; ///< this
    /// What the script of the page draws beside the result: the key `drawn` of its data.
    std::function<nlohmann::ordered_json(const Units &)> drawn{};
    std::function<std::string()> vtp{}; ///< for ParaView
    // What a document takes of it:
    model::Sentence answer{}; ///< in one sentence
    /// Tables with the rows that matter most.
    std::function<std::vector<Section>(const Units &)> brief{};
    // Of a report that is a document itself, with no page of another kind:
    std::function<Document(const Units &)> document{};
    bool pdf = false; ///< printed to a file as well
};

/// What every command has to say of its result.
template <class Result> struct Parts {
    nlohmann::ordered_json (*json)(const Result &, const Units &);
    std::string (*csv)(const Result &, const Units &);
    std::vector<Section> (*sections)(const Result &, const Units &);
    std::string (*text)(const model::Case &, const Result &, const Units &);
    Chart (*chart)(const model::Case &, const Result &, const Units &);
};

/// The report of a result from its parts.
template <class Result>
[[nodiscard]] Report report_of(const std::string &command, const std::string &heading,
                               const model::Case &scene, const Result &result,
                               const Parts<Result> &parts) {
    Report report{.command = command, .heading = heading, .scene = &scene, .model = &result.model};
    report.json = [&result, json = parts.json](const Units &units) { return json(result, units); };
    report.csv = [&result, csv = parts.csv](const Units &units) { return csv(result, units); };
    report.sections = [&result, sections = parts.sections](const Units &units) {
        return sections(result, units);
    };
    report.text = [&scene, &result, text = parts.text](const Units &units) {
        return text(scene, result, units);
    };
    if (parts.chart)
        report.chart = [&scene, &result, chart = parts.chart](const Units &units) {
            return chart(scene, result, units);
        };
    return report;
}

/// Version of the program, as in the results.
[[nodiscard]] std::string program_version();

/// The result as JSON (keys: docs/case_format.md, "Results"): SI and radians, numbers with all
/// digits, null for what is missing or not finite.
/// With [units] json = true in those that were asked for, and a key `units` that says so.
[[nodiscard]] std::string to_json(const Report &report);
/// The same in the units of the page, for its scripts; `units` names them by quantity.
[[nodiscard]] std::string to_page_json(const Report &report);
/// The same always in SI.
[[nodiscard]] std::string to_si_json(const Report &report);
/// The text for the terminal, in the units that were asked for, with its notes.
/// @param last  where the rest is
[[nodiscard]] std::string to_text(const Report &report, const TextStyle &style = {},
                                  const std::string &last = "");

/// Whether a script draws the diagram on its page.
[[nodiscard]] bool moves(const Report &report);
/// A chart on a page: drawn by its script, or still where the build has no Plotly.
/// @param label  what it is, for those who do not see it
[[nodiscard]] std::string page_diagram(const std::string &label, const std::string &still);
/// The scripts that draw a page.
/// @param chart  whether there is one
/// @param own    of this page, which need no library
[[nodiscard]] std::string page_scripts(bool chart, const std::string &own);
/// One self-contained page: nothing is loaded from elsewhere.
/// @param still     SVG shown where no script can draw
/// @param pictures  SVG of the pictures beside the main one
/// @param files     names of those beside the page that it links to
[[nodiscard]] std::string to_html(const Report &report, const std::string &still,
                                  const std::string &pictures = "",
                                  const std::vector<std::string> &files = {});

/// What a page that is open already puts in place of what it shows, as JSON: `main`, HTML, with the
/// notes and the diagram first, and `result`, the data for its script as text. Without pictures
/// beside the main one; that is drawn by gnuplot where no script does it.
[[nodiscard]] std::string page_parts(const Report &report);

/// What a report has written.
struct Files {
    std::vector<std::filesystem::path> paths; ///< the main picture first
    std::vector<std::string> notes;           ///< what is missing and why, for the user
    std::string failure;                      ///< what was asked for and is missing; empty: nothing
};

/// Writes <command>.svg, .png, .json, .csv and report.html (and modes.vtp) into the folder, of a
/// document report.html, .json, .csv and .pdf; all or none of them, but for a PDF that no program
/// prints: the rest is there, and the failure says why. Without gnuplot the pictures it draws are
/// missing, which a note says.
/// @throws model::AnalysisFailure where a file cannot be written or a picture not drawn.
Files write_report(const Report &report, const std::filesystem::path &folder);

} // namespace whirl::report
