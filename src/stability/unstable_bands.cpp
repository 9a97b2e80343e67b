#include "stability/unstable_bands.h"

#include "linalg/roots.h"
#include "stability/hill/band_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl::stability {

namespace {

/// Real part along the motion that is unstable at one end of a bracket.
class GrowthAlong {
  public:
    GrowthAlong(const MotionsAt &at, double unstable) : _at(at) {
        _reference = fastest_growing(at(unstable));
    }

    struct Probe {
        Motion motion;    ///< of those most like the one followed, the one that grows most
        double apart = 0; ///< of the two neutral motions next to its frequency, rad/s; 0: none
    };
    Probe operator()(double speed) const {
        const std::vector<Motion> motions = _at(speed);
        std::vector<double> likeness;
        for (const Motion &motion : motions)
            likeness.push_back(std::abs(_reference.state.dot(motion.state)));
        const double most = *std::ranges::max_element(likeness);
        std::vector<Motion> alike;
        for (std::size_t i = 0; i < motions.size(); ++i)
            if (likeness[i] > 0.7 * most)
                alike.push_back(motions[i]);
        return {fastest_growing(alike), neutral_apart(motions)};
    }
    [[nodiscard]] double growth() const { return _reference.value.real(); }
    void move_to(const Motion &motion) { _reference = motion; }

  private:
    const MotionsAt &_at;
    Motion _reference;

    [[nodiscard]] double neutral_apart(const std::vector<Motion> &motions) const {
        std::vector<double> off; // frequencies from that of the one followed
        for (const Motion &motion : motions) {
            const double here = motion.value.imag() - _reference.value.imag();
            if (motion.neutral())
                off.push_back(motion.repeats > 0 ? std::remainder(here, motion.repeats) : here);
        }
        if (off.size() < 2)
            return 0;
        std::partial_sort(off.begin(), off.begin() + 2, off.end(),
                          [](double a, double b) { return std::abs(a) < std::abs(b); });
        return std::abs(off[0] - off[1]);
    }
};

/// Walks from an unstable speed towards one border, with steps that grow, until it is stable.
/// @param part  of the way that it is found to, at least 1e-12 of the speed
double end_towards(const MotionsAt &at, const Known &known, double unstable, double step,
                   double border, double part = 0) {
    const double seed = unstable;
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
            return band_end(at, probe, unstable,
                            std::max(1e-12 * std::max(std::abs(probe), std::abs(unstable)),
                                     part * std::abs(probe - seed)));
        if (probe == border)
            return border;
        unstable = probe;
        step *= 2;
    }
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
        const std::vector<Motion> motions = at(speed);
        return motions.empty() ? -std::numeric_limits<double>::infinity()
                               : fastest_growing(motions).value.real();
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
std::vector<results::Interval> through_the_noise(const MotionsAt &at, const Known &known,
                                                 std::vector<results::Interval> bands) {
    if (bands.empty())
        return bands;
    const double front = known.begin()->first;
    const double back = known.rbegin()->first;
    double &first = bands.front().from;
    if (first > front && !stable_speed_between(known, front, first) && known.begin()->second >= 0 &&
        lost_in_noise(at, first, bands.front().to, front))
        first = front;
    double &last = bands.back().to;
    if (last < back && !stable_speed_between(known, last, back) && known.rbegin()->second >= 0 &&
        lost_in_noise(at, last, bands.back().from, back))
        last = back;
    for (std::size_t i = 0; i + 1 < bands.size(); ++i)
        if (!stable_speed_between(known, bands[i].to, bands[i + 1].from) &&
            (lost_in_noise(at, bands[i].to, bands[i].from, bands[i + 1].from) ||
             lost_in_noise(at, bands[i + 1].from, bands[i + 1].to, bands[i].to)))
            bands[i].to = bands[i + 1].from;
    return joined(std::move(bands));
}

/// What a growth at an end that stays counts for, when the other one moved from `before` to `now`.
double weight(double before, double now) {
    const double left = before != 0 ? 1 - now / before : 0;
    return left > 0 ? left : 0.5;
}

} // namespace

double SignBracket::next() {
    // Steps of regula falsi that may leave more than half of the bracket, then a bisection.
    constexpr int patience = 3;
    if (width() <= 0.5 * _wide) {
        _wide = width();
        _steps = 0;
    }
    const bool slow = ++_steps > patience;
    if (slow)
        _wide = HUGE_VAL; // anew from here on
    if (_decline >= 0 || _growth <= 0 || slow)
        return (_stable + _unstable) / 2;
    const double off = 1e-3 * width();
    return std::clamp((_stable * _growth - _unstable * _decline) / (_growth - _decline),
                      std::min(_stable, _unstable) + off, std::max(_stable, _unstable) - off);
}

void SignBracket::stable_at(double place, double growth) {
    if (_last < 0)
        _growth *= weight(_decline, growth);
    _stable = place;
    _decline = growth;
    _last = -1;
}

void SignBracket::unstable_at(double place, double growth) {
    if (_last > 0)
        _decline *= weight(_growth, growth);
    _unstable = place;
    _growth = growth;
    _last = 1;
}

double border_of_growth(const std::function<double(double place)> &growth, double stable,
                        double unstable, double width) {
    SignBracket bracket(stable, unstable);
    bracket.stable_at(stable, std::min(growth(stable), 0.0));
    bracket.unstable_at(unstable, growth(unstable));
    while (bracket.width() > width) {
        const double next = bracket.next();
        const double here = growth(next);
        if (here == 0 && bracket.decays()) // within the rounding of a root
            return next;
        if (here > 0)
            bracket.unstable_at(next, here);
        else
            bracket.stable_at(next, here);
    }
    return bracket.stable();
}

double band_end(const MotionsAt &at, double stable, double unstable, double tolerance) {
    GrowthAlong along(at, unstable);
    SignBracket bracket(stable, unstable);
    const GrowthAlong::Probe first = along(stable);
    const double decline = first.motion.value.real();
    // At the stable end two motions that neither grow nor die out.
    bool meets = first.motion.neutral() && first.apart > 0;
    if (meets) {
        bracket.unstable_at(unstable, along.growth() * along.growth());
        bracket.stable_at(stable, -first.apart * first.apart / 4);
    } else if (first.motion.decays()) {
        bracket.unstable_at(unstable, along.growth());
        bracket.stable_at(stable, decline);
    }
    for (int step = 0; step < 200 && bracket.width() > tolerance; ++step) {
        const double next = bracket.next();
        const GrowthAlong::Probe here = along(next);
        const double growth = here.motion.value.real();
        const bool decays = here.motion.decays();
        // Within the noise: unstable where the other side decays (a root), else not.
        if (bracket.decays() && !meets ? growth > 0 : here.motion.grows()) {
            bracket.unstable_at(next, meets ? growth * growth : growth);
            along.move_to(here.motion);
            continue;
        }
        const bool was_root = bracket.decays() && !meets;
        if (!meets && !decays && !was_root && here.apart > 0)
            bracket.square_growth(); // squares of half differences are smooth through the end
        meets = !decays && !was_root && here.apart > 0;
        if (meets)
            bracket.stable_at(next, -here.apart * here.apart / 4);
        else
            bracket.stable_at(next, decays || was_root ? std::min(growth, -1e-300) : 0);
    }
    return (bracket.stable() + bracket.unstable()) / 2;
}

std::vector<results::Interval> joined(std::vector<results::Interval> bands) {
    std::ranges::sort(bands);
    std::vector<results::Interval> out;
    for (const results::Interval &band : bands) {
        const double tolerance = 1e-9 * std::abs(band.from);
        if (!out.empty() && band.from <= out.back().to + tolerance)
            out.back().to = std::max(out.back().to, band.to);
        else
            out.push_back(band);
    }
    return out;
}

std::vector<results::Interval> common(const std::vector<results::Interval> &a,
                                      const std::vector<results::Interval> &b) {
    std::vector<results::Interval> out;
    for (const results::Interval &x : a)
        for (const results::Interval &y : b)
            if (std::max(x.from, y.from) < std::min(x.to, y.to))
                out.push_back({std::max(x.from, y.from), std::min(x.to, y.to)});
    return out;
}

BandsFound find_bands(const MotionsAt &at, const std::vector<double> &speeds, double part) {
    BandSearch search(at, speeds);
    const Known &known = search.known();
    BandsFound out;
    for (const auto &[speed, step] : search.seeds()) {
        const bool covered = std::ranges::any_of(
            out.bands, [s = speed](const auto &band) { return s >= band.from && s <= band.to; });
        if (covered)
            continue;
        const double low = end_towards(at, known, speed, step, speeds.front(), part);
        out.bands.push_back({low, end_towards(at, known, speed, step, speeds.back(), part)});
    }
    out.bands = through_the_noise(at, known, joined(std::move(out.bands)));
    out.doubtful = joined(search.doubtful());
    return out;
}

results::Interval band_around(const MotionsAt &at, double unstable, double step,
                              const results::Interval &borders) {
    return {end_towards(at, {}, unstable, step, borders.from),
            end_towards(at, {}, unstable, step, borders.to)};
}

std::vector<results::Interval> unstable_bands(const MotionsAt &at,
                                              const std::vector<double> &speeds) {
    return find_bands(at, speeds).bands;
}

double strongest_speed(const std::function<double(double speed)> &growth,
                       const results::Interval &band) {
    // By parabolas after coarse probing, since a band may have several humps.
    constexpr int parts = 16;
    double best = (band.from + band.to) / 2;
    double most = -1;
    const double width = (band.to - band.from) / parts;
    for (int i = 0; i <= parts; ++i) {
        const double speed = band.from + i * width;
        const double here = growth(speed);
        if (here > most) {
            most = here;
            best = speed;
        }
    }
    // In parts of the band, for a narrow one is a small part of the speed.
    return best + width * linalg::least_place([&](double x) { return -growth(best + width * x); },
                                              std::max(-1.0, (band.from - best) / width),
                                              std::min(1.0, (band.to - best) / width));
}

} // namespace whirl::stability
