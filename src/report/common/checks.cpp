#include "report/common/checks.h"

#include "report/common/csv.h"
#include "report/common/html.h"
#include "report/common/words.h"

#include <fmt/format.h>
#include <pugixml.hpp>

#include <algorithm>
#include <cmath>

namespace whirl::report {

using results::Check;

namespace {

constexpr const char *no_value = "–";

/// A value or a limit with its unit, as readers want it.
std::string check_amount(const Check &check, const std::optional<double> &si, const Units &units) {
    if (!si || std::isnan(*si))
        return no_value;
    if (std::isinf(*si))
        return "no limit";
    if (check.percent)
        return readable(100 * *si, 4) + " %";
    const std::string text = units.text(check.quantity, *si, 4);
    return check.reading.empty() || units.unit(check.quantity).peak_to_peak
               ? text
               : text + " " + check.reading;
}

std::string check_limit(const Check &check, const Units &units) {
    const std::string text = check_amount(check, check.limit, units);
    return text == no_value ? text : (check.at_least ? "≥ " : "≤ ") + text;
}

std::string check_margin(const Check &check) {
    const std::optional<double> margin = check.margin();
    return margin ? readable(100 * *margin, 3) + " %" : no_value;
}

const char *check_result(const Check &check) {
    return !check.pass ? "not judged" : *check.pass ? "passes" : "FAILS";
}

/// Why it is not judged stands where the source of the limit would.
std::string check_source(const Check &check, const Units &units) {
    if (check.why.empty())
        return check.source;
    return units.text(check.why) + (check.source.empty() ? "" : " (" + check.source + ")");
}

/// The unit of value and limit in a file.
std::string check_unit(const Check &check, const Units &units) {
    return check.percent ? "" : units.name(check.quantity);
}

const OfEach of_check{[](const Check &check) { return check.quantity; }};

const Columns<Check> check_columns{
    {"name", InCsv("check"), ForReaders("Check"), &Check::name},
    {ForReaders("Value"),
     [](const Check &check, const Units &units) {
         return check_amount(check, check.value, units);
     }},
    {ForReaders("Limit"), check_limit},
    {ForReaders("Margin"), check_margin},
    {ForReaders("Result"), check_result},
    {InFiles("value"), of_check, &Check::value},
    {InFiles("limit"), of_check, &Check::limit},
    {InFiles("unit"), check_unit},
    {InFiles("pass"), &Check::pass},
    {InFiles("margin"), Quantity::number, [](const Check &check) { return check.margin(); }},
    {"at_least", [](const Check &check) { return check.at_least; }},
    {"reading", [](const Check &check) { return known_name(check.reading); }},
    {InFiles("where"), ForReaders("Where"),
     [](const Check &check, const Units &units) { return units.text(check.where); }},
    {InFiles("source"), &Check::source},
    {OnPage("Source of the limit"), check_source},
    {InFiles("why"),
     [](const Check &check, const Units &units) { return known_name(units.text(check.why)); }}};

} // namespace

Json checks_json(const std::vector<Check> &checks, const Units &units) {
    return json_rows(check_columns, checks, units);
}

std::string checks_csv(const std::vector<Check> &checks, const Units &units) {
    return csv_table(check_columns, checks, units);
}

std::string checks_page(const std::vector<Check> &checks, const Units &units) {
    if (checks.empty())
        return "";
    pugi::xml_document document;
    pugi::xml_node table = document.append_child("table");
    table.append_attribute("class") = "checks";
    const Texts texts = texts_of(check_columns, checks, &Column<Check>::page, no_value, units);
    for (std::size_t row = 0; row < texts.size(); ++row) {
        const bool head = row == 0;
        pugi::xml_node line = (head       ? table.append_child("thead")
                               : row == 1 ? table.append_child("tbody")
                                          : table.child("tbody"))
                                  .append_child("tr");
        for (std::size_t column = 0; column < texts[row].size(); ++column) {
            pugi::xml_node cell = line.append_child(head ? "th" : "td");
            if (!head && texts[row][column] == check_result(checks[row - 1]))
                cell.append_attribute("class") = !checks[row - 1].pass   ? "open"
                                                 : *checks[row - 1].pass ? "passes"
                                                                         : "fails";
            cell.text().set(printable(texts[row][column]).c_str());
        }
    }
    return markup(document);
}

std::string checks_text(const std::vector<Check> &checks, std::size_t most, const Units &units) {
    if (checks.empty())
        return "";
    const std::size_t shown = checks.size() <= most ? checks.size() : most - 1;
    const std::vector<Check> first(checks.begin(),
                                   checks.begin() + static_cast<std::ptrdiff_t>(shown));
    return text_table(check_columns, first, units) +
           (shown < checks.size()
                ? fmt::format("  and {} more, in the report\n", checks.size() - shown)
                : "");
}

} // namespace whirl::report
