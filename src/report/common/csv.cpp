#include "report/common/csv.h"

#include "report/common/text_width.h"
#include "report/common/units.h"
#include "report/common/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace whirl::report {

namespace {

std::string in_quotes(const std::string &text) {
    std::string quoted = "\"";
    for (const char letter : text)
        quoted += letter == '"' ? "\"\"" : std::string(1, letter);
    return quoted + "\"";
}

UnitHeading converted(const std::string &heading) {
    const bool has_unit = heading.ends_with("]") || heading.ends_with("]\"");
    return has_unit ? heading_in_written_units(heading, "") : UnitHeading{heading, 1, false};
}

} // namespace

std::string csv_cell(const Json &value, double factor) {
    if (value.is_number_float() || (value.is_number() && factor != 1)) {
        const double number = value.get<double>() * factor;
        return std::isfinite(number) ? fmt::format("{}", number) : "";
    }
    if (!value.is_string())
        return value.is_null() ? "" : value.dump();
    std::string text = printable(value.get<std::string>());
    const bool formula =
        std::ranges::any_of(std::array{"=", "+", "-", "@", "＝", "＋", "－", "＠"},
                            [&text](const char *sign) { return text.starts_with(sign); });
    if (formula)
        text.insert(0, "'");
    return formula || text.find_first_of(",;\"") != std::string::npos ? in_quotes(text) : text;
}

std::string csv_head_line(const std::vector<std::string> &head) {
    const auto text = [](const std::string &heading) { return converted(heading).text; };
    return joined(head, ",", text) + "\n";
}

std::vector<double> csv_factors(const std::vector<std::string> &head) {
    std::vector<double> factors;
    for (const std::string &heading : head)
        factors.push_back(converted(heading).factor);
    return factors;
}

std::string csv_line(const std::vector<std::string> &cells) { return joined(cells, ",") + "\n"; }

std::string csv_lists(const std::vector<std::pair<std::string, Json>> &lists) {
    Columns<std::size_t> columns;
    for (const auto &[heading, values] : lists)
        columns.push_back({InCsv(heading), [&list = values](const std::size_t &, std::size_t i) {
                               return i < list.size() ? list[i] : Json();
                           }});
    return csv_table(columns, std::vector<std::size_t>(lists.front().second.size()));
}

} // namespace whirl::report
