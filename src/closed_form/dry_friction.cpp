#include "closed_form/dry_friction.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace whirl::closed_form {

namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

/// Rounding of angles at the ends of an arc.
constexpr double arc_rounding = 1e-14;

bool within(const Arc &arc, double angle) {
    return std::abs(std::remainder(angle - arc.centre, 2 * pi)) <= arc.half + arc_rounding;
}

/// Where |p - S|, S = e^(i b_1) + e^(i b_2), can be least or largest: both angles at ends of their
/// arcs; one of them inside and then along p - S; or both.
std::vector<std::pair<double, double>> candidates(Complex p, const Arc &first, const Arc &second) {
    std::vector<std::pair<double, double>> out;
    for (const double s : {-1.0, 1.0}) {
        const double one = first.centre + s * first.half;
        const double two = second.centre + s * second.half;
        for (const double t : {-1.0, 1.0})
            out.emplace_back(one, second.centre + t * second.half);
        for (const double turned : {0.0, pi}) {
            out.emplace_back(one, std::arg(p - std::polar(1.0, one)) + turned);
            out.emplace_back(std::arg(p - std::polar(1.0, two)) + turned, two);
        }
    }
    const double along = std::arg(p);
    for (const double a : {0.0, pi})
        for (const double b : {0.0, pi})
            out.emplace_back(along + a, along + b);
    if (std::abs(p) <= 2) // S = p
        for (const double s : {-1.0, 1.0}) {
            const double half = s * std::acos(std::abs(p) / 2);
            out.emplace_back(along + half, along - half);
        }
    return out;
}

/// The rest positions of a deflection r, in angles b from it: r sin(|b| - e) <= R sin e, tan e = f.
class RestOf {
  public:
    explicit RestOf(const DryBalls &balls)
        : _p(balls.K / (balls.mass * balls.radius)),
          _u(balls.imbalance / (balls.mass * balls.radius)), _radius(balls.radius),
          _angle(std::atan(balls.friction)) {}

    /// Up to it balls rest at any angle from the deflection, m.
    [[nodiscard]] double anywhere() const { return _radius * std::sin(_angle); }
    /// Two balls can stand so that this is the deflection.
    [[nodiscard]] bool possible(double r) const {
        if (r <= anywhere())
            return reached(r, {0, pi}, {0, pi});
        const double width = std::asin(anywhere() / r);
        const Arc ahead{0, width + _angle};
        const Arc behind{pi, std::max(width - _angle, 0.0)};
        return reached(r, ahead, ahead) || reached(r, ahead, behind) || reached(r, behind, behind);
    }

  private:
    Complex _p; ///< K/(m R), 1/m
    double _u;  ///< U/(m R)
    double _radius;
    double _angle; ///< of friction

    [[nodiscard]] bool reached(double r, const Arc &first, const Arc &second) const {
        const auto [least, largest] = distances(r * _p, first, second);
        return least <= _u && _u <= largest;
    }
};

/// Where a condition that holds at `in` ends on the way to `out`.
template <class Condition> double end_between(double in, double out, const Condition &holds) {
    for (int k = 0; k < 60; ++k) { // to the rounding
        const double middle = (in + out) / 2;
        (holds(middle) ? in : out) = middle;
    }
    return in;
}

/// The first end of a condition on the way from where it holds, or the end of the way.
template <class Condition> double first_end(double from, double to, const Condition &holds) {
    constexpr int steps = 4000;
    double in = from;
    for (int k = 1; k <= steps; ++k) {
        const double next = from + (to - from) * k / steps;
        if (!holds(next))
            return end_between(in, next, holds);
        in = next;
    }
    return to;
}

/// The first deflection that is not possible: rest positions beyond it do not hang together with
/// balance. In steps of a hundredth: what is left out between is no more than rest positions that
/// are apart by less, which the bound then includes.
/// @param anywhere  up to it balls rest at any angle
/// @param largest   up to it is looked
template <class Condition>
std::optional<double> first_impossible(double anywhere, double largest, const Condition &possible) {
    if (!possible(anywhere))
        return first_end(0, anywhere, possible);
    constexpr double step = 1.01;
    for (double r = anywhere; r <= largest; r *= step)
        if (!possible(step * r))
            return end_between(r, step * r, possible);
    return std::nullopt;
}

/// Least and largest |sum| of k unit vectors up to an angle a <= pi/2 ahead of a line and l <= k
/// as near to it behind. Of those ahead the sum is least with half of them at either end; of all it
/// is largest with those ahead at one end, those behind at the end across it.
std::pair<double, double> sums(int k, int l, double a) {
    const double one = k % 2 == 0 ? 0 : std::sin(a);
    const double least = std::hypot(k * std::cos(a), one) - l;
    return {k == l ? 0 : std::max(least, 0.0),
            std::hypot(k - l, 2 * std::sqrt(static_cast<double>(k) * l) * std::sin(a))};
}

} // namespace

std::pair<double, double> distances(Complex p, Arc first, Arc second) {
    double least = HUGE_VAL;
    double largest = 0;
    for (const auto &[one, two] : candidates(p, first, second)) {
        if (!within(first, one) || !within(second, two))
            continue;
        const double d = std::abs(p - std::polar(1.0, one) - std::polar(1.0, two));
        least = std::min(least, d);
        largest = std::max(largest, d);
    }
    return {least, largest};
}

std::optional<DryRest> dry_rest(const DryBalls &balls) {
    const double reach = 2 * balls.mass * balls.radius;
    if (balls.imbalance > reach)
        return std::nullopt;
    const RestOf rest(balls);
    const auto residual =
        first_impossible(rest.anywhere(), balls.radius, [&](double r) { return rest.possible(r); });
    if (!residual)
        return std::nullopt;
    DryRest out;
    out.residual = *residual;
    const auto mirrored = [&](double angle) {
        const Complex w = (balls.imbalance + reach * std::cos(angle)) / balls.K;
        return std::ranges::all_of(std::vector{angle, -angle}, [&](double a) {
            const Complex seen = w * std::polar(1.0, -a);
            return std::abs(seen.imag()) <= balls.friction * (balls.radius + seen.real());
        });
    };
    const double balanced = std::acos(-balls.imbalance / reach);
    out.from = first_end(balanced, 0, mirrored);
    out.to = first_end(balanced, pi, mirrored);
    return out;
}

std::optional<double> dry_bound(const DryBalls &balls) {
    const double one = balls.mass * balls.radius;
    const double u = balls.imbalance / one;
    if (u > balls.n)
        return std::nullopt;
    const double angle = std::atan(balls.friction);
    const double anywhere = balls.radius * std::sin(angle);
    // Balls that stand under a deflection r are within an angle of its line. Their sum is U, but
    // for what the deflection takes of it.
    return first_impossible(anywhere, balls.radius, [&](double r) {
        if (r <= anywhere)
            return true;
        const double a = std::min(angle + std::asin(anywhere / r), pi / 2);
        const double taken = r * std::abs(balls.K) / one;
        for (int k = (balls.n + 1) / 2; k <= balls.n; ++k) {
            const auto [least, largest] = sums(k, balls.n - k, a);
            if (least <= u + taken && u - taken <= largest)
                return true;
        }
        return false;
    });
}

} // namespace whirl::closed_form
