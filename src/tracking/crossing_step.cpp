#include "tracking/crossing_step.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl::tracking {

namespace {

/// Cubic on [0, 1] by values and slopes at its ends (Hermite).
struct Cubic {
    double d0, d1, d2, d3;

    Cubic(double a, double slope_a, double b, double slope_b)
        : d0(a), d1(slope_a), d2(3 * (b - a) - 2 * slope_a - slope_b),
          d3(2 * (a - b) + slope_a + slope_b) {}

    [[nodiscard]] double operator()(double t) const { return d0 + t * (d1 + t * (d2 + t * d3)); }
};

/// Root between two arguments at which the cubic has different signs.
double root(const Cubic &cubic, double from, double to) {
    const bool rising = cubic(to) > 0;
    for (int i = 0; i < 60; ++i) {
        const double middle = (from + to) / 2;
        ((cubic(middle) > 0) == rising ? to : from) = middle;
    }
    return (from + to) / 2;
}

/// Where a cubic that is of this sign at both ends comes nearest to zero inside, if it turns.
std::optional<double> nearest(const Cubic &cubic, double sign) {
    std::optional<double> best;
    // d1 + 2 d2 t + 3 d3 t^2 = 0, the roots without cancellation.
    const double discriminant = cubic.d2 * cubic.d2 - 3 * cubic.d3 * cubic.d1;
    if (discriminant < 0)
        return best;
    const double q = -(cubic.d2 + std::copysign(std::sqrt(discriminant), cubic.d2));
    for (const double t : {q / (3 * cubic.d3), cubic.d1 / q})
        if (t > 0 && t < 1 && (!best || sign * cubic(t) < sign * cubic(*best)))
            best = t;
    return best;
}

int sign_of(double value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

/// Sign just inside the step: that of the distance, or at a root that of where it goes.
int sign_inside(const StepEnd &end, double inwards) {
    if (std::abs(end.distance) > end.tolerance)
        return sign_of(end.distance);
    return std::isfinite(end.slope) ? sign_of(end.slope * inwards) : 0;
}

/// The frequency of the motion that lies next to another one.
struct Alias {
    double frequency = 0; ///< rad/s
    StepEnd end;
};
Alias alias_next_to(double other, const StepEnd &end, double multiple) {
    const double speed = std::abs(end.speed);
    const double direction = std::signbit(end.speed) ? -1 : 1;
    const double own = end.distance + multiple * speed;
    Alias best{std::numeric_limits<double>::infinity(), end};
    for (const double sign : {1.0, -1.0}) {
        const double turns = 2 * std::round((other - sign * own) / (2 * speed));
        const double frequency = sign * own + turns * speed;
        if (!(std::abs(frequency - other) < std::abs(best.frequency - other)))
            continue;
        best.frequency = frequency;
        best.end.distance = frequency - multiple * speed;
        best.end.slope = sign * end.slope + direction * (turns + (sign - 1) * multiple);
    }
    return best;
}

} // namespace

bool jumps_past(const StepEnd &a, const StepEnd &b, double multiple) {
    // Of the jump: within a step a frequency changes far less.
    constexpr double far_less = 0.1;
    const double before = a.distance + multiple * std::abs(a.speed);
    const double after = b.distance + multiple * std::abs(b.speed);
    const double jump = std::abs(after - before);
    const Alias b_before = alias_next_to(before, b, multiple);
    const Alias a_after = alias_next_to(after, a, multiple);
    // Next to the multiple aliases on both sides of it lie close to each other: slopes tell a jump
    // from a crossing, without them the distance.
    const bool slopes = std::isfinite(a.slope) && std::isfinite(b.slope);
    const auto stays_off = [&](const StepEnd &from, const StepEnd &to) {
        return slopes ? !next_probe(from, to, 0)
                      : std::min(std::abs(from.distance), std::abs(to.distance)) >
                            most_change(b.speed - a.speed, multiple);
    };
    return std::abs(b_before.frequency - before) < far_less * jump &&
           std::abs(a_after.frequency - after) < far_less * jump && stays_off(a, b_before.end) &&
           stays_off(a_after.end, b);
}

std::optional<double> next_probe(const StepEnd &a, const StepEnd &b, int depth) {
    const double h = b.speed - a.speed;
    const double secant = b.distance - a.distance;
    const double slope_a = std::isfinite(a.slope) ? a.slope * h : secant;
    const double slope_b = std::isfinite(b.slope) ? b.slope * h : secant;
    const Cubic cubic(a.distance, slope_a, b.distance, slope_b);
    const int from = sign_inside(a, 1);
    const int to = sign_inside(b, -1);
    const auto at = [&](double t) { return a.speed + std::clamp(t, 1e-3, 1 - 1e-3) * h; };
    const bool root_at_end =
        std::abs(a.distance) <= a.tolerance || std::abs(b.distance) <= b.tolerance;
    if (from * to < 0) {
        if (root_at_end) // and another one inside
            return at(0.5);
        const double t = root(cubic, 0, 1);
        return a.speed + std::clamp(t, 1e-14, 1 - 1e-14) * h;
    }
    const int sign = from != 0 ? from : to;
    if (sign == 0)
        return std::nullopt;
    const double low = std::min(sign * a.distance, sign * b.distance);
    const std::optional<double> turn = nearest(cubic, sign);
    if (turn && sign * cubic(*turn) < (root_at_end ? 0 : 0.3 * low))
        return at(*turn);
    // A line that bends within the step, within reach of zero: its cubic is no bound.
    const double steepest = std::max({std::abs(slope_a), std::abs(slope_b), std::abs(secant)});
    const double bend = std::max(std::abs(slope_a - secant), std::abs(slope_b - secant));
    if (depth < 5 && !root_at_end && bend > 0.25 * steepest && low < steepest)
        return at(0.5);
    return std::nullopt;
}

} // namespace whirl::tracking
