#include "report/csv.h"

#include "results/rigid_limit.h"
#include <fmt/format.h>

#include <cmath>

namespace whirl::report {

namespace {

std::string cell(std::optional<double> value) {
    return value && std::isfinite(*value) ? fmt::format("{}", *value) : "";
}

/// Names of planes come from the case: quoted.
std::string quoted(const std::string &text) {
    std::string out = "\"";
    for (const char letter : text)
        out += letter == '"' ? std::string("\"\"") : std::string(1, letter);
    return out + '"';
}

} // namespace

std::string to_csv(const results::RigidLimitResult &result) {
    // A point of the stiffness sweep has a stiffness, one of the mesh sweep a number of elements;
    // the rigid model has neither a factor nor a stiffness.
    std::string csv = "quantity,unit,order,elements,factor of E and G,stiffness [N/m],closed "
                      "form,model,relative difference,rate\n";
    for (const auto &row : result.rows)
        for (std::size_t k = 0; k < row.fe.size(); ++k)
            csv += fmt::format(
                "{},{},{},{},{},{},{},{},{},{}\n", quoted(row.quantity), row.unit, row.order,
                row.elements.empty() ? result.model.elements : row.elements[k], cell(row.factor[k]),
                row.stiffness.empty() ? "" : cell(row.stiffness[k]), row.closed_form,
                cell(row.fe[k]), cell(row.relative_difference[k]), cell(row.rate));
    return csv;
}

} // namespace whirl::report
