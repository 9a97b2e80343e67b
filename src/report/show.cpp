// Report of the command show.

#include "results/show.h"

#include "report/common/csv.h"
#include "report/common/table.h"
#include "report/common/words.h"
#include "report/pictures/figures.h"
#include "report/reports.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace whirl::report {

using results::AnisotropyChart;
using results::BalancerNumbers;
using results::CompositeCurves;
using results::DimensionlessNumbers;
using results::RotorNumbers;
using results::SagBearing;
using results::SagStation;
using results::ShowResult;
using results::StaticSag;

namespace {

const Columns<ShowResult> show_columns{
    {InFiles("mass"), OnPage("Mass", "{:.8g}"), InText("mass"), Quantity::mass, &ShowResult::mass},
    {InFiles("shaft_mass"), OnPage("of it the shaft", "{:.8g}"), InText("of the shaft"),
     Quantity::mass, &ShowResult::shaft_mass},
    {InFiles("length"), OnPage("Length of the shaft", "{:.8g}"), InText("length"), Quantity::length,
     &ShowResult::length},
    {InFiles("center_of_mass"), OnPage("Centre of mass, z", "{:.8g}"), InText("centre of mass, z"),
     Quantity::length, &ShowResult::center_of_mass},
    {InFiles("Id"), OnPage("Diametral inertia about it", "{:.8g}"), InText("diametral inertia Id"),
     Quantity::inertia, &ShowResult::Id},
    {InFiles("Ip"), OnPage("Polar inertia", "{:.8g}"), InText("polar inertia Ip"),
     Quantity::inertia, &ShowResult::Ip},
    {InFiles("type"), OnPage("Type"), &ShowResult::type},
    {"dI", Quantity::inertia, &ShowResult::dI},
    {"dI_angle", Quantity::angle, &ShowResult::dI_angle}};

// At rest under its weight.
const Columns<SagStation> sag_columns{
    {"z", ForReaders("z"), Quantity::length, &SagStation::z},
    {"name", Titled("Station"), &SagStation::name},
    {"x", OnPage("Static deflection x", "{:.5g}"), InText("static x", "{:.4g}"),
     Quantity::deflection, &SagStation::x},
    {"y", OnPage("Static deflection y", "{:.5g}"), InText("static y", "{:.4g}"),
     Quantity::deflection, &SagStation::y},
    {"slope_x", OnPage("Slope x", "{:.5g}"), Quantity::slope, &SagStation::slope_x},
    {"slope_y", OnPage("Slope y", "{:.5g}"), InText("slope y", "{:.4g}"), Quantity::slope,
     &SagStation::slope_y},
    {"error", RelativeError(), &SagStation::error},
    {"slope_error", Quantity::number, &SagStation::slope_error}};

const Columns<SagBearing> load_columns{
    {"z", ForReaders("z"), Quantity::length, &SagBearing::z},
    {"name", Titled("Bearing"), &SagBearing::name},
    {"load", OnPage("Load downwards", "{:.7g}"), InText("load downwards"), Quantity::force,
     &SagBearing::load},
    {"side", OnPage("Load along x", "{:.5g}"), Quantity::force, &SagBearing::side},
    {"error", RelativeError(), &SagBearing::error}};

std::string sag_heading(const StaticSag &sag, const Units &units) {
    return fmt::format("At rest under its weight ({})",
                       units.text(Quantity::acceleration, sag.gravity));
}

Json sag_json(const StaticSag &sag, const Units &units) {
    return {{"gravity", written(units, Quantity::acceleration, sag.gravity)},
            {"stations", json_rows(sag_columns, sag.stations, units)},
            {"bearings", json_rows(load_columns, sag.bearings, units)}};
}

/// Two ends in one cell.
auto ends(std::optional<results::Interval> BalancerNumbers::*of, Quantity quantity,
          const char *format) {
    return [of, quantity, format](const BalancerNumbers &b, const Units &units) {
        const auto &interval = b.*of;
        return interval ? std::optional(fmt::format(fmt::runtime(format),
                                                    units(quantity, interval->from),
                                                    units(quantity, interval->to)))
                        : std::nullopt;
    };
}

std::string name_of(const BalancerNumbers &balancer, std::size_t index) {
    return (balancer.name.empty() ? std::to_string(index + 1) : balancer.name) +
           (balancer.held ? " (held)" : "");
}

std::string position_text(const BalancerNumbers &balancer, const Units &units) {
    std::string text;
    for (const double angle : balancer.position) {
        if (text.size() > 200)
            return text + " …";
        text += fmt::format("{}{:.5g}", text.empty() ? "" : ", ", units(Quantity::angle, angle));
    }
    return text.empty() ? "–" : text + " " + units.name(Quantity::angle);
}

const Columns<BalancerNumbers> balancer_columns{
    {InText("balancer"), name_of},
    {"name", &BalancerNumbers::name},
    {"z", OnPage("Place, z", "{:.8g}"), InText("z"), Quantity::length, &BalancerNumbers::z},
    {"held", [](const auto &b) { return b.held; }},
    {"E", OnPage("Capacity E", "{:.8g}", "∞"), InText("E", "{:.6g}", "infinite"), Quantity::number,
     &BalancerNumbers::E},
    {OnPage("Place of the balls"), position_text},
    {"D_c", OnPage("Second harmonic D: cosine part", "{:.8g}"), InText("D_c"), Quantity::number,
     [](const auto &b) { return b.D ? std::optional(b.D->real()) : std::nullopt; }},
    {"D_s", OnPage("Second harmonic D: sine part", "{:.8g}"), InText("D_s"), Quantity::number,
     [](const auto &b) { return b.D ? std::optional(b.D->imag()) : std::nullopt; }},
    {"D_interval", Quantity::number, &BalancerNumbers::D_interval},
    {OnPage("|D| over all balanced positions"),
     ends(&BalancerNumbers::D_interval, Quantity::number, "{:.8g} … {:.8g}")},
    {InText("|D| of the family"),
     ends(&BalancerNumbers::D_interval, Quantity::number, "{:.6g} ... {:.6g}")},
    {"dA", OnPage("Anisotropy |A_m0 + A_m D|/2", "{:.8g}", "∞"), InText("dA"), Quantity::inertia,
     &BalancerNumbers::dA},
    {"dA_interval", Quantity::inertia, &BalancerNumbers::dA_interval},
    {OnPage("over all balanced positions"), Quantity::inertia,
     ends(&BalancerNumbers::dA_interval, Quantity::inertia, "{:.8g} … {:.8g}")},
    {InText("dA of the family"), Quantity::inertia,
     ends(&BalancerNumbers::dA_interval, Quantity::inertia, "{:.6g} ... {:.6g}")},
    {"dA_paper", OnPage("with the unsigned |D|", "{:.8g}", "∞"), Quantity::inertia,
     &BalancerNumbers::dA_paper},
    {OnPage("Mass of the rest of the rotor", "{:.8g}"), Quantity::mass,
     [](const auto &b) { return b.bare.mass; }},
    {OnPage("its diametral inertia", "{:.8g}"), Quantity::inertia,
     [](const auto &b) { return b.bare.Id; }},
    {OnPage("its polar inertia", "{:.8g}"), Quantity::inertia,
     [](const auto &b) { return b.bare.Ip; }},
    {OnPage("from its centre of mass to the balancer", "{:.8g}"), Quantity::length,
     [](const auto &b) { return b.bare.z_GA; }},
    {"position", Quantity::angle, &BalancerNumbers::position}};

/// @param on_terminal  empty: on the page alone
/// @param of           a member of the numbers of the rotor, or of those with the balancer
Column<BalancerNumbers> dimensionless(const char *key, const char *on_page, const char *on_terminal,
                                      auto of) {
    const bool there = *on_terminal != '\0';
    return {key, OnPage(on_page, "{:.8g}", "∞"),
            there ? InText(on_terminal, "{:.6g}", "infinite") : InText(), Quantity::number,
            [of](const BalancerNumbers &b) {
                if constexpr (std::is_invocable_v<decltype(of), const RotorNumbers &>)
                    return b.dimensionless.rotor.*of;
                else
                    return b.dimensionless.*of;
            }};
}

const Columns<BalancerNumbers> dimensionless_columns{
    {InText("balancer"), name_of},
    dimensionless("C", "C", "C", &RotorNumbers::C),
    dimensionless("A", "A", "A", &RotorNumbers::A),
    dimensionless("A_m", "A_m", "A_m", &DimensionlessNumbers::A_m),
    dimensionless("A_m0", "A_m0", "A_m0", &DimensionlessNumbers::A_m0),
    dimensionless("m", "m", "m", &DimensionlessNumbers::m),
    dimensionless("z_A", "z_A", "z_A", &DimensionlessNumbers::z_A),
    dimensionless("p2", "p²", "p2", &RotorNumbers::p2),
    dimensionless("c_y", "c_y", "c_y", &RotorNumbers::c_y),
    dimensionless("h_x", "h_x", "h_x", &RotorNumbers::h_x),
    dimensionless("h_beta", "h_β", "", &RotorNumbers::h_beta),
    dimensionless("h_y", "h_y", "", &RotorNumbers::h_y),
    dimensionless("h_s", "h_s", "h_s", &DimensionlessNumbers::h_s)};

const Columns<RotorNumbers> rotor_columns{
    {"C", OnPage("C", "{:.8g}"), Quantity::number, &RotorNumbers::C},
    {"A", OnPage("A", "{:.8g}"), Quantity::number, &RotorNumbers::A},
    {"p2", OnPage("p²", "{:.8g}"), Quantity::number, &RotorNumbers::p2},
    {"c_y", OnPage("c_y", "{:.8g}"), Quantity::number, &RotorNumbers::c_y},
    {"h_x", OnPage("h_x", "{:.8g}"), Quantity::number, &RotorNumbers::h_x},
    {"h_beta", OnPage("h_β", "{:.8g}"), Quantity::number, &RotorNumbers::h_beta},
    {"h_y", OnPage("h_y", "{:.8g}"), Quantity::number, &RotorNumbers::h_y},
    {"omega_0", OnPage("ω₀", "{:.8g}"), Quantity::frequency, &RotorNumbers::omega_0}};

/// The anisotropy alone, before and after what there may be several of.
const Columns<AnisotropyChart> chart_columns{
    {"C", OnPage("Polar over mean diametral inertia, C", "{:.8g}", "∞"), Quantity::number,
     &AnisotropyChart::C},
    {"A", OnPage("Anisotropy over the mean diametral inertia", "{:.8g}", "∞"), Quantity::number,
     &AnisotropyChart::anisotropy},
    {"p", OnPage("Natural frequency of tilt at rest, p", "{:.8g}", "∞"), Quantity::frequency,
     &AnisotropyChart::p},
    {"h", OnPage("Tilt damping over the mean diametral inertia, h", "{:.8g}", "∞"), Quantity::rate,
     &AnisotropyChart::h},
    {"critical_speeds", Quantity::speed, &AnisotropyChart::critical_speeds},
    {"permissible", Quantity::number, &AnisotropyChart::permissible},
    {"permissible_speed", Quantity::speed, &AnisotropyChart::permissible_speed}};

Texts chart_lines(const AnisotropyChart &chart, const Units &units) {
    const auto number = [](double value) { return shown(value, {"", "{:.8g}", "∞"}, "–"); };
    const auto speed = [&](double value) { return number(units(Quantity::speed, value)); };
    const std::string unit = " " + units.name(Quantity::speed);
    Texts lines = properties(chart_columns, chart, &Column<AnisotropyChart>::page, "–", units);
    lines.insert(lines.begin(), {"Quantity", "Value"});
    for (const double critical : chart.critical_speeds)
        lines.push_back({"Critical speed without damping", speed(critical) + unit});
    if (chart.unstable)
        lines.push_back({"Unstable", speed(chart.unstable->from) + " … " +
                                         (chart.unstable->to ? speed(*chart.unstable->to) : "∞") +
                                         unit});
    lines.push_back({"Largest anisotropy stable at every speed", number(chart.permissible)});
    lines.push_back({"least at", chart.permissible_speed ? speed(*chart.permissible_speed) + unit
                                                         : "infinite speed"});
    return lines;
}

std::string chart_text(const AnisotropyChart &chart, const Units &units) {
    using model::as::speed;
    model::Sentence text("  tilt as a rigid rotor: critical speeds {}",
                         speed.list(chart.critical_speeds, 7));
    if (!chart.unstable)
        text += model::Sentence(", stable at every speed");
    else if (chart.unstable->to)
        text += model::Sentence(", unstable from {}",
                                speed.range(chart.unstable->from, *chart.unstable->to, 7));
    else
        text += model::Sentence(", unstable above {}", speed(chart.unstable->from, 7));
    return units.text(text) +
           fmt::format("\n  largest anisotropy dI/Id stable at every speed: {:.5g} (the case has "
                       "{:.5g})\n\n",
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
                            composite_chart(scene, result, i, units), [&c](const Units &files) {
                                return csv_lists({{{"n m/M_s"}, c.m},
                                                  {{"A_m"}, c.A_m},
                                                  {{"A_C1"}, c.A_C1},
                                                  {{"A_C2"}, c.A_C2},
                                                  {{"A"}, c.A},
                                                  {{"C"}, c.C},
                                                  {{"A_C1 with |D|"}, c.A_C1_paper},
                                                  {{"A_C2 with |D|"}, c.A_C2_paper},
                                                  {{"A with |D|"}, c.A_paper},
                                                  {{"A least"}, c.A_least},
                                                  {{"A largest"}, c.A_largest}},
                                                 files);
                            }});
    }
    if (const auto &chart = result.anisotropy)
        pictures.push_back(
            {"anisotropy", anisotropy_chart(scene, *chart, units), [&chart](const Units &files) {
                 return csv_lists({{{"speed", Quantity::speed}, chart->speed},
                                   {{"anisotropy at the stability limit"}, chart->limit},
                                   {{"anisotropy at a critical speed"}, chart->undamped}},
                                  files);
             }});
    return pictures;
}

Json balancer_json(const BalancerNumbers &balancer, const Units &units) {
    Json json = json_row(balancer_columns, balancer, units);
    json["bare_rotor"] = {{"mass", written(units, Quantity::mass, balancer.bare.mass)},
                          {"Id", written(units, Quantity::inertia, balancer.bare.Id)},
                          {"Ip", written(units, Quantity::inertia, balancer.bare.Ip)},
                          {"Ip_over_Id", balancer.bare.Ip / balancer.bare.Id},
                          {"z_GA", written(units, Quantity::length, balancer.bare.z_GA)}};
    json["dimensionless"] = json_row(dimensionless_columns, balancer, units);
    return json;
}

Json chart_json(const AnisotropyChart &chart, const Units &units) {
    Json json = json_row(chart_columns, chart, units);
    json["unstable"] = Json::array();
    if (chart.unstable)
        json["unstable"].push_back(written(
            units, Quantity::speed, Json::array({chart.unstable->from, chart.unstable->to})));
    return json;
}

Json json_of(const ShowResult &result, const Units &units) {
    Json json = json_row(show_columns, result, units);
    json["static"] = result.sag ? sag_json(*result.sag, units) : Json();
    json["dimensionless"] = json_row(rotor_columns, result.dimensionless, units);
    json["balancers"] =
        json_list(result.balancers, [&units](const auto &b) { return balancer_json(b, units); });
    json["anisotropy"] = result.anisotropy ? chart_json(*result.anisotropy, units) : Json();
    json["formulations"] = json_list(result.formulations, [](const auto &entry) {
        Json form{{"command", entry.first}};
        form.update(Json(entry.second));
        return form;
    });
    return json;
}

std::vector<Section> sections_of(const ShowResult &result, const Units &units) {
    std::vector<Section> sections{
        {"Rigid body", page_properties(show_columns, result, units) +
                           page_table(rotor_columns, std::vector{result.dimensionless}, units)}};
    if (const auto &sag = result.sag)
        sections.push_back(
            {sag_heading(*sag, units), page_table(load_columns, sag->bearings, units) +
                                           page_table(sag_columns, sag->stations, units)});
    for (std::size_t i = 0; i < result.balancers.size(); ++i) {
        const BalancerNumbers &balancer = result.balancers[i];
        const std::string name = model::name_or_number(balancer.name, "balancer", i);
        sections.push_back({"Composite rotor: " + name + (balancer.held ? " (held)" : ""),
                            page_properties(balancer_columns, balancer, units) +
                                page_table(dimensionless_columns, std::vector{balancer}, units)});
    }
    if (result.anisotropy)
        sections.push_back({"Anisotropy: tilt of the rigid rotor",
                            page_table(chart_lines(*result.anisotropy, units))});
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

std::string text_of(const model::Case &scene, const ShowResult &result, const Units &units) {
    Texts lines = properties(show_columns, result, &Column<ShowResult>::text, "-", units);
    if (result.dI.value_or(0) > 0)
        lines.push_back({"anisotropy dI", units.text(Quantity::inertia, *result.dI)});
    std::string text =
        heading(scene, fmt::format("A {} rotor", result.type)) + text_table(lines) + "\n";
    if (!result.balancers.empty())
        text += text_table(balancer_columns, result.balancers, units) + "\n" +
                text_table(dimensionless_columns, result.balancers, units) + "\n";
    if (result.anisotropy)
        text += chart_text(*result.anisotropy, units);
    if (const auto &sag = result.sag)
        text += sag_heading(*sag, units) + "\n" + text_table(load_columns, sag->bearings, units) +
                "\n" + text_table(sag_columns, sag->stations, units) + "\n";
    return text + forms_text(result);
}

/// What the rotor is, in one sentence.
model::Sentence answer_of(const model::Case &scene, const ShowResult &result) {
    namespace as = model::as;
    const std::size_t supports = scene.rotor.supports().size();
    model::Sentence answer("a {} rotor of {} and {} on {} {}, centre of mass at z = {}",
                           result.type, as::mass(result.mass, 4), as::length(result.length, 4),
                           supports, supports == 1 ? "support" : "supports",
                           as::length(result.center_of_mass, 4));
    if (!result.sag || result.sag->stations.empty())
        return answer;
    const auto deepest = std::ranges::max_element(
        result.sag->stations, {}, [](const SagStation &at) { return std::hypot(at.x, at.y); });
    return answer += model::Sentence("; at rest its weight bends it by up to {}, at z = {}",
                                     as::deflection(std::hypot(deepest->x, deepest->y), 3),
                                     as::length(deepest->z, 4));
}

std::vector<Section> brief_of(const ShowResult &result, const Units &units) {
    std::vector<Section> sections{{"Rigid body", page_properties(show_columns, result, units)}};
    if (const auto &sag = result.sag)
        sections.push_back({sag_heading(*sag, units),
                            page_table_of_first(brief_rows, load_columns, sag->bearings, units)});
    return sections;
}

} // namespace

Report describe(const model::Case &scene, const ShowResult &result) {
    return {
        .command = "show",
        .heading = "Scene",
        .scene = &scene,
        .model = &result.model,
        .json = [&](const Units &units) { return json_of(result, units); },
        .csv =
            [&](const Units &units) { return csv_table(show_columns, std::vector{result}, units); },
        .sections = [&](const Units &units) { return sections_of(result, units); },
        .text = [&](const Units &units) { return text_of(scene, result, units); },
        .drawing = [&](const Units &units) { return show_drawing(scene, result, units); },
        .pictures = [&](const Units &units) { return pictures_of(scene, result, units); },
        .pictures_heading = "Curves of the rigid rotor",
        .pictures_after =
            (result.sag ? 2 : 1) + result.balancers.size() + (result.anisotropy ? 1 : 0),
        .answer = answer_of(scene, result),
        .brief = [&](const Units &units) { return brief_of(result, units); }};
}

} // namespace whirl::report
