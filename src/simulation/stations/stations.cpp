#include "simulation/stations/stations.h"

#include "forced/forced_motion.h"
#include "forced/response_places.h"
#include "linalg/check.h"
#include "model/errors.h"
#include "simulation/equations.h"
#include "simulation/outcome.h"
#include "simulation/steady_motion.h"
#include "simulation/trend.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::simulation {

namespace {

namespace as = results::as;

void add_peaks(const model::Case &steady, const assembly::Discretization &d, results::Form form,
               results::SimulateResult &result) {
    forced::Watched watched;
    for (const results::StationMotion &station : result.stations)
        watched.add({d.deflection_at(station.z)}, "station", station.z, station.name);
    std::vector<results::ResponsePeak> peaks;
    results::ResponseCurves curves;
    forced::add_peaks(peaks, curves, d, form, watched, *steady.speeds, {{}, false},
                      result.model.notes);
    for (const results::ResponsePeak &peak : peaks) {
        results::StationMotion &station = result.stations[static_cast<std::size_t>(peak.place)];
        if (!station.steady_peak || peak.value > *station.steady_peak) {
            station.steady_peak = peak.value;
            station.steady_peak_speed = peak.speed;
        }
    }
    result.steady = {curves.speeds, curves.values};
}

void add_last_speed(const assembly::Discretization &d, results::Form form, bool own,
                    results::SimulateResult &result) {
    const SteadyMotion motion(d, form, result.speed);
    for (results::StationMotion &station : result.stations) {
        const double amplitude = motion.amplitude(station.z);
        result.station_reference = std::max(result.station_reference, amplitude);
        if (own)
            station.steady = amplitude;
    }
    for (results::BalancerMotion &balancer : result.balancers)
        balancer.reference = motion.amplitude(balancer.z);
}

} // namespace

results::Sentence place_of(const results::StationMotion &station) {
    return station.name.empty() ? results::Sentence("z = {}", as::length(station.z, 5))
                                : results::Sentence("{}", station.name);
}

void add_steady_response(const model::Case &scene, int order, results::SimulateResult &result) {
    const bool balancers = !scene.rotor.balancers.empty();
    const char *judged =
        balancers ? "; `balanced` is judged against the amplitude of a free rotor" : "";
    try {
        const model::Rotor rotor = rotor_at_end(scene, result);
        const bool own = has_imbalance(rotor);
        if (!own && !balancers)
            return;
        const model::Case steady = driven(scene, rotor_without_balls(rotor), result);
        const results::Form form = forced::response_formulation(steady).form;
        const assembly::Discretization d(steady.rotor, order);
        if (own && steady.speeds->to > steady.speeds->from)
            add_peaks(steady, d, form, result);
        if (result.speed != 0)
            add_last_speed(d, form, own, result);
    } catch (const linalg::SolverError &) {
        result.model.notes.emplace_back(model::Weight::warning,
                                        "no steady motion at {} to compare with: the rotor is at a "
                                        "resonance without damping, or free to move{}",
                                        as::speed(result.speed), judged);
    } catch (const model::AnalysisFailure &failure) { // the motion is worth having all the same
        result.model.notes.emplace_back("no steady response to compare with: {}{}",
                                        failure.sentence(), judged);
    }
}

void classify_stations(const model::Case &scene, results::SimulateResult &result) {
    const std::vector<double> amplitudes =
        largest_of(result.series.amplitude, result.series.time.size());
    const double scale = *std::ranges::max_element(amplitudes);
    const results::StationMotion &worst =
        result.stations[results::largest_station(result.stations)];
    result.evidence = {"largest amplitude {} at {} after {} at {}",
                       as::amplitude(worst.peak.value, 5), place_of(worst),
                       as::time(worst.peak.time), as::speed(worst.peak.speed)};
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
    result.evidence += {"; over the last half of the time the amplitude {} ({})", how,
                        as::rate(trend.end_rate, 3)};
}

} // namespace whirl::simulation
