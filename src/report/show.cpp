// Report of the command show.

#include "results/show.h"

#include "report/common/csv.h"
#include "report/common/table.h"
#include "report/common/words.h"
#include "report/pictures/figures.h"
#include "report/reports.h"

#include <fmt/format.h>

#include <algorithm>

namespace whirl::report {

using results::AnisotropyChart;
using results::BalancerNumbers;
using results::CompositeCurves;
using results::DimensionlessNumbers;
using results::SagBearing;
using results::SagStation;
using results::ShowResult;
using results::StaticSag;

namespace {

const Columns<ShowResult> show_columns{
    {"mass", InCsv("mass [kg]"), OnPage("Mass", "{:.8g} kg"), InText("mass", "{:.6g} kg"),
     &ShowResult::mass},
    {OnPage("of it the shaft", "{:.8g} kg"), InText("of the shaft", "{:.6g} kg"),
     &ShowResult::shaft_mass},
    {OnPage("Length of the shaft", "{:.8g} m"), InText("length", "{:.6g} m"), &ShowResult::length},
    {"center_of_mass", InCsv("center_of_mass [m]"), OnPage("Centre of mass, z", "{:.8g} m"),
     InText("centre of mass", "z = {:.6g} m"), &ShowResult::center_of_mass},
    {"Id", InCsv("Id [kg m2]"), OnPage("Diametral inertia about it", "{:.8g} kg m²"),
     InText("diametral inertia Id", "{:.6g} kg m2"), &ShowResult::Id},
    {"Ip", InCsv("Ip [kg m2]"), OnPage("Polar inertia", "{:.8g} kg m²"),
     InText("polar inertia Ip", "{:.6g} kg m2"), &ShowResult::Ip},
    {"type", InCsv("type"), OnPage("Type"), &ShowResult::type},
    {"shaft_mass", InCsv("shaft_mass [kg]"), &ShowResult::shaft_mass},
    {"length", InCsv("length [m]"), &ShowResult::length},
    {"dI", &ShowResult::dI},
    {"dI_angle", &ShowResult::dI_angle}};

// At rest under its weight.
const Columns<SagStation> sag_columns{
    {"z", OnPage("z (m)"), InText("z m"), &SagStation::z},
    {"name", OnPage("Station"), InText("station"), &SagStation::name},
    {"x", &SagStation::x},
    {"y", &SagStation::y},
    {OnPage("Static deflection x (µm)", "{:.5g}"), InText("static x µm", "{:.4g}"),
     in(still_micrometres, &SagStation::x)},
    {OnPage("Static deflection y (µm)", "{:.5g}"), InText("static y µm", "{:.4g}"),
     in(still_micrometres, &SagStation::y)},
    {"slope_x", OnPage("Slope x (rad)", "{:.5g}"), &SagStation::slope_x},
    {"slope_y", OnPage("Slope y (rad)", "{:.5g}"), InText("slope y rad", "{:.4g}"),
     &SagStation::slope_y},
    {"error", OnPage("Relative error", "{:.2g}"), InText("error", rough), &SagStation::error},
    {"slope_error", &SagStation::slope_error}};

const Columns<SagBearing> load_columns{
    {"z", OnPage("z (m)"), InText("z m"), &SagBearing::z},
    {"name", OnPage("Bearing"), InText("bearing"), &SagBearing::name},
    {"load", OnPage("Load downwards (N)", "{:.7g}"), InText("load downwards N", "{:.6g}"),
     &SagBearing::load},
    {"side", OnPage("Load along x (N)", "{:.5g}"), &SagBearing::side},
    {"error", OnPage("Relative error", "{:.2g}"), InText("error", rough), &SagBearing::error}};

std::string sag_heading(const StaticSag &sag) {
    return fmt::format("At rest under its weight ({:.6g} m/s²)", sag.gravity);
}

Json sag_json(const StaticSag &sag) {
    return {{"gravity", sag.gravity},
            {"stations", json_rows(sag_columns, sag.stations)},
            {"bearings", json_rows(load_columns, sag.bearings)}};
}

/// Two ends in one cell.
auto ends(std::optional<results::Interval> BalancerNumbers::*of, const char *format) {
    return [of, format](const BalancerNumbers &b) {
        const auto &interval = b.*of;
        return interval ? Json(fmt::format(fmt::runtime(format), interval->from, interval->to))
                        : Json();
    };
}

std::string name_of(const BalancerNumbers &balancer, std::size_t index) {
    return (balancer.name.empty() ? std::to_string(index + 1) : balancer.name) +
           (balancer.held ? " (held)" : "");
}

std::string position_text(const BalancerNumbers &balancer) {
    std::string text;
    for (const double angle : balancer.position) {
        if (text.size() > 200)
            return text + " …";
        text += fmt::format("{}{:.5g}°", text.empty() ? "" : ", ", angle * degrees);
    }
    return text.empty() ? "–" : text;
}

const Columns<BalancerNumbers> balancer_columns{
    {InText("balancer"), name_of},
    {"name", &BalancerNumbers::name},
    {"z", OnPage("Place, z", "{:.8g} m"), InText("z (m)"), &BalancerNumbers::z},
    {"held", [](const auto &b) { return b.held; }},
    {"E", OnPage("Capacity E", "{:.8g}", "∞"), InText("E", "{:.6g}", "infinite"),
     &BalancerNumbers::E},
    {OnPage("Place of the balls"), position_text},
    {"D_c", OnPage("Second harmonic D: cosine part", "{:.8g}"), InText("D_c"),
     [](const auto &b) { return b.D ? Json(b.D->real()) : Json(); }},
    {"D_s", OnPage("Second harmonic D: sine part", "{:.8g}"), InText("D_s"),
     [](const auto &b) { return b.D ? Json(b.D->imag()) : Json(); }},
    {"D_interval", &BalancerNumbers::D_interval},
    {OnPage("|D| over all balanced positions"),
     ends(&BalancerNumbers::D_interval, "{:.8g} … {:.8g}")},
    {InText("|D| of the family"), ends(&BalancerNumbers::D_interval, "{:.6g} ... {:.6g}")},
    {"dA", OnPage("Anisotropy |A_m0 + A_m D|/2", "{:.8g} kg m²", "∞"), InText("dA (kg m2)"),
     &BalancerNumbers::dA},
    {"dA_interval", &BalancerNumbers::dA_interval},
    {OnPage("over all balanced positions"),
     ends(&BalancerNumbers::dA_interval, "{:.8g} … {:.8g} kg m²")},
    {InText("dA of the family"), ends(&BalancerNumbers::dA_interval, "{:.6g} ... {:.6g}")},
    {"dA_paper", OnPage("with the unsigned |D|", "{:.8g} kg m²", "∞"), &BalancerNumbers::dA_paper},
    {OnPage("Mass of the rest of the rotor", "{:.8g} kg"),
     [](const auto &b) { return b.bare.mass; }},
    {OnPage("its diametral inertia", "{:.8g} kg m²"), [](const auto &b) { return b.bare.Id; }},
    {OnPage("its polar inertia", "{:.8g} kg m²"), [](const auto &b) { return b.bare.Ip; }},
    {OnPage("from its centre of mass to the balancer", "{:.8g} m"),
     [](const auto &b) { return b.bare.z_GA; }},
    {"position", &BalancerNumbers::position}};

/// @param on_terminal  empty: on the page alone
Column<BalancerNumbers> dimensionless(const char *key, const char *on_page, const char *on_terminal,
                                      auto DimensionlessNumbers::*of) {
    const bool there = *on_terminal != '\0';
    return {key, OnPage(on_page, "{:.8g}", "∞"),
            there ? InText(on_terminal, "{:.6g}", "infinite") : InText(),
            [of](const BalancerNumbers &b) { return b.dimensionless.*of; }};
}

const Columns<BalancerNumbers> dimensionless_columns{
    {InText("balancer"), name_of},
    dimensionless("C", "C", "C", &DimensionlessNumbers::C),
    dimensionless("A", "A", "A", &DimensionlessNumbers::A),
    dimensionless("A_m", "A_m", "A_m", &DimensionlessNumbers::A_m),
    dimensionless("A_m0", "A_m0", "A_m0", &DimensionlessNumbers::A_m0),
    dimensionless("m", "m", "m", &DimensionlessNumbers::m),
    dimensionless("z_A", "z_A", "z_A", &DimensionlessNumbers::z_A),
    dimensionless("p2", "p²", "p2", &DimensionlessNumbers::p2),
    dimensionless("c_y", "c_y", "c_y", &DimensionlessNumbers::c_y),
    dimensionless("h_x", "h_x", "h_x", &DimensionlessNumbers::h_x),
    dimensionless("h_beta", "h_β", "", &DimensionlessNumbers::h_beta),
    dimensionless("h_y", "h_y", "", &DimensionlessNumbers::h_y),
    dimensionless("h_s", "h_s", "h_s", &DimensionlessNumbers::h_s)};

/// The anisotropy alone, before and after what there may be several of.
const Columns<AnisotropyChart> chart_columns{
    {"C", OnPage("Polar over mean diametral inertia, C", "{:.8g}", "∞"), &AnisotropyChart::C},
    {"A", OnPage("Anisotropy over the mean diametral inertia", "{:.8g}", "∞"),
     &AnisotropyChart::anisotropy},
    {"p", OnPage("Natural frequency of tilt at rest, p", "{:.8g} rad/s", "∞"), &AnisotropyChart::p},
    {"h", OnPage("Tilt damping over the mean diametral inertia, h", "{:.8g} 1/s", "∞"),
     &AnisotropyChart::h},
    {"critical_speeds", &AnisotropyChart::critical_speeds},
    {"permissible", &AnisotropyChart::permissible},
    {"permissible_speed", &AnisotropyChart::permissible_speed}};

Texts chart_lines(const AnisotropyChart &chart) {
    const auto number = [](double value) { return shown(value, {"", "{:.8g}", "∞"}, "–"); };
    Texts lines = properties(chart_columns, chart, &Column<AnisotropyChart>::page, "–");
    lines.insert(lines.begin(), {"Quantity", "Value"});
    for (const double speed : chart.critical_speeds)
        lines.push_back({"Critical speed without damping", number(speed) + " rad/s"});
    if (chart.unstable)
        lines.push_back({"Unstable", number(chart.unstable->from) + " … " +
                                         (chart.unstable->to ? number(*chart.unstable->to) : "∞") +
                                         " rad/s"});
    lines.push_back({"Largest anisotropy stable at every speed", number(chart.permissible)});
    lines.push_back({"least at", chart.permissible_speed
                                     ? number(*chart.permissible_speed) + " rad/s"
                                     : "infinite speed"});
    return lines;
}

std::string chart_text(const AnisotropyChart &chart) {
    std::string text = "  tilt as a rigid rotor: critical speeds";
    for (const double speed : chart.critical_speeds)
        text += fmt::format(" {:.7g}", speed);
    text += chart.critical_speeds.empty() ? " none" : " rad/s";
    if (!chart.unstable)
        text += ", stable at every speed";
    else if (chart.unstable->to)
        text += fmt::format(", unstable from {:.7g} to {:.7g} rad/s", chart.unstable->from,
                            *chart.unstable->to);
    else
        text += fmt::format(", unstable above {:.7g} rad/s", chart.unstable->from);
    return text + fmt::format("\n  largest anisotropy dI/Id stable at every speed: {:.5g} (the "
                              "case has {:.5g})\n\n",
                              chart.permissible, chart.anisotropy);
}

std::vector<Picture> pictures_of(const model::Case &scene, const ShowResult &result,
                                 const Units &units) {
    std::vector<Picture> pictures;
    for (std::size_t i = 0; i < result.balancers.size(); ++i) {
        if (!result.balancers[i].curves)
            continue;
        const CompositeCurves &c = *result.balancers[i].curves;
        pictures.push_back({i == 0 ? "composite" : "composite_" + std::to_string(i + 1),
                            composite_figure(scene, result, i, units), [&c](const Units &) {
                                return csv_lists({{"n m/M_s", c.m},
                                                  {"A_m", c.A_m},
                                                  {"A_C1", c.A_C1},
                                                  {"A_C2", c.A_C2},
                                                  {"A", c.A},
                                                  {"C", c.C},
                                                  {"A_C1 with |D|", c.A_C1_paper},
                                                  {"A_C2 with |D|", c.A_C2_paper},
                                                  {"A with |D|", c.A_paper},
                                                  {"A least", c.A_least},
                                                  {"A largest", c.A_largest}});
                            }});
    }
    if (const auto &chart = result.anisotropy)
        pictures.push_back(
            {"anisotropy", anisotropy_figure(scene, *chart, units), [&chart](const Units &) {
                 return csv_lists({{"speed [rad/s]", chart->speed},
                                   {"anisotropy at the stability limit", chart->limit},
                                   {"anisotropy at a critical speed", chart->undamped}});
             }});
    return pictures;
}

Json balancer_json(const BalancerNumbers &balancer) {
    Json json = json_row(balancer_columns, balancer);
    json["bare_rotor"] = {{"mass", balancer.bare.mass},
                          {"Id", balancer.bare.Id},
                          {"Ip", balancer.bare.Ip},
                          {"Ip_over_Id", balancer.bare.Ip / balancer.bare.Id},
                          {"z_GA", balancer.bare.z_GA}};
    json["dimensionless"] = json_row(dimensionless_columns, balancer);
    return json;
}

Json chart_json(const AnisotropyChart &chart) {
    Json json = json_row(chart_columns, chart);
    json["unstable"] = Json::array();
    if (chart.unstable)
        json["unstable"].push_back(Json::array({chart.unstable->from, chart.unstable->to}));
    return json;
}

Json json_of(const ShowResult &result, const Units &) {
    Json json = json_row(show_columns, result);
    json["static"] = result.sag ? sag_json(*result.sag) : Json();
    json["balancers"] = json_list(result.balancers, balancer_json);
    json["anisotropy"] = result.anisotropy ? chart_json(*result.anisotropy) : Json();
    json["formulations"] = json_list(result.formulations, [](const auto &entry) {
        Json form{{"command", entry.first}};
        form.update(Json(entry.second));
        return form;
    });
    return json;
}

std::vector<Section> sections_of(const ShowResult &result, const Units &) {
    std::vector<Section> sections{{"Rigid body", page_properties(show_columns, result)}};
    if (const auto &sag = result.sag)
        sections.push_back({sag_heading(*sag), page_table(load_columns, sag->bearings) +
                                                   page_table(sag_columns, sag->stations)});
    for (std::size_t i = 0; i < result.balancers.size(); ++i) {
        const BalancerNumbers &balancer = result.balancers[i];
        const std::string name =
            balancer.name.empty() ? fmt::format("balancer {}", i + 1) : balancer.name;
        sections.push_back({"Composite rotor: " + name + (balancer.held ? " (held)" : ""),
                            page_properties(balancer_columns, balancer) +
                                page_table(dimensionless_columns, std::vector{balancer})});
    }
    if (result.anisotropy)
        sections.push_back(
            {"Anisotropy: tilt of the rigid rotor", page_table(chart_lines(*result.anisotropy))});
    Texts forms{{"Command", "Form", "Why"}};
    for (const auto &[command, used] : result.formulations)
        forms.push_back({command, results::form_name(used.form), used.why});
    sections.push_back({"Form each analysis uses", page_table(forms)});
    return sections;
}

/// Commands that use the same form for the same reason share a line.
std::string forms_text(const ShowResult &result) {
    std::vector<std::pair<std::string, std::string>> forms;
    for (const auto &[command, used] : result.formulations) {
        const std::string what =
            fmt::format("{} form ({})", results::form_name(used.form), used.why);
        const auto same = std::find_if(forms.begin(), forms.end(),
                                       [&what](const auto &form) { return form.second == what; });
        if (same == forms.end())
            forms.emplace_back(command, what);
        else
            same->first += ", " + command;
    }
    std::string text;
    for (const auto &[commands, what] : forms)
        text += fmt::format("  {}: {}\n", commands, what);
    return text;
}

std::string text_of(const model::Case &scene, const ShowResult &result, const Units &) {
    Texts lines = properties(show_columns, result, &Column<ShowResult>::text, "-");
    if (result.dI.value_or(0) > 0)
        lines.push_back({"anisotropy dI", fmt::format("{:.6g} kg m2", *result.dI)});
    std::string text =
        heading(scene, fmt::format("A {} rotor", result.type)) + text_table(lines) + "\n";
    if (!result.balancers.empty())
        text += text_table(balancer_columns, result.balancers) + "\n" +
                text_table(dimensionless_columns, result.balancers) + "\n";
    if (result.anisotropy)
        text += chart_text(*result.anisotropy);
    if (const auto &sag = result.sag)
        text += sag_heading(*sag) + "\n" + text_table(load_columns, sag->bearings) + "\n" +
                text_table(sag_columns, sag->stations) + "\n";
    return text + forms_text(result) + notes_text(result.model);
}

} // namespace

Report describe(const model::Case &scene, const ShowResult &result) {
    return {.command = "show",
            .heading = "Scene",
            .scene = &scene,
            .model = &result.model,
            .json = [&](const Units &units) { return json_of(result, units); },
            .csv = [&](const Units &) { return csv_table(show_columns, std::vector{result}); },
            .sections = [&](const Units &units) { return sections_of(result, units); },
            .text = [&](const Units &units) { return text_of(scene, result, units); },
            .drawing = [&](const Units &units) { return show_drawing(scene, result, units); },
            .pictures = [&](const Units &units) { return pictures_of(scene, result, units); },
            .pictures_heading = "Curves of the rigid rotor",
            .pictures_after =
                (result.sag ? 2 : 1) + result.balancers.size() + (result.anisotropy ? 1 : 0)};
}

} // namespace whirl::report
