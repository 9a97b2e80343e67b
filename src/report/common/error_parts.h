#pragma once

#include "report/common/table.h"
#include "results/error_parts.h"

#include <utility>

namespace whirl::report {

/// A part of the error of a row that has one error.
inline auto error_part(double results::ErrorParts::*part) {
    return [part](const auto &row) { return row.error_parts.*part; };
}

/// The columns, and behind them those of the parts of an error.
/// @param of  from a member of results::ErrorParts to what reads it from a row
template <class Row, class Of>
[[nodiscard]] Columns<Row> with_error_parts(Columns<Row> columns, const Of &of) {
    using results::ErrorParts;
    for (const auto &[name, part] : {std::pair("error_mesh", &ErrorParts::mesh),
                                     std::pair("error_reduction", &ErrorParts::reduction),
                                     std::pair("error_rounding", &ErrorParts::rounding)})
        columns.push_back(Column<Row>{name, InCsv(name), Quantity::number, of(part)});
    return columns;
}

} // namespace whirl::report
