#include "cli/table.h"

#include <fmt/format.h>

#include <algorithm>

namespace whirl::cli {

std::string Table::text() const {
    std::vector<std::size_t> widths;
    for (const auto &row : _rows) {
        widths.resize(std::max(widths.size(), row.size()));
        for (std::size_t i = 0; i < row.size(); ++i)
            widths[i] = std::max(widths[i], row[i].size());
    }
    std::string out;
    for (const auto &row : _rows) {
        for (std::size_t i = 0; i < row.size(); ++i)
            out += i == 0 ? fmt::format("  {:<{}}", row[i], widths[i])
                          : fmt::format("   {:>{}}", row[i], widths[i]);
        out.erase(out.find_last_not_of(' ') + 1);
        out += '\n';
    }
    return out;
}

} // namespace whirl::cli
