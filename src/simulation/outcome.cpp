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

namespace whirl::simulation {

namespace {

using results::Sentence;
namespace as = results::as;

using std::numbers::pi;
constexpr double still_swing = 0.05;   ///< rad, of a ball that counts as standing still
constexpr double drifting = pi;        ///< rad over the last tenth, of a ball that lags
constexpr double balanced_ratio = 0.1; ///< of the unbalanced amplitude
constexpr double creeping = 0.1;       ///< rad over the last quarter, of balls on their way
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

/// What the motion looks like over its last stretch, whether or not that lasts.
struct Look {
    results::Outcome outcome = results::Outcome::whirling;
    double ratio = 0; ///< of the amplitude to the unbalanced one
    double swing = 0; ///< of the angles over the last fortieth, rad
};

Look look_of(const results::MotionSeries &series, double ratio) {
    const std::size_t tenth = index_from(series, 0.9 * series.time.back());
    const std::size_t fortieth = index_from(series, 0.975 * series.time.back());
    double drift = 0;
    Look look;
    look.ratio = ratio;
    for (const std::vector<double> &angles : series.angles) {
        drift = std::max(drift, std::abs(angles.back() - angles[tenth]));
        look.swing = std::max(look.swing, swing_from(angles, fortieth));
    }
    if (drift > drifting)
        look.outcome = results::Outcome::lagging;
    else if (look.swing > still_swing)
        look.outcome = results::Outcome::whirling;
    else
        look.outcome =
            ratio < balanced_ratio ? results::Outcome::balanced : results::Outcome::offset;
    return look;
}

/// The trends of a motion at constant speed over its last half.
struct Trends {
    Trend amplitude;
    Trend wobble;     ///< of the swing of the amplitude
    Trend balls;      ///< of the swing of the angles
    double creep = 0; ///< of the angles over the last quarter of the time, rad
};

/// @param amplitude_noise  m; what the integrator's tolerance leaves
/// @param angle_noise      rad
Trends trends_of(const results::MotionSeries &series, double amplitude_noise, double angle_noise) {
    const double end = series.time.back();
    const double width = end / 40;
    const std::size_t size = series.time.size();
    std::vector<std::vector<double>> wobbles;
    std::vector<std::vector<double>> swings;
    for (const std::vector<double> &amplitude : series.amplitude)
        wobbles.push_back(swings_of(series.time, amplitude, width));
    for (const std::vector<double> &angles : series.angles)
        swings.push_back(swings_of(series.time, angles, width));
    Trends trends;
    const auto trend = [&](const std::vector<double> &values, double below) {
        return trend_of(series.time, values, end / 2, below);
    };
    trends.amplitude = trend(largest_of(series.amplitude, size), amplitude_noise);
    trends.wobble = trend(largest_of(wobbles, size), amplitude_noise);
    trends.balls = trend(largest_of(swings, size), angle_noise);
    const std::size_t quarter = index_from(series, 0.75 * end);
    for (const std::vector<double> &angles : series.angles)
        trends.creep = std::max(trends.creep, std::abs(angles.back() - angles[quarter]));
    return trends;
}

/// Sets outcome, trend and decision_time; says why where the outcome is not what it looks like.
Sentence judge(const Look &look, const Trends &trends, double tolerance,
               results::SimulateResult &result) {
    const double end = result.series.time.back();
    result.outcome = look.outcome;
    result.trend = trends.amplitude.end_rate;
    const bool lagging = look.outcome == results::Outcome::lagging;
    for (const auto &[trend, what] : {std::pair(&trends.amplitude, "the amplitude"),
                                      std::pair(&trends.wobble, "the swing of the amplitude"),
                                      std::pair(&trends.balls, "the swing of the balls")}) {
        if (!trend->growing || (lagging && trend != &trends.amplitude))
            continue;
        result.outcome = results::Outcome::growing;
        return Sentence("{} grows steadily, by {} over the last half", what,
                        as::rate(trend->end_rate, 3));
    }
    const auto undecided = [&](double time, Sentence why) {
        result.outcome = results::Outcome::undecided;
        result.decision_time = time;
        return why;
    };
    if (look.outcome == results::Outcome::whirling && trends.balls.decaying)
        return undecided(
            end + std::log(look.swing / still_swing) / -trends.balls.end_rate,
            Sentence("the swing of the balls dies out, by {}", as::rate(trends.balls.end_rate, 3)));
    if (look.outcome == results::Outcome::balanced && result.linear_growth.value_or(0) > 0)
        return undecided(end + std::log(1 / tolerance) / *result.linear_growth,
                         Sentence("it looks balanced, but by its eigenvalues that position is "
                                  "unstable: small motions grow by {}",
                                  as::rate(*result.linear_growth, 3)));
    if (look.outcome == results::Outcome::offset && trends.amplitude.decaying)
        return undecided(
            end + std::log(look.ratio / balanced_ratio) / -trends.amplitude.end_rate,
            Sentence("the amplitude still falls, by {}", as::rate(trends.amplitude.end_rate, 3)));
    if (look.outcome == results::Outcome::offset &&
        (trends.amplitude.changing || trends.creep > creeping))
        return undecided(
            2 * end,
            Sentence(
                "the motion still changes: angles by {} over the last quarter, the amplitude by {}",
                as::angle(trends.creep, 3), as::rate(trends.amplitude.end_rate, 3)));
    return {};
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
    const double scale = reference > 0 ? reference : free_amplitude(scene.rotor);
    const double ratio = scale > 0 ? amplitude / scale : HUGE_VAL;
    if (has_imbalance(scene.rotor) && reference > 0)
        result.residual_ratio = ratio;
    const Look look = look_of(result.series, ratio);
    const double tolerance = scene.simulate.tolerance;
    Sentence why;
    if (ends_at_constant_speed(result))
        why = judge(look, trends_of(result.series, noise * tolerance * scale, noise * tolerance),
                    tolerance, result);
    else
        result.outcome = look.outcome;
    result.evidence = Sentence(
        "largest amplitude at a balancer {} at the end, {} without balls; fastest ball in the "
        "rotor {} on the mean of the last tenth, swing of the angles over the last fortieth {}{}{}",
        as::amplitude(amplitude, 4), as::amplitude(reference, 4),
        as::speed(fastest_rate(result), 3), as::angle(look.swing, 3), why.empty() ? "" : "; ", why);
}

} // namespace whirl::simulation
