// Report of the command modes.

#include "results/modes.h"

#include "balancers/kind.h"
#include "report/common/csv.h"
#include "report/common/table.h"
#include "report/common/words.h"
#include "report/pictures/figures.h"
#include "report/pictures/scene_parts.h"
#include "report/reports.h"
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

Json json_of(const Dissipation &part) {
    return {{"of", part.of}, {"z", part.z}, {"name", part.name}, {"share", part.share}};
}

const Columns<ModeShape> shape_columns{
    {"label", OnPage("Mode"), InText("mode"),
     [](const auto &mode) { return known_name(mode.label); }},
    {"at", &ModeShape::at},
    {"frequency", OnPage("Frequency (rad/s)", "{:.10g}"), InText("rad/s", precise), frequency},
    {OnPage("Frequency (Hz)", "{:.10g}"), InText("Hz"), in(hertz, frequency)},
    {"real", OnPage("Real part (1/s)"), real_part},
    {InText("damping ratio"), damping_ratio},
    {"whirl", OnPage("Whirl"), InText("whirl"), &ModeShape::whirl},
    {"forward_share", OnPage("Forward share", "{:.4g}"), &ModeShape::forward_fraction},
    {"forward_fraction", &ModeShape::forward_fraction}, // its older name
    {"x_real", [](const auto &mode) { return real_parts(mode.x); }},
    {"x_imag", [](const auto &mode) { return imaginary_parts(mode.x); }},
    {"y_real", [](const auto &mode) { return real_parts(mode.y); }},
    {"y_imag", [](const auto &mode) { return imaginary_parts(mode.y); }},
    {"dissipation", [](const ModeShape &mode) { return json_list(mode.dissipation, json_of); }}};

/// The same with the speed of each: those at critical speeds.
Columns<ModeShape> critical_columns() {
    Columns<ModeShape> columns = shape_columns;
    columns.insert(columns.begin() + 1, {OnPage("at (rpm)", "{:.8g}"), InText("at rpm", "{:.8g}"),
                                         in(rpm, &ModeShape::at)});
    return columns;
}

/// "bearing, drive end"
std::string words_of(const Dissipation &part) {
    if (!part.z)
        return part.of;
    return part.of + ", " + place(part.name, *part.z);
}

/// Its name, or what else tells it from others.
std::string name_of(const ModeShape &mode) {
    return mode.label.empty() ? readable(frequency(mode) * hertz) + " Hz" : mode.label;
}

/// Shares in percent, a row a part, a column a mode; nothing where no mode has any.
Texts dissipation_texts(const std::vector<ModeShape> &modes, const std::string &missing) {
    Texts table{{"Share of the dissipated power (%)"}};
    std::vector<std::string> parts;
    for (const ModeShape &mode : modes) {
        table.front().push_back(name_of(mode) + (real_part(mode) > 0 ? " (grows)" : ""));
        for (const Dissipation &part : mode.dissipation)
            if (std::find(parts.begin(), parts.end(), words_of(part)) == parts.end())
                parts.push_back(words_of(part));
    }
    for (const std::string &part : parts) {
        table.push_back({part});
        for (const ModeShape &mode : modes) {
            const auto found =
                std::find_if(mode.dissipation.begin(), mode.dissipation.end(),
                             [&part](const Dissipation &other) { return words_of(other) == part; });
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
    {InCsv("speed [rad/s]"), &Deflection::speed},
    {InCsv("mode"), [](const auto &at) { return known_name(at.mode.label); }},
    {InCsv("frequency [rad/s]"), [](const auto &at) { return frequency(at.mode); }},
    {InCsv("real [1/s]"), [](const auto &at) { return real_part(at.mode); }},
    {InCsv("whirl"), [](const auto &at) { return at.mode.whirl; }},
    {InCsv("z [m]"), &Deflection::z},
    {InCsv("x_real"), [](const auto &at) { return at.x.real(); }},
    {InCsv("x_imag"), [](const auto &at) { return at.x.imag(); }},
    {InCsv("y_real"), [](const auto &at) { return at.y.real(); }},
    {InCsv("y_imag"), [](const auto &at) { return at.y.imag(); }}};

std::string csv_of(const ModesResult &result, const Units &) {
    std::vector<Deflection> rows;
    for (const std::vector<ModeShape> *list : {&result.modes, &result.critical})
        for (const ModeShape &mode : *list)
            for (std::size_t i = 0; i < std::min({result.z.size(), mode.x.size(), mode.y.size()});
                 ++i)
                rows.push_back({mode.at, mode, result.z[i], mode.x[i], mode.y[i]});
    return csv_table(deflection_columns, rows);
}

std::string after_a_line(const Texts &table) {
    return table.empty() ? "" : "\n" + text_table(table);
}

std::string text_of(const model::Case &scene, const ModesResult &result, const Units &) {
    return heading(scene, fmt::format("Mode shapes at {:.6g} rpm", result.speed * rpm)) +
           text_table(shape_columns, result.modes) +
           after_a_line(dissipation_texts(result.modes, "-")) +
           text_table("\nAt the critical speeds:\n", critical_columns(), result.critical) +
           after_a_line(dissipation_texts(result.critical, "-")) + model_text(result.model);
}

/// A JavaScript array; five digits are more than a screen shows.
std::string script_array(const std::vector<double> &values) {
    std::string text = "[";
    for (const double value : values)
        text += (text.size() > 1 ? "," : "") +
                (std::isfinite(value) ? fmt::format("{:.5g}", value) : "null");
    return text + "]";
}

/// What of the rotor is drawn in space, for the script of the page; m.
std::string drawn_rotor(const model::Rotor &rotor) {
    Json segments = Json::array();
    double z = 0;
    double thickest = 0;
    for (const model::Segment &segment : rotor.shaft.segments) {
        segments.push_back({z, z + segment.length, segment.outer_start / 2, segment.outer_end / 2});
        z += segment.length;
        thickest = std::max({thickest, segment.outer_start / 2, segment.outer_end / 2});
    }
    Json discs = Json::array();
    for (const model::Disc &disc : rotor.discs)
        discs.push_back({{"z", disc.z},
                         {"radius", std::max(disc_radius(disc), 1.3 * thickest)},
                         {"half", std::max(disc.width / 2, 0.004 * z)},
                         {"balancer", false}});
    for (const model::Balancer &balancer : rotor.balancers)
        discs.push_back({{"z", balancer.z},
                         {"radius", balancers::kind_of(balancer)->outline().radius()},
                         {"half", 0.004 * z},
                         {"balancer", true}});
    const Json bearings = json_list(rotor.bearings, [](const model::Bearing &bearing) {
        return Json{{"z", bearing.z}, {"seal", bearing.seal}};
    });
    const Json drawn{
        {"length", z}, {"segments", segments}, {"discs", discs}, {"bearings", bearings}};
    return "const rotor = " + drawn.dump() + ";\n";
}

/// The curves of the still picture for the script of the page: at the speed, then at critical ones.
std::string drawn_modes(const ModesResult &result) {
    std::string text = "const drawnModes = [";
    for (const std::vector<ModeShape> *list : {&result.modes, &result.critical})
        for (const ModeShape &mode : *list) {
            const ModeCurves curves = mode_curves(mode);
            text += fmt::format("\n{{x: {}, y: {}, atOneInstant: {}}},", script_array(curves.x),
                                script_array(curves.y), curves.at_one_instant);
        }
    return text + "];\n";
}

std::vector<Section> sections_of(const ModesResult &result, const Units &) {
    std::vector<Section> sections{{"Shapes in space", "<div id=\"space\"></div>\n"},
                                  {fmt::format("Modes at {:.6g} rpm", result.speed * rpm),
                                   page_table(shape_columns, result.modes)}};
    const Texts dissipation = dissipation_texts(result.modes, "–");
    if (!dissipation.empty())
        sections.push_back({"Where the modes dissipate", page_table(dissipation)});
    if (!result.critical.empty())
        sections.push_back(
            {"Modes at the critical speeds", page_table(critical_columns(), result.critical)});
    const Texts critical = dissipation_texts(result.critical, "–");
    if (!critical.empty())
        sections.push_back({"Where they dissipate", page_table(critical)});
    return sections;
}

} // namespace

Report describe(const model::Case &scene, const ModesResult &result) {
    return {.command = "modes",
            .heading = "Mode shapes",
            .scene = &scene,
            .model = &result.model,
            .json =
                [&](const Units &) {
                    return Json{{"speed", result.speed},
                                {"z", result.z},
                                {"modes", json_rows(shape_columns, result.modes)},
                                {"critical_modes", json_rows(shape_columns, result.critical)}};
                },
            .csv = [&](const Units &units) { return csv_of(result, units); },
            .sections = [&](const Units &units) { return sections_of(result, units); },
            .text = [&](const Units &units) { return text_of(scene, result, units); },
            .figure = [&](const Units &units) { return modes_figure(scene, result, units); },
            .script_data =
                [&](const Units &) { return drawn_rotor(scene.rotor) + drawn_modes(result); },
            .vtp = [&] { return to_vtp(scene, result); }};
}

} // namespace whirl::report
