#include "analyses/motion_outcome.h"

#include "analyses/balance_rigid.h"
#include "analyses/balanced_position.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace whirl::analyses {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double still_swing = 0.05;   ///< rad, of a ball that counts as standing still
constexpr double drifting = pi;        ///< rad over the last tenth, of a ball that lags
constexpr double balanced_ratio = 0.1; ///< of the unbalanced amplitude

/// First index of the series at or after the time.
std::size_t index_from(const MotionSeries &series, double time) {
    const auto at = std::lower_bound(series.time.begin(), series.time.end(), time);
    const auto index = static_cast<std::size_t>(at - series.time.begin());
    return std::min(index, series.time.size() - 2);
}

double swing_from(const std::vector<double> &angles, std::size_t first) {
    const auto [low, high] =
        std::minmax_element(angles.begin() + static_cast<std::ptrdiff_t>(first), angles.end());
    return *high - *low;
}

/// Largest over the balancers.
double worst(const SimulateResult &result, std::vector<double> BalancerMotion::*list) {
    double largest = 0;
    for (const BalancerMotion &b : result.balancers)
        for (const double value : b.*list)
            if (std::abs(value) > std::abs(largest))
                largest = value;
    return largest;
}

/// Of the imbalances on a rotor without supports, m.
double free_amplitude(const model::Rotor &rotor) {
    double moment = 0;
    for (const model::Balancer &b : rotor.balancers)
        moment += b.imbalance;
    for (const model::Imbalance &imbalance : rotor.imbalances)
        moment += std::abs(imbalance.mr);
    return moment / rotor_mass(rotor);
}

void fill_balancers(const model::Case &scene, SimulateResult &result) {
    const MotionSeries &series = result.series;
    const std::size_t tenth = index_from(series, 0.9 * series.time.back());
    const double window = series.time.back() - series.time[tenth];
    std::size_t angle = 0;
    for (std::size_t i = 0; i < scene.rotor.balancers.size(); ++i) {
        const model::Balancer &b = scene.rotor.balancers[i];
        BalancerMotion &out = result.balancers[i];
        out.z = b.z;
        out.name = b.name;
        const bool ball = b.kind == model::BalancerKind::ball;
        out.kind = ball ? "ball" : "pendulum4";
        if (ball && b.imbalance > 0)
            out.capacity = capacity(b);
        for (int j = 0; j < (ball ? b.n : 2); ++j, ++angle) {
            const std::vector<double> &own = series.angles[angle];
            out.angles.push_back(std::remainder(own.back(), 2 * pi));
            out.rates.push_back((own.back() - own[tenth]) / window);
            out.swing.push_back(swing_from(own, tenth));
        }
    }
}

} // namespace

std::string outcome_name(Outcome outcome) {
    switch (outcome) {
    case Outcome::balanced:
        return "balanced";
    case Outcome::offset:
        return "offset";
    case Outcome::lagging:
        return "lagging";
    default:
        return "whirling";
    }
}

void classify(const model::Case &scene, SimulateResult &result) {
    fill_balancers(scene, result);
    const MotionSeries &series = result.series;
    double amplitude = 0;
    double reference = 0;
    for (const BalancerMotion &b : result.balancers) {
        amplitude = std::max(amplitude, b.amplitude);
        reference = std::max(reference, b.reference);
    }
    const double scale = reference > 0 ? reference : free_amplitude(scene.rotor);
    const double ratio = scale > 0 ? amplitude / scale : HUGE_VAL;
    if (has_imbalance(scene.rotor) && reference > 0)
        result.residual_ratio = ratio;
    const std::size_t tenth = index_from(series, 0.9 * series.time.back());
    const std::size_t fortieth = index_from(series, 0.975 * series.time.back());
    double drift = 0;
    double swing = 0;
    for (const std::vector<double> &angles : series.angles) {
        drift = std::max(drift, std::abs(angles.back() - angles[tenth]));
        swing = std::max(swing, swing_from(angles, fortieth));
    }
    if (drift > drifting)
        result.outcome = Outcome::lagging;
    else if (swing > still_swing)
        result.outcome = Outcome::whirling;
    else
        result.outcome = ratio < balanced_ratio ? Outcome::balanced : Outcome::offset;
    result.evidence = fmt::format(
        "largest amplitude at a balancer {:.4g} m at the end, {:.4g} m without balls; fastest ball "
        "in the rotor {:.3g} rad/s on the mean of the last tenth, swing of the angles over the "
        "last fortieth {:.3g} rad",
        amplitude, reference, worst(result, &BalancerMotion::rates), swing);
}

} // namespace whirl::analyses
