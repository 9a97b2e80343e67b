// Report of the command modes.

#include "results/modes.h"

#include "balancers/kind.h"
#include "report/common/csv.h"
#include "report/common/words.h"
#include "report/pictures/figures.h"
#include "report/pictures/scene_parts.h"
#include "report/reports.h"
#include "report/sections.h"
#include "report/vtk.h"
#include "results/whirl.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::report {

using results::Dissipation;
using results::ModeShape;
using results::ModesResult;

namespace {

double frequency(const ModeShape &mode) { return mode.eigenvalue.imag(); }
double real_part(const ModeShape &mode) { return mode.eigenvalue.real(); }

double damping_ratio(const ModeShape &mode) {
    const double modulus = std::abs(mode.eigenvalue);
    return modulus > 0 ? 0.0 - real_part(mode) / modulus : 0.0;
}

Json json_of(const Dissipation &part, const Units &units) {
    return {{"of", part.of},
            {"z", written(units, Quantity::length, part.z)},
            {"name", part.name},
            {"share", part.share}};
}

const Columns<ModeShape> shape_columns{
    {"label", Titled("Mode"), [](const auto &mode) { return known_name(mode.label); }},
    {"at", Quantity::speed, &ModeShape::at},
    {"frequency", OnPage("Frequency", "{:.10g}").and_si("{:.10g}"), InText("").and_si(precise),
     Quantity::frequency, frequency},
    {"real", OnPage("Real part"), Quantity::rate, real_part},
    {InText("damping ratio"), Quantity::number, damping_ratio},
    {"whirl", &ModeShape::whirl},
    {"plane", Quantity::angle, &ModeShape::plane},
    {Titled("Whirl"), whirl_of},
    {"forward_share", OnPage("Forward share", "{:.4g}"), Quantity::number,
     &ModeShape::forward_fraction},
    {"forward_fraction", Quantity::number, &ModeShape::forward_fraction}, // its older name
    {"x_real", Quantity::number, [](const auto &mode) { return real_parts(mode.x); }},
    {"x_imag", Quantity::number, [](const auto &mode) { return imaginary_parts(mode.x); }},
    {"y_real", Quantity::number, [](const auto &mode) { return real_parts(mode.y); }},
    {"y_imag", Quantity::number, [](const auto &mode) { return imaginary_parts(mode.y); }},
    {"dissipation", Quantity::number, [](const ModeShape &mode, const Units &units) {
         return json_list(mode.dissipation,
                          [&units](const Dissipation &part) { return json_of(part, units); });
     }}};

/// The same with the speed of each: those at critical speeds.
Columns<ModeShape> critical_columns() {
    Columns<ModeShape> columns = shape_columns;
    columns.insert(columns.begin() + 1,
                   {ForReaders("at", "{:.8g}"), Quantity::speed, &ModeShape::at});
    return columns;
}

/// "bearing, drive end"
std::string words_of(const Dissipation &part, const Units &units) {
    if (!part.z)
        return part.of;
    return part.of + ", " + place(part.name, *part.z, units);
}

/// Its name, or what else tells it from others.
std::string name_of(const ModeShape &mode, const Units &units) {
    return mode.label.empty() ? units.text(Quantity::frequency, frequency(mode), 5) : mode.label;
}

/// Shares in percent, a row a part, a column a mode; nothing where no mode has any.
Texts dissipation_texts(const std::vector<ModeShape> &modes, const std::string &missing,
                        const Units &units) {
    Texts table{{"Share of the dissipated power (%)"}};
    std::vector<std::string> parts;
    for (const ModeShape &mode : modes) {
        table.front().push_back(name_of(mode, units) + (real_part(mode) > 0 ? " (grows)" : ""));
        for (const Dissipation &part : mode.dissipation)
            if (std::find(parts.begin(), parts.end(), words_of(part, units)) == parts.end())
                parts.push_back(words_of(part, units));
    }
    for (const std::string &part : parts) {
        table.push_back({part});
        for (const ModeShape &mode : modes) {
            const auto found = std::find_if(
                mode.dissipation.begin(), mode.dissipation.end(),
                [&](const Dissipation &other) { return words_of(other, units) == part; });
            const bool known = found != mode.dissipation.end() && found->share;
            table.back().push_back(known ? fmt::format("{:.1f}", *found->share * 100) : missing);
        }
    }
    return parts.empty() ? Texts{} : table;
}

/// A mode at a station.
struct Deflection {
    double speed;
    const ModeShape &mode;
    double z;
    std::complex<double> x, y;
};

const Columns<Deflection> deflection_columns{
    {InCsv("speed"), Quantity::speed, &Deflection::speed},
    {InCsv("mode"), [](const auto &at) { return known_name(at.mode.label); }},
    {InCsv("frequency"), Quantity::frequency, [](const auto &at) { return frequency(at.mode); }},
    {InCsv("real"), Quantity::rate, [](const auto &at) { return real_part(at.mode); }},
    {InCsv("whirl"), [](const auto &at) { return at.mode.whirl; }},
    {InCsv("z"), Quantity::length, &Deflection::z},
    {InCsv("x_real"), Quantity::number, [](const auto &at) { return at.x.real(); }},
    {InCsv("x_imag"), Quantity::number, [](const auto &at) { return at.x.imag(); }},
    {InCsv("y_real"), Quantity::number, [](const auto &at) { return at.y.real(); }},
    {InCsv("y_imag"), Quantity::number, [](const auto &at) { return at.y.imag(); }},
    {InCsv("plane"), Quantity::angle, [](const auto &at) { return at.mode.plane; }}};

std::string csv_of(const ModesResult &result, const Units &units) {
    std::vector<Deflection> rows;
    for (const std::vector<ModeShape> *list : {&result.modes, &result.critical})
        for (const ModeShape &mode : *list)
            for (std::size_t i = 0; i < std::min({result.z.size(), mode.x.size(), mode.y.size()});
                 ++i)
                rows.push_back({mode.at, mode, result.z[i], mode.x[i], mode.y[i]});
    return csv_table(deflection_columns, rows, units);
}

std::string after_a_line(const Texts &table) {
    return table.empty() ? "" : "\n" + text_table(table);
}

std::string text_of(const model::Case &scene, const ModesResult &result, const Units &units) {
    return heading(scene, "Mode shapes at " + units.text(Quantity::speed, result.speed)) +
           text_table(shape_columns, result.modes, units) +
           after_a_line(dissipation_texts(result.modes, "-", units)) +
           text_table("\nAt the critical speeds:\n", critical_columns(), result.critical, units) +
           after_a_line(dissipation_texts(result.critical, "-", units)) +
           model_text(result.model, units);
}

/// What of the rotor is drawn in space, for the script of the page.
Json drawn_rotor(const model::Rotor &rotor, const Units &units) {
    const auto length = [&units](double si) { return units(Quantity::length, si); };
    Json segments = Json::array();
    double z = 0;
    double thickest = 0;
    for (const model::Segment &segment : rotor.shaft.segments) {
        segments.push_back({length(z), length(z + segment.length), length(segment.outer_start / 2),
                            length(segment.outer_end / 2)});
        z += segment.length;
        thickest = std::max({thickest, segment.outer_start / 2, segment.outer_end / 2});
    }
    Json discs = Json::array();
    for (const model::Disc &disc : rotor.discs)
        discs.push_back({{"z", length(disc.z)},
                         {"radius", length(std::max(disc_radius(disc), 1.3 * thickest))},
                         {"half", length(std::max(disc.width / 2, 0.004 * z))},
                         {"balancer", false}});
    for (const model::Balancer &balancer : rotor.balancers)
        discs.push_back({{"z", length(balancer.z)},
                         {"radius", length(balancers::kind_of(balancer)->outline().radius())},
                         {"half", length(0.004 * z)},
                         {"balancer", true}});
    const Json bearings = json_list(rotor.bearings, [&](const model::Bearing &bearing) {
        return Json{{"z", length(bearing.z)}, {"seal", bearing.seal}};
    });
    return {
        {"length", length(z)}, {"segments", segments}, {"discs", discs}, {"bearings", bearings}};
}

std::vector<Section> sections_of(const ModesResult &result, const Units &units) {
    std::vector<Section> sections{{"Shapes in space", "<div id=\"space\"></div>\n"},
                                  {"Modes at " + units.text(Quantity::speed, result.speed),
                                   page_table(shape_columns, result.modes, units)}};
    const Texts dissipation = dissipation_texts(result.modes, "–", units);
    if (!dissipation.empty())
        sections.push_back({"Where the modes dissipate", page_table(dissipation)});
    add_table(sections, "Modes at the critical speeds", critical_columns(), result.critical, units);
    const Texts critical = dissipation_texts(result.critical, "–", units);
    if (!critical.empty())
        sections.push_back({"Where they dissipate", page_table(critical)});
    return sections;
}

/// The frequencies and the mode that is damped least, in one sentence.
model::Sentence answer_of(const ModesResult &result) {
    namespace as = model::as;
    if (result.modes.empty())
        return {"no modes at {}", as::speed(result.speed, 5)};
    std::vector<double> frequencies;
    for (const ModeShape &mode : result.modes)
        frequencies.push_back(frequency(mode));
    model::Sentence answer("at {} the modes swing with {}", as::speed(result.speed, 5),
                           as::frequency.list(frequencies, 4));
    const auto least = std::ranges::min_element(result.modes, {}, damping_ratio);
    const double ratio = damping_ratio(*least);
    if (ratio == 0)
        return answer;
    return answer += ratio > 0 ? model::Sentence("; {} is damped least, damping ratio {}",
                                                 least->label, as::number(ratio, 3))
                               : model::Sentence("; {} grows, damping ratio {}", least->label,
                                                 as::number(ratio, 3));
}

std::vector<Section> brief_of(const ModesResult &result, const Units &units) {
    std::vector<Section> sections{
        {"Modes at " + units.text(Quantity::speed, result.speed),
         page_table_of_first(brief_rows, shape_columns, result.modes, units)}};
    const Texts dissipation = dissipation_texts(result.modes, "–", units);
    if (!dissipation.empty())
        sections.push_back({"Where the modes dissipate", page_table(dissipation)});
    return sections;
}

} // namespace

Report describe(const model::Case &scene, const ModesResult &result) {
    return {.command = "modes",
            .heading = "Mode shapes",
            .scene = &scene,
            .model = &result.model,
            .json =
                [&](const Units &units) {
                    return Json{
                        {"speed", written(units, Quantity::speed, result.speed)},
                        {"z", written(units, Quantity::length, result.z)},
                        {"modes", json_rows(shape_columns, result.modes, units)},
                        {"critical_modes", json_rows(shape_columns, result.critical, units)}};
                },
            .csv = [&](const Units &units) { return csv_of(result, units); },
            .sections = [&](const Units &units) { return sections_of(result, units); },
            .text = [&](const Units &units) { return text_of(scene, result, units); },
            .chart = [&](const Units &units) { return modes_chart(scene, result, units); },
            .drawn =
                [&](const Units &units) {
                    return Json{{"rotor", drawn_rotor(scene.rotor, units)},
                                {"at", "At " + units.text(Quantity::speed, result.speed)},
                                {"modes", mode_headings(result.modes, units, false)},
                                {"critical_modes", mode_headings(result.critical, units, true)}};
                },
            .vtp = [&] { return to_vtp(scene, result); },
            .answer = answer_of(result),
            .brief = [&](const Units &units) { return brief_of(result, units); }};
}

} // namespace whirl::report
