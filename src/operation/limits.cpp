#include "operation/limits.h"

#include "model/rpm.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace whirl::operation {

namespace {

using model::Reading;
using results::Measure;

constexpr double micron = 1e-6;            // m
constexpr double millimetre_second = 1e-3; // m/s

/// The amplitude of what is read.
double amplitude_of(double limit, Reading reading) {
    return reading == Reading::peak_to_peak ? limit / 2 : limit;
}

/// ISO 20816-3 is for machines of 120 to 30 000 rpm.
results::Sentence beyond_iso(const model::Operation &operation) {
    constexpr double slowest = 120 / model::rpm;
    constexpr double fastest = 30000 / model::rpm;
    constexpr double rounding = 1e-9;
    if (operation.from >= slowest * (1 - rounding) && operation.to <= fastest * (1 + rounding))
        return {};
    return {"the standard is for speeds of {}", results::as::speed.range(slowest, fastest)};
}

/// Root mean square at A/B, B/C, C/D: velocity in mm/s and displacement in um.
struct HousingZones {
    std::array<double, 3> velocity, displacement;
};

HousingZones zones_of(const model::HousingClass &of) {
    if (of.group == 1)
        return of.flexible ? HousingZones{{3.5, 7.1, 11.0}, {45, 90, 140}}
                           : HousingZones{{2.3, 4.5, 7.1}, {29, 57, 90}};
    return of.flexible ? HousingZones{{2.3, 4.5, 7.1}, {37, 71, 113}}
                       : HousingZones{{1.4, 2.8, 4.5}, {22, 45, 71}};
}

} // namespace

double top_speed(const model::Operation &operation) {
    return std::max(operation.to, operation.trip.value_or(0));
}

std::vector<VibrationLimit> shaft_limits(const model::Limits &limits,
                                         const model::Operation &operation) {
    std::vector<VibrationLimit> out;
    if (limits.shaft)
        out.push_back({Measure::amplitude,
                       amplitude_of(*limits.shaft, limits.shaft_reading),
                       "case, " + model::reading_name(limits.shaft_reading),
                       {}});
    const double fastest = operation.to * model::rpm;
    if (limits.shaft_standard == model::ShaftStandard::api617) {
        constexpr double most = 25.4 * micron; // one thousandth of an inch
        const double peak_to_peak = std::min(most, most * std::sqrt(12000 / fastest));
        out.push_back({Measure::amplitude, peak_to_peak / 2, "API 617", {}});
    }
    if (limits.shaft_standard == model::ShaftStandard::iso20816 && limits.zone) {
        constexpr std::array<double, 3> at{4800, 9000, 13200};
        const double peak_to_peak =
            at.at(static_cast<std::size_t>(*limits.zone)) * micron / std::sqrt(fastest);
        out.push_back({Measure::amplitude, peak_to_peak / 2,
                       "ISO 20816-3, shaft, " + model::zone_name(*limits.zone),
                       beyond_iso(operation)});
    }
    return out;
}

std::vector<VibrationLimit> pedestal_limits(const model::Limits &limits,
                                            const model::Operation &operation) {
    std::vector<VibrationLimit> out;
    if (limits.velocity)
        out.push_back(
            {limits.velocity_reading == Reading::rms ? Measure::velocity_rms : Measure::velocity,
             *limits.velocity,
             "case, " + model::reading_name(limits.velocity_reading),
             {}});
    if (limits.pedestals && limits.zone) {
        const HousingZones zones = zones_of(*limits.pedestals);
        const auto zone = static_cast<std::size_t>(*limits.zone);
        const std::string source = fmt::format(
            "ISO 20816-3, group {}, {}, {}", limits.pedestals->group,
            limits.pedestals->flexible ? "flexible" : "rigid", model::zone_name(*limits.zone));
        const results::Sentence why = beyond_iso(operation);
        out.push_back(
            {Measure::velocity_rms, zones.velocity.at(zone) * millimetre_second, source, why});
        out.push_back({Measure::amplitude_rms, zones.displacement.at(zone) * micron, source, why});
    }
    return out;
}

} // namespace whirl::operation
