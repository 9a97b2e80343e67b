#include "report/pictures/operation.h"

#include <fmt/format.h>

#include <algorithm>

namespace whirl::report {

namespace {

constexpr const char *band_colour = "#E3EFDA";
constexpr const char *trip_colour = "#7A5200";

/// Where a speed lies at the low or the high end of the other axis.
std::string at(double speed, SpeedAxis axis, int end) {
    return axis == SpeedAxis::x ? fmt::format("first {:.9g},graph {}", speed, end)
                                : fmt::format("graph {},first {:.9g}", end, speed);
}

bool within(Range range, double speed) { return speed >= range.low && speed <= range.high; }

/// Arrows are not cut at the border: nothing beyond the axis.
std::string line_at(double speed, Range range, SpeedAxis axis, const std::string &look) {
    if (!within(range, speed))
        return "";
    return fmt::format("set arrow from {} to {} nohead {} lw 1.4\n", at(speed, axis, 0),
                       at(speed, axis, 1), look);
}

/// The part of the band that the axis shows.
std::optional<Range> shown_band(const model::Case &scene, const Units &units, Range range) {
    if (!scene.operation)
        return std::nullopt;
    const Range band{std::max(units(Quantity::speed, scene.operation->from), range.low),
                     std::min(units(Quantity::speed, scene.operation->to), range.high)};
    return band.high > band.low ? std::optional(band) : std::nullopt;
}

} // namespace

std::string operation_band(const model::Case &scene, const Units &units, Range range,
                           SpeedAxis axis) {
    std::string out;
    if (const auto band = shown_band(scene, units, range))
        out +=
            fmt::format("set object rectangle from {} to {} behind fs solid noborder fc rgb '{}'\n",
                        at(band->low, axis, 0), at(band->high, axis, 1), band_colour);
    if (scene.operation && scene.operation->trip)
        out += line_at(units(Quantity::speed, *scene.operation->trip), range, axis,
                       fmt::format("back lc rgb '{}'", trip_colour));
    return out;
}

void add_operation(const model::Case &scene, const Units &units, const LineStyle &style,
                   ChartPanel &panel) {
    if (!scene.operation)
        return;
    const auto add = [&](double speed, const LineStyle &look) {
        const double at = units(Quantity::speed, speed);
        if (panel.x.spin_speed && within({*panel.x.low, *panel.x.high}, at))
            panel.curves.push_back(upright_line(panel, at, look, 1.4));
        if (panel.y.spin_speed && within({*panel.y.low, *panel.y.high}, at))
            panel.curves.push_back(level_line(panel, at, look, 1.4));
    };
    for (const double end : {scene.operation->from, scene.operation->to})
        add(end, style);
    if (scene.operation->trip)
        add(*scene.operation->trip, {"", trip_colour});
}

std::string operation_key(const model::Case &scene, const Units &units, Range range) {
    std::vector<std::string> entries;
    if (shown_band(scene, units, range))
        entries.push_back(fmt::format("keyentry with boxes fs solid fc rgb '{0}' lc rgb '{0}' "
                                      "title 'operating speeds'",
                                      band_colour));
    const auto trip = scene.operation ? scene.operation->trip : std::nullopt;
    if (trip && within(range, units(Quantity::speed, *trip)))
        entries.push_back(
            fmt::format("keyentry with lines lw 1.4 lc rgb '{}' title 'trip'", trip_colour));
    return joined(entries, ", ");
}

} // namespace whirl::report
