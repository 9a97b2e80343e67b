#include "simulation/outcome.h"

#include "balancers/balanced_position.h"
#include "balancers/kind.h"
#include "rigid/projection.h"
#include "simulation/stations/stations.h"
#include "simulation/trend.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace whirl::simulation {

namespace {

namespace as = results::as;
using results::Sentence;
using std::numbers::pi;
constexpr double still_swing = 0.05;   ///< rad, of a ball that counts as standing still
constexpr double drifting = pi;        ///< rad over the last tenth, of a ball that lags
constexpr double balanced_ratio = 0.1; ///< of the unbalanced amplitude
constexpr double creeping = 0.1;       ///< rad over the last quarter, of balls on their way
/// Of the amplitude: the rotor moves as it would if the balls were fixed where they are.
constexpr double follows_balls = 0.05;
/// Of that motion: the balls have changed it.
constexpr double moved = 0.01;
/// Errors of the integrator gather over its steps: sizes below so many tolerances say nothing.
constexpr double noise = 1e3;

/// First index of the series at or after the time.
std::size_t index_from(const results::MotionSeries &series, double time) {
    const auto at = std::lower_bound(series.time.begin(), series.time.end(), time);
    const auto index = static_cast<std::size_t>(at - series.time.begin());
    return std::min(index, series.time.size() - 2);
}

double swing_from(const std::vector<double> &angles, std::size_t first) {
    const auto [low, high] =
        std::minmax_element(angles.begin() + static_cast<std::ptrdiff_t>(first), angles.end());
    return *high - *low;
}

/// Largest rate of a part in the rotor, rad/s.
double fastest_rate(const results::SimulateResult &result) {
    double fastest = 0;
    for (const results::BalancerMotion &b : result.balancers)
        for (const double rate : b.rates)
            if (std::abs(rate) > std::abs(fastest))
                fastest = rate;
    return fastest;
}

/// Of the imbalances, or without any of the balls side by side, on a rotor without supports, m.
double free_amplitude(const model::Rotor &rotor) {
    double moment = 0;
    for (const model::Balancer &b : rotor.balancers)
        moment += b.imbalance;
    for (const model::Imbalance &imbalance : rotor.imbalances)
        moment += std::abs(imbalance.mr);
    if (moment == 0)
        for (const model::Balancer &b : rotor.balancers)
            moment += balancers::kind_of(b)->reach().side_by_side;
    return moment / rigid::rigid_body(rotor, 0).mass;
}

void fill_balancers(const model::Case &scene, results::SimulateResult &result) {
    const results::MotionSeries &series = result.series;
    const std::size_t tenth = index_from(series, 0.9 * series.time.back());
    const double window = series.time.back() - series.time[tenth];
    std::size_t angle = 0;
    for (std::size_t i = 0; i < scene.rotor.balancers.size(); ++i) {
        const model::Balancer &b = scene.rotor.balancers[i];
        results::BalancerMotion &out = result.balancers[i];
        out.z = b.z;
        out.name = b.name;
        const auto kind = balancers::kind_of(b);
        out.kind = kind->name();
        out.coordinates = kind->coordinates();
        if (!kind->circled().empty() && b.imbalance > 0)
            out.capacity = balancers::capacity(b);
        for (std::size_t j = 0; j < out.coordinates.size(); ++j, ++angle) {
            const std::vector<double> &own = series.angles[angle];
            out.angles.push_back(std::remainder(own.back(), 2 * pi));
            out.rates.push_back((own.back() - own[tenth]) / window);
            out.swing.push_back(swing_from(own, tenth));
        }
    }
}

/// How the motion ends by its last stretch alone, whether or not that lasts.
struct Ending {
    results::Outcome outcome = results::Outcome::whirling;
    double ratio = 0; ///< of the amplitude to the unbalanced one
    double swing = 0; ///< of the angles to and fro over the last fortieth, rad
};

Ending ending_of(const results::MotionSeries &series, double ratio) {
    const std::size_t tenth = index_from(series, 0.9 * series.time.back());
    const std::size_t fortieth = index_from(series, 0.975 * series.time.back());
    double drift = 0;
    Ending ending;
    ending.ratio = ratio;
    for (const std::vector<double> &angles : series.angles) {
        drift = std::max(drift, std::abs(angles.back() - angles[tenth]));
        // What only moves on is straight over the last tenth.
        ending.swing =
            std::max(ending.swing, std::min(swing_from(angles, fortieth),
                                            swing_about_line(std::span(angles).subspan(tenth))));
    }
    if (drift > drifting)
        ending.outcome = results::Outcome::lagging;
    else if (ending.swing > still_swing)
        ending.outcome = results::Outcome::whirling;
    else
        ending.outcome =
            ratio < balanced_ratio ? results::Outcome::balanced : results::Outcome::offset;
    return ending;
}

/// The trends of a motion at constant speed over its last half.
struct Trends {
    Trend amplitude;
    Trend wobble;     ///< of the swing of the amplitude
    Trend balls;      ///< of the swing of the angles
    double creep = 0; ///< of the angles over the last quarter of the time, rad
};

/// Of the swings of some lists. Neither a motion that bends nor one that slows down swings more and
/// more: it must by both measures of a swing.
/// @param noise  what the integrator's tolerance leaves of a swing
Trend trend_of_swings(const std::vector<double> &time,
                      const std::vector<std::vector<double>> &lists, double noise) {
    const double end = time.back();
    const auto by = [&](double (*swing)(std::span<const double>)) {
        std::vector<std::vector<double>> swings;
        for (const std::vector<double> &values : lists)
            swings.push_back(swings_of(time, values, end / 40, swing));
        return trend_of(time, largest_of(swings, time.size()), end / 2, noise);
    };
    Trend out = by(swing_about_line);
    if (out.growing)
        out.growing = by(swing_back).growing;
    return out;
}

/// @param amplitude_noise  m; what the integrator's tolerance leaves
/// @param angle_noise      rad
Trends trends_of(const results::MotionSeries &series, double amplitude_noise, double angle_noise) {
    const double end = series.time.back();
    std::vector<std::vector<double>> amplitudes = series.amplitude;
    if (!series.stations.empty())
        amplitudes.push_back(series.stations);
    Trends trends;
    trends.amplitude =
        trend_of(series.time, largest_of(amplitudes, series.time.size()), end / 2, amplitude_noise);
    trends.wobble = trend_of_swings(series.time, amplitudes, amplitude_noise);
    trends.balls = trend_of_swings(series.time, series.angles, angle_noise);
    const std::size_t quarter = index_from(series, 0.75 * end);
    for (const std::vector<double> &angles : series.angles)
        trends.creep = std::max(trends.creep, std::abs(angles.back() - angles[quarter]));
    return trends;
}

/// The rotor is in its steady motion with the balls where they are, after half the time and at the
/// end, and that has changed: it grows as they move, not by itself, and what it swings with it (of
/// an orbit that is no circle the parts between two output times differ).
bool follows_the_balls(const results::SimulateResult &result) {
    if (!result.at_rest)
        return false;
    const auto [least, most] = std::minmax(result.at_rest->halfway, result.at_rest->amplitude);
    if (most - least < moved * most)
        return false;
    const results::MotionSeries &series = result.series;
    const std::size_t last = series.time.size() - 1;
    // Orbits are seen whole over two turns.
    const double window = std::max(series.time.back() / 40, 4 * pi / std::abs(series.speed.back()));
    const auto agrees = [&](std::size_t index, double fixed) {
        double amplitude = 0;
        for (std::size_t k = index_from(series, series.time[index] - window); k <= index; ++k) {
            if (k < series.stations.size())
                amplitude = std::max(amplitude, series.stations[k]);
            for (const std::vector<double> &plane : series.amplitude)
                amplitude = std::max(amplitude, plane[k]);
        }
        return std::abs(amplitude - fixed) <= follows_balls * std::max(amplitude, fixed);
    };
    return agrees(last / 2, result.at_rest->halfway) && agrees(last, result.at_rest->amplitude);
}

/// Sets outcome, trend and decision_time; says why where the outcome is another.
Sentence judge(const Ending &ending, const Trends &trends, double tolerance,
               results::SimulateResult &result) {
    const double end = result.series.time.back();
    result.outcome = ending.outcome;
    result.trend = trends.amplitude.end_rate;
    const bool lagging = ending.outcome == results::Outcome::lagging;
    const bool follows = follows_the_balls(result);
    for (const auto &[trend, what] : {std::pair(&trends.amplitude, "the amplitude"),
                                      std::pair(&trends.wobble, "the swing of the amplitude"),
                                      std::pair(&trends.balls, "the swing of the balls")}) {
        if (!trend->growing || (lagging && trend != &trends.amplitude) ||
            (follows && trend != &trends.balls))
            continue;
        result.outcome = results::Outcome::growing;
        return {"{} grows steadily, by {} over the last half", what, as::rate(trend->end_rate, 3)};
    }
    const auto undecided = [&](double time, Sentence why) {
        result.outcome = results::Outcome::undecided;
        result.decision_time = time;
        return why;
    };
    if (ending.outcome == results::Outcome::whirling && trends.balls.decaying)
        return undecided(
            end + std::log(ending.swing / still_swing) / -trends.balls.end_rate,
            {"the swing of the balls dies out, by {}", as::rate(trends.balls.end_rate, 3)});
    if (ending.outcome == results::Outcome::balanced && result.linear_growth.value_or(0) > 0)
        return undecided(end + std::log(1 / tolerance) / *result.linear_growth,
                         {"balanced so far, but that position is unstable by its "
                          "eigenvalues: small motions grow by {}",
                          as::rate(*result.linear_growth, 3)});
    if (ending.outcome == results::Outcome::offset && trends.amplitude.decaying)
        return undecided(
            end + std::log(ending.ratio / balanced_ratio) / -trends.amplitude.end_rate,
            {"the amplitude still falls, by {}", as::rate(trends.amplitude.end_rate, 3)});
    if (ending.outcome == results::Outcome::offset && result.at_rest) {
        if (const double away = result.at_rest->away.value_or(0); away > still_swing)
            return undecided(2 * end, {"the balls are still on their way, {} from where they would "
                                       "rest; they moved by {} over the last quarter",
                                       as::angle(away, 3), as::angle(trends.creep, 3)});
        if (!result.at_rest->holds.value_or(true))
            return undecided(2 * end, "the balls are next to a position in which they would rest, "
                                      "but from which small motions lead away");
    }
    if (ending.outcome == results::Outcome::offset &&
        (trends.amplitude.changing || trends.creep > creeping))
        return undecided(2 * end,
                         {"the motion still changes: angles by {} over the last quarter, "
                          "the amplitude by {}",
                          as::angle(trends.creep, 3), as::rate(trends.amplitude.end_rate, 3)});
    return {};
}

/// Parts that do not stand still leave no motion with them at rest.
void forget_parts_at_rest(results::SimulateResult &result) {
    result.at_rest.reset();
    for (results::StationMotion &station : result.stations)
        station.with_balls.reset();
}

Sentence what_is_left(const results::PartsAtRest &left) {
    return {"balanced at the balancers, but not at the stations: a couple of {} about the centre "
            "of mass, z = {}, is left in the rotor, and an imbalance of {}",
            as::inertia(left.couple, 4), as::length(left.center_of_mass, 5),
            as::imbalance(left.imbalance, 4)};
}

} // namespace

bool ends_at_constant_speed(const results::SimulateResult &result) {
    const results::MotionSeries &series = result.series;
    const std::size_t half = index_from(series, 0.5 * series.time.back());
    const auto [low, high] = std::minmax_element(
        series.speed.begin() + static_cast<std::ptrdiff_t>(half), series.speed.end());
    return *high - *low <= 1e-3 * std::max(std::abs(*high), std::abs(*low));
}

void classify(const model::Case &scene, results::SimulateResult &result) {
    if (scene.rotor.balancers.empty()) {
        classify_stations(scene, result);
        return;
    }
    fill_balancers(scene, result);
    double amplitude = 0;
    double reference = 0;
    for (const results::BalancerMotion &b : result.balancers) {
        amplitude = std::max(amplitude, b.amplitude);
        reference = std::max(reference, b.reference);
    }
    double station = 0;
    std::size_t worst = 0;
    for (std::size_t i = 0; i < result.stations.size(); ++i)
        if (result.stations[i].amplitude > station) {
            worst = i;
            station = result.stations[i].amplitude;
        }
    const double scale = reference > 0 ? reference : free_amplitude(scene.rotor);
    const double station_scale = result.station_reference > 0 ? result.station_reference : scale;
    const double ratio = scale > 0 ? amplitude / scale : HUGE_VAL;
    const double station_ratio = station_scale > 0 ? station / station_scale : ratio;
    if (has_imbalance(scene.rotor) && reference > 0)
        result.residual_ratio = ratio;
    if (has_imbalance(scene.rotor) && result.station_reference > 0)
        result.station_ratio = station_ratio;
    const Ending ending = ending_of(result.series, std::max(ratio, station_ratio));
    const double tolerance = scene.simulate.tolerance;
    Sentence why;
    if (ends_at_constant_speed(result))
        why = judge(ending, trends_of(result.series, noise * tolerance * scale, noise * tolerance),
                    tolerance, result);
    else
        result.outcome = ending.outcome;
    std::vector<Sentence> evidence{{"largest amplitude at a balancer {} at the end, {} without "
                                    "balls",
                                    as::amplitude(amplitude, 4), as::amplitude(reference, 4)}};
    if (station > 0)
        evidence.emplace_back("at a station {} ({}), {} without balls", as::amplitude(station, 4),
                              place_of(result.stations[worst]),
                              as::amplitude(result.station_reference, 4));
    evidence.emplace_back("fastest ball in the rotor {} on the mean of the last tenth, swing of "
                          "the angles over the last fortieth {}",
                          as::speed(fastest_rate(result), 3), as::angle(ending.swing, 3));
    for (std::size_t i = 0; i < scene.rotor.balancers.size(); ++i)
        if (const auto centre = balancers::kind_of(scene.rotor.balancers[i])->race_centre();
            centre != 0.0)
            evidence.emplace_back(
                "the race of {} is off the axis by {}, which its balls cannot "
                "take away",
                model::name_or_number(scene.rotor.balancers[i].name, "balancer", i),
                as::amplitude(std::abs(centre), 4));
    if (!why.empty())
        evidence.push_back(why);
    const bool stands =
        ending.outcome == results::Outcome::balanced || ending.outcome == results::Outcome::offset;
    if (!stands)
        forget_parts_at_rest(result);
    else if (result.outcome == results::Outcome::offset && ratio < balanced_ratio &&
             result.at_rest && result.at_rest->amplitude >= balanced_ratio * station_scale)
        evidence.push_back(what_is_left(*result.at_rest));
    result.evidence = joined(evidence, "; ");
}

} // namespace whirl::simulation
