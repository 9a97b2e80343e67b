#include "report/html_pages.h"

#include "report/html.h"
#include "report/html_scripts.h"
#include "report/json.h"
#include "report/plot_style.h"

#include <fmt/format.h>

namespace whirl::report {

namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string bands_table(const std::vector<std::pair<double, double>> &bands) {
    Rows rows;
    for (const auto &[from, to] : bands)
        rows.push_back({readable(from, 10), readable(to, 10), readable(from * rpm, 8),
                        readable(to * rpm, 8), readable(to - from, 4)});
    if (rows.empty())
        return "<p>None in this range.</p>\n";
    return html_table({"From (rad/s)", "to (rad/s)", "from (rpm)", "to (rpm)", "width (rad/s)"},
                      rows);
}

std::string speeds_table(const analyses::StabilityResult &result) {
    Rows rows;
    for (const double speed : result.critical_speeds)
        rows.push_back({"critical, balls held", readable(speed, 10), readable(speed * rpm, 8)});
    for (const double speed : result.additional_speeds)
        rows.push_back(
            {"additional: pinned at the balancers", readable(speed, 10), readable(speed * rpm, 8)});
    return rows.empty() ? "<p>None in this range.</p>\n"
                        : html_table({"Kind", "rad/s", "rpm"}, rows);
}

std::string permissible_table(const analyses::StabilityResult &result) {
    Rows rows;
    const auto text = [](const std::optional<double> &value) {
        return value ? readable(*value, 8) : "–";
    };
    for (const auto &entry : result.permissible)
        rows.push_back({entry.name, readable(entry.z), text(entry.dI), text(entry.closed_form)});
    return html_table({"Element", "z (m)", "largest dI (kg m²)", "rigid closed form (kg m²)"},
                      rows);
}

} // namespace

std::string to_html(const model::Case &scene, const analyses::StabilityResult &result,
                    const std::string &picture) {
    PageContent parts{
        "stability", "Stability", plot_script("stability"), picture, to_json(scene, result), {}};
    parts.sections.emplace_back("Unstable spin speeds", bands_table(result.unstable));
    if (!result.critical_speeds.empty() || !result.additional_speeds.empty())
        parts.sections.emplace_back("Speeds at which something stands still in rotating axes",
                                    speeds_table(result));
    if (!result.permissible.empty())
        parts.sections.emplace_back("Permissible inertial anisotropy", permissible_table(result));
    if (result.family) {
        const auto &family = *result.family;
        parts.sections.emplace_back(
            fmt::format("Unstable with some of {} arrangements of the balls", family.arrangements),
            bands_table(family.unstable));
        parts.sections.emplace_back("Unstable with every one of them",
                                    bands_table(family.always_unstable));
        parts.sections.emplace_back("Critical speeds over the arrangements",
                                    bands_table(family.critical_speeds));
        parts.sections.emplace_back("Additional speeds over the arrangements",
                                    bands_table(family.additional_speeds));
    }
    return page(scene, result.model, parts);
}

} // namespace whirl::report
