#include "simulation/held_motion.h"

#include "balancers/kind.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace whirl::simulation {

namespace {

/// Share by which the halves of a settled motion may differ, and two motions that are one.
constexpr double alike = 0.02;
/// Of the size of deflections: as much as balls leave that still creep into balance.
constexpr double none_left = 0.01;
constexpr double resting = 0.02; ///< rad: by less a part that stands still moves in a half
constexpr double swinging = 0.1; ///< rad: swing of a part that stands still
/// Of a part that slows down: what is still before it, rad, by the moves of two halves.
constexpr double before_it = 0.05;
constexpr double stands = 1e-4; ///< rad in a half: over the times of motions less than before_it
/// Share of the larger amplitude by which a jump, and a motion that depends on the way, differ.
constexpr double apart = 0.1;
constexpr double nothing = 1e-3; ///< of the largest amplitude of a sweep: as good as balanced

bool agree(double a, double b, double size) {
    return std::abs(a - b) <= alike * std::max(std::abs(a), std::abs(b)) + size;
}

/// A piece of the time series, whose first sample is a step behind the start.
struct Window {
    const results::MotionSeries &series;
    std::size_t first, last;

    [[nodiscard]] Window half(bool second) const {
        const std::size_t middle = (first + last) / 2;
        return second ? Window{series, middle, last} : Window{series, first, middle};
    }
    [[nodiscard]] std::span<const double> of(const std::vector<double> &values) const {
        return {values.data() + first, last - first + 1};
    }
    [[nodiscard]] double largest(std::size_t row) const {
        return *std::ranges::max_element(of(series.amplitude[row]).subspan(1));
    }
    [[nodiscard]] double rms(std::size_t row) const {
        const std::span<const double> x = of(series.x[row]);
        const std::span<const double> y = of(series.y[row]);
        double sum = 0;
        for (std::size_t k = 0; k < x.size(); ++k)
            sum += x[k] * x[k] + y[k] * y[k];
        return std::sqrt(sum / static_cast<double>(x.size()));
    }
    [[nodiscard]] double moved(const std::vector<double> &angles) const {
        return angles[last] - angles[first];
    }
    [[nodiscard]] double rate(const std::vector<double> &angles) const {
        return moved(angles) / (series.time[last] - series.time[first]);
    }
};

Window window_of(const results::MotionSeries &series, double from, double until) {
    const auto index = [&series](double time) {
        const auto at = std::ranges::lower_bound(series.time, time);
        return std::min(static_cast<std::size_t>(at - series.time.begin()), series.time.size() - 1);
    };
    const auto past = std::ranges::upper_bound(series.time, until);
    const auto last = static_cast<std::size_t>(past - series.time.begin()) - 1;
    return {series, std::min(index(from), last - 2), last};
}

bool rests(const Window &w, const std::vector<double> &angles) {
    const auto [low, high] = std::ranges::minmax_element(w.of(angles));
    return *high - *low < swinging && std::abs(w.half(true).moved(angles)) < resting;
}

/// A part that all but stands still may creep for long: each half of the window it moves by the
/// same share of the half before, and all that is to come is the sum of these moves.
bool creeps(const Window &w, const std::vector<double> &angles) {
    const double first = w.half(false).moved(angles);
    const double second = w.half(true).moved(angles);
    if (std::abs(second) < stands || first * second < 0)
        return false;
    return std::abs(second) >= std::abs(first) ||
           second * second / std::abs(first - second) > before_it;
}

bool settled(const Window &w, double size) {
    const Window first = w.half(false);
    const Window second = w.half(true);
    for (std::size_t i = 0; i < w.series.amplitude.size(); ++i)
        if (!agree(first.largest(i), second.largest(i), size) ||
            !agree(first.rms(i), second.rms(i), size))
            return false;
    return std::ranges::all_of(w.series.angles, [&](const std::vector<double> &angles) {
        if (rests(w, angles) && creeps(w, angles))
            return false;
        const double still_rate = resting / (w.series.time[w.last] - w.series.time[w.first]);
        return agree(first.rate(angles), second.rate(angles), still_rate);
    });
}

/// One of two amplitudes is another one.
/// @param least  by less both are balanced, m
bool other_amplitude(const results::HeldMotion &a, const results::HeldMotion &b, double least) {
    const double larger = std::max(a.largest(), b.largest());
    return larger > least && std::abs(a.largest() - b.largest()) > apart * larger;
}

} // namespace

results::HeldMotion motion_between(const model::Rotor &rotor, const results::MotionSeries &series,
                                   double from, double until, double size) {
    const Window w = window_of(series, from, until);
    results::HeldMotion out;
    out.speed = series.speed[w.last];
    const std::size_t planes = rotor.balancers.size();
    for (std::size_t i = 0; i < series.amplitude.size(); ++i) {
        (i < planes ? out.planes : out.amplitude).push_back(w.largest(i));
        if (i >= planes)
            out.rms.push_back(w.rms(i));
    }
    std::size_t next = 0;
    for (const model::Balancer &b : rotor.balancers) {
        out.angles.emplace_back();
        out.rates.emplace_back();
        for (std::size_t j = 0; j < balancers::kind_of(b)->coordinates().size(); ++j, ++next) {
            out.angles.back().push_back(
                std::remainder(series.angles[next][w.last], 2 * std::numbers::pi));
            out.rates.back().push_back(w.rate(series.angles[next]));
        }
    }
    out.at_rest = std::ranges::all_of(
        series.angles, [&w](const std::vector<double> &angles) { return rests(w, angles); });
    out.settled = settled(w, none_left * size);
    return out;
}

void find_jumps(results::HeldSweep &sweep) {
    const std::vector<results::HeldMotion> &all = sweep.motions;
    const auto branch_of = [&sweep](const results::HeldMotion &motion) {
        return motion.state ? std::optional(sweep.states->states[*motion.state].branch)
                            : std::nullopt;
    };
    double most = 0;
    for (const results::HeldMotion &motion : all)
        most = std::max(most, motion.largest());
    const double least = std::max(nothing * most, none_left * sweep.size);
    for (std::size_t k = 1; k < all.size(); ++k) {
        const results::HeldMotion &a = all[k - 1];
        const results::HeldMotion &b = all[k];
        const bool other = a.at_rest != b.at_rest || branch_of(a) != branch_of(b);
        if (other && other_amplitude(a, b, least))
            sweep.jumps.push_back({b.up, a.speed, b.speed, a.largest(), b.largest()});
    }
    bool open = false; // the speed above belongs to the last interval
    for (const results::HeldMotion &up : all) {
        const auto down = std::ranges::find_if(
            all, [&up](const auto &m) { return !m.up && m.speed == up.speed; });
        if (!up.up || down == all.end())
            continue;
        // What moves without end may not repeat itself within a window; what rests has to last.
        const bool last = up.at_rest == down->at_rest ? up.settled && down->settled
                          : up.at_rest                ? up.settled
                                                      : down->settled;
        const bool here = last && other_amplitude(up, *down, least);
        if (here && open)
            sweep.hysteresis.back().second = up.speed;
        else if (here)
            sweep.hysteresis.emplace_back(up.speed, up.speed);
        open = here;
    }
}

} // namespace whirl::simulation
