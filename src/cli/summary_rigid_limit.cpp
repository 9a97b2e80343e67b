#include "cli/summary.h"

#include "cli/table.h"
#include "cli/words.h"
#include "results/rigid_limit.h"

#include <fmt/format.h>

#include <cmath>

namespace whirl::cli {

namespace {

using results::RigidLimitResult;
using results::RigidLimitRow;

std::string rate_text(const RigidLimitRow &row) {
    return row.rate ? fmt::format("{:.4f}", *row.rate) : "-";
}

std::string stiffness_table(const RigidLimitResult &result) {
    Table table({"quantity", "closed form", "softest shaft", "difference", "stiffest shaft",
                 "difference", "rate"});
    for (const RigidLimitRow &row : result.rows)
        if (row.elements.empty() && !row.fe.empty())
            table.add({row.quantity, precise(row.closed_form), precise(row.fe.front()),
                       rough(row.relative_difference.front()), precise(row.fe.back()),
                       rough(row.relative_difference.back()), rate_text(row)});
    return table.text();
}

/// Differences on the finest and the coarsest mesh.
std::string mesh_table(const RigidLimitResult &result) {
    Table table(
        {"quantity", "closed form", "order", "elements", "difference", "elements", "difference"});
    for (const RigidLimitRow &row : result.rows)
        if (!row.elements.empty())
            table.add({row.quantity, precise(row.closed_form), std::to_string(row.order),
                       std::to_string(row.elements.front()), rough(row.relative_difference.front()),
                       std::to_string(row.elements.back()), rough(row.relative_difference.back())});
    return table.text();
}

} // namespace

std::string summary(const model::Case &scene, const RigidLimitResult &result) {
    std::string text = heading(scene, "Flexible model and rigid closed forms");
    text += result.sentence + "\n\n";
    if (std::isfinite(result.stiffness))
        text += "While the shaft stiffens (E and G multiplied, bearings as they are):\n";
    text += stiffness_table(result);
    text +=
        std::isfinite(result.mesh_factor)
            ? fmt::format("\nWhile the mesh coarsens, E and G times {:.4g}:\n", result.mesh_factor)
            : "\nOn the mesh:\n";
    return text + mesh_table(result) + model_text(result.model);
}

} // namespace whirl::cli
