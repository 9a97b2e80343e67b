#pragma once

#include "report/common/table.h"

#include <vector>

namespace whirl::report {

/// Without the columns in which no row has anything.
template <class Row, class Rows>
[[nodiscard]] Columns<Row> without_empty(Columns<Row> columns, const Rows &rows) {
    std::erase_if(columns, [&rows](const Column<Row> &column) {
        for (std::size_t index = 0; const Row &row : rows)
            if (!column.value(row, index++).is_null())
                return false;
        return true;
    });
    return columns;
}

} // namespace whirl::report
