#include "report/response/parts.h"

#include "report/common/csv.h"
#include "report/common/table.h"
#include "report/common/words.h"
#include "report/pictures/figures.h"

#include <fmt/format.h>

namespace whirl::report {

using results::Receptance;
using results::ReceptanceDirection;
using results::ReceptancePeak;
using results::ReceptanceResponse;

namespace {

/// The half-power points.
std::string half_power_range(const ReceptancePeak &peak, const Units &units) {
    const auto end = [&units](const std::optional<double> &frequency) {
        return frequency ? fmt::format("{:.6g}", units(Quantity::frequency, *frequency)) : "-";
    };
    return peak.lower || peak.upper ? end(peak.lower) + " … " + end(peak.upper) : "";
}

const Columns<ReceptancePeak> receptance_peaks{
    {"direction", OnPage("Direction"), InText("peak of"), &ReceptancePeak::direction},
    {"from", Titled("Force at", "{:.5g}"), Quantity::length, &ReceptancePeak::from},
    {"to", Titled("Deflection at", "{:.5g}"), Quantity::length, &ReceptancePeak::to},
    {"frequency", Titled("Frequency", "{:.8g}"), Quantity::frequency, &ReceptancePeak::frequency},
    {"value", OnPage("Peak", "{:.6g}", "no limit"), InText("value", "{:.6g}", "no limit"),
     Quantity::receptance, &ReceptancePeak::value},
    {"phase", Titled("Phase", "{:.1f}", ""), Quantity::angle, &ReceptancePeak::phase},
    {"amplification", OnPage("Amplification factor", "{:.4g}", ""), InText("AF", "{:.4g}", ""),
     Quantity::number, &ReceptancePeak::amplification},
    {"half_power", Quantity::frequency,
     [](const ReceptancePeak &peak) {
         return Json{Json(peak.lower), Json(peak.upper)};
     }},
    {OnPage("Half-power points"), InText("half power"), Quantity::frequency, half_power_range},
    {"error", RelativeError(), &ReceptancePeak::error},
    {"frequency_error", Quantity::number, &ReceptancePeak::frequency_error}};

/// One direction at one frequency.
struct ReceptanceLine {
    double frequency; ///< rad/s
    const Receptance *between;
    const ReceptanceDirection *direction;
    std::size_t index; ///< of the frequency
};

const Columns<ReceptanceLine> receptance_columns{
    {InCsv("frequency"), Quantity::frequency, &ReceptanceLine::frequency},
    {InCsv("direction"), [](const ReceptanceLine &line) { return line.direction->name; }},
    {InCsv("force at"), Quantity::length,
     [](const ReceptanceLine &line) { return line.between->from; }},
    {InCsv("deflection at"), Quantity::length,
     [](const ReceptanceLine &line) { return line.between->to; }},
    {InCsv("receptance"), Quantity::receptance,
     [](const ReceptanceLine &line) { return line.direction->amplitude[line.index]; }},
    {InCsv("phase"), Quantity::angle,
     [](const ReceptanceLine &line) { return line.direction->phase[line.index]; }},
    {InCsv("error"), Quantity::number,
     [](const ReceptanceLine &line) { return line.direction->error[line.index]; }}};

Json curve_json(const results::ResponseCurves &curve, const Units &units) {
    const bool none = curve.values.empty();
    const std::vector<double> nothing;
    return {
        {"frequencies", written(units, Quantity::frequency, curve.speeds)},
        {"amplitude", written(units, Quantity::receptance, none ? nothing : curve.values.front())},
        {"phase", written(units, Quantity::angle, none ? nothing : curve.phases.front())}};
}

Json receptance_json(const ReceptanceResponse &response, const Units &units) {
    return {{"speed", written(units, Quantity::speed, response.speed)},
            {"frequencies", written(units, Quantity::frequency, response.frequencies)},
            {"peaks", json_rows(receptance_peaks, response.peaks, units)},
            {"receptances", json_list(response.receptances, [&](const Receptance &one) {
                 Json json{{"from", written(units, Quantity::length, one.from)},
                           {"to", written(units, Quantity::length, one.to)}};
                 for (const ReceptanceDirection &direction : one.directions)
                     json[direction.name] = {
                         {"amplitude", written(units, Quantity::receptance, direction.amplitude)},
                         {"phase", written(units, Quantity::angle, direction.phase)},
                         {"error", written(units, Quantity::number, direction.error)},
                         {"curve", curve_json(direction.curve, units)}};
                 return json;
             })}};
}

std::string receptance_csv(const ReceptanceResponse &response, const Units &units) {
    std::vector<ReceptanceLine> lines;
    for (std::size_t i = 0; i < response.frequencies.size(); ++i)
        for (const Receptance &one : response.receptances)
            for (const ReceptanceDirection &direction : one.directions)
                lines.push_back({response.frequencies[i], &one, &direction, i});
    return csv_table(receptance_columns, lines, units);
}

std::vector<Section> receptance_sections(const ReceptanceResponse &response, const Units &units) {
    return {{"Receptance at " + units.text(Quantity::speed, response.speed) + ": peaks",
             response.peaks.empty() ? "<p>None inside the range.</p>"
                                    : page_table(receptance_peaks, response.peaks, units)}};
}

std::string receptance_text(const ReceptanceResponse &response, const Units &units) {
    const std::string frequencies =
        fmt::format("{:.6g} to {}", units(Quantity::frequency, response.frequencies.front()),
                    units.text(Quantity::frequency, response.frequencies.back()));
    return fmt::format("Receptance at {}, {}, {} frequencies\n",
                       units.text(Quantity::speed, response.speed), frequencies,
                       response.frequencies.size()) +
           (response.peaks.empty() ? "  no peak inside the range\n"
                                   : text_table(receptance_peaks, response.peaks, units));
}

} // namespace

Part receptance_part(const model::Case &scene, const results::ResponseResult &result) {
    const ReceptanceResponse &of = *result.receptance;
    return {.file = "response_receptance",
            .title = "Receptance",
            .picture = "receptance",
            .chart = [&](const Units &units) { return receptance_chart(scene, of, units); },
            .csv = [&](const Units &units) { return receptance_csv(of, units); },
            .sections = [&](const Units &units) { return receptance_sections(of, units); },
            .text = [&](const Units &units) { return receptance_text(of, units); },
            .key = "receptance",
            .json = [&](const Units &units) { return receptance_json(of, units); }};
}

} // namespace whirl::report
