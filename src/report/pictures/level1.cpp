#include "report/pictures/figures.h"

#include "report/pictures/style.h"
#include "results/level1.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::report {

namespace {

/// The unit of stiffness that was asked for, or the one in which the largest is neither long nor
/// short.
Unit unit_of(const Units &units, double largest) {
    if (!units.asked(Quantity::stiffness))
        for (const Unit &unit : {Unit{"GN/m", 1e-9}, Unit{"MN/m", 1e-6}, Unit{"kN/m", 1e-3}})
            if (largest * unit.factor >= 1)
                return unit;
    return units.unit(Quantity::stiffness);
}

} // namespace

Chart level1_chart(const model::Case &scene, const results::Level1 &level1, const Units &units) {
    const double last = level1.q.empty() ? 0 : level1.q.back();
    const Unit unit = unit_of(units, std::max(last, level1.anticipated.value_or(0)));
    const double largest = unit.factor * std::max(last, 1.02 * level1.anticipated.value_or(0));
    double low = 0;
    double high = 0;
    for (const double log_dec : level1.log_dec)
        if (std::isfinite(log_dec)) {
            low = std::min(low, log_dec);
            high = std::max(high, log_dec);
        }
    const double margin = high > low ? 0.08 * (high - low) : 0.1;
    ChartPanel panel{
        370,
        {.title = "Added cross coupling Q = kxy = −kyx (" + unit.name + ")",
         .unit = unit.name,
         .low = 0,
         .high = largest > 0 ? largest : 1},
        {.title = "Logarithmic decrement", .low = low - margin, .high = high + margin}};
    panel.curves = {
        chart_bar({0, *panel.x.high}, {*panel.y.low, 0}, {"grows", "#FBE3EA"}),
        level_line(panel, 0, {"", "#555555"}, 1.2),
        {"", points_over(level1.q, unit.factor, level1.log_dec, 1), {"", "#0072B2"}, 2.2}};
    if (level1.anticipated)
        panel.curves.push_back(upright_line(panel, *level1.anticipated * unit.factor,
                                            {"anticipated", "#7A5200", "(9,7)"}, 1.3));
    if (const auto &root = level1.critical_cross_coupling;
        root && *root * unit.factor <= *panel.x.high) { // where the curve passes zero
        const double q = *root * unit.factor;
        panel.curves.push_back({"", {{q, 0}}, {"", "#000000", "1", 6}, 0, 1.7});
        panel.labels.push_back({"Q₀ = " + drawn_number(q, 6) + " " + unit.name, q, 0});
    }
    return {"Level-I stability: " + title_of(scene),
            fmt::format("at {}, cross coupling Q added at z = {}",
                        drawn_value(units, Quantity::speed, level1.speed, 6),
                        drawn_value(units, Quantity::length, level1.z)),
            {panel}};
}

} // namespace whirl::report
