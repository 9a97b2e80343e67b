#include "report/html_pages.h"

#include "report/drawing.h"
#include "report/html.h"
#include "report/html_scripts.h"
#include "report/json.h"
#include "report/plot_style.h"
#include "results/rigid_limit.h"

#include <fmt/format.h>

#include <cmath>

namespace whirl::report {

namespace {

using results::RigidLimitResult;
using results::RigidLimitRow;
using Rows = std::vector<std::vector<std::string>>;

std::string cell(std::optional<double> value, int digits) {
    return value && std::isfinite(*value) ? readable(*value, digits) : "–";
}

std::string label(const RigidLimitRow &row) {
    return row.unit.empty() ? row.quantity : fmt::format("{} ({})", row.quantity, row.unit);
}

/// First and last point of every row, and the rate.
std::string ends_table(const RigidLimitResult &result, bool mesh) {
    Rows rows;
    for (const RigidLimitRow &row : result.rows) {
        if (row.elements.empty() == mesh || row.fe.empty())
            continue;
        std::vector<std::string> cells{label(row)};
        if (mesh)
            cells.push_back(row.order == 1 ? "classical" : fmt::format("order {}", row.order));
        cells.push_back(readable(row.closed_form, 10));
        cells.push_back(cell(row.fe.front(), 10));
        cells.push_back(cell(row.relative_difference.front(), 3));
        cells.push_back(cell(row.fe.back(), 10));
        cells.push_back(cell(row.relative_difference.back(), 3));
        cells.push_back(cell(row.rate, 5));
        if (!mesh)
            cells.push_back(cell(row.rigid, 12));
        rows.push_back(cells);
    }
    if (mesh)
        return html_table({"Quantity", "elements of", "closed form", "finest mesh", "difference",
                           "coarsest mesh", "difference", "slope"},
                          rows);
    return html_table({"Quantity", "closed form", "softest shaft", "difference", "stiffest shaft",
                       "difference", "rate", "rigid model"},
                      rows);
}

/// Relative differences of the speeds at every stiffness.
std::string sweep_table(const RigidLimitResult &result) {
    std::vector<std::string> head{"Factor of E and G", "48 EI/L³ (N/m)", "over the bearings"};
    Rows rows;
    for (const RigidLimitRow &row : result.rows) {
        if (!row.elements.empty())
            continue;
        head.push_back(row.quantity);
        rows.resize(row.fe.size());
        for (std::size_t k = 0; k < row.fe.size(); ++k) {
            if (rows[k].empty())
                rows[k] = {cell(row.factor[k], 4), cell(row.stiffness[k], 4),
                           cell(row.stiffness[k] / result.bearing_stiffness, 4)};
            rows[k].push_back(cell(row.relative_difference[k], 3));
        }
    }
    return html_table(head, rows);
}

} // namespace

std::string to_html(const model::Case &scene, const RigidLimitResult &result,
                    const std::string &picture) {
    PageContent parts{"rigid-limit",
                      "Flexible model and rigid closed forms",
                      plot_script("rigid-limit"),
                      picture,
                      to_json(scene, result),
                      {}};
    parts.sections.emplace_back("From which stiffness the rigid formulas do",
                                "<p>" + escape_markup(result.sentence) + "</p>\n");
    parts.sections.emplace_back("While the shaft stiffens", ends_table(result, false));
    parts.sections.emplace_back("Relative differences", sweep_table(result));
    parts.sections.emplace_back(
        std::isfinite(result.mesh_factor)
            ? fmt::format("While the mesh coarsens, E and G times {}", readable(result.mesh_factor))
            : "On the mesh",
        ends_table(result, true));
    return page(scene, result.model, parts);
}

} // namespace whirl::report
