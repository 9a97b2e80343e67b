#include "stability/pair_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

/// Through three points at most, Newton's form.
Complex interpolated(const std::vector<PairPoint> &points, Complex PairPoint::*what, double speed) {
    const PairPoint &a = points[0];
    const PairPoint &b = points[1];
    const Complex ab = (b.*what - a.*what) / (b.speed - a.speed);
    Complex value = a.*what + ab * (speed - a.speed);
    if (points.size() > 2) {
        const PairPoint &c = points[2];
        const Complex bc = (c.*what - b.*what) / (c.speed - b.speed);
        value += (bc - ab) / (c.speed - a.speed) * (speed - a.speed) * (speed - b.speed);
    }
    return value;
}

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
    constexpr int steps = 400;
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
        constexpr int most_steps = 12;
        constexpr int looks_that_agree = 3;
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
            const double margin =
                off_s + std::min(std::sqrt(off_q), off_q / std::max(2 * root, 1e-300));
            const double moved = std::abs(guess.speed - speed);
            // What three points say of the whole is not enough: another look where they place the
            // most growth must agree with them.
            said_stable = guess.growth < -2 * margin ? said_stable + 1 : 0;
            if (said_stable == looks_that_agree || moved < 1e-9 * std::abs(_m.to) ||
                moved < 1e-7 * (_m.to - _m.from))
                return {Kind::stable, speed};
            // Keep the two points nearest to the guess.
            std::sort(three.begin(), three.end(), [&](const PairPoint &x, const PairPoint &y) {
                return std::abs(x.speed - guess.speed) < std::abs(y.speed - guess.speed);
            });
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

    /// Of what the points lead one to expect the nearer to what was found.
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
        const auto grows = [](const Motion &motion) { return motion.value.real() > motion.noise; };
        for (const Motion &a : motions)
            for (const Motion &b : motions) {
                if (&a == &b)
                    continue;
                // Copies as far apart as at the ends; both may be at another copy together.
                const Complex shift(0, _m.copies * a.repeats);
                PairPoint point = pair_point(speed, a.value, b.value + shift);
                if (a.repeats > 0)
                    point.s = s + Complex((point.s - s).real(),
                                          std::remainder((point.s - s).imag(), a.repeats));
                const double off = std::abs(point.s - s) +
                                   std::sqrt(std::abs(point.q - expected_q(point.q, speed)));
                if (off < least) {
                    least = off;
                    best = point;
                    best.grows = grows(a) || grows(b);
                }
            }
        return best;
    }
};

} // namespace

CoalescenceVerdict examine(const MotionsAt &at, const Coalescence &coalescence) {
    return CoalescenceSearch(at, coalescence).verdict();
}

} // namespace whirl::stability
