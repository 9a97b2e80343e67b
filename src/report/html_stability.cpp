#include "report/html_pages.h"

#include "report/html.h"
#include "report/html_scripts.h"
#include "report/json.h"
#include "report/plot_style.h"
#include "results/stability.h"

#include <fmt/format.h>

namespace whirl::report {

namespace {

using Rows = std::vector<std::vector<std::string>>;

/// @param errors  of both ends, or empty
std::string bands_table(const std::vector<std::pair<double, double>> &bands,
                        const std::vector<std::pair<double, double>> &errors = {}) {
    Rows rows;
    for (const auto &[from, to] : bands)
        rows.push_back({readable(from, 10), readable(to, 10), readable(from * rpm, 8),
                        readable(to * rpm, 8), readable(to - from, 4)});
    if (rows.empty())
        return "<p>None in this range.</p>\n";
    std::vector<std::string> heads{"From (rad/s)", "to (rad/s)", "from (rpm)", "to (rpm)",
                                   "width (rad/s)"};
    if (errors.size() == bands.size()) {
        heads.insert(heads.end(), {"error of from (rad/s)", "error of to (rad/s)"});
        for (std::size_t i = 0; i < errors.size(); ++i)
            rows[i].insert(rows[i].end(),
                           {readable(errors[i].first, 2), readable(errors[i].second, 2)});
    }
    return html_table(heads, rows);
}

/// Of one speed: what becomes of a small motion there.
std::string verdict_text(const results::StabilityResult &result) {
    const std::string name = results::verdict_name(result.verdict.front());
    if (name.empty())
        return "<p>No answer at this speed.</p>\n";
    return fmt::format("<p>{} at {} rad/s: largest growth {} 1/s.</p>\n", name,
                       readable(result.speeds.front()), readable(result.growth.front(), 8));
}

std::string speeds_table(const results::StabilityResult &result) {
    Rows rows;
    for (const double speed : result.critical_speeds)
        rows.push_back(
            {"critical, balls held, undamped", readable(speed, 10), readable(speed * rpm, 8)});
    for (const double speed : result.zero_root_speeds)
        rows.push_back({"a root is zero: a motion stands still and neither grows nor dies out",
                        readable(speed, 10), readable(speed * rpm, 8)});
    for (const double speed : result.additional_speeds)
        rows.push_back(
            {"additional: pinned at the balancers", readable(speed, 10), readable(speed * rpm, 8)});
    return rows.empty() ? "<p>None in this range.</p>\n"
                        : html_table({"Kind", "rad/s", "rpm"}, rows);
}

std::string permissible_table(const results::StabilityResult &result) {
    Rows rows;
    const auto text = [](const std::optional<double> &value) {
        return value ? readable(*value, 8) : "–";
    };
    for (const auto &entry : result.permissible)
        rows.push_back({entry.name, readable(entry.z),
                        entry.dI ? text(entry.dI) : "stable up to the most there can be",
                        readable(entry.most, 8), text(entry.closed_form)});
    return html_table({"Element", "z (m)", "largest dI (kg m²)", "most there can be (kg m²)",
                       "rigid closed form (kg m²)"},
                      rows);
}

} // namespace

std::string to_html(const model::Case &scene, const results::StabilityResult &result,
                    const std::string &picture) {
    PageContent parts{
        "stability", "Stability", plot_script("stability"), picture, to_json(scene, result), {}};
    if (result.speeds.size() == 1)
        parts.sections.emplace_back("Stability at this speed", verdict_text(result));
    else
        parts.sections.emplace_back("Unstable spin speeds",
                                    bands_table(result.unstable, result.unstable_error));
    if (!result.critical_speeds.empty() || !result.additional_speeds.empty() ||
        !result.zero_root_speeds.empty())
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
