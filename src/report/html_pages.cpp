#include "report/html_pages.h"

#include "report/html.h"
#include "report/html_balance.h"
#include "report/html_scripts.h"
#include "report/html_show.h"
#include "report/json.h"
#include "report/plot_modes.h"
#include "report/plot_style.h"
#include "report/plotly.h"
#include "results/accuracy.h"
#include "results/campbell.h"
#include "results/critical.h"
#include "results/formulation.h"
#include "results/modes.h"
#include "results/show.h"
#include "results/whirl.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::report {

namespace {

using Rows = std::vector<std::vector<std::string>>;

template <class Result>
PageContent content(const char *command, const char *heading, const model::Case &scene,
                    const Result &result, const std::string &picture) {
    return {command, heading, plot_script(command), picture, to_json(scene, result), {}};
}

std::string cell(std::optional<double> value, int digits) {
    return value ? readable(*value, digits) : "–";
}

template <class T> std::optional<T> last(const std::vector<std::optional<T>> &list) {
    return list.empty() ? std::nullopt : list.back();
}

/// Index of the largest value, where there is one.
std::optional<std::size_t> peak_at(const std::vector<double> &values,
                                   const std::vector<double> &speeds) {
    const auto peak = std::max_element(values.begin(), values.end());
    const auto at = static_cast<std::size_t>(peak - values.begin());
    return at < std::min(values.size(), speeds.size()) ? std::optional(at) : std::nullopt;
}

std::string microns(double amplitude) {
    return std::isinf(amplitude) ? "no limit" : readable(amplitude * 1e6, 6);
}

std::string share(const std::vector<double> &errors, std::size_t at) {
    return at < errors.size() && std::isfinite(errors[at]) ? readable(errors[at], 2) : "–";
}

/// Crossings with multiples of the spin speed; those with 1× are critical speeds.
std::string crossings_table(const results::CampbellResult &result) {
    Rows rows;
    for (const auto &crossing : result.crossings) {
        const auto index = static_cast<std::size_t>(crossing.mode);
        rows.push_back({index < result.modes.size() ? result.modes[index].label : "",
                        readable(crossing.multiple) + "×", readable(crossing.speed * rpm, 10),
                        readable(crossing.speed, 10), readable(crossing.frequency * hertz, 10)});
    }
    if (rows.empty())
        return "<p>No mode crosses a multiple of the spin speed in this range.</p>\n";
    return html_table(
        {"Mode", "Multiple", "Spin speed (rpm)", "Spin speed (rad/s)", "Whirl frequency (Hz)"},
        rows);
}

std::string why_none(const results::CampbellMode &mode) {
    return mode.absent.empty() ? "" : mode.absent.back();
}

std::string last_speed_table(const results::CampbellResult &result) {
    Rows rows;
    for (const auto &mode : result.modes) {
        const auto frequency = last(mode.frequency);
        rows.push_back(
            {mode.label, cell(frequency, 10),
             frequency ? readable(*frequency * hertz, 10) : why_none(mode),
             cell(last(mode.real), 6), cell(last(mode.damping_ratio), 6),
             mode.whirl.empty() ? "" : results::whirl_name(mode.whirl.back()),
             mode.forward_fraction.empty() ? "" : readable(mode.forward_fraction.back(), 4),
             cell(last(mode.error), 2)});
    }
    return html_table({"Mode", "Frequency (rad/s)", "Frequency (Hz)", "Real part (1/s)",
                       "Damping ratio", "Whirl", "Forward share", "Relative error"},
                      rows);
}

/// A JavaScript array; five digits are more than a screen shows.
std::string script_array(const std::vector<double> &values) {
    std::string text = "[";
    for (const double value : values)
        text += (text.size() > 1 ? "," : "") +
                (std::isfinite(value) ? fmt::format("{:.5g}", value) : "null");
    return text + "]";
}

/// The curves of the still picture for the script of the page.
std::string drawn_modes(const results::ModesResult &result) {
    std::string text = "const drawnModes = [";
    for (const auto &mode : result.modes) {
        const ModeCurves curves = mode_curves(mode);
        text += fmt::format("\n{{x: {}, y: {}, atOneInstant: {}}},", script_array(curves.x),
                            script_array(curves.y), curves.at_one_instant);
    }
    return text + "];\n";
}

} // namespace

std::string to_html(const model::Case &scene, const results::CampbellResult &result,
                    const std::string &picture) {
    PageContent parts = content("campbell", "Campbell diagram", scene, result, picture);
    parts.sections.emplace_back("Critical speeds (1×) and other crossings",
                                crossings_table(result));
    if (!result.speeds.empty())
        parts.sections.emplace_back(
            fmt::format("Whirl modes at {} rpm", readable(result.speeds.back() * rpm, 6)),
            last_speed_table(result));
    return page(scene, result.model, parts);
}

std::string to_html(const model::Case &scene, const results::CriticalResult &result,
                    const std::string &picture) {
    PageContent parts = content("critical", "Critical speeds", scene, result, picture);
    Rows rows;
    for (const auto &critical : result.critical_speeds)
        rows.push_back({std::to_string(rows.size() + 1), readable(critical.speed * rpm, 10),
                        readable(critical.speed, 10), readable(critical.speed * hertz, 10),
                        results::whirl_name(critical.whirl), readable(critical.real, 5),
                        std::isfinite(critical.error) ? readable(critical.error, 2) : "–"});
    parts.sections.emplace_back("Table", html_table({"No.", "rpm", "rad/s", "Hz", "Whirl",
                                                     "Real part (1/s)", "Relative error"},
                                                    rows));
    return page(scene, result.model, parts);
}

std::string to_html(const model::Case &scene, const results::ResponseResult &result,
                    const std::string &picture) {
    PageContent parts = content("response", "Unbalance response", scene, result, picture);
    Rows rows;
    for (const auto &node : result.nodes)
        if (const auto at = peak_at(node.amplitude, result.speeds))
            rows.push_back({node.name, readable(node.z), microns(node.amplitude[*at]),
                            readable(result.speeds[*at] * rpm, 6), share(node.error, *at)});
    parts.sections.emplace_back(
        "Largest amplitudes among the computed speeds",
        html_table({"Place", "z (m)", "Amplitude (µm)", "at (rpm)", "Relative error"}, rows));
    rows.clear();
    for (const auto &probe : result.probes)
        if (const auto at = peak_at(probe.amplitude, result.speeds))
            rows.push_back({probe.name, readable(probe.z), readable(probe.angle * 180 / pi, 6),
                            microns(probe.amplitude[*at]), readable(result.speeds[*at] * rpm, 6),
                            share(probe.error, *at)});
    if (!rows.empty())
        parts.sections.emplace_back("Largest readings of the probes",
                                    html_table({"Probe", "z (m)", "Direction (deg)",
                                                "Amplitude (µm)", "at (rpm)", "Relative error"},
                                               rows));
    return page(scene, result.model, parts);
}

std::string to_html(const model::Case &scene, const results::ModesResult &result,
                    const std::string &picture) {
    PageContent parts = content("modes", "Mode shapes", scene, result, picture);
    parts.script = drawn_modes(result) + parts.script;
    Rows rows;
    for (const auto &mode : result.modes)
        rows.push_back({mode.label, readable(mode.eigenvalue.imag(), 10),
                        readable(mode.eigenvalue.imag() * hertz, 10),
                        readable(mode.eigenvalue.real(), 6), results::whirl_name(mode.whirl),
                        readable(mode.forward_fraction, 4)});
    parts.sections.emplace_back(fmt::format("Modes at {} rpm", readable(result.speed * rpm, 6)),
                                html_table({"Mode", "Frequency (rad/s)", "Frequency (Hz)",
                                            "Real part (1/s)", "Whirl", "Forward share"},
                                           rows));
    return page(scene, result.model, parts);
}

std::string to_html(const model::Case &scene, const results::ShowResult &result,
                    const std::string &picture, const std::string &more) {
    PageContent parts = content("show", "Scene", scene, result, picture);
    parts.sections.emplace_back(
        "Rigid body", html_table({"Quantity", "Value"},
                                 {{"Mass", readable(result.mass, 8) + " kg"},
                                  {"of it the shaft", readable(result.shaft_mass, 8) + " kg"},
                                  {"Length of the shaft", readable(result.length, 8) + " m"},
                                  {"Centre of mass, z", readable(result.center_of_mass, 8) + " m"},
                                  {"Diametral inertia about it", readable(result.Id, 8) + " kg m²"},
                                  {"Polar inertia", readable(result.Ip, 8) + " kg m²"},
                                  {"Type", result.type}}));
    for (const auto &section : show_sections(result))
        parts.sections.push_back(section);
    if (!more.empty())
        parts.sections.emplace_back("Curves of the rigid rotor", more);
    Rows rows;
    for (const auto &[command, used] : result.formulations)
        rows.push_back({command, results::form_name(used.form), used.why});
    parts.sections.emplace_back("Form each analysis uses",
                                html_table({"Command", "Form", "Why"}, rows));
    return page(scene, result.model, parts);
}

std::string to_html(const model::Case &scene, const results::AccuracyResult &result,
                    const std::string &picture) {
    PageContent parts = content("accuracy", "Speed and accuracy", scene, result, picture);
    Rows rows;
    for (const auto &row : result.rows)
        rows.push_back({row.family, std::to_string(row.order), std::to_string(row.elements),
                        std::to_string(row.unknowns), readable(row.seconds * 1000, 4),
                        cell(row.error_estimate, 3), cell(row.true_error, 3)});
    parts.sections.emplace_back("Error against " + result.reference,
                                html_table({"Family", "Order", "Elements", "Unknowns",
                                            "Wall time (ms)", "Estimate", "True error"},
                                           rows));
    return page(scene, result.model, parts);
}

std::string to_html(const model::Case &scene, const results::BalanceResult &result,
                    const std::string &picture) {
    PageContent parts = content("balance", "Auto-balancing", scene, result, picture);
    // With an interactive diagram the page has no picture of its own: those of the placement and
    // of the pendulums come below it.
    if (!plotly_bundle().empty() && !picture.empty())
        parts.sections.emplace_back("Pictures", picture);
    for (auto &section : balance_sections(result))
        parts.sections.push_back(std::move(section));
    return page(scene, result.model, parts);
}

} // namespace whirl::report
