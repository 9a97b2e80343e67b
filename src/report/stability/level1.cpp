#include "report/stability/level1.h"

#include "report/common/csv.h"
#include "report/common/table.h"
#include "report/common/words.h"
#include "report/pictures/figures.h"

#include <fmt/format.h>

#include <cmath>

namespace whirl::report {

using results::Level1;

namespace {

/// Q0 over the coupling that is anticipated.
std::optional<double> reserve(const Level1 &level1) {
    return level1.anticipated && level1.critical_cross_coupling
               ? std::optional(*level1.critical_cross_coupling / *level1.anticipated)
               : std::nullopt;
}

std::optional<double> without_coupling(const Level1 &level1) {
    return level1.log_dec.empty() ? std::nullopt : std::optional(level1.log_dec.front());
}

const Columns<Level1> found{
    {"z", OnPage("z (m)", "{:.6g}"), InText("added at z (m)"), &Level1::z},
    {"speed", &Level1::speed},
    {OnPage("Spin speed (rpm)", "{:.6g}"), InText("spin speed (rpm)", "{:.6g}"),
     in(rpm, &Level1::speed)},
    {OnPage("Logarithmic decrement without it", "{:.6g}"),
     InText("log. decrement without it", "{:.6g}"), without_coupling},
    {"critical_cross_coupling", OnPage("Critical cross coupling (N/m)", "{:.10g}"),
     InText("critical cross coupling (N/m)", precise), &Level1::critical_cross_coupling},
    {"error", OnPage("Relative error", "{:.2g}"), InText("its relative error", rough),
     &Level1::error},
    {"critical_frequency", &Level1::critical_frequency},
    {OnPage("Frequency there (Hz)", "{:.6g}"), InText("frequency there (Hz)", "{:.6g}"),
     in(hertz, &Level1::critical_frequency)},
    {"anticipated", OnPage("Anticipated cross coupling (N/m)", "{:.6g}"),
     InText("anticipated cross coupling (N/m)", "{:.6g}"), &Level1::anticipated},
    {"anticipated_log_dec", OnPage("Logarithmic decrement with that", "{:.6g}"),
     InText("log. decrement with that", "{:.6g}"), &Level1::anticipated_log_dec},
    {"ratio", OnPage("Critical over anticipated", "{:.4g}"),
     InText("critical over anticipated", "{:.4g}"), reserve}};

/// A point of the curve.
struct CurvePoint {
    double q, log_dec, frequency;
};

std::vector<CurvePoint> points(const Level1 &level1) {
    std::vector<CurvePoint> out;
    for (std::size_t i = 0; i < level1.q.size(); ++i)
        out.push_back({level1.q[i], level1.log_dec[i], level1.frequency[i]});
    return out;
}

const Columns<CurvePoint> curve{{"q", InCsv("q [N/m]"), &CurvePoint::q},
                                {"log_dec", InCsv("log_dec"), &CurvePoint::log_dec},
                                {"frequency", InCsv("frequency [rad/s]"), &CurvePoint::frequency}};

} // namespace

Json level1_json(const Level1 &level1) {
    Json json = json_row(found, level1);
    take_entries(json, json_lists(curve, points(level1)));
    return json;
}

Section level1_section(const Level1 &level1) {
    return {"Level-I stability: added cross coupling", page_properties(found, level1)};
}

std::string level1_text(const Level1 &level1) {
    return "\nLevel-I stability, added cross coupling:\n" +
           text_table(properties(found, level1, &Column<Level1>::text, "-"));
}

Picture level1_picture(const model::Case &scene, const Level1 &level1) {
    return {"level1", level1_figure(scene, level1), csv_table(curve, points(level1))};
}

} // namespace whirl::report
