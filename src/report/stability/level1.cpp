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
    {"z", "", {"z (m)", "{:.6g}"}, {"added at z (m)"}, &Level1::z},
    {"speed", "", {}, {}, &Level1::speed},
    {"",
     "",
     {"Spin speed (rpm)", "{:.6g}"},
     {"spin speed (rpm)", "{:.6g}"},
     [](const Level1 &of) { return of.speed * rpm; }},
    {"",
     "",
     {"Logarithmic decrement without it", "{:.6g}"},
     {"log. decrement without it", "{:.6g}"},
     without_coupling},
    {"critical_cross_coupling",
     "",
     {"Critical cross coupling (N/m)", "{:.10g}"},
     {"critical cross coupling (N/m)", precise},
     &Level1::critical_cross_coupling},
    {"error", "", {"Relative error", "{:.2g}"}, {"its relative error", rough}, &Level1::error},
    {"critical_frequency", "", {}, {}, &Level1::critical_frequency},
    {"",
     "",
     {"Frequency there (Hz)", "{:.6g}"},
     {"frequency there (Hz)", "{:.6g}"},
     [](const Level1 &of) {
         return of.critical_frequency ? std::optional(*of.critical_frequency * hertz)
                                      : std::nullopt;
     }},
    {"anticipated",
     "",
     {"Anticipated cross coupling (N/m)", "{:.6g}"},
     {"anticipated cross coupling (N/m)", "{:.6g}"},
     &Level1::anticipated},
    {"anticipated_log_dec",
     "",
     {"Logarithmic decrement with that", "{:.6g}"},
     {"log. decrement with that", "{:.6g}"},
     &Level1::anticipated_log_dec},
    {"ratio",
     "",
     {"Critical over anticipated", "{:.4g}"},
     {"critical over anticipated", "{:.4g}"},
     reserve}};

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

const Columns<CurvePoint> curve{{"q", "q [N/m]", {}, {}, &CurvePoint::q},
                                {"log_dec", "log_dec", {}, {}, &CurvePoint::log_dec},
                                {"frequency", "frequency [rad/s]", {}, {}, &CurvePoint::frequency}};

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
