// Report of the command simulate.

#include "results/simulate.h"

#include "report/common/csv.h"
#include "report/common/html.h"
#include "report/common/units.h"
#include "report/common/words.h"
#include "report/held_motions.h"
#include "report/pictures/figures.h"
#include "report/reports.h"
#include "report/sections.h"
#include "report/steady_states.h"

#include <fmt/format.h>

#include <algorithm>
#include <complex>
#include <numbers>

namespace whirl::report {

using results::BalancerMotion;
using results::FoundCycle;
using results::LimitCycle;
using results::MotionAudit;
using results::OtherStart;
using results::SimulateResult;
using results::StationMotion;
using results::Waterfall;

namespace {

std::string page_angles(const std::vector<double> &angles, const Units &units) {
    return angles_text(angles, units, "{:.6g}", ", ");
}
std::string text_angles(const std::vector<double> &angles, const Units &units) {
    return angles_text(angles, units, "{:.2f}", " ");
}

constexpr auto outcome_of = [](const auto &of) { return results::outcome_name(of.outcome); };
constexpr auto evidence_of = [](const auto &of, const Units &units) {
    return units.text(of.evidence);
};

/// The motion as a whole.
const Columns<SimulateResult> outcome_columns{
    {"outcome", OnPage("Outcome"), outcome_of},
    {"evidence", evidence_of},
    {"residual_ratio", OnPage("Amplitude left over that without balls", "{:.5g}"), Quantity::number,
     &SimulateResult::residual_ratio},
    {"station_ratio", OnPage("The same of the stations", "{:.5g}"), Quantity::number,
     &SimulateResult::station_ratio},
    {"imbalance_left", OnPage("Imbalance left in the rotor", "{:.5g}"), Quantity::imbalance,
     [](const auto &result) { return result.at_rest ? Json(result.at_rest->imbalance) : Json(); }},
    {"couple_left", OnPage("Couple left about its centre of mass", "{:.5g}"), Quantity::inertia,
     [](const auto &result) { return result.at_rest ? Json(result.at_rest->couple) : Json(); }},
    {"impacts", OnPage("Impacts between balls", "{}"), &SimulateResult::impacts},
    {"trend", OnPage("Growth of the amplitude over the last half", "{:.4g}"), Quantity::rate,
     &SimulateResult::trend},
    {"linear_growth", OnPage("Growth at the balanced position by its eigenvalues", "{:.4g}"),
     Quantity::rate, &SimulateResult::linear_growth},
    {"decision_time", OnPage("Time that would decide", "{:.3g}"), Quantity::time,
     &SimulateResult::decision_time},
    {"time", OnPage("Time"), Quantity::time, &SimulateResult::time},
    {"speed", OnPage("Speed at the end", "{:.7g}"), Quantity::speed, &SimulateResult::speed},
    {"revolutions", OnPage("Revolutions"), Quantity::number, &SimulateResult::revolutions},
    {"start_angles", Quantity::angle, &SimulateResult::start_angles}};

const Columns<BalancerMotion> balancer_motion_columns{
    {InText("balancer"),
     [](const auto &b, const Units &units) {
         return b.name.empty() ? place("", b.z, units) : b.name;
     }},
    {"name", OnPage("Name"), &BalancerMotion::name},
    {"z", OnPage("z", "{:.5g}"), Quantity::length, &BalancerMotion::z},
    {"kind", Titled("Kind"), &BalancerMotion::kind},
    {"coordinates", &BalancerMotion::coordinates},
    {"E", OnPage("Capacity E", "{:.5g}"), InText("capacity E", "{:.4g}"), Quantity::number,
     &BalancerMotion::capacity},
    {"angles", Quantity::angle, &BalancerMotion::angles},
    {"rates", Quantity::speed, &BalancerMotion::rates},
    {"swing", Quantity::angle, &BalancerMotion::swing},
    {OnPage("Final angles"), Quantity::angle,
     [](const auto &b, const Units &units) { return page_angles(b.angles, units); }},
    {"amplitude", OnPage("Amplitude at the end", "{:.5g}"), InText("amplitude", "{:.4g}"),
     Quantity::amplitude, &BalancerMotion::amplitude},
    {"amplitude_without_balls", OnPage("without balls", "{:.5g}"),
     InText("without balls", "{:.4g}"), Quantity::amplitude, &BalancerMotion::reference},
    {InText("final angles in the rotor,"), Quantity::angle,
     [](const auto &b, const Units &units) { return text_angles(b.angles, units); }}};

const Columns<OtherStart> start_columns{
    {"start_angles", Quantity::angle, &OtherStart::start_angles},
    {OnPage("Start"), Quantity::angle,
     [](const auto &start, const Units &units) { return page_angles(start.start_angles, units); }},
    {"outcome", OnPage("Outcome"), outcome_of},
    {"evidence", evidence_of},
    {"residual_ratio", OnPage("Amplitude left over that without balls", "{:.5g}"), Quantity::number,
     &OtherStart::residual_ratio},
    {"balls", Quantity::angle, &OtherStart::angles},
    {"amplitude", Quantity::amplitude, &OtherStart::amplitude},
    {OnPage("Final angles"), Quantity::angle, [](const auto &start, const Units &units) {
         return joined(start.angles, "; ",
                       [&units](const auto &angles) { return page_angles(angles, units); });
     }}};

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

/// What the stations did.
std::optional<double> over_steady(const StationMotion &station) {
    if (!station.steady_peak || *station.steady_peak == 0)
        return std::nullopt;
    return station.peak.value / *station.steady_peak;
}

const Columns<StationMotion> station_columns{
    {Titled("Station"),
     [](const auto &s, const Units &units) {
         return s.name.empty() ? place("", s.z, units) : s.name;
     }},
    {"name", &StationMotion::name},
    {"z", OnPage("z", "{:.5g}"), Quantity::length, &StationMotion::z},
    {"peak", Titled("Peak", "{:.5g}"), Quantity::amplitude,
     [](const auto &s) { return s.peak.value; }},
    {"peak_time", ForReaders("at"), Quantity::time, [](const auto &s) { return s.peak.time; }},
    {"peak_speed", ForReaders("at"), Quantity::speed, [](const auto &s) { return s.peak.speed; }},
    {"at_end", [](const auto &s) { return s.peak.at_end; }},
    {"amplitude", OnPage("At the end", "{:.5g}"), InText("at the end", "{:.4g}"),
     Quantity::amplitude, &StationMotion::amplitude},
    {"steady", OnPage("Steady at that speed", "{:.5g}"), InText("steady", "{:.4g}"),
     Quantity::amplitude, &StationMotion::steady},
    {"with_balls", OnPage("Steady with the balls fixed", "{:.5g}"), Quantity::amplitude,
     &StationMotion::with_balls},
    {"steady_peak", Titled("Steady peak", "{:.5g}"), Quantity::amplitude,
     &StationMotion::steady_peak},
    {"steady_peak_speed", ForReaders("at"), Quantity::speed, &StationMotion::steady_peak_speed},
    {"over_steady_peak", OnPage("Peak over steady peak", "{:.4g}"), InText("ratio", "{:.4g}"),
     Quantity::number, over_steady}};

Json waterfall_json(const Waterfall &w, const Units &units) {
    return {{"z", written(units, Quantity::length, w.z)},
            {"name", w.name},
            {"window", written(units, Quantity::time, w.window)},
            {"times", written(units, Quantity::time, w.times)},
            {"speeds", written(units, Quantity::speed, w.speeds)},
            {"frequencies", written(units, Quantity::frequency, w.frequencies)},
            {"amplitude", written(units, Quantity::amplitude, w.amplitude)}};
}

/// A window at a frequency.
struct WaterfallPoint {
    double time, speed, frequency, amplitude;
};
const Columns<WaterfallPoint> waterfall_columns{
    {InCsv("time"), Quantity::time, &WaterfallPoint::time},
    {InCsv("speed"), Quantity::speed, &WaterfallPoint::speed},
    {InCsv("frequency"), Quantity::frequency, &WaterfallPoint::frequency},
    {InCsv("amplitude"), Quantity::amplitude, &WaterfallPoint::amplitude}};

std::string waterfall_csv(const Waterfall &w, const Units &units) {
    std::vector<WaterfallPoint> points;
    for (std::size_t k = 0; k < w.times.size(); ++k)
        for (std::size_t i = 0; i < w.frequencies.size(); ++i)
            points.push_back({w.times[k], w.speeds[k], w.frequencies[i], w.amplitude[k][i]});
    return csv_table(waterfall_columns, points, units);
}

const Columns<LimitCycle> cycle_columns{
    {"speed", OnPage("Spin speed", "{:.7g}"), InText("Speed", "{:.7g}"), InCsv("speed"),
     Quantity::speed, &LimitCycle::speed},
    {"kind", Titled("Kind"), InCsv("kind"), &LimitCycle::kind},
    {"period", Titled("Period", "{:.6g}"), InCsv("period"), Quantity::time, &LimitCycle::period},
    {OnPage("Turns of the balls in the rotor"), InText("turns of balls"),
     [](const auto &cycle) {
         return joined(cycle.turns, "; ", [](const std::vector<int> &turns) {
             return joined(turns, " ", [](int turn) { return fmt::format("{}", turn); });
         });
     }},
    {"largest", Quantity::amplitude, &LimitCycle::largest},
    {"least", Quantity::amplitude, &LimitCycle::least},
    {OnPage("Amplitude, largest", "{:.5g}"), InText("largest amplitude", "{:.5g}"),
     InCsv("largest"), Quantity::amplitude,
     [](const auto &cycle) { return std::ranges::max(cycle.largest); }},
    {Titled("Stability"), InCsv("stability"),
     [](const auto &cycle) {
         return cycle.stable ? *cycle.stable ? "stable" : "unstable" : "neutral";
     }},
    {"growth", Titled("Growth", "{:.4g}"), InCsv("growth"), Quantity::rate, &LimitCycle::growth},
    {"multiplier_error", Quantity::number, &LimitCycle::multiplier_error},
    {"defect", Quantity::number, &LimitCycle::defect}};

Json cycle_row(const LimitCycle &cycle, const Units &units) {
    Json json = json_row(cycle_columns, cycle, units);
    json["turns"] = cycle.turns;
    json["stable"] = cycle.stable ? Json(*cycle.stable) : Json();
    json["multipliers"] = json_list(cycle.multipliers, [](std::complex<double> multiplier) {
        return Json{{"re", multiplier.real()}, {"im", multiplier.imag()}};
    });
    return json;
}

Json cycle_json(const std::optional<FoundCycle> &found, const Units &units) {
    if (!found)
        return nullptr;
    Json json = cycle_row(found->cycle, units);
    json["away"] = found->away;
    json["branch"] = json_list(
        found->branch, [&units](const LimitCycle &cycle) { return cycle_row(cycle, units); });
    json["first_end"] = found->first_end.empty() ? Json() : Json(found->first_end);
    json["last_end"] = found->last_end.empty() ? Json() : Json(found->last_end);
    return json;
}

/// How a branch ends, for readers.
std::string end_text(const std::string &end) {
    return end == "range"      ? "at the end of the speeds asked for"
           : end == "standing" ? "where the period grows without bounds, towards balls that rest"
           : end == "points"   ? "unfinished, after as many points as are followed"
                               : "where it could not be followed on";
}

/// In sentences.
std::string cycle_sentence(const FoundCycle &found, const Units &units) {
    const LimitCycle &cycle = found.cycle;
    std::string text = fmt::format(
        "Limit cycle: it repeats itself after {} ({:.5g} turns of the rotor), amplitude {} to {}, "
        "{}",
        units.text(Quantity::time, cycle.period, 6),
        cycle.period * std::abs(cycle.speed) / (2 * std::numbers::pi),
        units.text(Quantity::amplitude, std::ranges::min(cycle.least), 5),
        units.text(Quantity::amplitude, std::ranges::max(cycle.largest), 5),
        !cycle.stable ? "neither stable nor unstable beyond the errors"
        : *cycle.stable
            ? "stable: what disturbs it dies out by " + units.text(Quantity::rate, -cycle.growth, 4)
            : "unstable: what disturbs it grows by " + units.text(Quantity::rate, cycle.growth, 4));
    constexpr double on_it = 0.02;
    if (found.away > on_it)
        text += fmt::format("; the motion ended {:.2g} of its size away from it", found.away);
    for (const LimitCycle &point : found.branch)
        if (!point.kind.empty())
            text += fmt::format("; {} at {}", point.kind == "fold" ? "fold" : "border of stability",
                                units.text(Quantity::speed, point.speed, 7));
    if (!found.branch.empty())
        text += fmt::format(
            "; the branch begins {} ({}) and ends {} ({})", end_text(found.first_end),
            units.text(Quantity::speed, found.branch.front().speed, 6), end_text(found.last_end),
            units.text(Quantity::speed, found.branch.back().speed, 6));
    return text;
}

/// How good the numbers are.
const Columns<SimulateResult> quality_columns{
    {OnPage("Shapes of the shaft"),
     [](const auto &result) {
         return fmt::format("{}, with the lowest {} modes", result.shapes, result.modes);
     }},
    {OnPage("Relative error by it: steady response", "{:.2g}"), Quantity::number,
     &SimulateResult::response_error},
    {OnPage("Relative error by it: whirl speeds", "{:.2g}"), Quantity::number,
     &SimulateResult::frequency_error},
    {OnPage("Integrator"), &SimulateResult::integrator},
    {OnPage("Steps, evaluations"),
     [](const auto &result) {
         return fmt::format("{}, {}", result.steps, result.rate_evaluations);
     }},
    {OnPage("Energy missing in the balance"),
     [](const auto &result, const Units &units) {
         return units.text(Quantity::energy, result.audit.energy_error, 2) + " of " +
                units.text(Quantity::energy, result.audit.energy_scale, 4);
     }},
    {OnPage("Angular momentum missing"), [](const auto &result, const Units &units) {
         return units.text(Quantity::angular_momentum, result.audit.momentum_error, 2) + " of " +
                units.text(Quantity::angular_momentum, result.audit.momentum_scale, 4);
     }}};

/// Steady states beside the motions.
const std::optional<results::SteadyStates> &states_of(const SimulateResult &result) {
    static const std::optional<results::SteadyStates> none;
    return result.sweep ? result.sweep->states : result.starts ? result.starts->states : none;
}

Json json_of(const SimulateResult &result, const Units &units) {
    const MotionAudit &audit = result.audit;
    Json json = json_row(outcome_columns, result, units);
    json["balls"] = json_list(result.balancers, [&units](const auto &b) {
        return written(units, Quantity::angle, b.angles);
    });
    json["balancers"] = json_rows(balancer_motion_columns, result.balancers, units);
    json["other_starts"] = json_rows(start_columns, result.other_starts, units);
    json["cycle"] = cycle_json(result.cycle, units);
    json["sweep"] = sweep_json(result.sweep, units);
    json["sweep_jumps"] = jumps_json(result.sweep, units);
    json["sweep_hysteresis"] = hysteresis_json(result.sweep, units);
    json["starts"] = starts_json(result.starts, units);
    json["states"] = states_json(states_of(result), units);
    json["state_borders"] = state_borders_json(states_of(result), units);
    json["stations"] = json_rows(station_columns, result.stations, units);
    json["steady"] = {{"speeds", written(units, Quantity::speed, result.steady.speeds)},
                      {"amplitude", written(units, Quantity::amplitude, result.steady.amplitudes)}};
    json["waterfall"] = result.waterfall ? waterfall_json(*result.waterfall, units) : Json();
    json["reduction"] = {{"modes", result.modes},
                         {"shapes", result.shapes},
                         {"response_error", result.response_error},
                         {"frequency_error", result.frequency_error}};
    json["integration"] = {{"method", result.integrator},
                           {"steps", result.steps},
                           {"rate_evaluations", result.rate_evaluations}};
    json["audit"] = {
        {"energy_error", written(units, Quantity::energy, audit.energy_error)},
        {"energy_scale", written(units, Quantity::energy, audit.energy_scale)},
        {"momentum_error", written(units, Quantity::angular_momentum, audit.momentum_error)},
        {"momentum_scale", written(units, Quantity::angular_momentum, audit.momentum_scale)},
        {"impact_gain", audit.impact_gain}};
    json["series"] = {{"time", written(units, Quantity::time, result.series.time)},
                      {"speed", written(units, Quantity::speed, result.series.speed)},
                      {"amplitude", written(units, Quantity::amplitude, result.series.amplitude)},
                      {"angles", written(units, Quantity::angle, result.series.angles)}};
    return json;
}

/// The time series; a column for each plane and each ball.
std::string csv_of(const SimulateResult &result, const Units &units) {
    const results::MotionSeries &series = result.series;
    std::vector<CsvList> lists{{{"time", Quantity::time}, series.time},
                               {{"speed", Quantity::speed}, series.speed}};
    for (std::size_t i = 0; i < series.amplitude.size(); ++i) {
        lists.push_back(
            {{fmt::format("amplitude_{}", i), Quantity::amplitude}, series.amplitude[i]});
        lists.push_back({{fmt::format("x_{}", i), Quantity::deflection}, series.x[i]});
        lists.push_back({{fmt::format("y_{}", i), Quantity::deflection}, series.y[i]});
    }
    for (std::size_t i = 0; i < series.angles.size(); ++i)
        lists.push_back({{fmt::format("angle_{}", i), Quantity::angle}, series.angles[i]});
    return csv_lists(lists, units);
}

std::vector<Section> sections_of(const SimulateResult &result, const Units &units) {
    std::vector<Section> sections{
        {"How it ended", element("p", units.text(result.evidence)) +
                             page_properties(outcome_columns, result, units)}};
    if (result.sweep)
        sections.insert(sections.begin(), sweep_section(*result.sweep, units));
    if (result.starts)
        sections.insert(sections.begin(), starts_section(*result.starts, units));
    add_table(sections, "Balancers", balancer_motion_columns, result.balancers, units);
    add_table(sections, "Stations", station_columns, result.stations, units);
    if (!result.other_starts.empty())
        sections.push_back(
            {"From other starts", page_table(start_columns, all_starts(result), units)});
    if (result.cycle)
        sections.push_back(
            {"Limit cycle", element("p", cycle_sentence(*result.cycle, units) + ".") +
                                page_table(cycle_columns,
                                           result.cycle->branch.empty()
                                               ? std::vector<LimitCycle>{result.cycle->cycle}
                                               : result.cycle->branch,
                                           units)});
    sections.push_back(
        {"How good the numbers are", page_properties(quality_columns, result, units)});
    return sections;
}

std::string outcome_text(const SimulateResult &result, const Units &units) {
    std::string text = fmt::format("Outcome: {}\n  {}\n", results::outcome_name(result.outcome),
                                   units.text(result.evidence));
    if (result.residual_ratio)
        text += fmt::format(
            "  left of the amplitude without balls: {:.4g}{}\n", *result.residual_ratio,
            result.station_ratio ? fmt::format(", at the stations {:.4g}", *result.station_ratio)
                                 : "");
    if (result.linear_growth)
        text += fmt::format("  by its eigenvalues the balanced position is {}: {}\n",
                            *result.linear_growth > 0 ? "unstable, small motions grow" : "stable",
                            units.text(Quantity::rate, *result.linear_growth, 4));
    if (result.impacts)
        text += fmt::format("  {} impacts of balls on each other or on walls\n", *result.impacts);
    if (result.decision_time)
        text += fmt::format("  a motion of {} would decide\n",
                            units.text(Quantity::time, *result.decision_time, 3));
    return text;
}

std::string quality_text(const SimulateResult &result, const Units &units) {
    const MotionAudit &audit = result.audit;
    const std::string modes =
        result.modes > 0 ? fmt::format(" with its lowest {} modes", result.modes) : "";
    return fmt::format("\nmodel: {} shapes of the shaft{} (order {}, {} elements); relative error "
                       "by it {:.1e} in response, {:.1e} in whirl speeds\n",
                       result.shapes, modes, result.model.order, result.model.elements,
                       result.response_error, result.frequency_error) +
           fmt::format("       {}, {} steps, {}; energy missing {} of {}, angular momentum "
                       "{} of {}\n",
                       result.integrator, result.steps,
                       units.text(Quantity::time, result.model.seconds, 3),
                       units.text(Quantity::energy, audit.energy_error, 2),
                       units.text(Quantity::energy, audit.energy_scale, 3),
                       units.text(Quantity::angular_momentum, audit.momentum_error, 2),
                       units.text(Quantity::angular_momentum, audit.momentum_scale, 3));
}

std::string text_of(const model::Case &scene, const SimulateResult &result, const Units &units) {
    if (result.sweep || result.starts)
        return heading(scene, fmt::format("Motion in time, {}, {} at the end",
                                          units.text(Quantity::time, result.time),
                                          units.text(Quantity::speed, result.speed))) +
               (result.sweep ? sweep_text(*result.sweep, units) : outcome_text(result, units)) +
               (result.starts ? starts_text(*result.starts, units) : "") +
               quality_text(result, units);
    std::string text =
        heading(scene, fmt::format("Motion in time, {}, {} revolutions, {} at the end",
                                   units.text(Quantity::time, result.time),
                                   readable(result.revolutions, 6),
                                   units.text(Quantity::speed, result.speed))) +
        outcome_text(result, units) + "\n" +
        (result.balancers.empty()
             ? ""
             : text_table(balancer_motion_columns, result.balancers, units) + "\n") +
        text_table(station_columns, result.stations, units);
    for (const OtherStart &start : result.other_starts)
        text += fmt::format(
            "from another start ({}): {}{}\n", text_angles(start.start_angles, units),
            results::outcome_name(start.outcome),
            start.residual_ratio ? fmt::format(", residual {:.4g}", *start.residual_ratio) : "");
    if (result.cycle)
        text += "\n" + cycle_sentence(*result.cycle, units) + "\n";
    return text + quality_text(result, units);
}

} // namespace

Report describe(const model::Case &scene, const SimulateResult &result) {
    Report report =
        report_of<SimulateResult>("simulate", "Motion in time", scene, result,
                                  {json_of, csv_of, sections_of, text_of, simulate_chart});
    const bool branch = result.cycle && !result.cycle->branch.empty();
    const bool asked = result.sweep || result.starts;
    if (asked || branch || result.waterfall)
        report.pictures = [&scene, &result, branch](const Units &units) {
            std::vector<Picture> pictures;
            if (result.sweep)
                pictures.push_back({"sweep", held_sweep_chart(scene, *result.sweep, units), {}});
            if (result.starts)
                pictures.push_back({"starts", starts_chart(scene, *result.starts, units), {}});
            if (result.waterfall)
                pictures.push_back({"waterfall", waterfall_chart(scene, *result.waterfall, units),
                                    [&result](const Units &units) {
                                        return waterfall_csv(*result.waterfall, units);
                                    }});
            if (branch)
                pictures.push_back({"cycles", cycle_chart(scene, *result.cycle, units),
                                    [&result](const Units &units) {
                                        return csv_table(cycle_columns, result.cycle->branch,
                                                         units);
                                    }});
            return pictures;
        };
    report.tables = [&result] {
        std::vector<TableFile> tables;
        if (result.sweep)
            tables.push_back(sweep_table(*result.sweep));
        if (result.starts)
            tables.push_back(starts_table(*result.starts));
        return tables;
    };
    report.pictures_heading = asked || branch ? "Further pictures" : "Waterfall";
    report.pictures_after = asked ? 0 : result.balancers.empty() ? 2 : 3;
    return report;
}

} // namespace whirl::report
