#include "report/response/parts.h"

#include "report/common/csv.h"
#include "report/common/html.h"
#include "report/common/table.h"
#include "report/common/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace whirl::report {

using results::Measure;
using results::OperatingPlace;
using results::OperatingRow;
using results::OperatingWorst;
using results::ResponseResult;

namespace {

std::string outcome(const std::optional<bool> &pass) {
    return !pass ? "not judged" : *pass ? "passes" : "fails";
}

/// "probe DE x (z = 0.2 m)", "probe at z = 0.2 m, 45 deg, against the pedestal".
std::string operating_place(const OperatingPlace &row, const Units &units) {
    std::string out = row.of + " " + place(row.name, row.z, units);
    if (row.angle && row.name.empty()) // which of two at one place
        out += ", " + units.text(Quantity::angle, *row.angle, 4);
    return row.of == "probe" && row.relative ? out + ", against the pedestal" : out;
}

Quantity limited_quantity(const OperatingRow &row) {
    return row.limited ? results::measure_quantity(*row.limited) : Quantity::number;
}
const OfEach row_limit{limited_quantity};
const OfEach worst_value{
    [](const OperatingWorst &worst) { return results::measure_quantity(worst.what); }};

template <class Row> Column<Row> unit_column(Quantity (*quantity)(const Row &)) {
    return {InFiles("unit"),
            [quantity](const Row &row, const Units &units) { return units.name(quantity(row)); }};
}

/// A value with the unit of its row.
std::string with_unit(Quantity quantity, std::optional<double> value, const Units &units) {
    if (!value || std::isnan(*value))
        return "";
    if (std::isinf(*value))
        return "no limit";
    return units.text(quantity, *value, 5);
}

std::optional<std::string> limited_name(const OperatingRow &row) {
    return row.limited ? std::optional(results::measure_name(*row.limited)) : std::nullopt;
}

std::string row_outcome(const OperatingRow &row) {
    return row.limited ? outcome(row.pass) : std::string();
}

const Columns<OperatingRow> row_columns{
    {InFiles("speed"), ForReaders("at"), Quantity::speed, &OperatingRow::speed},
    {InFiles("at"), ForReaders("speed"), &OperatingRow::at},
    {InFiles("of"), &OperatingRow::of},
    {InFiles("name"), &OperatingRow::name},
    {InFiles("z"), Quantity::length, &OperatingRow::z},
    {InFiles("angle"), Quantity::angle, &OperatingRow::angle},
    {InFiles("relative"), &OperatingRow::relative},
    {Titled("Place"),
     [](const OperatingRow &row, const Units &units) { return operating_place(row, units); }},
    {InFiles("amplitude"), Titled("Amplitude", "{:.5g}", "no limit"), Quantity::amplitude,
     &OperatingRow::amplitude},
    {InFiles("phase"), Titled("Phase", "{:.1f}", ""), Quantity::angle, &OperatingRow::phase},
    {InFiles("velocity"), Titled("Velocity", "{:.5g}", "no limit"), Quantity::velocity,
     &OperatingRow::velocity},
    {InFiles("acceleration"), OnPage("Acceleration", "{:.5g}", "no limit"), Quantity::acceleration,
     &OperatingRow::acceleration},
    {InFiles("clearance_share"), Quantity::number, &OperatingRow::clearance_share},
    {OnPage("Share of the clearance (%)", "{:.4g}", "no limit"),
     InText("% of clearance", "{:.4g}", "no limit"), Quantity::number,
     in(100, &OperatingRow::clearance_share)},
    {InFiles("force"), Titled("Force", "{:.5g}", "no limit"), Quantity::force,
     &OperatingRow::force},
    {InFiles("limited"), limited_name},
    {InFiles("value"), row_limit,
     [](const OperatingRow &row) { return row.limited ? std::optional(row.value) : std::nullopt; }},
    {InFiles("limit"), row_limit, &OperatingRow::limit},
    unit_column<OperatingRow>(limited_quantity),
    {OnPage("Limited"), InText("limited", "{}", ""),
     [](const OperatingRow &row, const Units &units) {
         return row.limited ? fmt::format("{} {} of {}", results::measure_name(*row.limited),
                                          with_unit(limited_quantity(row), row.value, units),
                                          with_unit(limited_quantity(row), row.limit, units))
                            : std::string();
     }},
    {InFiles("pass"), &OperatingRow::pass},
    {ForReaders(""), row_outcome},
    {InFiles("error"), RelativeError(), &OperatingRow::error}};

/// A value as it is compared with its limit: shares of a clearance in percent.
std::string measured(results::Measure what, double value, const Units &units) {
    return what == results::Measure::clearance_share && std::isfinite(value)
               ? fmt::format("{:.4g} %", 100 * value)
               : with_unit(results::measure_quantity(what), value, units);
}

const Columns<OperatingWorst> worst_columns{
    {"of", &OperatingWorst::of},
    {"name", &OperatingWorst::name},
    {"z", Quantity::length, &OperatingWorst::z},
    {"angle", Quantity::angle, &OperatingWorst::angle},
    {"relative", &OperatingWorst::relative},
    {OnPage("Largest over the operating speeds"), InText("largest"),
     [](const OperatingWorst &worst, const Units &units) { return operating_place(worst, units); }},
    {"what", ForReaders("of"),
     [](const OperatingWorst &worst) { return results::measure_name(worst.what); }},
    {"from", Quantity::speed, &OperatingWorst::from},
    {"to", Quantity::speed, &OperatingWorst::to},
    {"value", worst_value, &OperatingWorst::value},
    {"limit", worst_value, &OperatingWorst::limit},
    unit_column<OperatingWorst>(
        [](const OperatingWorst &worst) { return results::measure_quantity(worst.what); }),
    {Titled("Value"), [](const OperatingWorst &worst,
                         const Units &units) { return measured(worst.what, worst.value, units); }},
    {Titled("Limit"), [](const OperatingWorst &worst,
                         const Units &units) { return measured(worst.what, worst.limit, units); }},
    {"speed", ForReaders("at"), Quantity::speed, &OperatingWorst::speed},
    {"scale", Quantity::number, &OperatingWorst::scale},
    {"source", ForReaders("limit of"), &OperatingWorst::source},
    {"pass", &OperatingWorst::pass},
    {ForReaders(""), [](const OperatingWorst &worst) { return outcome(worst.pass); }},
    {"why", [](const OperatingWorst &worst, const Units &units) { return units.text(worst.why); }},
    {"error", RelativeError(), &OperatingWorst::error}};

/// Why limits are not judged, each reason once.
std::vector<std::string> reasons(const ResponseResult &result, const Units &units) {
    std::vector<std::string> out;
    for (const OperatingWorst &worst : result.operating->worst)
        if (!worst.why.empty()) {
            const std::string why = "not judged: " + units.text(worst.why);
            if (std::find(out.begin(), out.end(), why) == out.end())
                out.push_back(why);
        }
    if (result.operating->scale)
        out.push_back(fmt::format("Clearances with the imbalance times {:.4g}: as far as the probe "
                                  "that reads most keeps its limit, at least 1 and at most "
                                  "limits.scale_most",
                                  *result.operating->scale));
    return out;
}

} // namespace

Json operating_json(const results::OperatingResponse &operating, const Units &units) {
    return {{"operating", json_rows(row_columns, operating.rows, units)},
            {"worst", json_rows(worst_columns, operating.worst, units)},
            {"scale", Json(operating.scale)}};
}

std::string operating_csv(const Columns<OperatingRow> &first, const std::vector<OperatingRow> &rows,
                          const Units &units) {
    return csv_table(and_then(first, row_columns), rows, units);
}

std::vector<Section> operating_sections(const ResponseResult &result, const Units &units) {
    if (!result.operating)
        return {};
    std::vector<Section> out{
        {"At the operating speeds", page_table(row_columns, result.operating->rows, units)}};
    if (!result.operating->worst.empty()) {
        std::string html = page_table(worst_columns, result.operating->worst, units);
        for (const std::string &reason : reasons(result, units))
            html += "<p>" + escaped(reason) + ".</p>";
        out.push_back({"Limits", std::move(html)});
    }
    return out;
}

std::vector<Section> operating_brief(const ResponseResult &result, const Units &units) {
    std::vector<Section> all = operating_sections(result, units);
    if (all.empty())
        return all;
    std::vector<OperatingRow> rows;
    for (const char *at : {"normal", "maximum"}) {
        for (const OperatingRow &row : result.operating->rows)
            if (row.at.find(at) != std::string::npos)
                rows.push_back(row);
        if (!rows.empty())
            break;
    }
    if (rows.empty())
        return all;
    Columns<OperatingRow> columns = row_columns; // what stands in the heading or among the limits
    std::erase_if(columns, [](const Column<OperatingRow> &column) {
        const std::string heading = column.page.heading.value_or("");
        return heading == "at" || heading == "speed" || heading == "Acceleration" ||
               heading == "Limited" || heading == "Relative error";
    });
    std::rotate(all.begin(), all.begin() + 1, all.end()); // limits first
    all.back() = {
        fmt::format("At {} ({})", units.text(Quantity::speed, rows.front().speed), rows.front().at),
        page_table_of_first(2 * brief_rows, columns, rows, units)};
    return all;
}

model::Sentence operating_answer(const ResponseResult &result) {
    namespace as = model::as;
    const auto used = [](const OperatingRow &row) {
        return row.limited && row.limit && *row.limit > 0 ? row.value / *row.limit : -1;
    };
    const auto words = [](const OperatingRow &row) {
        return results::place_in_words(row.of, row.name, row.z, 4);
    };
    const std::vector<OperatingRow> &rows = result.operating->rows;
    if (rows.empty())
        return {};
    const auto most = std::ranges::max_element(rows, {}, used);
    if (used(*most) >= 0)
        return {"at the operating speeds the {} is nearest to its limit: {} of {} at {}",
                words(*most), model::Value{{most->value}, limited_quantity(*most), 4},
                model::Value{{*most->limit}, limited_quantity(*most), 4},
                as::speed(most->speed, 5)};
    const auto largest = std::ranges::max_element(rows, {}, &OperatingRow::amplitude);
    if (std::isinf(largest->amplitude))
        return {"a resonance without damping at the operating speed {}",
                as::speed(largest->speed, 5)};
    return {"the largest amplitude at the operating speeds is {}, {}, at {}",
            as::amplitude(largest->amplitude, 4), words(*largest), as::speed(largest->speed, 5)};
}

std::string operating_text(const ResponseResult &result, const Units &units) {
    if (!result.operating)
        return "";
    // What a terminal has no room for is left out from the end: the speed at which the machine runs
    // as a rule stands first.
    std::vector<OperatingRow> rows = result.operating->rows;
    std::ranges::stable_sort(rows, {}, [](const OperatingRow &row) {
        return row.at.find("normal") != std::string::npos    ? 0
               : row.at.find("maximum") != std::string::npos ? 1
               : row.at.find("trip") != std::string::npos    ? 2
                                                             : 3;
    });
    std::string limits = text_table("\nLimits:\n", worst_columns, result.operating->worst, units);
    for (const std::string &reason : reasons(result, units))
        limits += "  " + reason + "\n";
    return "At the operating speeds:\n" + text_table(row_columns, rows, units) + limits + "\n";
}

} // namespace whirl::report
