#include "report/report.h"
#include "report/common/csv.h"
#include "report/common/files.h"
#include "report/common/html.h"
#include "report/common/plot_jobs.h"
#include "report/common/table.h"
#include "report/common/units.h"
#include "report/common/words.h"
#include "report/compare/comparison.h"

#include <fmt/format.h>

namespace whirl::report {

namespace {

std::string verdict(const Difference &at) {
    if (!at.difference)
        return at.first_value ? "only in the first" : "only in the other";
    if (!at.within)
        return "error not known";
    return *at.within ? "within errors" : "beyond errors";
}

const OfEach of_difference{[](const Difference &at) { return at.quantity; }};

const Columns<Difference> columns{
    {OnPage("No."), InText(""), [](const auto &, std::size_t i) { return i + 1; }},
    {InFiles("quantity"), Titled("Quantity"),
     [](const Difference &at, const Units &units) { return units.text(at.name); }},
    {InFiles("unit"), Titled("Unit"),
     [](const Difference &at, const Units &units) { return units.name(at.quantity); }},
    {InFiles("other"), OnPage("Other result"), &Difference::other},
    {InFiles("first_value"), OnPage("First", "{:.10g}"), InText("first", precise), of_difference,
     &Difference::first_value},
    {InFiles("other_value"), OnPage("Other", "{:.10g}"), InText("other", precise), of_difference,
     &Difference::other_value},
    {InFiles("difference"), Titled("Difference", "{:+.6g}"), of_difference,
     &Difference::difference},
    {InFiles("relative"), Titled("Relative to first", "{:+.3g}"), Quantity::number,
     &Difference::relative},
    {InFiles("error"), OnPage("Both error bars", "{:.5g}"), InText("error bars", rough),
     of_difference, &Difference::error},
    {InFiles("within_errors"), &Difference::within},
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

/// Those of all results, one after another.
std::vector<Difference> all_of(const Comparison &comparison) {
    std::vector<Difference> all;
    for (const std::vector<Difference> &of : comparison.differences)
        all.insert(all.end(), of.begin(), of.end());
    return all;
}

/// "after.json against before.json".
std::string against_first(const Comparison &comparison, std::size_t index) {
    return comparison.results[index].name + " against " + comparison.results[0].name;
}

std::string sections(const Comparison &comparison, const Units &units) {
    std::string html = element("h2", "Results");
    for (std::size_t i = 0; i < comparison.results.size(); ++i)
        html += element("p", result_text(comparison.results[i], i));
    for (std::size_t i = 1; i < comparison.results.size(); ++i)
        html += element("h2", against_first(comparison, i)) +
                page_table(columns, comparison.differences[i - 1], units);
    return html;
}

std::string page_of(const Comparison &comparison, const Units &units, const std::string &still,
                    const std::vector<std::string> &files) {
    std::string notes;
    for (const std::string &note : comparison.notes)
        notes += element("p", note, "note");
    std::string cases;
    std::string date;
    for (const ComparedResult &result : comparison.results)
        if (const auto found = result.json.find("provenance"); found != result.json.end()) {
            date = found->value("date", "");
            cases += "# " + result.name + "\n";
            for (const Json &entry : found->value("set", Json::array()))
                cases += "# --set \"" + entry.get<std::string>() + "\"\n";
            cases += found->value("case", "") + "\n";
        }
    Json json = comparison_json(comparison, {});
    json["chart"] = chart_json(comparison_chart(comparison, units));
    return with_contents(
        filled(embedded("page.html"),
               {{"heading", "Comparison"},
                {"title", escaped("Comparison: " + comparison.command)},
                {"case", escaped(comparison.results.front().name)},
                {"command", "compare"},
                {"version", program_version()},
                {"style", embedded("page.css")},
                {"notes", notes},
                {"rotor", ""},
                {"files", file_links(files)},
                {"page_script", embedded("page.js") + embedded("tables.js")},
                {"plot", page_diagram("Results side by side and their differences", still)},
                {"sections", sections(comparison, units)},
                {"model", ""},
                {"date", date},
                {"case_text", escaped(cases)},
                {"json", json_for_script(json_text(json))},
                {"scripts", page_scripts(true, "")}}));
}

} // namespace

std::string comparison_text(const Comparison &comparison, const Units &units) {
    std::string text = "Comparison of results of " + comparison.command + "\n";
    for (std::size_t i = 0; i < comparison.results.size(); ++i)
        text += "  " + result_text(comparison.results[i], i) + "\n";
    for (std::size_t i = 1; i < comparison.results.size(); ++i) {
        const std::vector<Difference> &of = comparison.differences[i - 1];
        text += "\n" + against_first(comparison, i) + ":\n" +
                (of.empty() ? "  nothing to compare\n" : text_table(columns, of, units));
    }
    for (const std::string &note : comparison.notes)
        text += "note: " + note + "\n";
    return text;
}

Json comparison_json(const Comparison &comparison, const Units &units) {
    Json results = Json::array();
    for (const ComparedResult &result : comparison.results) {
        Json entry{{"name", result.name}};
        for (const char *key : {"case", "title", "version", "order", "elements", "provenance"})
            if (const auto found = result.json.find(key); found != result.json.end())
                entry[key] = *found;
        results.push_back(entry);
    }
    Json json{{"program", "whirl"},
              {"version", program_version()},
              {"format", 1},
              {"command", "compare"},
              {"of", comparison.command},
              {"results", results},
              {"differences", json_rows(columns, all_of(comparison), units)},
              {"notes", comparison.notes}};
    if (units.asked())
        json["units"] = unit_names(units);
    return json;
}

std::vector<std::filesystem::path> write_comparison(const Comparison &comparison,
                                                    const std::filesystem::path &folder,
                                                    const model::OutputUnits &asked) {
    OutputFiles files(folder);
    PlotJobs jobs;
    const Units readers = Units::of_readers(asked);
    // Spin speeds of several cases: no operating speeds behind them.
    const Figure figure = chart_figure(comparison_chart(comparison, readers), {}, readers);
    std::string still;
    files.announce("compare.svg");
    files.announce("compare.png");
    if (jobs.start(figure, PictureFormat::svg, "compare.svg")) {
        jobs.start(figure, PictureFormat::png, "compare.png");
        for (auto &[name, picture] : jobs.finish()) {
            if (name == "compare.svg")
                still = picture_element(picture, "Results side by side and their differences");
            files.add(name, std::move(picture));
        }
    }
    files.add("compare.json", json_text(comparison_json(comparison, Units::of_json(asked))));
    files.add("compare.csv", csv_table(columns, all_of(comparison), Units::of_files(asked)));
    std::vector<std::string> linked{"compare.json", "compare.csv"};
    if (!still.empty())
        linked.insert(linked.end(), {"compare.svg", "compare.png"});
    files.add("report.html", page_of(comparison, readers, still, linked));
    return files.commit();
}

} // namespace whirl::report
