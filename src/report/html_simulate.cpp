#include "report/html_simulate.h"

#include "report/html.h"
#include "report/html_scripts.h"
#include "report/json_simulate.h"
#include "report/plot_style.h"

namespace whirl::report {

namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string degrees(const std::vector<double> &angles) {
    std::string text;
    for (const double angle : angles)
        text += (text.empty() ? "" : ", ") + readable(angle * 180 / pi, 6);
    return text;
}

std::string result_table(const results::SimulateResult &result) {
    return html_table({"Quantity", "Value"},
                      {{"Outcome", results::outcome_name(result.outcome)},
                       {"Evidence", result.evidence},
                       {"Amplitude left over that without balls",
                        result.residual_ratio ? readable(*result.residual_ratio, 5) : "–"},
                       {"Growth of the amplitude over the last half (1/s)",
                        result.trend ? readable(*result.trend, 4) : "–"},
                       {"Growth at the balanced position by its eigenvalues (1/s)",
                        result.linear_growth ? readable(*result.linear_growth, 4) : "–"},
                       {"Time that would decide (s)",
                        result.decision_time ? readable(*result.decision_time, 3) : "–"},
                       {"Time", readable(result.time, 6) + " s, " +
                                    readable(result.revolutions, 6) + " revolutions"},
                       {"Speed at the end", readable(result.speed * rpm, 7) + " rpm"}});
}

/// The first motion and those from other starts, side by side.
std::string starts_table(const results::SimulateResult &result) {
    Rows rows;
    const auto add = [&rows](const std::vector<double> &start, results::Outcome outcome,
                             const std::optional<double> &ratio,
                             const std::vector<std::vector<double>> &angles) {
        std::string last;
        for (const std::vector<double> &of : angles)
            last += (last.empty() ? "" : "; ") + degrees(of);
        rows.push_back({degrees(start), results::outcome_name(outcome),
                        ratio ? readable(*ratio, 5) : "–", last});
    };
    std::vector<std::vector<double>> first;
    for (const results::BalancerMotion &b : result.balancers)
        first.push_back(b.angles);
    add(result.start_angles, result.outcome, result.residual_ratio, first);
    for (const results::OtherStart &start : result.other_starts)
        add(start.start_angles, start.outcome, start.residual_ratio, start.angles);
    return html_table(
        {"Start (deg)", "Outcome", "Amplitude left over that without balls", "Final angles (deg)"},
        rows);
}

std::string quality_table(const results::SimulateResult &result) {
    const results::MotionAudit &a = result.audit;
    return html_table(
        {"Quantity", "Value"},
        {{"Shapes of the shaft", std::to_string(result.shapes) + ", with the lowest " +
                                     std::to_string(result.modes) + " modes"},
         {"Relative error by it: steady response", readable(result.response_error, 2)},
         {"Relative error by it: whirl speeds", readable(result.frequency_error, 2)},
         {"Integrator", result.integrator},
         {"Steps, evaluations",
          std::to_string(result.steps) + ", " + std::to_string(result.rate_evaluations)},
         {"Energy missing in the balance (J)",
          readable(a.energy_error, 2) + " of " + readable(a.energy_scale, 4)},
         {"Angular momentum missing (kg m²/s)",
          readable(a.momentum_error, 2) + " of " + readable(a.momentum_scale, 4)}});
}

} // namespace

std::string to_html(const model::Case &scene, const results::SimulateResult &result,
                    const std::string &picture) {
    PageContent parts{"simulate", "Motion in time",       plot_script("simulate"),
                      picture,    to_json(scene, result), {}};
    parts.sections.emplace_back("How it ended", result_table(result));
    Rows rows;
    for (const results::BalancerMotion &b : result.balancers)
        rows.push_back({b.name, readable(b.z), b.kind, b.capacity ? readable(*b.capacity) : "–",
                        degrees(b.angles), readable(b.amplitude * 1e6, 5),
                        readable(b.reference * 1e6, 5)});
    parts.sections.emplace_back(
        "Balancers", html_table({"Name", "z (m)", "Kind", "Capacity E", "Final angles (deg)",
                                 "Amplitude at the end (µm)", "without balls (µm)"},
                                rows));
    if (!result.other_starts.empty())
        parts.sections.emplace_back("From other starts", starts_table(result));
    parts.sections.emplace_back("How good the numbers are", quality_table(result));
    return page(scene, result.model, parts);
}

} // namespace whirl::report
