#include "report/common/csv.h"

#include "report/common/text_width.h"
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

} // namespace

std::string csv_cell(const Json &value) {
    if (value.is_number_float()) {
        const auto number = value.get<double>();
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

std::string csv_head_line(const std::vector<CsvHeading> &head, const Units &units) {
    const auto text = [&units](const CsvHeading &heading) {
        return csv_cell(units.heading(heading.name, heading.quantity));
    };
    return joined(head, ",", text) + "\n";
}

std::string csv_line(const std::vector<std::string> &cells) { return joined(cells, ",") + "\n"; }

std::string csv_lists(const std::vector<CsvList> &lists, const Units &units) {
    Columns<std::size_t> columns;
    for (const CsvList &list : lists)
        columns.push_back({InCsv(list.heading.name), list.heading.quantity,
                           [&values = list.values](const std::size_t &, std::size_t i) {
                               return i < values.size() ? values[i] : Json();
                           }});
    return csv_table(columns, std::vector<std::size_t>(lists.front().values.size()), units);
}

} // namespace whirl::report
