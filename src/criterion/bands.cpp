#include "criterion/bands.h"

#include "linalg/roots.h"
#include "synchronous/critical_error.h"

#include <fmt/format.h>

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

std::vector<results::Interval> sharp_bands(const SpeedFunction &criterion,
                                           const std::vector<double> &critical,
                                           const std::vector<double> &pinned, double from,
                                           double to) {
    std::vector<Breakpoint> points = breakpoints(critical, pinned);
    points.insert(points.begin(), {from, true}); // the range begins there, as at a critical speed
    points.push_back({to, true});
    std::vector<results::Interval> bands;
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

std::vector<results::Interval> sampled_bands(const SpeedFunction &criterion,
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
    std::vector<results::Interval> bands;
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

namespace {

/// Where the criterion changes its sign near the end of a band, in the same direction; none between
/// the limits.
std::optional<double> end_near(const SpeedFunction &criterion, double end, bool upper, double least,
                               double largest) {
    // Negative below the end, positive above it.
    const auto g = [&](double speed) { return upper ? criterion(speed) : -criterion(speed); };
    const auto root = [&](double a, double b) { return linalg::root_between(g, a, g(a), b, g(b)); };
    bool left = true;
    bool right = true;
    double last_a = end;
    double last_b = end;
    for (double reach = 1e-10; left || right; reach *= 8) {
        const double a = std::max(least, end * (1 - reach));
        const double b = std::min(largest, end * (1 + reach));
        const bool below = left && g(a) < 0;
        const bool above = right && g(b) >= 0;
        if (last_a == last_b) { // the first bracket is about the end itself
            if (below && above)
                return root(a, b);
            left = !below;
            right = !above;
        } else if (below) {
            return root(a, last_a);
        } else if (above) {
            return root(last_b, b);
        }
        left = left && a > least;
        right = right && b < largest;
        last_a = a;
        last_b = b;
    }
    return std::nullopt;
}

/// The end of a band is looked for half way to its neighbours below and above.
std::pair<double, double> around(const std::vector<results::Interval> &bands, double end) {
    double below = end / 2;
    double above = end * 1.5;
    for (const results::Interval &band : bands)
        for (const double other : {band.from, band.to}) {
            if (other < end)
                below = std::max(below, (other + end) / 2);
            if (other > end)
                above = std::min(above, (other + end) / 2);
        }
    return {below, above};
}

/// A criterion, and how far rounding can make it off.
struct Judged {
    SpeedFunction value, rounding;
};

/// How far rounding can move an end: what it makes of the criterion beside it, over the slope there
/// (of a root as of a pole: near both the ratio is that of the end itself), rad/s.
double blur_of(double end, const Judged &criterion) {
    constexpr double beside = 1e-5;
    double blur = 0;
    for (const double side : {-beside, beside}) {
        const double near = end * (1 + side);
        const double off = end * (1 + 1.25 * side);
        const double slope = (criterion.value(off) - criterion.value(near)) / (off - near);
        if (slope != 0)
            blur = std::max(blur, criterion.rounding(near) / std::abs(slope));
    }
    return blur;
}

/// Error of one end, rad/s.
std::optional<double> error_of(double end, bool upper, const std::vector<results::Interval> &bands,
                               const Judged &judged, const SpeedFunction *finer) {
    const SpeedFunction &criterion = judged.value;
    const auto [below, above] = around(bands, end);
    const auto again = end_near(criterion, end, upper, below, above);
    // Bracketing ends at 1e-13 of the speed.
    const double error =
        2e-13 * end + 3 * std::abs(again.value_or(end) - end) + 2 * blur_of(end, judged);
    if (finer == nullptr)
        return error;
    const auto other = end_near(*finer, end, upper, below, above);
    if (!other)
        return std::nullopt;
    return error + mesh_error::estimate_safety * std::abs(*other - end);
}

/// Fills in the errors of one list of bands. Ends without a counterpart get a note.
/// @param which  bands, in words
void judge(const BalanceScene &scene, const std::string &which, const Judged &criterion,
           const SpeedFunction *finer, results::BalanceBands &of,
           std::vector<results::Sentence> &notes) {
    of.errors.clear();
    const auto judged = [&](double end, bool upper, double edge) -> std::optional<double> {
        if (end == edge)
            return 0.0;
        const auto error = error_of(end, upper, of.bands, criterion, finer);
        if (!error)
            notes.push_back(fmt::format("{}: the end of a band at {:.6g} rad/s is not there on a "
                                        "finer model; its error is not known",
                                        which, end));
        return error;
    };
    for (const results::Interval &band : of.bands)
        of.errors.emplace_back(judged(band.from, false, scene.from),
                               judged(band.to, true, scene.to));
}

} // namespace

void judge_band_ends(const BalanceScene &scene, BalanceForm &form, results::BalanceResult &result) {
    const bool rigid = scene.rotor.shaft.rigid;
    const assembly::Discretization d(scene.rotor,
                                     rigid ? scene.order : mesh_error::finer_order(scene.order));
    BalanceForm finer(d, scene.formulation.form, deflections_at(d, scene.planes),
                      scene.plane_positions());
    std::vector<results::Sentence> &notes = result.model.notes;
    const std::vector<results::BalanceBands *> each = bands_of_each(result);
    const std::size_t planes = scene.planes.size();
    const auto name = [planes](std::size_t i) {
        return i < planes ? fmt::format("plane {}", i + 1) : std::string("all planes together");
    };
    for (std::size_t i = 0; i < each.size(); ++i) {
        const Judged given{[&](double speed) { return form.value(i, speed); },
                           [&](double speed) { return form.rounding(i, speed); }};
        const SpeedFunction fine = [&](double speed) { return finer.value(i, speed); };
        judge(scene, name(i), given, rigid ? nullptr : &fine, *each[i], notes);
    }
    if (rigid)
        return;
    const BalanceBreakpoints points = balance_breakpoints(scene, d, finer.receptance().undamped());
    for (std::size_t i = 0; i < each.size() && points.sharp; ++i) {
        const SpeedFunction fine = [&](double speed) { return finer.value(i, speed); };
        const std::size_t there =
            sharp_bands(fine, points.critical, points.pinned[i], scene.from, scene.to).size();
        if (there != each[i]->bands.size())
            notes.push_back(fmt::format(
                "{}: {} bands here, {} on a finer model: some are narrower than the error of the "
                "mesh",
                name(i), each[i]->bands.size(), there));
    }
}

} // namespace whirl::criterion
