#include "report/common/csv.h"

#include <fmt/format.h>

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
        const double number = value.get<double>();
        return std::isfinite(number) ? fmt::format("{}", number) : "";
    }
    if (!value.is_string())
        return value.is_null() ? "" : value.dump();
    const std::string text = value.get<std::string>();
    return text.find_first_of(",\"\r\n") == std::string::npos ? text : in_quotes(text);
}

std::string csv_line(const std::vector<std::string> &cells) {
    return fmt::format("{}\n", fmt::join(cells, ","));
}

} // namespace whirl::report
