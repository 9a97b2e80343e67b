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

std::string operation_edges(const model::Case &scene, const Units &units, Range range) {
    if (!scene.operation)
        return "";
    std::string out;
    for (const double speed : {scene.operation->from, scene.operation->to})
        out += line_at(units(Quantity::speed, speed), range, SpeedAxis::x,
                       "back lc rgb '#5B8C3A' dt (6,3)");
    return out;
}

std::string operation_lines(const model::Case &scene, const Units &units, Range range,
                            SpeedAxis axis) {
    if (!scene.operation)
        return "";
    const model::Operation &running = *scene.operation;
    std::string out;
    for (const double speed : {running.from, running.to, running.trip.value_or(running.to)})
        out +=
            line_at(units(Quantity::speed, speed), range, axis, "front lc rgb '#FFC83D' dt (9,5)");
    if (shown_band(scene, units, range) && axis == SpeedAxis::y)
        out += fmt::format("set label 'operating speeds' at graph 0.015,first {:.9g} left offset "
                           "0,-0.6 font ',9' front textcolor '#FFC83D'\n",
                           shown_band(scene, units, range)->high);
    return out;
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
