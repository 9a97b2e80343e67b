#include "criterion/bands.h"

#include "linalg/roots.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace whirl::criterion {

namespace {

/// Speeds that differ by less are one: the rounding of eigenvalues of stiff rotors stays below.
constexpr double one_speed = 1e-8;

/// A speed where the sign of a criterion may change; several that are one speed.
struct Breakpoint {
    double speed = 0;
    bool critical = false;
};

std::vector<Breakpoint> breakpoints(const std::vector<double> &critical,
                                    const std::vector<double> &pinned) {
    std::vector<Breakpoint> all;
    for (const double speed : critical)
        all.push_back({speed, true});
    for (const double speed : pinned)
        all.push_back({speed, false});
    std::ranges::sort(all, {}, &Breakpoint::speed);
    std::vector<Breakpoint> merged;
    for (const Breakpoint &point : all) {
        if (!merged.empty() && point.speed - merged.back().speed < one_speed * point.speed)
            merged.back().critical |= point.critical;
        else
            merged.push_back(point);
    }
    return merged;
}

/// The zero at a pinned critical speed, between two speeds with signs of their own.
double zero_at(const SpeedFunction &criterion, double pinned, double below, double above) {
    // Not symmetric: the pinned speed itself must not be the first guess.
    const double near_below = std::max(below, pinned * (1 - 1.3e-6));
    const double near_above = std::min(above, pinned * (1 + 0.7e-6));
    const double f_below = criterion(near_below);
    const double f_above = criterion(near_above);
    if ((f_below < 0) != (f_above < 0))
        return linalg::root_between(criterion, near_below, f_below, near_above, f_above);
    return linalg::root_between(criterion, below, criterion(below), above, criterion(above));
}

/// The least |f| between a and b is looked for until the sign changes or the gain is small: the
/// speed with the other sign, if there is one.
std::optional<double> turning_sign(const SpeedFunction &f, double a, double b, double between) {
    std::optional<double> turned;
    const auto size = [&](double speed) {
        const double value = f(speed);
        if ((value < 0) != (between < 0))
            turned = speed;
        return std::abs(value);
    };
    int step = 0;
    double last = std::abs(between);
    (void)linalg::least_between(size, a, b, [&](double, double, double least) {
        const bool look = step++ % 6 == 5;
        const bool stalls = look && least > 0.9 * last;
        if (look)
            last = least;
        return turned || stalls || step > 40;
    });
    return turned;
}

} // namespace

std::vector<results::SpeedBand> sharp_bands(const SpeedFunction &criterion,
                                            const std::vector<double> &critical,
                                            const std::vector<double> &pinned, double from,
                                            double to) {
    std::vector<Breakpoint> points = breakpoints(critical, pinned);
    points.insert(points.begin(), {from, true}); // the range begins there, as at a critical speed
    points.push_back({to, true});
    std::vector<results::SpeedBand> bands;
    bool before = false;
    double middle_before = from;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const double middle = (points[i].speed + points[i + 1].speed) / 2;
        const bool balanced = criterion(middle) < 0;
        if (balanced != before) {
            double end = points[i].speed;
            if (!points[i].critical) {
                // With a pole close beside the zero the counted root is the surer one.
                const double zero = zero_at(criterion, end, middle_before, middle);
                end = std::abs(zero - end) < 1e-9 * end ? zero : end;
            }
            if (balanced)
                bands.push_back({end, to});
            else
                bands.back().to = end;
        }
        before = balanced;
        middle_before = middle;
    }
    return bands;
}

std::vector<results::SpeedBand> sampled_bands(const SpeedFunction &criterion,
                                              const std::vector<double> &speeds) {
    std::vector<std::pair<double, double>> points; // speed, value
    for (const double speed : speeds)
        points.emplace_back(speed, criterion(speed));
    std::vector<double> turns;
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
        const double f = points[i].second;
        const auto same = [&](std::size_t k) { return (points[k].second < 0) == (f < 0); };
        const double size = std::abs(f);
        if (same(i - 1) && same(i + 1) && size < std::abs(points[i - 1].second) &&
            size <= std::abs(points[i + 1].second))
            if (const auto turn =
                    turning_sign(criterion, points[i - 1].first, points[i + 1].first, f))
                turns.push_back(*turn);
    }
    for (const double speed : turns)
        points.emplace_back(speed, criterion(speed));
    std::ranges::sort(points);
    std::vector<results::SpeedBand> bands;
    const double last = points.back().first;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const bool balanced = points[i].second < 0;
        const bool before = i > 0 && points[i - 1].second < 0;
        if (balanced == before)
            continue;
        const double end =
            i == 0 ? points[i].first
                   : linalg::root_between(criterion, points[i - 1].first, points[i - 1].second,
                                          points[i].first, points[i].second);
        if (balanced)
            bands.push_back({end, last});
        else
            bands.back().to = end;
    }
    return bands;
}

std::vector<double> samples_around(const std::vector<double> &hints,
                                   const std::vector<double> &given, double from, double to) {
    std::vector<double> edges = hints;
    edges.insert(edges.end(), {from, to});
    std::ranges::sort(edges);
    std::vector<double> samples = given;
    samples.insert(samples.end(), {from, to});
    for (std::size_t i = 0; i + 1 < edges.size(); ++i)
        for (const double share : {0.02, 0.1, 0.3, 0.5, 0.7, 0.9, 0.98})
            samples.push_back(edges[i] + share * (edges[i + 1] - edges[i]));
    for (const double hint : hints)
        for (const double distance : {1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 4e-3, 1e-2, 3e-2}) {
            samples.push_back(hint * (1 - distance));
            samples.push_back(hint * (1 + distance));
        }
    std::ranges::sort(samples);
    std::vector<double> out;
    for (const double speed : samples)
        if (speed >= from && speed <= to && (out.empty() || speed - out.back() > 1e-12 * to))
            out.push_back(speed);
    return out;
}

} // namespace whirl::criterion
