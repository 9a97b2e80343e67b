// Report of the command balance.

#include "results/balance.h"

#include "report/balance_pendulum.h"
#include "report/common/csv.h"
#include "report/common/html.h"
#include "report/common/table.h"
#include "report/common/words.h"
#include "report/pictures/figures.h"
#include "report/reports.h"

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

std::string page_bands(const Bands &bands) {
    return bands_text(bands, "{:.8g}", " … ", "; ", written_factor("speed").value_or(1));
}
std::string terminal_bands(const Bands &bands, double factor = 1) {
    return bands_text(bands, "{:.6g}", " to ", ", ", factor);
}

/// Largest error of an end.
std::string largest_error(const BalanceBands &of, double factor) {
    double largest = 0;
    for (const auto &[at_from, at_to] : of.errors) {
        if (!at_from || !at_to)
            return "not known";
        largest = std::max({largest, *at_from, *at_to});
    }
    return of.errors.empty() ? "-" : fmt::format("{:.1e}", largest * factor);
}

/// A plane, all of them together, or the real balancers: where they balance.
struct Planes {
    std::string on_page, on_terminal; ///< name
    std::string number;               ///< in the file
    std::optional<double> z;
    const BalanceBands *of;
};

std::vector<Planes> all_planes(const BalanceResult &result) {
    std::vector<Planes> all;
    for (std::size_t i = 0; i < result.planes.size(); ++i) {
        const BalancePlane &plane = result.planes[i];
        const std::string number = std::to_string(i + 1);
        all.push_back(
            {fmt::format("{}, z = {:.5g} m", plane.name.empty() ? "plane " + number : plane.name,
                         plane.z),
             fmt::format("{} z = {:.4g} m", plane.name.empty() ? number : plane.name, plane.z),
             number, plane.z, &plane.bands});
    }
    return all;
}

/// The planes one by one, and together where there are several.
std::vector<Planes> planes_and_joint(const BalanceResult &result) {
    std::vector<Planes> all = all_planes(result);
    if (all.size() > 1)
        all.push_back({"all together", "all together", "joint", {}, &result.joint.bands});
    return all;
}

const Columns<Planes> band_columns{
    {OnPage("Planes"), &Planes::on_page},
    {OnPage("Flexible"), [](const Planes &p) { return page_bands(p.of->bands); }},
    {OnPage("Rigid closed form"), [](const Planes &p) {
         return p.of->rigid_bands ? page_bands(*p.of->rigid_bands) : std::string("–");
     }}};

/// An end of a band of a plane.
struct End : BandEnd {
    std::string planes;
};

const Columns<End> band_end_columns{
    {OnPage("Planes"), &End::planes},
    {"speed", &End::speed},
    {"end", OnPage("End"), [](const End &end) { return end.upper ? "upper" : "lower"; }},
    {OnPage("rad/s", "{:.10g}"), &End::speed},
    {OnPage("rpm", "{:.8g}"), in(rpm, &End::speed)},
    {"error", OnPage("Error (rad/s)", "{:.2g}"), &End::error},
    {"pinned", OnPage("Pinned critical speed (rad/s)", "{:.10g}"), &End::pinned},
    {"rigid", OnPage("Rigid (rad/s)", "{:.10g}"), &End::rigid},
    {"relative_difference", OnPage("Relative difference", "{:.3g}"), &End::relative_difference}};

std::vector<End> ends_of(const std::string &planes, const BalanceBands &of) {
    std::vector<End> ends;
    for (const BandEnd &end : of.ends)
        ends.push_back({end, planes});
    return ends;
}

Json bands_json(const BalanceBands &of) {
    return {{"bands", of.bands},
            {"band_errors", of.errors},
            {"rigid_bands", of.rigid_bands},
            {"pinned_critical_speeds", of.pinned},
            {"ends", json_rows(band_end_columns, ends_of("", of))}};
}

/// One value a column that holds something; the line of the file that has several kinds.
struct CsvLine {
    std::string kind, which{};
    std::optional<double> z{}, speed{}, from{}, to{}, value{}, ratio{};
};

const Columns<CsvLine> line_columns{{InCsv("kind"), &CsvLine::kind},
                                    {InCsv("which"), &CsvLine::which},
                                    {InCsv("z [m]"), &CsvLine::z},
                                    {InCsv("speed [rad/s]"), &CsvLine::speed},
                                    {InCsv("from [rad/s]"), &CsvLine::from},
                                    {InCsv("to [rad/s]"), &CsvLine::to},
                                    {InCsv("value [1/kg]"), &CsvLine::value},
                                    {InCsv("ratio"), &CsvLine::ratio}};

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

std::string csv_of(const BalanceResult &result, const Units &) {
    std::vector<CsvLine> lines;
    const std::vector<Planes> planes = all_planes(result);
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
    if (result.balanced_position)
        for (const auto &band : result.balanced_position->bands)
            lines.push_back({.kind = "balanced_position", .from = band.from, .to = band.to});
    for (const SimulatedSpeed &run : result.simulated)
        lines.push_back(
            {.kind = "simulated_" + run.outcome, .speed = run.speed, .ratio = run.residual_ratio});
    return csv_table(line_columns, lines);
}

const Columns<SignaturePoint> signature_columns{
    {"speed", &SignaturePoint::speed},
    {"eigenvalues", &SignaturePoint::eigenvalues},
    {"negative", &SignaturePoint::negative},
    {"relative", &SignaturePoint::relative},
    {"worst_real", [](const auto &point) { return real_parts(point.worst); }},
    {"worst_imag", [](const auto &point) { return imaginary_parts(point.worst); }}};

const Columns<SimulatedSpeed> simulated_columns{{"speed", &SimulatedSpeed::speed},
                                                {"outcome", &SimulatedSpeed::outcome},
                                                {"residual_ratio", &SimulatedSpeed::residual_ratio},
                                                {"growth", &SimulatedSpeed::growth}};

Json rigid_json(const results::RigidEquivalent &of) {
    return {{"mass", of.mass},
            {"center_of_mass", of.center},
            {"Id", of.diametral},
            {"Ip", of.polar},
            {"k11", of.k11},
            {"k14", of.k14},
            {"k33", of.k33},
            {"type", of.type},
            {"critical_speeds", of.critical_speeds}};
}

Json position_json(const BalancedPosition &of) {
    return {{"bands", of.bands},
            {"band_errors", of.errors},
            {"arrangements", of.arrangements},
            {"with_every", of.with_every},
            {"with_some", of.with_some}};
}

/// Places for one auto-balancer or two over all speeds of the range.
struct Best : results::BestPlace {
    std::string balancers;
    [[nodiscard]] std::string places(const char *format, const char *between) const {
        return joined(z, between, [&](double at) { return fmt::format(fmt::runtime(format), at); });
    }
};

const Columns<Best> best_columns{
    {OnPage("Best"), &Best::balancers},
    {"z", &Best::z},
    {OnPage("z (m)"), [](const Best &best) { return best.places("{:.5g}", ", "); }},
    {OnPage("Share of the speeds (%)", "{:.4g}"),
     [](const Best &best) { return 100 * best.share; }},
    {"share", &Best::share},
    {"margin", OnPage("Margin", "{:.4g}"), &Best::margin}};

std::vector<Best> best_places(const results::Placement &map) {
    return {{map.best, "one plane"}, {map.best_pair, "two planes"}};
}

Json placement_json(const results::Placement &map) {
    const Json best = json_rows(best_columns, best_places(map));
    return {{"z", map.z},
            {"speeds", map.speeds},
            {"criterion", map.criterion},
            {"share", map.share},
            {"best", best[0]},
            {"pairs",
             {{"speed", map.pair_speed},
              {"z", map.pair_z},
              {"largest_eigenvalue", map.pair_value},
              {"best", best[1]}}}};
}

std::string placement_text(const results::Placement &map) {
    std::string text = "\nBest places for all speeds of the range:\n";
    for (const Best &best : best_places(map))
        text += best.share <= 0
                    ? fmt::format("  {:<10}: nowhere\n", best.balancers)
                    : fmt::format("  {:<10}: z = {} m, balances {:.1f} % of the speeds, margin "
                                  "{:.3f}\n",
                                  best.balancers, best.places("{:.4g}", " and "), 100 * best.share,
                                  best.margin);
    return text;
}

Json json_of(const BalanceResult &result, const Units &units) {
    Json joint = bands_json(result.joint.bands);
    joint["rank"] = result.joint.rank;
    joint["signature"] = json_rows(signature_columns, result.joint.signature);
    Json json{
        {"findings",
         json_list(result.findings, [&units](const auto &finding) { return units.text(finding); })},
        {"speeds", result.speeds},
        {"critical_speeds", result.critical_speeds},
        {"sharp", result.sharp},
        {"planes", json_list(result.planes,
                             [](const BalancePlane &plane) {
                                 Json entry{{"name", plane.name}, {"z", plane.z}};
                                 take_entries(entry, bands_json(plane.bands));
                                 entry["criterion"] = plane.criterion;
                                 return entry;
                             })},
        {"joint", joint},
        {"rigid", result.rigid ? rigid_json(*result.rigid) : Json()},
        {"simulated", json_rows(simulated_columns, result.simulated)},
        {"balanced_position",
         result.balanced_position ? position_json(*result.balanced_position) : Json()},
        {"pendulum", json_list(result.pendulum, pendulum_json)}};
    if (result.placement)
        json["placement"] = placement_json(*result.placement);
    return json;
}

std::string findings_html(const std::vector<model::Sentence> &findings, const Units &units) {
    std::string html = findings.empty() ? "<p>Nothing beyond the bands.</p>\n" : "";
    for (const model::Sentence &finding : findings)
        html += kept_as_written(element("p", units.text(finding)));
    return html;
}

std::vector<Section> sections_of(const BalanceResult &result, const Units &units) {
    std::vector<End> ends;
    for (const Planes &of : planes_and_joint(result))
        for (const End &end : ends_of(of.on_page, *of.of))
            ends.push_back(end);
    std::vector<Section> sections{
        {"What it says", findings_html(result.findings, units)},
        {fmt::format("Bands of spin speed ({})", unit_name("speed", "rad/s")),
         page_table(band_columns, planes_and_joint(result))}};
    if (!ends.empty())
        sections.push_back({"Ends of the bands", page_table(band_end_columns, ends)});
    if (result.placement)
        sections.push_back(
            {"Best places", page_table(best_columns, best_places(*result.placement)) +
                                "<p>Margin: mean over the speeds of the largest eigenvalue, times "
                                "−1 and the mass of the rotor, each cut to ±1.</p>\n"});
    if (!result.pendulum.empty())
        sections.push_back({"Four-pendulum balancers", pendulum_page(result.pendulum)});
    return sections;
}

std::string table_of_bands(const BalanceResult &result) {
    const double factor = written_factor("speed").value_or(1);
    const std::string unit = unit_name("speed", "rad/s");
    Texts table{{"planes", "balanced, " + unit_name("speed", "rpm"), "rad/s", "error, " + unit,
                 "rigid closed form, " + unit}};
    for (const Planes &planes : planes_and_joint(result))
        table.push_back(
            {planes.on_terminal, terminal_bands(planes.of->bands, rpm),
             terminal_bands(planes.of->bands), largest_error(*planes.of, factor),
             planes.of->rigid_bands ? terminal_bands(*planes.of->rigid_bands, factor) : "-"});
    if (const auto &real = result.balanced_position)
        table.push_back({"real balancers, stable", terminal_bands(real->bands, rpm),
                         terminal_bands(real->bands), "-", "-"});
    for (auto &row : table)
        if (written_factor("speed"))
            row.erase(row.begin() + 2); // rad/s
    return text_table(table);
}

std::string text_of(const model::Case &scene, const BalanceResult &result, const Units &units) {
    std::string text =
        heading(scene, "Auto-balancing, " + range_text(result.speeds)) + table_of_bands(result);
    for (const SimulatedSpeed &run : result.simulated)
        text += fmt::format(
            "  motion in time at {:.6g} rpm: {}{}\n", run.speed * rpm, run.outcome,
            run.residual_ratio ? fmt::format(", residual {:.3g}", *run.residual_ratio) : "");
    for (const model::Sentence &finding : result.findings)
        text += (&finding == &result.findings.front() ? "\n" : "") +
                kept_as_written(units.text(finding)) + "\n";
    if (result.placement)
        text += placement_text(*result.placement);
    for (const auto &pendulum : result.pendulum)
        text += pendulum_text(pendulum);
    return text + model_text(result.model);
}

std::vector<Picture> pictures_of(const model::Case &scene, const BalanceResult &result,
                                 const Units &units) {
    std::vector<Picture> pictures;
    if (result.placement)
        pictures.push_back({"placement", placement_figure(scene, *result.placement, units), {}});
    for (std::size_t i = 0; i < result.pendulum.size(); ++i) {
        const results::PendulumBalance &of = result.pendulum[i];
        const std::string number = i == 0 ? "" : "_" + std::to_string(i + 1);
        pictures.push_back({"pendulum" + number, pendulum_figure(scene, of, units), {}});
        if (!of.dampings.empty())
            pictures.push_back(
                {"pendulum_designs" + number, pendulum_designs_figure(scene, of, units), {}});
    }
    return pictures;
}

} // namespace

Report describe(const model::Case &scene, const BalanceResult &result) {
    Report report =
        report_of<BalanceResult>("balance", "Auto-balancing", scene, result,
                                 {json_of, csv_of, sections_of, text_of, balance_figure});
    report.pictures = [&](const Units &units) { return pictures_of(scene, result, units); };
    report.pictures_heading = "Pictures";
    return report;
}

} // namespace whirl::report
