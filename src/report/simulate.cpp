// Report of the command simulate.

#include "results/simulate.h"

#include "report/common/csv.h"
#include "report/common/html.h"
#include "report/common/table.h"
#include "report/common/units.h"
#include "report/common/words.h"
#include "report/pictures/figures.h"
#include "report/reports.h"

#include <fmt/format.h>

namespace whirl::report {

using results::BalancerMotion;
using results::MotionAudit;
using results::OtherStart;
using results::SimulateResult;
using results::StationMotion;
using results::Waterfall;

namespace {

/// Angles in degrees, such as "10, -20".
std::string in_degrees(const std::vector<double> &angles, const char *format, const char *between) {
    return joined(angles, between,
                  [&](double angle) { return fmt::format(fmt::runtime(format), angle * degrees); });
}
std::string page_angles(const std::vector<double> &angles) {
    return in_degrees(angles, "{:.6g}", ", ");
}
std::string text_angles(const std::vector<double> &angles) {
    return in_degrees(angles, "{:.2f}", " ");
}

/// The motion as a whole.
const Columns<SimulateResult> outcome_columns{
    {"outcome", OnPage("Outcome"),
     [](const auto &result) { return results::outcome_name(result.outcome); }},
    {"evidence", [](const auto &r) { return r.evidence.text(); }},
    {"residual_ratio", OnPage("Amplitude left over that without balls", "{:.5g}"),
     &SimulateResult::residual_ratio},
    {"impacts", OnPage("Impacts between balls", "{}"), &SimulateResult::impacts},
    {"trend", OnPage("Growth of the amplitude over the last half (1/s)", "{:.4g}"),
     &SimulateResult::trend},
    {"linear_growth", OnPage("Growth at the balanced position by its eigenvalues (1/s)", "{:.4g}"),
     &SimulateResult::linear_growth},
    {"decision_time", OnPage("Time that would decide (s)", "{:.3g}"),
     &SimulateResult::decision_time},
    {"time", &SimulateResult::time},
    {"speed", &SimulateResult::speed},
    {"revolutions", &SimulateResult::revolutions},
    {"start_angles", &SimulateResult::start_angles},
    {OnPage("Time"),
     [](const auto &result) {
         return fmt::format("{:.6g} s, {:.6g} revolutions", result.time, result.revolutions);
     }},
    {OnPage("Speed at the end", "{:.7g} rpm"), in(rpm, &SimulateResult::speed)}};

const Columns<BalancerMotion> balancer_motion_columns{
    {InText("balancer"), [](const auto &b) { return b.name.empty() ? place("", b.z) : b.name; }},
    {"name", OnPage("Name"), &BalancerMotion::name},
    {"z", OnPage("z (m)", "{:.5g}"), &BalancerMotion::z},
    {"kind", OnPage("Kind"), InText("kind"), &BalancerMotion::kind},
    {"coordinates", &BalancerMotion::coordinates},
    {"E", OnPage("Capacity E", "{:.5g}"), InText("capacity E", "{:.4g}"),
     &BalancerMotion::capacity},
    {"angles", &BalancerMotion::angles},
    {"rates", &BalancerMotion::rates},
    {"swing", &BalancerMotion::swing},
    {OnPage("Final angles (deg)"), [](const auto &b) { return page_angles(b.angles); }},
    {"amplitude", &BalancerMotion::amplitude},
    {"amplitude_without_balls", &BalancerMotion::reference},
    {OnPage("Amplitude at the end (µm)", "{:.5g}"), InText("amplitude µm", "{:.4g}"),
     in(micrometres, &BalancerMotion::amplitude)},
    {OnPage("without balls (µm)", "{:.5g}"), InText("without balls µm", "{:.4g}"),
     in(micrometres, &BalancerMotion::reference)},
    {InText("final angles in the rotor, deg"),
     [](const auto &b) { return text_angles(b.angles); }}};

const Columns<OtherStart> start_columns{
    {"start_angles", &OtherStart::start_angles},
    {OnPage("Start (deg)"), [](const auto &start) { return page_angles(start.start_angles); }},
    {"outcome", OnPage("Outcome"),
     [](const auto &start) { return results::outcome_name(start.outcome); }},
    {"evidence", [](const auto &r) { return r.evidence.text(); }},
    {"residual_ratio", OnPage("Amplitude left over that without balls", "{:.5g}"),
     &OtherStart::residual_ratio},
    {"balls", &OtherStart::angles},
    {"amplitude", &OtherStart::amplitude},
    {OnPage("Final angles (deg)"),
     [](const auto &start) { return joined(start.angles, "; ", page_angles); }}};

/// The first motion and those from other starts, side by side.
std::vector<OtherStart> all_starts(const SimulateResult &result) {
    OtherStart first{
        result.start_angles, result.outcome, result.evidence, result.residual_ratio, {}, {}};
    for (const BalancerMotion &b : result.balancers)
        first.angles.push_back(b.angles);
    std::vector<OtherStart> all{first};
    all.insert(all.end(), result.other_starts.begin(), result.other_starts.end());
    return all;
}

/// Of a rotor without balancers: what the stations did.
std::optional<double> over_steady(const StationMotion &station) {
    if (!station.steady_peak || *station.steady_peak == 0)
        return std::nullopt;
    return station.peak.value / *station.steady_peak;
}

const Columns<StationMotion> station_columns{
    {OnPage("Station"), InText("station"),
     [](const auto &s) { return s.name.empty() ? place("", s.z) : s.name; }},
    {"name", &StationMotion::name},
    {"z", OnPage("z (m)", "{:.5g}"), &StationMotion::z},
    {"peak", [](const auto &s) { return s.peak.value; }},
    {OnPage("Peak (µm)", "{:.5g}"), InText("peak µm", "{:.5g}"),
     [](const auto &s) { return s.peak.value * micrometres; }},
    {"peak_time", OnPage("at (s)", "{:.6g}"), InText("at s", "{:.6g}"),
     [](const auto &s) { return s.peak.time; }},
    {"peak_speed", [](const auto &s) { return s.peak.speed; }},
    {OnPage("at (rpm)", "{:.6g}"), InText("at rpm", "{:.6g}"),
     [](const auto &s) { return s.peak.speed * rpm; }},
    {"at_end", [](const auto &s) { return s.peak.at_end; }},
    {"amplitude", &StationMotion::amplitude},
    {OnPage("At the end (µm)", "{:.5g}"), InText("at the end µm", "{:.4g}"),
     in(micrometres, &StationMotion::amplitude)},
    {"steady", &StationMotion::steady},
    {OnPage("Steady at that speed (µm)", "{:.5g}"), InText("steady µm", "{:.4g}"),
     in(micrometres, &StationMotion::steady)},
    {"steady_peak", &StationMotion::steady_peak},
    {OnPage("Steady peak (µm)", "{:.5g}"), InText("steady peak µm", "{:.5g}"),
     in(micrometres, &StationMotion::steady_peak)},
    {"steady_peak_speed", &StationMotion::steady_peak_speed},
    {OnPage("at (rpm)", "{:.6g}"), InText("at rpm", "{:.6g}"),
     in(rpm, &StationMotion::steady_peak_speed)},
    {"over_steady_peak", OnPage("Peak over steady peak", "{:.4g}"), InText("ratio", "{:.4g}"),
     over_steady}};

Json waterfall_json(const Waterfall &w) {
    return {{"z", w.z},
            {"name", w.name},
            {"window", w.window},
            {"times", w.times},
            {"speeds", w.speeds},
            {"frequencies", w.frequencies},
            {"amplitude", w.amplitude}};
}

/// A window at a frequency.
struct WaterfallPoint {
    double time, speed, frequency, amplitude;
};
const Columns<WaterfallPoint> waterfall_columns{
    {InCsv("time [s]"), &WaterfallPoint::time},
    {InCsv("speed [rad/s]"), &WaterfallPoint::speed},
    {InCsv("frequency [rad/s]"), &WaterfallPoint::frequency},
    {InCsv("amplitude [m]"), &WaterfallPoint::amplitude}};

std::string waterfall_csv(const Waterfall &w) {
    std::vector<WaterfallPoint> points;
    for (std::size_t k = 0; k < w.times.size(); ++k)
        for (std::size_t i = 0; i < w.frequencies.size(); ++i)
            points.push_back({w.times[k], w.speeds[k], w.frequencies[i], w.amplitude[k][i]});
    return csv_table(waterfall_columns, points);
}

/// How good the numbers are.
const Columns<SimulateResult> quality_columns{
    {OnPage("Shapes of the shaft"),
     [](const auto &result) {
         return fmt::format("{}, with the lowest {} modes", result.shapes, result.modes);
     }},
    {OnPage("Relative error by it: steady response", "{:.2g}"), &SimulateResult::response_error},
    {OnPage("Relative error by it: whirl speeds", "{:.2g}"), &SimulateResult::frequency_error},
    {OnPage("Integrator"), &SimulateResult::integrator},
    {OnPage("Steps, evaluations"),
     [](const auto &result) {
         return fmt::format("{}, {}", result.steps, result.rate_evaluations);
     }},
    {OnPage("Energy missing in the balance (J)"),
     [](const auto &result) {
         return fmt::format("{:.2g} of {:.4g}", result.audit.energy_error,
                            result.audit.energy_scale);
     }},
    {OnPage("Angular momentum missing (kg m²/s)"), [](const auto &result) {
         return fmt::format("{:.2g} of {:.4g}", result.audit.momentum_error,
                            result.audit.momentum_scale);
     }}};

Json json_of(const SimulateResult &result, const Units &) {
    const MotionAudit &audit = result.audit;
    Json json = json_row(outcome_columns, result);
    json["balls"] = json_list(result.balancers, [](const auto &b) { return b.angles; });
    json["balancers"] = json_rows(balancer_motion_columns, result.balancers);
    json["other_starts"] = json_rows(start_columns, result.other_starts);
    json["stations"] = json_rows(station_columns, result.stations);
    json["steady"] = {{"speeds", result.steady.speeds}, {"amplitude", result.steady.amplitudes}};
    json["waterfall"] = result.waterfall ? waterfall_json(*result.waterfall) : Json();
    json["reduction"] = {{"modes", result.modes},
                         {"shapes", result.shapes},
                         {"response_error", result.response_error},
                         {"frequency_error", result.frequency_error}};
    json["integration"] = {{"method", result.integrator},
                           {"steps", result.steps},
                           {"rate_evaluations", result.rate_evaluations}};
    json["audit"] = {{"energy_error", audit.energy_error},
                     {"energy_scale", audit.energy_scale},
                     {"momentum_error", audit.momentum_error},
                     {"momentum_scale", audit.momentum_scale},
                     {"impact_gain", audit.impact_gain}};
    json["series"] = {{"time", result.series.time},
                      {"speed", result.series.speed},
                      {"amplitude", result.series.amplitude},
                      {"angles", result.series.angles}};
    return json;
}

/// The time series; a column for each plane and each ball.
std::string csv_of(const SimulateResult &result, const Units &) {
    const results::MotionSeries &series = result.series;
    std::vector<std::pair<std::string, Json>> lists{{"time [s]", series.time},
                                                    {"speed [rad/s]", series.speed}};
    for (std::size_t i = 0; i < series.amplitude.size(); ++i) {
        lists.emplace_back(fmt::format("amplitude_{} [m]", i), series.amplitude[i]);
        lists.emplace_back(fmt::format("x_{} [m]", i), series.x[i]);
        lists.emplace_back(fmt::format("y_{} [m]", i), series.y[i]);
    }
    for (std::size_t i = 0; i < series.angles.size(); ++i)
        lists.emplace_back(fmt::format("angle_{} [rad]", i), series.angles[i]);
    return csv_lists(lists);
}

std::vector<Section> sections_of(const SimulateResult &result, const Units &units) {
    std::vector<Section> sections{
        {"How it ended", kept_as_written(element("p", units.text(result.evidence))) +
                             page_properties(outcome_columns, result)}};
    if (!result.balancers.empty())
        sections.push_back({"Balancers", page_table(balancer_motion_columns, result.balancers)});
    if (!result.stations.empty())
        sections.push_back({"Stations", page_table(station_columns, result.stations)});
    if (!result.other_starts.empty())
        sections.push_back({"From other starts", page_table(start_columns, all_starts(result))});
    sections.push_back({"How good the numbers are", page_properties(quality_columns, result)});
    return sections;
}

std::string outcome_text(const SimulateResult &result, const Units &units) {
    std::string text = fmt::format("Outcome: {}\n  {}\n", results::outcome_name(result.outcome),
                                   kept_as_written(units.text(result.evidence)));
    if (result.residual_ratio)
        text +=
            fmt::format("  left of the amplitude without balls: {:.4g}\n", *result.residual_ratio);
    if (result.linear_growth)
        text += fmt::format("  by its eigenvalues the balanced position is {}: {:.4g} 1/s\n",
                            *result.linear_growth > 0 ? "unstable, small motions grow" : "stable",
                            *result.linear_growth);
    if (result.impacts)
        text += fmt::format("  {} impacts between balls\n", *result.impacts);
    if (result.decision_time)
        text += fmt::format("  a motion of {:.3g} s would decide\n", *result.decision_time);
    return text;
}

std::string quality_text(const SimulateResult &result) {
    const MotionAudit &audit = result.audit;
    const std::string modes =
        result.modes > 0 ? fmt::format(" with its lowest {} modes", result.modes) : "";
    return fmt::format("\nmodel: {} shapes of the shaft{} (order {}, {} elements); relative error "
                       "by it {:.1e} in response, {:.1e} in whirl speeds\n",
                       result.shapes, modes, result.model.order, result.model.elements,
                       result.response_error, result.frequency_error) +
           fmt::format("       {}, {} steps, {:.3g} s; energy missing {:.1e} J of {:.3g} J, "
                       "angular momentum {:.1e} of {:.3g} kg m2/s\n",
                       result.integrator, result.steps, result.model.seconds, audit.energy_error,
                       audit.energy_scale, audit.momentum_error, audit.momentum_scale);
}

std::string text_of(const model::Case &scene, const SimulateResult &result, const Units &units) {
    std::string text =
        heading(scene, fmt::format("Motion in time, {:.6g} s, {:.6g} revolutions, {:.6g} rpm at "
                                   "the end",
                                   result.time, result.revolutions, result.speed * rpm)) +
        outcome_text(result, units) + "\n" +
        (result.stations.empty() ? text_table(balancer_motion_columns, result.balancers)
                                 : text_table(station_columns, result.stations));
    for (const OtherStart &start : result.other_starts)
        text += fmt::format(
            "from another start ({}): {}{}\n", text_angles(start.start_angles),
            results::outcome_name(start.outcome),
            start.residual_ratio ? fmt::format(", residual {:.4g}", *start.residual_ratio) : "");
    return text + quality_text(result) + notes_text(result.model);
}

} // namespace

Report describe(const model::Case &scene, const SimulateResult &result) {
    Report report =
        report_of<SimulateResult>("simulate", "Motion in time", scene, result,
                                  {json_of, csv_of, sections_of, text_of,
                                   result.stations.empty() ? simulate_figure : stations_figure});
    if (result.waterfall) {
        report.pictures = [&scene, &result](const Units &units) {
            return std::vector<Picture>{
                {"waterfall", waterfall_figure(scene, *result.waterfall, units),
                 [&result](const Units &) { return waterfall_csv(*result.waterfall); }}};
        };
        report.pictures_heading = "Waterfall";
        report.pictures_after = 2;
    }
    return report;
}

} // namespace whirl::report
