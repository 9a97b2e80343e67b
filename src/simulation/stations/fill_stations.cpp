// The results of a run that concern its stations.

#include "linalg/check.h"
#include "linalg/roots.h"
#include "simulation/run.h"

#include <algorithm>

namespace whirl::simulation {

/// The maximum again as a root of d|w|^2/dt; as far as the polynomial knows it where what touched
/// and stood then is not known any more, or the motion grew beyond all numbers.
results::PeakInTime Run::refined(std::size_t station, const PeakCandidate &candidate) {
    if (!_dry) {
        try {
            return integrated(station, candidate);
        } catch (const linalg::SolverError &) {
        }
    }
    return {candidate.value, candidate.time, speed_at(candidate.time), false};
}

/// By integration from the beginning of its step.
results::PeakInTime Run::integrated(std::size_t station, const PeakCandidate &candidate) {
    const reduction::Row &row = _prepared.stations.rows[station];
    // Between two jumps, in the piece that the step belongs to.
    _motion.enter_piece(std::nextafter(candidate.start, HUGE_VAL));
    OdeSolver solver(problem(), _method);
    Eigen::Vector2d w;
    double speed = speed_at(candidate.time);
    const auto growth = [&](double since) {
        double t = candidate.start;
        solver.start(t, candidate.state.data());
        while (t < candidate.start + since)
            t = solver.step(candidate.start + since);
        w = _motion.deflection(row, solver.state());
        speed = _motion.spin(t, solver.state()).speed;
        return w.dot(_motion.deflection(row, solver.state() + _motion.coordinates()));
    };
    // A little beyond the bracket, whose ends the polynomial has found.
    const double low =
        std::max(candidate.from - candidate.start, 1e-6 * (candidate.to - candidate.start));
    const double high = candidate.to - candidate.start;
    const double at_low = growth(low);
    const double at_high = growth(high);
    results::PeakInTime peak{candidate.value, candidate.time, 0, false};
    if (at_low > 0 && at_high < 0) {
        const double since = linalg::root_between(growth, low, at_low, high, at_high, 1e-12);
        growth(since);
        peak.value = w.norm();
        peak.time = candidate.start + since;
    }
    peak.speed = speed;
    return peak;
}

void Run::fill_stations(results::SimulateResult &result) {
    for (std::size_t i = 0; i < _prepared.stations.rows.size(); ++i) {
        results::StationMotion station;
        station.z = _prepared.stations.z[i];
        station.name = _prepared.stations.names[i];
        station.amplitude = _stations.final_amplitude(_motion.parts().free.size() + i);
        station.peak = {first_amplitude(i), 0, speed_at(0), false};
        if (const auto [value, time] = _stations.before(i); value > station.peak.value)
            station.peak = {value, time, speed_at(time), false};
        for (const PeakCandidate &candidate : _stations.peaks(i))
            if (const results::PeakInTime peak = refined(i, candidate);
                peak.value > station.peak.value)
                station.peak = peak;
        if (_stations.last(i) > station.peak.value)
            station.peak = {_stations.last(i), _t, speed_at(_t), true};
        result.stations.push_back(station);
    }
    const std::size_t index = results::largest_station(result.stations);
    results::Waterfall waterfall = _stations.samples().spectra(index);
    if (waterfall.times.empty())
        return;
    for (const double t : waterfall.times)
        waterfall.speeds.push_back(speed_at(t));
    waterfall.z = result.stations[index].z;
    waterfall.name = result.stations[index].name;
    result.waterfall = std::move(waterfall);
}

} // namespace whirl::simulation
