#include "report/csv_cell.h"

#include <fmt/format.h>

#include <cmath>

namespace whirl::report {

std::string csv_cell(std::optional<double> value) {
    return value && std::isfinite(*value) ? fmt::format("{}", *value) : "";
}

std::string csv_cell(const std::string &text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos)
        return text;
    std::string quoted = "\"";
    for (const char letter : text)
        quoted += letter == '"' ? "\"\"" : std::string(1, letter);
    return quoted + "\"";
}

std::string csv_cell(const std::vector<double> &values, std::size_t i) {
    return i < values.size() ? csv_cell(values[i]) : "";
}

} // namespace whirl::report
