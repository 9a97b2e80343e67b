#include "analyses/unstable_bands.h"

#include "analyses/meetings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

namespace whirl::analyses {

namespace {

using Complex = std::complex<double>;

/// Mean and squared half difference of two eigenvalues at a speed.
struct PairPoint {
    double speed = 0;
    Complex s, q;
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

/// The speed between `low` and `high` where the interpolated pair grows most; where it does not,
/// where it comes nearest to it (q nearest to a positive number).
double best_guess(const std::vector<PairPoint> &points, double low, double high) {
    double best = (low + high) / 2;
    std::pair<double, double> best_score{-1e300, -1e300};
    constexpr int steps = 400;
    for (int i = 1; i < steps; ++i) {
        const double speed = low + (high - low) * i / steps;
        const Complex q = interpolated(points, &PairPoint::q, speed);
        const double growth =
            interpolated(points, &PairPoint::s, speed).real() + std::abs(std::sqrt(q).real());
        const std::pair<double, double> score{growth > 0 ? growth : 0.0, q.real()};
        if (score > best_score) {
            best_score = score;
            best = speed;
        }
    }
    return best;
}

/// The two motions nearest to a value.
std::pair<Complex, Complex> nearest_two(const std::vector<Motion> &motions, Complex value) {
    std::vector<Complex> values;
    for (const Motion &motion : motions)
        values.push_back(motion.value);
    std::partial_sort(
        values.begin(), values.begin() + std::min<std::ptrdiff_t>(2, std::ssize(values)),
        values.end(),
        [&](Complex a, Complex b) { return std::abs(a - value) < std::abs(b - value); });
    return {values[0], values.size() > 1 ? values[1] : values[0]};
}

/// A speed at which the meeting is unstable, if there is one.
std::optional<double> unstable_meeting(const MotionsAt &at, const Meeting &m) {
    std::vector<PairPoint> points{pair_point(m.from, m.first_from, m.second_from),
                                  pair_point(m.to, m.first_to, m.second_to)};
    const double before = std::abs((m.first_from - m.second_from).imag());
    const double after = std::abs((m.first_to - m.second_to).imag());
    double share = before + after > 0 ? before / (before + after) : 0.5;
    share = std::clamp(share, 0.02, 0.98);
    double speed = m.from + share * (m.to - m.from);
    double low = m.from;
    double high = m.to;
    for (int step = 0; step < 6; ++step) {
        const std::vector<Motion> motions = at(speed);
        if (growth_of(motions) > 0)
            return speed;
        const auto [a, b] = nearest_two(motions, interpolated(points, &PairPoint::s, speed));
        const PairPoint middle = pair_point(speed, a, b);
        std::vector<PairPoint> three{middle, points[0], points[1]};
        // The next guess lies within a bracket that shrinks about the best place so far.
        const double guess = best_guess(three, low, high);
        if (std::abs(guess - speed) < 1e-9 * std::abs(m.to) ||
            std::abs(guess - speed) < 1e-7 * (m.to - m.from))
            break;
        // Keep the two points nearest to the guess.
        std::sort(three.begin(), three.end(), [&](const PairPoint &x, const PairPoint &y) {
            return std::abs(x.speed - guess) < std::abs(y.speed - guess);
        });
        points = {three[0], three[1]};
        const double reach = 4 * std::abs(guess - speed);
        low = std::max(low, guess - reach);
        high = std::min(high, guess + reach);
        speed = guess;
    }
    return std::nullopt;
}

/// Real part along the motion that is unstable at one end of a bracket.
class GrowthAlong {
  public:
    GrowthAlong(const MotionsAt &at, double unstable) : _at(at) {
        const std::vector<Motion> motions = at(unstable);
        _reference = *std::max_element(motions.begin(), motions.end(), by_growth);
    }

    /// Of the motions most like the one followed, the one that grows most.
    Motion operator()(double speed) const {
        const std::vector<Motion> motions = _at(speed);
        std::vector<double> likeness;
        for (const Motion &motion : motions)
            likeness.push_back(std::abs(_reference.state.dot(motion.state)));
        const double most = *std::max_element(likeness.begin(), likeness.end());
        const Motion *best = nullptr;
        for (std::size_t i = 0; i < motions.size(); ++i)
            if (likeness[i] > 0.7 * most && (best == nullptr || by_growth(*best, motions[i])))
                best = &motions[i];
        return *best;
    }
    void move_to(const Motion &motion) { _reference = motion; }

    static bool by_growth(const Motion &a, const Motion &b) {
        return a.value.real() < b.value.real();
    }

  private:
    const MotionsAt &_at;
    Motion _reference;
};

/// The end of instability between a stable and an unstable speed. Where the growth passes through
/// zero it is a root; where two eigenvalues part along the imaginary axis the growth starts like a
/// square root, and the speed at which it leaves the noise is the end to far less than 1e-10.
double band_end(const MotionsAt &at, double stable, double unstable) {
    GrowthAlong along(at, unstable);
    const double tolerance = 1e-12 * std::max(std::abs(stable), std::abs(unstable));
    double f_stable = 0; // 0: not known
    double f_unstable = 0;
    for (int step = 0; step < 200 && std::abs(unstable - stable) > tolerance; ++step) {
        double next = (stable + unstable) / 2;
        // A secant between two signs, kept off the ends; every third step halves the bracket.
        if (f_stable < 0 && f_unstable > 0 && step % 3 != 0)
            next = std::clamp((stable * f_unstable - unstable * f_stable) / (f_unstable - f_stable),
                              std::min(stable, unstable) + 1e-3 * std::abs(unstable - stable),
                              std::max(stable, unstable) - 1e-3 * std::abs(unstable - stable));
        const Motion motion = along(next);
        const double growth = motion.value.real();
        const bool decays = growth < -motion.noise;
        // Within the noise: unstable where the other side decays (a root), else not.
        const bool grows = f_stable < 0 ? growth > 0 : growth > motion.noise;
        if (grows) {
            unstable = next;
            f_unstable = growth;
            along.move_to(motion);
        } else {
            stable = next;
            f_stable = decays || f_stable < 0 ? std::min(growth, -1e-300) : 0;
        }
    }
    return (stable + unstable) / 2;
}

/// Growth at speeds looked at, ascending: above zero unstable, below stable, zero not decided.
using Known = std::map<double, double>;

/// Walks from an unstable speed towards one border, with steps that grow, until it is stable.
double end_towards(const MotionsAt &at, const Known &known, double unstable, double step,
                   double border) {
    const double sign = border > unstable ? 1 : -1;
    while (true) {
        double probe = unstable + sign * step;
        if (sign * (probe - border) >= 0)
            probe = border;
        // Do not step over a grid speed: it is known.
        const auto above = known.upper_bound(unstable);
        if (sign > 0 && above != known.end() && above->first <= probe)
            probe = above->first;
        const auto below = known.lower_bound(unstable);
        if (sign < 0 && below != known.begin() && std::prev(below)->first >= probe)
            probe = std::prev(below)->first;
        const auto grid = known.find(probe);
        const bool grows = (grid != known.end() ? grid->second : growth_of(at(probe))) > 0;
        if (!grows)
            return band_end(at, probe, unstable);
        if (probe == border)
            return border;
        unstable = probe;
        step *= 2;
    }
}

/// Place and value of the least of a function between two places, by golden section; `done` sees
/// the ends of the bracket and the least value so far.
template <class Function, class Done>
std::pair<double, double> least_by_golden_section(Function &&f, double low, double high,
                                                  Done &&done) {
    const double ratio = (std::sqrt(5.0) - 1) / 2;
    double c = high - ratio * (high - low);
    double d = low + ratio * (high - low);
    double at_c = f(c);
    double at_d = f(d);
    while (!done(low, high, std::min(at_c, at_d))) {
        if (at_c < at_d) {
            high = d;
            d = c;
            at_d = at_c;
            c = high - ratio * (high - low);
            at_c = f(c);
        } else {
            low = c;
            c = d;
            at_c = at_d;
            d = low + ratio * (high - low);
            at_d = f(d);
        }
    }
    return at_c <= at_d ? std::pair(c, at_c) : std::pair(d, at_d);
}

/// Between two unstable speeds at which different motions grow there can be a stable window: the
/// speed of least growth, where that is none.
std::optional<double> stable_between(const MotionsAt &at, double low, const std::vector<Motion> &a,
                                     double high, const std::vector<Motion> &b) {
    const auto most = [](const std::vector<Motion> &motions) {
        return std::max_element(motions.begin(), motions.end(), GrowthAlong::by_growth);
    };
    constexpr double same_motion = 0.8;
    if (std::abs(most(a)->state.dot(most(b)->state)) > same_motion)
        return std::nullopt;
    // Growth falls from one side and rises to the other.
    int steps = 0;
    const auto [speed, growth] = least_by_golden_section(
        [&at](double x) { return growth_of(at(x)); }, low, high,
        [&steps](double, double, double least) { return least <= 0 || ++steps > 20; });
    return growth <= 0 ? std::optional(speed) : std::nullopt;
}

/// Growth can sink below the noise like a power of the speed (balls at a heavy spot near rest): the
/// place where that happens is no end. Beyond an end the largest real part is negative, or zero but
/// for rounding; there it goes on with the same order of magnitude.
///
/// @param end     of a band
/// @param inside  the band's other end
/// @param beyond  the next band, or the border of the range
bool lost_in_noise(const MotionsAt &at, double end, double inside, double beyond) {
    const auto largest = [&at](double speed) { // whether or not rounding could make it of zero
        double real = -std::numeric_limits<double>::infinity();
        for (const Motion &motion : at(speed))
            real = std::max(real, motion.value.real());
        return real;
    };
    const double near = std::min(std::abs(inside - end) / 2, 1e-3 * std::abs(end));
    const double growth = largest(end + std::copysign(near, inside - end));
    const double away = std::min(std::abs(beyond - end) / 2, 0.3 * std::abs(end));
    constexpr double same_order = 0.02; // a sixth power leaves 0.1
    return largest(end + std::copysign(away, beyond - end)) > same_order * growth;
}

bool stable_speed_between(const Known &known, double low, double high) {
    return std::any_of(known.upper_bound(low), known.lower_bound(high),
                       [](const auto &speed) { return speed.second < 0; });
}

/// Carries instability on where it was lost in the noise: up to the next band, or the border of the
/// range, unless a speed on the way is known to be stable.
std::vector<SpeedInterval> through_the_noise(const MotionsAt &at, const Known &known,
                                             std::vector<SpeedInterval> bands) {
    if (bands.empty())
        return bands;
    const double front = known.begin()->first;
    const double back = known.rbegin()->first;
    double &first = bands.front().first;
    if (first > front && !stable_speed_between(known, front, first) && known.begin()->second >= 0 &&
        lost_in_noise(at, first, bands.front().second, front))
        first = front;
    double &last = bands.back().second;
    if (last < back && !stable_speed_between(known, last, back) && known.rbegin()->second >= 0 &&
        lost_in_noise(at, last, bands.back().first, back))
        last = back;
    for (std::size_t i = 0; i + 1 < bands.size(); ++i)
        if (!stable_speed_between(known, bands[i].second, bands[i + 1].first) &&
            (lost_in_noise(at, bands[i].second, bands[i].first, bands[i + 1].first) ||
             lost_in_noise(at, bands[i + 1].first, bands[i + 1].second, bands[i].second)))
            bands[i].second = bands[i + 1].first;
    return joined(std::move(bands));
}

} // namespace

std::vector<SpeedInterval> joined(std::vector<SpeedInterval> bands) {
    std::sort(bands.begin(), bands.end());
    std::vector<SpeedInterval> out;
    for (const SpeedInterval &band : bands) {
        const double tolerance = 1e-9 * std::abs(band.first);
        if (!out.empty() && band.first <= out.back().second + tolerance)
            out.back().second = std::max(out.back().second, band.second);
        else
            out.push_back(band);
    }
    return out;
}

std::vector<SpeedInterval> common(const std::vector<SpeedInterval> &a,
                                  const std::vector<SpeedInterval> &b) {
    std::vector<SpeedInterval> out;
    for (const SpeedInterval &x : a)
        for (const SpeedInterval &y : b)
            if (std::max(x.first, y.first) < std::min(x.second, y.second))
                out.emplace_back(std::max(x.first, y.first), std::min(x.second, y.second));
    return out;
}

std::vector<SpeedInterval> unstable_bands(const MotionsAt &at, const std::vector<double> &speeds) {
    Known known;
    std::vector<std::pair<double, double>> seeds; // an unstable speed, a first step from it
    std::vector<Motion> before;
    for (std::size_t k = 0; k < speeds.size(); ++k) {
        std::vector<Motion> now = at(speeds[k]);
        known[speeds[k]] = growth_of(now);
        const double interval = speeds[k] - speeds[k > 0 ? k - 1 : 0];
        if (known[speeds[k]] > 0)
            seeds.emplace_back(speeds[k], std::max(interval, speeds[1] - speeds[0]));
        const bool both = k > 0 && known[speeds[k]] > 0 && known[speeds[k - 1]] > 0;
        if (both) {
            if (const auto window = stable_between(at, speeds[k - 1], before, speeds[k], now))
                known[*window] = -1;
        } else if (k > 0) {
            for (const Meeting &meeting : meetings(speeds[k - 1], before, speeds[k], now))
                if (const auto speed = unstable_meeting(at, meeting))
                    seeds.emplace_back(*speed, 1e-3 * interval);
        }
        before = std::move(now);
    }
    std::vector<SpeedInterval> bands;
    for (const auto &[speed, step] : seeds) {
        const bool covered = std::any_of(bands.begin(), bands.end(), [s = speed](const auto &band) {
            return s >= band.first && s <= band.second;
        });
        if (covered)
            continue;
        const double low = end_towards(at, known, speed, step, speeds.front());
        bands.emplace_back(low, end_towards(at, known, speed, step, speeds.back()));
    }
    return through_the_noise(at, known, joined(std::move(bands)));
}

double strongest_speed(const MotionsAt &at, const SpeedInterval &band) {
    // Golden section after a coarse look, since a band may have several humps.
    constexpr int looks = 16;
    double best = (band.first + band.second) / 2;
    double most = -1;
    const double width = (band.second - band.first) / looks;
    for (int i = 0; i <= looks; ++i) {
        const double speed = band.first + i * width;
        const double growth = growth_of(at(speed));
        if (growth > most) {
            most = growth;
            best = speed;
        }
    }
    return least_by_golden_section(
               [&at](double speed) { return -growth_of(at(speed)); },
               std::max(band.first, best - width), std::min(band.second, best + width),
               [](double a, double b, double) { return b - a <= 1e-7 * std::abs(b); })
        .first;
}

} // namespace whirl::analyses
