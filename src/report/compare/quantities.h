#pragma once

#include "report/common/json.h"

#include <optional>
#include <string>
#include <vector>

namespace whirl::report {

/// A result to be compared: what `--json` writes, and what it is called.
struct ComparedResult {
    std::string name;
    Json json;
};

/// A number of a result that others have too.
struct Quantity {
    std::string name; ///< by which it is matched: "critical speed, forward 2"
    std::string unit; ///< SI; empty: a ratio
    double value = 0;
    std::optional<double> error; ///< half width of its error bar, in the same unit; none: not known
};

/// The numbers of a result: critical speeds by whirl and number, whirl frequencies at
/// the first and the last speed by mode, crossings, peaks by place and number, ends of bands by
/// number, masses.
/// @throws model::BadInput for results of commands that have none of these.
[[nodiscard]] std::vector<Quantity> quantities_of(const ComparedResult &result);

} // namespace whirl::report
