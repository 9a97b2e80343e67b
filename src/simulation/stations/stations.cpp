#include "simulation/stations/stations.h"

#include "forced/forced_motion.h"
#include "forced/response_places.h"
#include "linalg/check.h"
#include "model/errors.h"
#include "simulation/equations.h"
#include "simulation/outcome.h"
#include "simulation/scene_outside.h"
#include "simulation/trend.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace whirl::simulation {

namespace {

using results::Sentence;
namespace as = results::as;

/// The case with all imbalances there are at the end, driven over the speeds passed.
model::Case steady_case(const model::Case &scene, const results::SimulateResult &result) {
    model::Case steady = scene;
    steady.rotor = rotor_with_nodes(scene);
    for (const model::SuddenImbalance &imbalance : scene.simulate.imbalances)
        if (imbalance.time < result.time)
            steady.rotor.imbalances.push_back(
                {imbalance.name, imbalance.z, imbalance.mr, imbalance.phase});
    const auto [low, high] = std::ranges::minmax_element(result.series.speed);
    steady.speeds = model::SpeedRange{*low, *high, 2};
    return steady;
}

void add_peaks(const model::Case &steady, const assembly::Discretization &d, results::Form form,
               results::SimulateResult &result) {
    forced::Watched watched;
    for (const results::StationMotion &station : result.stations)
        watched.add({d.deflection_at(station.z)}, "station", station.z, station.name);
    std::vector<results::ResponsePeak> peaks;
    results::ResponseCurves curves;
    forced::add_peaks(peaks, curves, d, form, watched, *steady.speeds,
                      {{}, false, steady.reduction});
    for (const results::ResponsePeak &peak : peaks) {
        results::StationMotion &station = result.stations[static_cast<std::size_t>(peak.place)];
        if (!station.steady_peak || peak.value > *station.steady_peak) {
            station.steady_peak = peak.value;
            station.steady_peak_speed = peak.speed;
        }
    }
    result.steady = {curves.speeds, curves.values};
}

void add_last_speed(const assembly::Discretization &d, results::Form form,
                    results::SimulateResult &result) {
    std::vector<double> places;
    for (const results::StationMotion &station : result.stations)
        places.push_back(station.z);
    const std::vector<double> amplitudes = steady_amplitudes(d, form, result.speed, places);
    for (std::size_t i = 0; i < places.size(); ++i)
        result.stations[i].steady = amplitudes[i];
}

Sentence place_of(const results::StationMotion &station) {
    return station.name.empty() ? Sentence("z = {}", as::length(station.z, 5))
                                : Sentence("{}", station.name);
}

} // namespace

void add_steady_response(const model::Case &scene, int order, results::SimulateResult &result) {
    try {
        const model::Case steady = steady_case(scene, result);
        if (!has_imbalance(steady.rotor))
            return;
        const results::Form form = forced::response_formulation(steady).form;
        const assembly::Discretization d(steady.rotor, order);
        if (steady.speeds->to > steady.speeds->from)
            add_peaks(steady, d, form, result);
        if (result.speed != 0)
            add_last_speed(d, form, result);
    } catch (const linalg::SolverError &) {
        result.model.notes.emplace_back("no steady motion at {} to compare with: the rotor is at a "
                                        "resonance without damping, or free to move",
                                        as::speed(result.speed));
    } catch (const model::AnalysisFailure &failure) { // the motion is worth having all the same
        result.model.notes.emplace_back("no steady response to compare with: {}",
                                        failure.sentence());
    }
}

void classify_stations(const model::Case &scene, results::SimulateResult &result) {
    const std::vector<double> amplitudes =
        largest_of(result.series.amplitude, result.series.time.size());
    const double scale = *std::ranges::max_element(amplitudes);
    const results::StationMotion &worst =
        result.stations[results::largest_station(result.stations)];
    result.evidence =
        Sentence("largest amplitude {} at {} after {} at {}", as::amplitude(worst.peak.value, 5),
                 place_of(worst), as::time(worst.peak.time), as::speed(worst.peak.speed));
    if (worst.peak.at_end)
        result.evidence += ", where it still grew";
    result.outcome = results::Outcome::transient;
    if (!ends_at_constant_speed(result)) {
        result.evidence += "; the speed still changed over the last half of the time";
        return;
    }
    const Trend trend = trend_of(result.series.time, amplitudes, result.time / 2,
                                 1e3 * scene.simulate.tolerance * scale);
    result.trend = trend.end_rate;
    const char *how = "stays as it is";
    if (trend.growing) {
        result.outcome = results::Outcome::growing;
        how = "grows steadily";
    } else if (trend.decaying || trend.changing) {
        how = "still changes";
    } else {
        result.outcome = results::Outcome::steady;
    }
    result.evidence += Sentence("; over the last half of the time the amplitude {} ({})", how,
                                as::rate(trend.end_rate, 3));
}

} // namespace whirl::simulation
