#include "report/report.h"
#include "report/common/csv.h"
#include "report/common/files.h"
#include "report/common/gnuplot.h"
#include "report/common/html.h"
#include "report/common/table.h"
#include "report/common/units.h"
#include "report/common/words.h"
#include "report/compare/comparison.h"
#include "report/compare/picture.h"

#include <fmt/format.h>

#include <fstream>
#include <sstream>

namespace whirl::report {

namespace {

/// A difference with the name of the other result.
struct Line : Difference {
    std::string other_name;
};

std::vector<Line> lines_of(const Comparison &comparison) {
    std::vector<Line> lines;
    for (const Difference &at : comparison.differences)
        lines.push_back({at, comparison.results[at.other].name});
    return lines;
}

std::string verdict(const Line &line) {
    if (!line.difference)
        return line.first_value ? "only in the first" : "only in the other";
    if (!line.within)
        return "error not known";
    return *line.within ? "within errors" : "beyond errors";
}

/// The unit in which a number is read.
struct LineUnit {
    std::string name;
    double factor = 1;
};
LineUnit unit_of(const Difference &at) {
    const auto is_of = [&at](const char *word) {
        return at.quantity.find(word) != std::string::npos;
    };
    std::string quantity = quantity_in(at.unit);
    if (at.unit == "rad/s" && is_of("frequency"))
        quantity = "frequency";
    if (at.unit == "m" && !is_of("centre of mass") && !is_of("length"))
        quantity = "amplitude";
    const auto factor = written_factor(quantity);
    return factor ? LineUnit{unit_name(quantity, at.unit), *factor} : LineUnit{at.unit, 1};
}
auto in_its_unit(std::optional<double> Difference::*of) {
    return [of](const Line &line) { return times(unit_of(line).factor, line.*of); };
}

const Columns<Line> columns{
    {OnPage("No."), InText(""), [](const auto &, std::size_t i) { return i + 1; }},
    {"quantity", InCsv("quantity"), OnPage("Quantity"), InText("quantity"), &Line::quantity},
    {"unit", &Line::unit},
    {"first_value", &Line::first_value},
    {"other_value", &Line::other_value},
    {"difference", &Line::difference},
    {"error", &Line::error},
    {InCsv("unit"), OnPage("Unit"), InText("unit"),
     [](const Line &line) { return unit_of(line).name; }},
    {"other", InCsv("other"), OnPage("Other result"), &Line::other_name},
    {InCsv("first_value"), OnPage("First", "{:.10g}"), InText("first", precise),
     in_its_unit(&Difference::first_value)},
    {InCsv("other_value"), OnPage("Other", "{:.10g}"), InText("other", precise),
     in_its_unit(&Difference::other_value)},
    {InCsv("difference"), OnPage("Difference", "{:+.6g}"), InText("difference", "{:+.6g}"),
     in_its_unit(&Difference::difference)},
    {"relative", InCsv("relative"), OnPage("Relative to first", "{:+.3g}"),
     InText("relative to first", "{:+.3g}"), &Line::relative},
    {InCsv("error"), OnPage("Both error bars", "{:.5g}"), InText("error bars", rough),
     in_its_unit(&Difference::error)},
    {"within_errors", InCsv("within_errors"), &Line::within},
    {OnPage("Verdict"), InText(""), verdict}};

/// "1: before.json, critical, order 10, 3 elements".
std::string result_text(const ComparedResult &result, std::size_t index) {
    const Json &json = result.json;
    const auto word = [&json](const char *key) {
        const auto found = json.find(key);
        return found == json.end()  ? std::string("?")
               : found->is_string() ? found->get<std::string>()
                                    : found->dump();
    };
    return fmt::format("{}: {} (case {}, order {}, {} elements, {})", index + 1, result.name,
                       word("case"), word("order"), word("elements"), word("title"));
}

std::vector<Line> of_other(const std::vector<Line> &lines, std::size_t other) {
    std::vector<Line> out;
    for (const Line &line : lines)
        if (line.other == other)
            out.push_back(line);
    return out;
}

std::string sections(const Comparison &comparison) {
    std::string html = element("h2", "Results");
    for (std::size_t i = 0; i < comparison.results.size(); ++i)
        html += element("p", result_text(comparison.results[i], i));
    const auto lines = lines_of(comparison);
    for (std::size_t i = 1; i < comparison.results.size(); ++i)
        html += element("h2", fmt::format("{} against {}", comparison.results[i].name,
                                          comparison.results[0].name)) +
                in_written_units(page_table(columns, of_other(lines, i)));
    return html;
}

std::string page_of(const Comparison &comparison, const std::string &still,
                    const std::vector<std::string> &files) {
    std::string notes;
    for (const std::string &note : comparison.notes)
        notes += element("p", note, "note");
    std::string cases;
    std::string date;
    for (const ComparedResult &result : comparison.results)
        if (const auto found = result.json.find("provenance"); found != result.json.end()) {
            date = found->value("date", "");
            cases += "# " + result.name + "\n" + found->value("case", "") + "\n";
        }
    return with_contents(filled(embedded("page.html"),
                                {{"heading", "Comparison"},
                                 {"title", escaped("Comparison: " + comparison.command)},
                                 {"case", escaped(comparison.results.front().name)},
                                 {"command", "compare"},
                                 {"version", program_version()},
                                 {"style", embedded("page.css")},
                                 {"notes", notes},
                                 {"rotor", ""},
                                 {"files", file_links(files)},
                                 {"page_script", embedded("page.js")},
                                 {"plot", still},
                                 {"sections", sections(comparison)},
                                 {"model", ""},
                                 {"date", date},
                                 {"case_text", escaped(cases)},
                                 {"json", json_for_script(json_text(comparison_json(comparison)))},
                                 {"scripts", ""}}));
}

std::string element_of(const std::filesystem::path &svg) {
    std::ifstream file(svg, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return picture_element(text.str(), "Results side by side and their differences");
}

} // namespace

std::string comparison_text(const Comparison &comparison) {
    std::string text = "Comparison of results of " + comparison.command + "\n";
    for (std::size_t i = 0; i < comparison.results.size(); ++i)
        text += "  " + result_text(comparison.results[i], i) + "\n";
    const auto lines = lines_of(comparison);
    for (std::size_t i = 1; i < comparison.results.size(); ++i) {
        const auto of = of_other(lines, i);
        text += fmt::format("\n{} against {}:\n", comparison.results[i].name,
                            comparison.results[0].name) +
                (of.empty() ? "  nothing to compare\n" : text_table(columns, of));
    }
    for (const std::string &note : comparison.notes)
        text += "note: " + note + "\n";
    return text;
}

Json comparison_json(const Comparison &comparison) {
    Json results = Json::array();
    for (const ComparedResult &result : comparison.results) {
        Json entry{{"name", result.name}};
        for (const char *key : {"case", "title", "version", "order", "elements", "provenance"})
            if (const auto found = result.json.find(key); found != result.json.end())
                entry[key] = *found;
        results.push_back(entry);
    }
    return {{"program", "whirl"},
            {"version", program_version()},
            {"format", 1},
            {"command", "compare"},
            {"of", comparison.command},
            {"results", results},
            {"differences", json_rows(columns, lines_of(comparison))},
            {"notes", comparison.notes}};
}

std::vector<std::filesystem::path> write_comparison(const Comparison &comparison,
                                                    const std::filesystem::path &folder) {
    OutputFiles files(folder);
    PlotJobs jobs;
    Figure figure = comparison_figure(comparison);
    figure.script = script_in_written_units(figure.script);
    std::string still;
    const auto svg = files.reserve("compare.svg");
    if (jobs.start(figure, PictureFormat::svg, svg)) {
        jobs.start(figure, PictureFormat::png, files.reserve("compare.png"));
        jobs.finish();
        still = element_of(svg);
    } else {
        files.drop("compare.svg"); // no gnuplot
    }
    files.add("compare.json", json_text(comparison_json(comparison)));
    files.add("compare.csv", csv_table(columns, lines_of(comparison)));
    std::vector<std::string> linked{"compare.json", "compare.csv"};
    if (!still.empty())
        linked.insert(linked.end(), {"compare.svg", "compare.png"});
    files.add("report.html", page_of(comparison, still, linked));
    return files.commit();
}

} // namespace whirl::report
