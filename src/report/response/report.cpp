// Report of the command response.

#include "results/response.h"

#include "report/common/error_parts.h"
#include "report/common/margins.h"
#include "report/common/words.h"
#include "report/pictures/figures.h"
#include "report/reports.h"
#include "report/response/marks.h"
#include "report/response/parts.h"
#include "report/response/tables.h"
#include "report/sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace whirl::report {

using results::ForceResponse;
using results::HarmonicMotion;
using results::ResponseBearing;
using results::ResponseNode;
using results::ResponsePeak;
using results::ResponseProbe;
using results::ResponseResult;

namespace {

const Kind<ResponseNode> node_kind{
    "node",
    {series("amplitude", Quantity::amplitude, &ResponseNode::amplitude),
     series("phase", Quantity::angle, &ResponseNode::phase),
     series("major", Quantity::amplitude, &ResponseNode::major),
     series("minor", Quantity::amplitude, &ResponseNode::minor),
     series("x", Quantity::amplitude, &ResponseNode::x),
     series("x_phase", Quantity::angle, &ResponseNode::x_phase),
     series("y", Quantity::amplitude, &ResponseNode::y),
     series("y_phase", Quantity::angle, &ResponseNode::y_phase),
     series("inclination", Quantity::angle, &ResponseNode::inclination),
     series("error", Quantity::number, &ResponseNode::error)}};

const Kind<ResponseBearing> bearing_kind{
    "bearing",
    {series("force", Quantity::force, &ResponseBearing::force),
     series("error", Quantity::number, &ResponseBearing::error)}};

const Kind<ResponseProbe> probe_kind{
    "probe",
    {series("amplitude", Quantity::amplitude, &ResponseProbe::amplitude),
     series("phase", Quantity::angle, &ResponseProbe::phase),
     series("error", Quantity::number, &ResponseProbe::error)},
    {{InFiles("angle"), Quantity::angle, [](const auto &at) { return at.of->angle; }}}};

const std::vector<CsvHeading> csv_headings{{"speed", Quantity::speed},
                                           {"kind"},
                                           {"name"},
                                           {"z", Quantity::length},
                                           {"amplitude", Quantity::amplitude},
                                           {"phase", Quantity::angle},
                                           {"major", Quantity::amplitude},
                                           {"minor", Quantity::amplitude},
                                           {"force", Quantity::force},
                                           {"x", Quantity::amplitude},
                                           {"x_phase", Quantity::angle},
                                           {"y", Quantity::amplitude},
                                           {"y_phase", Quantity::angle},
                                           {"inclination", Quantity::angle},
                                           {"error"},
                                           {"angle", Quantity::angle}};

/// What the value of a peak is.
const OfEach peak_value{[](const ResponsePeak &peak) {
    return peak.of == "bearing" ? Quantity::force : Quantity::amplitude;
}};

Json half_power(const ResponsePeak &peak) { return {Json(peak.lower), Json(peak.upper)}; }

/// "reading at 45 deg (µm)"
std::string measured(const ResponsePeak &peak, const Units &units) {
    return units.label(peak.of == "probe"
                           ? "reading at " + units.text(Quantity::angle, peak.angle.value_or(0), 4)
                       : peak.of == "bearing" ? "force"
                                              : "amplitude",
                       peak_value.quantity(peak));
}

/// The number of its resonance in their table, or why it is of none.
std::string resonance_of(const ResponsePeak &peak) {
    return peak.resonance ? std::to_string(*peak.resonance + 1)
                          : results::peak_kind_name(peak.kind);
}

const Columns<ResponsePeak> peaks_found = with_error_parts<ResponsePeak>(
    {{"of", &ResponsePeak::of},
     {"angle", Quantity::angle, &ResponsePeak::angle},
     {"z", OnPage("z", "{:.5g}"), Quantity::length, &ResponsePeak::z},
     {"name", OnPage("Place"), &ResponsePeak::name},
     {InText("peak at"), place_of},
     {ForReaders("of"), measured},
     {"speed", OnPage("at", "{:.8g}"), InText("", "{:.8g}"), Quantity::speed, &ResponsePeak::speed},
     {"mode", Titled("Mode", "{}", ""),
      [](const ResponsePeak &peak) { return known_name(peak.mode); }},
     {"value", OnPage("Peak", "{:.6g}", "no limit"), InText("value", "{:.6g}", "no limit"),
      peak_value, &ResponsePeak::value},
     {"phase", Titled("Phase", "{:.1f}", ""), Quantity::angle, &ResponsePeak::phase},
     {Titled("Resonance"), resonance_of},
     {"resonance", &ResponsePeak::resonance},
     {"kind", [](const ResponsePeak &peak) { return results::peak_kind_name(peak.kind); }},
     {"amplification", Quantity::number, &ResponsePeak::amplification},
     {"half_power", Quantity::speed, half_power},
     {"error", RelativeError(), &ResponsePeak::error},
     {"speed_error", Quantity::number, &ResponsePeak::speed_error}},
    error_part);

const Columns<results::Resonance> resonance_columns{
    {OnPage("No."), InText(""), [](const auto &, std::size_t i) { return i + 1; }},
    {"speed", OnPage("at", "{:.8g}"), InText("", "{:.8g}"), Quantity::speed,
     [](const auto &one) { return one.peak.speed; }},
    {"mode", Titled("Mode", "{}", ""), [](const auto &one) { return known_name(one.peak.mode); }},
    {"amplification", OnPage("Amplification factor", "{:.4g}", ""), InText("AF", "{:.4g}", ""),
     Quantity::number, [](const auto &one) { return one.peak.amplification; }},
    {"kind", ForReaders("kind"),
     [](const auto &one) { return results::peak_kind_name(one.peak.kind); }},
    {"half_power", Quantity::speed, [](const auto &one) { return half_power(one.peak); }},
    {OnPage("Half-power points"), InText("half power"), Quantity::speed,
     [](const auto &one, const Units &units) {
         return one.peak.lower && one.peak.upper
                    ? fmt::format("{:.6g} … {:.6g}", units(Quantity::speed, *one.peak.lower),
                                  units(Quantity::speed, *one.peak.upper))
                    : "";
     }},
    {"of", [](const auto &one) { return one.peak.of; }},
    {"z", Quantity::length, [](const auto &one) { return one.peak.z; }},
    {"name", [](const auto &one) { return one.peak.name; }},
    {ForReaders("by the peak at"),
     [](const auto &one, const Units &units) { return place(one.peak.name, one.peak.z, units); }},
    {ForReaders("of"),
     [](const auto &one, const Units &units) { return measured(one.peak, units); }},
    {"value", OnPage("Peak", "{:.6g}", "no limit"), InText("value", "{:.6g}", "no limit"),
     OfEach{[](const results::Resonance &one) { return peak_value.quantity(one.peak); }},
     [](const auto &one) { return one.peak.value; }},
    {"peaks", &results::Resonance::peaks},
    {ForReaders("peaks"), [](const auto &one) { return one.peaks.size(); }}};

} // namespace

const Columns<ResponsePeak> &curve_peaks() { return peaks_found; }

Json resonances_json(const std::vector<results::Resonance> &resonances, const Units &units) {
    return json_rows(resonance_columns, resonances, units);
}

std::string peaks_text(const std::vector<results::Resonance> &resonances,
                       const std::vector<ResponsePeak> &peaks, const Units &units) {
    return text_table("Resonances:\n", resonance_columns, resonances, units) +
           text_table("\n", curve_peaks(), peaks, units);
}

std::string peaks_page(const std::vector<results::Resonance> &resonances,
                       const std::vector<ResponsePeak> &peaks, const Units &units) {
    if (peaks.empty())
        return "<p>None inside the range.</p>";
    return (resonances.empty() ? std::string() : page_table(resonance_columns, resonances, units)) +
           page_table(curve_peaks(), peaks, units);
}

std::vector<ResponsePeak> sharpest_first(std::vector<ResponsePeak> peaks) {
    std::ranges::stable_sort(peaks, std::greater(), [](const ResponsePeak &peak) {
        return peak.amplification.value_or(std::isfinite(peak.value) ? 0.0 : HUGE_VAL);
    });
    return peaks;
}

Json curves_of_kind(const results::ResponseCurves &curves, std::size_t from, std::size_t to,
                    const char *key, Quantity quantity, const Units &units) {
    Json list = Json::array();
    for (std::size_t i = from; i < to && i < curves.values.size(); ++i)
        list.push_back({{key, written(units, quantity, curves.values[i])},
                        {"phase", written(units, Quantity::angle, curves.phases[i])}});
    return list;
}

namespace {

/// @param what  the value on the terminal
Columns<LargestValue> largest_columns(const char *on_page, const char *on_terminal,
                                      const char *what, Quantity quantity = Quantity::amplitude) {
    return {{OnPage(on_page), &LargestValue::name},
            {OnPage("z", "{:.5g}"), Quantity::length, &LargestValue::z},
            {InText(on_terminal), place_of},
            {OnPage("Amplitude", "{:.6g}", "no limit"), InText(what, "{:.6g}", "no limit"),
             quantity, &LargestValue::value},
            {ForReaders("at"), Quantity::speed, &LargestValue::speed},
            {RelativeError(), &LargestValue::error}};
}

const Columns<LargestValue> station_columns =
    largest_columns("Place", "station", "largest amplitude");
const Columns<LargestValue> force_columns =
    largest_columns("Bearing", "bearing", "largest force", Quantity::force);
const Columns<LargestValue> probe_peak_columns = [] {
    Columns<LargestValue> columns = largest_columns("Probe", "probe", "largest reading");
    columns.insert(columns.begin() + 3, {OnPage("Direction"), InText("looks along"),
                                         Quantity::angle, &LargestValue::angle});
    return columns;
}();

using Speeds = std::vector<double>;

std::vector<LargestValue> largest_amplitudes(const Speeds &speeds, const HarmonicMotion &motion) {
    return peaks_of(speeds, motion.peaks, motion.nodes, &ResponseNode::amplitude, "station");
}
std::vector<LargestValue> largest_readings(const Speeds &speeds, const HarmonicMotion &motion) {
    return peaks_of(speeds, motion.peaks, motion.probes, &ResponseProbe::amplitude, "probe");
}
std::vector<LargestValue> largest_forces(const Speeds &speeds, const HarmonicMotion &motion) {
    return peaks_of(speeds, motion.peaks, motion.bearings, &ResponseBearing::force, "bearing");
}

Json curves_json(const HarmonicMotion &result, const Units &units) {
    const results::ResponseCurves &curves = result.curves;
    const std::size_t nodes = result.nodes.size();
    const std::size_t probes = nodes + result.bearings.size();
    const auto kind = [&](std::size_t from, std::size_t to, const char *key, Quantity quantity) {
        return curves_of_kind(curves, from, to, key, quantity, units);
    };
    return {{"speeds", written(units, Quantity::speed, curves.speeds)},
            {"nodes", kind(0, nodes, "amplitude", Quantity::amplitude)},
            {"bearings", kind(nodes, probes, "force", Quantity::force)},
            {"probes", kind(probes, curves.values.size(), "amplitude", Quantity::amplitude)}};
}

/// With the other multiples of the spin speed, where there are any.
Json nodes_json(const Speeds &speeds, const std::vector<ResponseNode> &nodes, const Units &units) {
    Json list = node_kind.json(speeds, nodes, units);
    for (std::size_t i = 0; i < nodes.size(); ++i)
        if (!nodes[i].harmonics.empty())
            list[i]["harmonics"] =
                json_list(nodes[i].harmonics, [&](const results::ResponseHarmonic &harmonic) {
                    return Json{{"multiple", harmonic.multiple},
                                {"major", written(units, Quantity::amplitude, harmonic.major)},
                                {"minor", written(units, Quantity::amplitude, harmonic.minor)}};
                });
    return list;
}

Json motion_json(const Speeds &speeds, const HarmonicMotion &motion, const Units &units) {
    return {{"resonances", resonances_json(motion.resonances, units)},
            {"peaks", json_rows(curve_peaks(), motion.peaks, units)},
            {"nodes", nodes_json(speeds, motion.nodes, units)},
            {"bearings", bearing_kind.json(speeds, motion.bearings, units)},
            {"probes", probe_kind.json(speeds, motion.probes, units)},
            {"curves", curves_json(motion, units)}};
}

const Columns<ForceResponse::Acting> acting_columns{
    {"z", OnPage("z", "{:.5g}"), Quantity::length, &ForceResponse::Acting::z},
    {"name", OnPage("Place"), &ForceResponse::Acting::name},
    {InText("force at"), place_of},
    {"amplitude", OnPage("Force", "{:.6g}"), InText("amplitude", "{:.6g}"), Quantity::force,
     &ForceResponse::Acting::amplitude},
    {"phase", Titled("Phase", "{:.1f}"), Quantity::angle, &ForceResponse::Acting::phase},
    {"direction", ForReaders("direction"), &ForceResponse::Acting::direction}};

Json force_json(const Speeds &speeds, const ForceResponse &response, const Units &units) {
    Json json{{"multiple", Json(response.multiple)},
              {"frequency", response.frequency
                                ? written(units, Quantity::frequency, *response.frequency)
                                : Json()},
              {"forces", json_rows(acting_columns, response.forces, units)}};
    take_entries(json, motion_json(speeds, response, units));
    return json;
}

std::string motion_csv(const Speeds &speeds, const HarmonicMotion &motion, const Units &units) {
    std::string csv = csv_head_line(csv_headings, units);
    for (std::size_t i = 0; i < speeds.size(); ++i)
        csv += node_kind.csv(csv_headings, speeds[i], i, motion.nodes, units) +
               bearing_kind.csv(csv_headings, speeds[i], i, motion.bearings, units) +
               probe_kind.csv(csv_headings, speeds[i], i, motion.probes, units);
    return csv;
}

/// @param of  in front of the headings
std::vector<Section> motion_sections(const Speeds &speeds, const HarmonicMotion &motion,
                                     const std::string &of, const Units &units) {
    const auto heading = [&of](const std::string &words) {
        return of.empty() ? words : of + uncapitalized(words);
    };
    std::vector<Section> sections{
        {heading("Resonances and peaks"), peaks_page(motion.resonances, motion.peaks, units)},
        {heading("Largest amplitudes in the range"),
         page_table(station_columns, largest_amplitudes(speeds, motion), units)}};
    add_table(sections, heading("Largest readings of the probes"), probe_peak_columns,
              largest_readings(speeds, motion), units);
    return sections;
}

std::string motion_text(const Speeds &speeds, const HarmonicMotion &motion,
                        const std::string &before_peaks, const Units &units) {
    return before_peaks +
           (motion.peaks.empty() ? "No peak inside the range.\n"
                                 : peaks_text(motion.resonances, motion.peaks, units)) +
           "\n" + text_table(station_columns, largest_amplitudes(speeds, motion), units) +
           text_table("\n", probe_peak_columns, largest_readings(speeds, motion), units) +
           text_table("\n", force_columns, largest_forces(speeds, motion), units);
}

/// Margins answer what peaks are looked for: they stand in front of them.
std::string margins_before(const Margins &margins, const Units &units) {
    std::string text = margins_text(margins, units);
    if (text.starts_with('\n'))
        text.erase(0, 1);
    return text.empty() ? text : text + "\n";
}

Part imbalance_part(const model::Case &scene, const ResponseResult &result) {
    return {.file = "response",
            .title = "Unbalance response",
            .picture = "unbalance response",
            .chart = [&](const Units &units) { return response_chart(scene, result, units); },
            .csv = [&](const Units &units) { return motion_csv(result.speeds, result, units); },
            .sections =
                [&](const Units &units) {
                    std::vector<Section> all = motion_sections(result.speeds, result, "", units);
                    if (result.margins)
                        all.insert(all.begin() + 1,
                                   {margins_heading, margins_page(*result.margins, units)});
                    add_sections(all, orbit_sections(result, units));
                    return all;
                },
            .text =
                [&](const Units &units) {
                    return motion_text(result.speeds, result, margins_before(result.margins, units),
                                       units) +
                           orbit_text(result, units);
                }};
}

/// @param index  from 1
Part force_part(const model::Case &scene, const ResponseResult &result,
                const ForceResponse &response, std::size_t index) {
    const auto what = [&response](const Units &units) {
        return "forces at " + excitation_text(units, response);
    };
    const std::string usual = what(Units::of_readers(scene.units));
    return {
        .file = fmt::format("response_force_{}", index),
        .title = "Response to " + usual,
        .picture = usual,
        .chart =
            [&](const Units &units) { return force_chart(scene, result.speeds, response, units); },
        .csv = [&](const Units &units) { return motion_csv(result.speeds, response, units); },
        .sections =
            [&, what](const Units &units) {
                const std::string name = capitalized(what(units)) + ": ";
                std::vector<Section> all{
                    {name + "where they act", page_table(acting_columns, response.forces, units)}};
                add_sections(all, motion_sections(result.speeds, response, name, units));
                return all;
            },
        .text =
            [&, what](const Units &units) {
                return "Under " + what(units) + ":\n" +
                       text_table(acting_columns, response.forces, units) + "\n" +
                       motion_text(result.speeds, response, "", units);
            }};
}

/// The unbalance response first; never empty.
std::vector<Part> parts_of(const model::Case &scene, const ResponseResult &result) {
    std::vector<Part> parts;
    if (!result.nodes.empty() || (!result.gravity && !result.receptance && result.forces.empty()))
        parts.push_back(imbalance_part(scene, result));
    for (const ForceResponse &response : result.forces)
        parts.push_back(force_part(scene, result, response,
                                   static_cast<std::size_t>(&response - result.forces.data()) + 1));
    if (result.gravity)
        parts.push_back(weight_part(scene, result));
    if (result.receptance)
        parts.push_back(receptance_part(scene, result));
    return parts;
}

Json json_of(const model::Case &scene, const ResponseResult &result, const Units &units) {
    Json json{{"speeds", written(units, Quantity::speed, result.speeds)}};
    if (result.operating)
        take_entries(json, operating_json(*result.operating, units));
    add_runs(json, result, units);
    // Without an imbalance the first of the forces, so that a motion is always at the same place.
    const HarmonicMotion *first = &result;
    if (result.nodes.empty() && !result.forces.empty())
        first = &result.forces.front();
    take_entries(json, motion_json(result.speeds, *first, units));
    add_orbits(json, result, units);
    add_margins(json, result.margins, units);
    if (!result.forces.empty())
        json["forces"] = json_list(result.forces, [&](const ForceResponse &response) {
            return force_json(result.speeds, response, units);
        });
    for (const Part &part : parts_of(scene, result))
        if (part.json)
            json[part.key] = part.json(units);
    return json;
}

std::string text_of(const model::Case &scene, const ResponseResult &result, const Units &units) {
    const std::vector<Part> parts = parts_of(scene, result);
    return heading(scene, parts.front().title + ", " +
                              (result.receptance && parts.size() == 1
                                   ? range_text({result.receptance->speed}, units)
                                   : range_text(result.speeds, units))) +
           worst_run_text(result, units) + operating_text(result, units) +
           runs_text(result, units) +
           joined(parts, "\n", [&units](const Part &part) { return part.text(units); }) +
           model_text(result.model, units);
}

/// The polar plot, orbits and shapes, and the pictures of all motions beside the first.
std::vector<Picture> pictures_of(const model::Case &scene, const ResponseResult &result,
                                 const Units &units) {
    std::vector<Picture> pictures;
    if (has_polar(result))
        pictures.push_back({"response_polar", polar_chart(scene, result, units), {}});
    for (Picture &picture : orbit_pictures(scene, result, units))
        pictures.push_back(std::move(picture));
    const std::vector<Part> parts = parts_of(scene, result);
    for (std::size_t i = 1; i < parts.size(); ++i)
        pictures.push_back({parts[i].file, parts[i].chart(units), parts[i].csv});
    return pictures;
}

/// "Polar plot, orbits, deflected shapes"
std::string pictures_heading(const std::vector<Part> &parts, const ResponseResult &result) {
    std::vector<std::string> words;
    if (has_polar(result))
        words.emplace_back("polar plot");
    if (!result.orbits.empty())
        words.emplace_back("orbits");
    if (!result.shapes.empty())
        words.emplace_back("deflected shapes");
    for (std::size_t i = 1; i < parts.size(); ++i)
        words.push_back(parts[i].picture);
    return words.empty() ? "Pictures" : capitalized(joined(words, ", "));
}

/// The largest amplitude of the stations, or reading of the probes, in one sentence.
model::Sentence answer_of(const ResponseResult &result) {
    namespace as = model::as;
    if (result.operating && !result.operating->rows.empty())
        return operating_answer(result);
    const bool probes = !result.probes.empty();
    const std::vector<LargestValue> all = probes ? largest_readings(result.speeds, result)
                                                 : largest_amplitudes(result.speeds, result);
    const LargestValue *largest = nullptr;
    for (const LargestValue &at : all)
        if (at.value && (!largest || *at.value > *largest->value))
            largest = &at;
    if (!largest)
        return result.receptance || result.gravity || !result.forces.empty()
                   ? "no imbalance drives the rotor; its motion under other forces is below"
                   : "no amplitude is known";
    const model::Sentence where = largest->name.empty()
                                      ? model::Sentence("z = {}", as::length(largest->z, 4))
                                      : model::Sentence("{}", largest->name);
    if (std::isinf(*largest->value))
        return {"without limit at a resonance without damping: {} at {}", where,
                as::speed(largest->speed, 5)};
    return {"the largest {} from {} is {}, {} at {}",
            probes ? "reading of a probe" : "amplitude of a station",
            as::speed.range(result.speeds.front(), result.speeds.back(), 4),
            as::amplitude(*largest->value, 4),
            where,
            as::speed(largest->speed, 5)};
}

/// What is told before the curves: the operating speeds and the standard runs.
std::vector<Section> first_sections(const ResponseResult &result, const Units &units) {
    std::vector<Section> sections = operating_sections(result, units);
    add_sections(sections, run_sections(result, units));
    return sections;
}

std::vector<Section> brief_of(const ResponseResult &result, const Units &units) {
    std::vector<Section> sections = run_sections(result, units);
    add_sections(sections, operating_brief(result, units));
    add_table(sections, "Resonances", resonance_columns, result.resonances, units, brief_rows);
    return sections;
}

} // namespace

Report describe(const model::Case &scene, const ResponseResult &result) {
    const std::vector<Part> parts = parts_of(scene, result);
    Report report{.command = "response",
                  .heading = parts.front().title,
                  .scene = &scene,
                  .model = &result.model,
                  .json = [&](const Units &units) { return json_of(scene, result, units); },
                  .csv = parts.front().csv,
                  .sections =
                      [parts, &result](const Units &units) {
                          std::vector<Section> sections = first_sections(result, units);
                          for (const Part &part : parts)
                              add_sections(sections, part.sections(units));
                          return sections;
                      },
                  .text = [&](const Units &units) { return text_of(scene, result, units); },
                  .chart = parts.front().chart};
    if (result.operating)
        report.tables = [&result] {
            std::vector<TableFile> files{{"response_operating", [&result](const Units &units) {
                                              return operating_csv({}, result.operating->rows,
                                                                   units);
                                          }}};
            if (!result.runs.empty())
                files.push_back({"response_runs", [&result](const Units &units) {
                                     return runs_csv(result, units);
                                 }});
            return files;
        };
    report.pictures = [&scene, &result](const Units &units) {
        return pictures_of(scene, result, units);
    };
    report.pictures_heading = pictures_heading(parts, result);
    report.pictures_after = result.nodes.empty() ? 0 : 2 + first_sections(result, Units()).size();
    if (!result.speeds.empty()) // complete: on the first process
        report.answer = answer_of(result);
    report.brief = [&](const Units &units) { return brief_of(result, units); };
    return report;
}

} // namespace whirl::report
