#include "stability/hill/pair_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace whirl::stability {

namespace {

using Complex = std::complex<double>;

/// Mean and squared half difference of two eigenvalues at a speed.
struct PairPoint {
    double speed = 0;
    Complex s, q;
    bool grows = false;
};

PairPoint pair_point(double speed, Complex a, Complex b) {
    return {speed, (a + b) / 2.0, (a - b) * (a - b) / 4.0};
}

/// Points of one pair are at most so many: the two ends of a step, and two beyond each.
constexpr std::size_t most_points = 6;

/// Through all points, Neville's scheme.
Complex interpolated(const std::vector<PairPoint> &points, Complex PairPoint::*what, double speed) {
    std::array<Complex, most_points> values;
    for (std::size_t i = 0; i < points.size(); ++i)
        values.at(i) = points[i].*what;
    for (std::size_t order = 1; order < points.size(); ++order)
        for (std::size_t i = 0; i + order < points.size(); ++i) {
            const double from = points[i].speed;
            const double to = points[i + order].speed;
            values[i] = ((to - speed) * values[i] + (speed - from) * values[i + 1]) / (to - from);
        }
    return values.front();
}

/// How far s + sqrt(q) can be off where s and q are.
double margin_of(double off_s, double off_q, double root) {
    return off_s + std::min(std::sqrt(off_q), off_q / std::max(2 * root, 1e-300));
}

/// A pair that is known at speeds beyond both ends of a step, too. Mean and squared half difference
/// by all of them, and without the first or the last one, which shows how far they can be trusted.
class Neighbourhood {
  public:
    explicit Neighbourhood(const Coalescence &m) : _low(m.from), _high(m.to) {
        _points = {pair_point(m.from, m.first_from, m.second_from),
                   pair_point(m.to, m.first_to, m.second_to)};
        for (const PairValues &at : m.beyond)
            _points.push_back(pair_point(at.speed, at.first, at.second));
        std::ranges::sort(_points, {}, &PairPoint::speed);
        _without_first.assign(_points.begin() + 1, _points.end());
        _without_last.assign(_points.begin(), _points.end() - 1);
    }

    /// Nowhere in the step can the two grow.
    [[nodiscard]] bool decays() const {
        // Points of a cubic: without one of them it is judged by what is left.
        constexpr std::size_t enough = 4;
        if (_points.size() < enough || _points.front().speed >= _low ||
            _points.back().speed <= _high)
            return false;
        constexpr int steps = 100; // of the step of speeds, then of the two around the best
        // Times a step to either side of the best one: each a factor of 50.
        constexpr int closer = 4;
        double low = _low;
        double high = _high;
        for (int k = 0; k <= closer; ++k) { // about where q comes nearest to a positive number
            const double step = (high - low) / steps;
            double most = -HUGE_VAL;
            double best = low;
            for (int i = 0; i <= steps; ++i) {
                const double speed = low + i * step;
                const double q = judged(speed);
                if (std::isnan(q))
                    return false;
                if (q > most) {
                    most = q;
                    best = speed;
                }
            }
            low = std::max(_low, best - step);
            high = std::min(_high, best + step);
        }
        return true;
    }

  private:
    double _low, _high;
    std::vector<PairPoint> _points, _without_first, _without_last;

    [[nodiscard]] double apart(Complex PairPoint::*what, double speed, Complex all) const {
        return std::max(std::abs(interpolated(_without_first, what, speed) - all),
                        std::abs(interpolated(_without_last, what, speed) - all));
    }

    /// @returns Re q; not a number where the two may grow
    [[nodiscard]] double judged(double speed) const {
        const Complex s = interpolated(_points, &PairPoint::s, speed);
        const Complex q = interpolated(_points, &PairPoint::q, speed);
        const double root = std::abs(std::sqrt(q).real());
        const double margin =
            margin_of(apart(&PairPoint::s, speed, s), apart(&PairPoint::q, speed, q), root);
        constexpr double reserve = 2; // times the difference that leaving a point out makes
        return s.real() + root + reserve * margin < 0 ? q.real() : std::nan("");
    }
};

/// Where a pair grows most, or comes nearest to it, and how much.
struct Guess {
    double speed = 0;
    double growth = 0; ///< 1/s
};

/// The speed between `low` and `high` where the interpolated pair grows most; where it does not,
/// where it comes nearest to it (q nearest to a positive number).
Guess best_guess(const std::vector<PairPoint> &points, double low, double high) {
    Guess best{(low + high) / 2, 0};
    std::pair<double, double> best_score{-HUGE_VAL, -HUGE_VAL};
    constexpr int steps = 400; // cubics have no two tops within one
    for (int i = 1; i < steps; ++i) {
        const double speed = low + (high - low) * i / steps;
        const Complex q = interpolated(points, &PairPoint::q, speed);
        const double growth =
            interpolated(points, &PairPoint::s, speed).real() + std::abs(std::sqrt(q).real());
        const std::pair<double, double> score{std::max(growth, 0.0), q.real()};
        if (score > best_score) {
            best_score = score;
            best = {speed, growth};
        }
    }
    return best;
}

class CoalescenceSearch {
  public:
    CoalescenceSearch(const MotionsAt &at, const Coalescence &m)
        : _at(at), _m(m), _points{pair_point(m.from, m.first_from, m.second_from),
                                  pair_point(m.to, m.first_to, m.second_to)},
          _size(std::sqrt(std::max(std::abs(_points[0].q), std::abs(_points[1].q)))) {}

    CoalescenceVerdict verdict() {
        using Kind = CoalescenceVerdict::Kind;
        double low = _m.from;
        double high = _m.to;
        double speed = first_guess();
        // A prediction that holds is confirmed in three; more means that none does.
        constexpr int most_steps = 12;
        // Predictions that hold one after the other: one may by chance.
        constexpr int agreeing_predictions = 3;
        int said_stable = 0;
        for (int step = 0; step < most_steps; ++step) {
            const PairPoint found = nearest(_at(speed), speed);
            if (found.grows)
                return {Kind::grows, speed};
            const Complex s = interpolated(_points, &PairPoint::s, speed);
            const Complex q = expected_q(found.q, speed);
            const double off_s = std::abs(found.s - s);
            const double off_q = std::abs(found.q - q);
            if (off_s > 0.3 * _size || off_q > 0.3 * _size * _size)
                return {Kind::unsure, speed};
            std::vector<PairPoint> three{found, _points[0], _points[1]};
            // The next guess lies within a bracket that shrinks about the best place so far.
            const Guess guess = best_guess(three, low, high);
            const double root = std::abs(std::sqrt(found.q).real());
            const double margin = margin_of(off_s, off_q, root);
            const double moved = std::abs(guess.speed - speed);
            // Three points alone do not decide: the speed at which they place the largest growth
            // must confirm them.
            said_stable = guess.growth < -2 * margin ? said_stable + 1 : 0;
            if (said_stable == agreeing_predictions || moved < 1e-9 * std::abs(_m.to) ||
                moved < 1e-7 * (_m.to - _m.from))
                return {Kind::stable, speed};
            // Keep the two points nearest to the guess.
            std::ranges::sort(three, {},
                              [&](const PairPoint &x) { return std::abs(x.speed - guess.speed); });
            _points = {three[0], three[1]};
            _crossing = false;
            const double reach = 4 * moved;
            low = std::max(low, guess.speed - reach);
            high = std::min(high, guess.speed + reach);
            speed = guess.speed;
        }
        return {Kind::unsure, speed};
    }

  private:
    const MotionsAt &_at;
    const Coalescence &_m;
    std::vector<PairPoint> _points;
    double _size;
    bool _crossing = false; ///< the difference itself is interpolated: q has its zero in between

    double first_guess() {
        const double before = (_m.first_from - _m.second_from).imag();
        const double after = (_m.first_to - _m.second_to).imag();
        _crossing = _m.ordered && (before > 0) != (after > 0);
        if (!_m.ordered)
            return best_guess(_points, _m.from, _m.to).speed;
        const double sum = std::abs(before) + std::abs(after);
        const double share = sum > 0 ? std::abs(before) / sum : 0.5;
        return _m.from + std::clamp(share, 0.02, 0.98) * (_m.to - _m.from);
    }

    /// Of the two expected values the one nearer to what was found.
    [[nodiscard]] Complex expected_q(Complex found, double speed) const {
        const Complex q = interpolated(_points, &PairPoint::q, speed);
        if (!_crossing)
            return q;
        const double share = (speed - _m.from) / (_m.to - _m.from);
        const Complex half = ((_m.first_from - _m.second_from) * (1 - share) +
                              (_m.first_to - _m.second_to) * share) /
                             2.0;
        return std::abs(half * half - found) < std::abs(q - found) ? half * half : q;
    }

    /// The pair of motions that is most like the expected one.
    [[nodiscard]] PairPoint nearest(const std::vector<Motion> &motions, double speed) const {
        const Complex s = interpolated(_points, &PairPoint::s, speed);
        PairPoint best;
        double least = HUGE_VAL;
        for (const Motion &a : motions)
            for (const Motion &b : motions) {
                if (&a == &b)
                    continue;
                // Aliases as far apart as at the ends; both may be at another alias together.
                const Complex shift(0, _m.aliases * a.repeats);
                PairPoint point = pair_point(speed, a.value, b.value + shift);
                if (a.repeats > 0)
                    point.s = s + Complex((point.s - s).real(),
                                          std::remainder((point.s - s).imag(), a.repeats));
                const double off = std::abs(point.s - s) +
                                   std::sqrt(std::abs(point.q - expected_q(point.q, speed)));
                if (off < least) {
                    least = off;
                    best = point;
                    best.grows = a.grows() || b.grows();
                }
            }
        return best;
    }
};

/// Two motions of opposite actions, which identify them at every speed: they open a band where the
/// difference of their frequencies passes zero, and nowhere else.
class PassingSearch {
  public:
    PassingSearch(const MotionsAt &at, const Coalescence &m)
        : _at(at),
          _m(m), _low{m.from, m.first_from, m.second_from}, _high{m.to, m.first_to, m.second_to},
          _size(std::max(std::abs(_low.apart()), std::abs(_high.apart()))) {}

    CoalescenceVerdict verdict() {
        return _low.apart() * _high.apart() < 0 ? where_they_pass() : in_the_middle();
    }

  private:
    using Kind = CoalescenceVerdict::Kind;
    struct Place {
        double speed = 0;
        Complex first, second;
        double noise = 0;
        bool grows = false;

        [[nodiscard]] double apart() const { return (first - second).imag(); }
    };
    const MotionsAt &_at;
    const Coalescence &_m;
    Place _low, _high; ///< the narrowest so far
    double _size;

    /// By the sign of the difference: each speed leaves a smaller bracket, until one of them grows
    /// or rounding hides the difference, and with it any band that may be there.
    CoalescenceVerdict where_they_pass() {
        const double sign = _low.apart() < 0 ? 1 : -1;
        SignBracket bracket(_m.from, _m.to);
        bracket.stable_at(_m.from, sign * _low.apart());
        bracket.unstable_at(_m.to, sign * _high.apart());
        constexpr int most_steps = 60; // bisection alone reaches rounding in 53
        for (int step = 0; step < most_steps; ++step) {
            const double speed = bracket.next();
            const std::optional<Place> now = probe(speed);
            if (!now)
                break;
            if (now->grows)
                return {Kind::grows, speed};
            if (std::abs(now->apart()) <= now->noise)
                return {Kind::stable, speed};
            const double past = sign * now->apart();
            if (past < 0)
                bracket.stable_at(speed, past);
            else
                bracket.unstable_at(speed, past);
            (past < 0 ? _low : _high) = *now;
        }
        return {Kind::unsure, (_low.speed + _high.speed) / 2};
    }

    /// They come no nearer to each other than at the ends, nor would a parabola.
    CoalescenceVerdict in_the_middle() {
        const double speed = (_low.speed + _high.speed) / 2;
        const std::optional<Place> now = probe(speed);
        if (!now)
            return {Kind::unsure, speed};
        if (now->grows)
            return {Kind::grows, speed};
        const double before = now->apart() - _low.apart();
        const double after = _high.apart() - now->apart();
        const bool monotonic = before * after > 0 && std::abs(after) < 3 * std::abs(before) &&
                               std::abs(before) < 3 * std::abs(after);
        return {monotonic ? Kind::stable : Kind::unsure, speed};
    }

    /// Nothing where the motions differ from what the ends predict.
    [[nodiscard]] std::optional<Place> probe(double speed) const {
        const double share = (speed - _low.speed) / (_high.speed - _low.speed);
        const Complex first = _low.first + share * (_high.first - _low.first);
        const Complex second = _low.second + share * (_high.second - _low.second);
        const std::vector<Motion> motions = _at(speed);
        const Motion *one = nearest(motions, first, _m.action);
        const Motion *other = nearest(motions, second, -_m.action);
        if (one == nullptr || other == nullptr)
            return std::nullopt;
        const Place out{speed, nearest_alias(first, *one), nearest_alias(second, *other),
                        one->noise + other->noise, !one->neutral() || !other->neutral()};
        const double off = std::max(std::abs(out.first - first), std::abs(out.second - second));
        return out.grows || off <= 0.3 * _size ? std::optional(out) : std::nullopt;
    }
    /// Of this action, or of none that is known: where they have met.
    [[nodiscard]] static const Motion *nearest(const std::vector<Motion> &motions, Complex expected,
                                               int action) {
        const Motion *best = nullptr;
        double least = HUGE_VAL;
        for (const Motion &motion : motions) {
            const double off = std::abs(nearest_alias(expected, motion) - expected);
            if (motion.action * action >= 0 && off < least) {
                least = off;
                best = &motion;
            }
        }
        return best;
    }
};

} // namespace

CoalescenceVerdict examine(const MotionsAt &at, const Coalescence &coalescence) {
    if (coalescence.action != 0)
        return PassingSearch(at, coalescence).verdict();
    if (Neighbourhood(coalescence).decays())
        return {CoalescenceVerdict::Kind::stable, (coalescence.from + coalescence.to) / 2};
    return CoalescenceSearch(at, coalescence).verdict();
}

} // namespace whirl::stability
