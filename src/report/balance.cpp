// Report of the command balance.

#include "results/balance.h"

#include "report/balance_pendulum.h"
#include "report/balance_supply.h"
#include "report/common/csv.h"
#include "report/common/html.h"
#include "report/common/words.h"
#include "report/pictures/figures.h"
#include "report/reports.h"
#include "report/sections.h"
#include "report/steady_states.h"

#include <fmt/format.h>

#include <algorithm>

namespace whirl::report {

using results::BalanceBands;
using results::BalancedPosition;
using results::BalancePlane;
using results::BalanceResult;
using results::BandEnd;
using results::SignaturePoint;
using results::SimulatedSpeed;

namespace {

using Bands = std::vector<results::Interval>;

std::string page_bands(const Bands &bands, const Units &units) {
    return bands_text(bands, "{:.8g}", " … ", "; ", units);
}
std::string terminal_bands(const Bands &bands, const Units &units) {
    const std::string end =
        fmt::format("{{:.{}g}}", units.style().digits > 0 ? units.style().digits : 6);
    return bands_text(bands, end.c_str(), " to ", ", ", units);
}

/// Largest error of an end.
std::string largest_error(const std::vector<results::KnownErrors> &errors, const Units &units) {
    double largest = 0;
    for (const auto &[at_from, at_to] : errors) {
        if (!at_from || !at_to)
            return "not known";
        largest = std::max({largest, *at_from, *at_to});
    }
    return errors.empty() ? "-" : fmt::format("{:.1e}", units(Quantity::speed, largest));
}

/// A plane, all of them together, or the real balancers: where they balance.
struct Planes {
    std::string on_page, on_terminal; ///< name
    std::string number;               ///< in the file
    std::optional<double> z;
    const BalanceBands *of;
};

std::vector<Planes> all_planes(const BalanceResult &result, const Units &units) {
    std::vector<Planes> all;
    for (std::size_t i = 0; i < result.planes.size(); ++i) {
        const BalancePlane &plane = result.planes[i];
        const std::string number = std::to_string(i + 1);
        all.push_back(
            {fmt::format("{}, z = {}", plane.name.empty() ? "plane " + number : plane.name,
                         units.text(Quantity::length, plane.z, 5)),
             fmt::format("{} z = {}", plane.name.empty() ? number : plane.name,
                         units.text(Quantity::length, plane.z, 4)),
             number, plane.z, &plane.bands});
    }
    return all;
}

/// The planes one by one, and together where there are several.
std::vector<Planes> planes_and_joint(const BalanceResult &result, const Units &units) {
    std::vector<Planes> all = all_planes(result, units);
    if (all.size() > 1)
        all.push_back({"all together", "all together", "joint", {}, &result.joint.bands});
    return all;
}

const Columns<Planes> band_columns{
    {OnPage("Planes"), &Planes::on_page},
    {OnPage("Flexible"), Quantity::speed,
     [](const Planes &p, const Units &units) { return page_bands(p.of->bands, units); }},
    {OnPage("Rigid closed form"), Quantity::speed, [](const Planes &p, const Units &units) {
         return p.of->rigid_bands ? page_bands(*p.of->rigid_bands, units) : std::string("–");
     }}};

/// An end of a band of a plane.
struct End : BandEnd {
    std::string planes;
};

const Columns<End> band_end_columns{
    {OnPage("Planes"), &End::planes},
    {"speed", OnPage("", "{:.8g}").and_si("{:.10g}"), Quantity::speed, &End::speed},
    {"end", OnPage("End"), [](const End &end) { return end.upper ? "upper" : "lower"; }},
    {"error", OnPage("Error", "{:.2g}"), Quantity::speed, &End::error},
    {"pinned", OnPage("Pinned critical speed", "{:.10g}"), Quantity::speed, &End::pinned},
    {"rigid", OnPage("Rigid", "{:.10g}"), Quantity::speed, &End::rigid},
    {"relative_difference", OnPage("Relative difference", "{:.3g}"), Quantity::number,
     &End::relative_difference},
    {"direction", Quantity::angle, &End::direction}};

std::vector<End> ends_of(const std::string &planes, const BalanceBands &of) {
    std::vector<End> ends;
    for (const BandEnd &end : of.ends)
        ends.push_back({end, planes});
    return ends;
}

Json bands_json(const BalanceBands &of, const Units &units) {
    return {{"bands", written(units, Quantity::speed, of.bands)},
            {"band_errors", written(units, Quantity::speed, of.errors)},
            {"rigid_bands", written(units, Quantity::speed, of.rigid_bands)},
            {"pinned_critical_speeds", written(units, Quantity::speed, of.pinned)},
            {"ends", json_rows(band_end_columns, ends_of("", of), units)}};
}

/// One value a column that holds something; the line of the file that has several kinds.
struct CsvLine {
    std::string kind, which{};
    std::optional<double> z{}, speed{}, from{}, to{}, value{}, ratio{};
};

const Columns<CsvLine> line_columns{{InCsv("kind"), &CsvLine::kind},
                                    {InCsv("which"), &CsvLine::which},
                                    {InCsv("z"), Quantity::length, &CsvLine::z},
                                    {InCsv("speed"), Quantity::speed, &CsvLine::speed},
                                    {InCsv("from"), Quantity::speed, &CsvLine::from},
                                    {InCsv("to"), Quantity::speed, &CsvLine::to},
                                    {InCsv("value"), Quantity::inverse_mass, &CsvLine::value},
                                    {InCsv("ratio"), Quantity::number, &CsvLine::ratio}};

void add_band_lines(std::vector<CsvLine> &lines, const Planes &planes) {
    const auto add = [&](const char *kind, std::optional<double> from, std::optional<double> to) {
        lines.push_back({kind, planes.number, planes.z, {}, from, to});
    };
    for (const auto &band : planes.of->bands)
        add("band", band.from, band.to);
    for (const auto &[at_from, at_to] : planes.of->errors)
        add("band_error", at_from, at_to);
    for (const auto &band : planes.of->rigid_bands.value_or(Bands{}))
        add("rigid_band", band.from, band.to);
}

void add_pendulum_lines(std::vector<CsvLine> &lines, const BalanceResult &result) {
    for (std::size_t i = 0; i < result.pendulum.size(); ++i) {
        const results::PendulumBalance &of = result.pendulum[i];
        for (std::size_t k = 0; k < of.speeds.size(); ++k)
            for (const auto &state : of.states[k])
                lines.push_back({.kind = state.stable ? "pendulum_stable" : "pendulum_unstable",
                                 .which = std::to_string(i + 1),
                                 .z = of.z,
                                 .speed = of.speeds[k],
                                 .ratio = state.ratio});
    }
}

void add_first_order_lines(std::vector<CsvLine> &lines, const results::FirstOrder &of,
                           const std::vector<double> &speeds) {
    for (const auto &band : of.bands)
        lines.push_back({.kind = "first_order", .from = band.from, .to = band.to});
    for (const auto &[at_from, at_to] : of.errors)
        lines.push_back({.kind = "first_order_error", .from = at_from, .to = at_to});
    for (std::size_t k = 0; k < of.least_drag.size(); ++k)
        if (of.least_drag[k])
            lines.push_back({.kind = "least_drag", .speed = speeds[k], .ratio = of.least_drag[k]});
}

std::string csv_of(const BalanceResult &result, const Units &units) {
    std::vector<CsvLine> lines;
    const std::vector<Planes> planes = all_planes(result, units);
    for (const Planes &plane : planes)
        add_band_lines(lines, plane);
    add_band_lines(lines, {"", "", "joint", {}, &result.joint.bands});
    for (const SignaturePoint &point : result.joint.signature)
        for (std::size_t k = 0; k < point.eigenvalues.size(); ++k)
            lines.push_back({.kind = "eigenvalue",
                             .which = std::to_string(k + 1),
                             .speed = point.speed,
                             .value = point.eigenvalues[k]});
    for (std::size_t i = 0; i < planes.size(); ++i)
        for (std::size_t k = 0; k < result.planes[i].criterion.size(); ++k)
            lines.push_back({.kind = "criterion",
                             .which = planes[i].number,
                             .z = planes[i].z,
                             .speed = result.speeds[k],
                             .value = result.planes[i].criterion[k]});
    add_pendulum_lines(lines, result);
    if (result.first_order)
        add_first_order_lines(lines, *result.first_order, result.speeds);
    if (result.balanced_position)
        for (const auto &band : result.balanced_position->bands)
            lines.push_back({.kind = "balanced_position", .from = band.from, .to = band.to});
    for (const SimulatedSpeed &run : result.simulated)
        lines.push_back(
            {.kind = "simulated_" + run.outcome, .speed = run.speed, .ratio = run.residual_ratio});
    return csv_table(line_columns, lines, units);
}

const Columns<SignaturePoint> signature_columns{
    {"speed", Quantity::speed, &SignaturePoint::speed},
    {"eigenvalues", Quantity::inverse_mass, &SignaturePoint::eigenvalues},
    {"negative", &SignaturePoint::negative},
    {"relative", Quantity::number, &SignaturePoint::relative},
    {"worst_real", Quantity::number, [](const auto &point) { return real_parts(point.worst); }},
    {"worst_imag", Quantity::number,
     [](const auto &point) { return imaginary_parts(point.worst); }}};

const Columns<SimulatedSpeed> simulated_columns{
    {"speed", Quantity::speed, &SimulatedSpeed::speed},
    {"outcome", &SimulatedSpeed::outcome},
    {"residual_ratio", Quantity::number, &SimulatedSpeed::residual_ratio},
    {"growth", Quantity::rate, &SimulatedSpeed::growth}};

Json rigid_json(const results::RigidEquivalent &of, const std::vector<double> &speeds,
                const Units &units) {
    std::vector<double> over_omega_0;
    for (const double speed : speeds)
        over_omega_0.push_back(speed / of.omega_0);
    return {{"mass", written(units, Quantity::mass, of.mass)},
            {"center_of_mass", written(units, Quantity::length, of.center)},
            {"Id", written(units, Quantity::inertia, of.diametral)},
            {"Ip", written(units, Quantity::inertia, of.polar)},
            {"dI", written(units, Quantity::inertia, of.anisotropy)},
            {"k11", written(units, Quantity::stiffness, of.k11)},
            {"k14", written(units, Quantity::coupling_stiffness, of.k14)},
            {"k33", written(units, Quantity::tilt_stiffness, of.k33)},
            {"type", of.type},
            {"critical_speeds", written(units, Quantity::speed, of.critical_speeds)},
            {"partial_frequencies", written(units, Quantity::frequency, of.partial_frequencies)},
            {"z_max", written(units, Quantity::length, of.z_max)},
            {"omega_0", written(units, Quantity::frequency, of.omega_0)},
            {"over_omega_0", over_omega_0}};
}

Json position_json(const BalancedPosition &of, const Units &units) {
    return {{"against", of.all_imbalances ? "all imbalances" : "own imbalance"},
            {"missing", written(units, Quantity::speed, of.missing)},
            {"bands", written(units, Quantity::speed, of.bands)},
            {"band_errors", written(units, Quantity::speed, of.errors)},
            {"arrangements", of.arrangements},
            {"with_every", written(units, Quantity::speed, of.with_every)},
            {"with_some", written(units, Quantity::speed, of.with_some)}};
}

Json first_order_json(const results::FirstOrder &of, const Units &units) {
    return {{"bands", written(units, Quantity::speed, of.bands)},
            {"band_errors", written(units, Quantity::speed, of.errors)},
            {"least_drag", of.least_drag}};
}

/// Places for one auto-balancer or two over all speeds of the range.
struct Best : results::BestPlace {
    std::string balancers;
};

const Columns<Best> best_columns{
    {OnPage("Best"), &Best::balancers},
    {"z", Quantity::length, &Best::z},
    {OnPage("z"),
     [](const Best &best, const Units &units) {
         return units.text(model::Sentence("{}", model::as::length.list(best.z, 5)));
     }},
    {OnPage("Share of the speeds (%)", "{:.4g}"), Quantity::number,
     [](const Best &best) { return 100 * best.share; }},
    {"share", Quantity::number, &Best::share},
    {"margin", OnPage("Margin", "{:.4g}"), Quantity::number, &Best::margin}};

std::vector<Best> best_places(const results::Placement &map) {
    return {{map.best, "one plane"}, {map.best_pair, "two planes"}};
}

Json placement_json(const results::Placement &map, const Units &units) {
    const Json best = json_rows(best_columns, best_places(map), units);
    return {{"z", written(units, Quantity::length, map.z)},
            {"speeds", written(units, Quantity::speed, map.speeds)},
            {"criterion", map.criterion},
            {"share", map.share},
            {"best", best[0]},
            {"pairs",
             {{"speed", written(units, Quantity::speed, map.pair_speed)},
              {"z", written(units, Quantity::length, map.pair_z)},
              {"largest_eigenvalue", map.pair_value},
              {"best", best[1]}}}};
}

std::string placement_text(const results::Placement &map, const Units &units) {
    std::string text = "\nBest places for all speeds of the range:\n";
    for (const Best &best : best_places(map))
        text +=
            best.share <= 0
                ? fmt::format("  {:<10}: nowhere\n", best.balancers)
                : fmt::format("  {:<10}: z = {}, balances {:.1f} % of the speeds, margin "
                              "{:.3f}\n",
                              best.balancers,
                              units.text(model::Sentence("{}", model::as::length.list(best.z, 4))),
                              100 * best.share, best.margin);
    return text;
}

Json json_of(const BalanceResult &result, const Units &units) {
    Json joint = bands_json(result.joint.bands, units);
    joint["rank"] = result.joint.rank;
    joint["signature"] = json_rows(signature_columns, result.joint.signature, units);
    Json json{
        {"findings", written(units, result.findings)},
        {"speeds", written(units, Quantity::speed, result.speeds)},
        {"critical_speeds", written(units, Quantity::speed, result.critical_speeds)},
        {"sharp", result.sharp},
        {"planes",
         json_list(
             result.planes,
             [&](const BalancePlane &plane) {
                 Json entry{{"name", plane.name}, {"z", written(units, Quantity::length, plane.z)}};
                 take_entries(entry, bands_json(plane.bands, units));
                 entry["criterion"] = written(units, Quantity::inverse_mass, plane.criterion);
                 const auto index = static_cast<std::size_t>(&plane - result.planes.data());
                 take_entries(entry, plane_supply_json(result, index, units));
                 return entry;
             })},
        {"joint", joint},
        {"rigid", result.rigid ? rigid_json(*result.rigid, result.speeds, units) : Json()},
        {"simulated", json_rows(simulated_columns, result.simulated, units)},
        {"balanced_position",
         result.balanced_position ? position_json(*result.balanced_position, units) : Json()},
        {"first_order", result.first_order ? first_order_json(*result.first_order, units) : Json()},
        {"pendulum",
         json_list(result.pendulum, [&units](const auto &of) { return pendulum_json(of, units); })},
        {"states", states_json(result.states, units)},
        {"state_borders", state_borders_json(result.states, units)},
        {"states_undecided", states_undecided_json(result.states, units)}};
    take_entries(json, supply_json(result, units));
    if (result.placement)
        json["placement"] = placement_json(*result.placement, units);
    return json;
}

std::string findings_html(const std::vector<model::Sentence> &findings, const Units &units) {
    std::string html = findings.empty() ? "<p>Nothing beyond the bands.</p>\n" : "";
    for (const model::Sentence &finding : findings)
        html += element("p", units.text(finding));
    return html;
}

std::vector<Section> sections_of(const BalanceResult &result, const Units &units) {
    std::vector<End> ends;
    for (const Planes &of : planes_and_joint(result, units))
        for (const End &end : ends_of(of.on_page, *of.of))
            ends.push_back(end);
    std::vector<Section> sections{
        {"What it says", findings_html(result.findings, units)},
        {"Bands of spin speed", page_table(band_columns, planes_and_joint(result, units), units)}};
    add_table(sections, "Ends of the bands", band_end_columns, ends, units);
    if (result.placement)
        sections.push_back(
            {"Best places", page_table(best_columns, best_places(*result.placement), units) +
                                "<p>Margin: mean over the speeds of the largest eigenvalue, times "
                                "−1 and the mass of the rotor, each cut to ±1.</p>\n"});
    add_sections(sections, supply_sections(result, units));
    if (!result.pendulum.empty())
        sections.push_back({"Four-pendulum balancers", pendulum_page(result.pendulum, units)});
    if (result.states)
        add_sections(sections, states_sections(*result.states, units));
    return sections;
}

/// The bands of each plane in the unit of readers and, where none was asked for, in SI.
std::string table_of_bands(const BalanceResult &result, const Units &units) {
    const Units si;
    const std::string unit = units.name(Quantity::speed);
    const bool beside_si = !units.asked(Quantity::speed);
    Texts table{{"planes", "balanced, " + unit}};
    if (beside_si)
        table.front().push_back(si.name(Quantity::speed));
    table.front().insert(table.front().end(), {"error, " + unit, "rigid closed form, " + unit});
    const auto add = [&](const std::string &name, const Bands &bands, const std::string &error,
                         const std::optional<Bands> &rigid) {
        table.push_back({name, terminal_bands(bands, units)});
        if (beside_si)
            table.back().push_back(terminal_bands(bands, si));
        table.back().insert(table.back().end(),
                            {error, rigid ? terminal_bands(*rigid, units) : "-"});
    };
    for (const Planes &planes : planes_and_joint(result, units))
        add(planes.on_terminal, planes.of->bands, largest_error(planes.of->errors, units),
            planes.of->rigid_bands);
    if (const auto &light = result.first_order)
        add("light balancers, stable", light->bands, largest_error(light->errors, units),
            std::nullopt);
    if (const auto &real = result.balanced_position)
        add("real balancers, stable", real->bands, "-", std::nullopt);
    return text_table(table);
}

std::string text_of(const model::Case &scene, const BalanceResult &result, const Units &units) {
    std::string text = heading(scene, "Auto-balancing, " + range_text(result.speeds, units)) +
                       table_of_bands(result, units);
    if (result.placement) // asked for by --map
        text += placement_text(*result.placement, units) + "\n";
    for (const SimulatedSpeed &run : result.simulated)
        text += fmt::format(
            "  motion in time at {}: {}{}\n", units.text(Quantity::speed, run.speed), run.outcome,
            run.residual_ratio ? fmt::format(", residual {:.3g}", *run.residual_ratio) : "");
    for (const model::Sentence &finding : result.findings)
        text += (&finding == &result.findings.front() ? "\n" : "") + units.text(finding) + "\n";
    text += supply_text(result, units);
    for (const auto &pendulum : result.pendulum)
        text += pendulum_text(pendulum, units);
    if (result.states)
        text += states_text(*result.states, units);
    return text + model_text(result.model, units);
}

std::vector<Picture> pictures_of(const model::Case &scene, const BalanceResult &result,
                                 const Units &units) {
    std::vector<Picture> pictures;
    if (result.supply)
        pictures.push_back({"residual", residual_chart(scene, result, units), {}});
    if (result.states && !result.states->states.empty())
        pictures.push_back({"states", states_chart(scene, *result.states, units), {}});
    if (result.placement)
        pictures.push_back({"placement", placement_chart(scene, *result.placement, units), {}});
    for (std::size_t i = 0; i < result.pendulum.size(); ++i) {
        const results::PendulumBalance &of = result.pendulum[i];
        const std::string number = i == 0 ? "" : "_" + std::to_string(i + 1);
        pictures.push_back({"pendulum" + number, pendulum_chart(scene, of, units), {}});
        if (!of.dampings.empty())
            pictures.push_back(
                {"pendulum_designs" + number, pendulum_designs_chart(scene, of, units), {}});
    }
    return pictures;
}

/// Where all planes together balance the rotor, in one sentence.
model::Sentence answer_of(const BalanceResult &result) {
    const auto words = [](const Bands &bands) {
        std::vector<model::Sentence> all;
        for (const results::Interval &band : bands)
            all.emplace_back("{}", model::as::speed.range(band.from, band.to, 5));
        return all.empty() ? model::Sentence("nowhere in the range") : model::joined(all, ", ");
    };
    model::Sentence answer("balancers in {} {} can balance the rotor: {}", result.planes.size(),
                           result.planes.size() == 1 ? "plane" : "planes together",
                           words(result.joint.bands.bands));
    if (result.balanced_position)
        answer += model::Sentence("; the real ones are stable at their balanced position: {}",
                                  words(result.balanced_position->bands));
    return answer;
}

std::vector<Section> brief_of(const BalanceResult &result, const Units &units) {
    return {{"What it says", findings_html(result.findings, units)},
            {"Bands of spin speed", page_table_of_first(brief_rows, band_columns,
                                                        planes_and_joint(result, units), units)}};
}

} // namespace

Report describe(const model::Case &scene, const BalanceResult &result) {
    Report report =
        report_of<BalanceResult>("balance", "Auto-balancing", scene, result,
                                 {json_of, csv_of, sections_of, text_of, balance_chart});
    report.pictures = [&](const Units &units) { return pictures_of(scene, result, units); };
    report.pictures_heading = "Pictures";
    report.tables = [&result] {
        std::vector<TableFile> tables = supply_tables(result);
        if (result.states && !result.states->states.empty())
            tables.push_back(states_table(*result.states));
        return tables;
    };
    report.answer = answer_of(result);
    report.brief = [&](const Units &units) { return brief_of(result, units); };
    return report;
}

} // namespace whirl::report
