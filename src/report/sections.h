#pragma once

#include "report/common/table.h"
#include "report/report.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <string>
#include <vector>

namespace whirl::report {

/// A table below its heading; nothing without rows.
/// @param most  rows: of more the first
template <class Row, class Rows>
void add_table(std::vector<Section> &sections, const std::string &heading,
               const Columns<Row> &columns, const Rows &rows, const Units &units,
               std::size_t most = SIZE_MAX) {
    if (!rows.empty())
        sections.push_back({heading, page_table_of_first(most, columns, rows, units)});
}

inline void add_sections(std::vector<Section> &sections, std::vector<Section> more) {
    std::ranges::move(more, std::back_inserter(sections));
}

} // namespace whirl::report
