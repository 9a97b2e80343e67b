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

using results::Sentence;
namespace as = results::as;

/// Speeds that differ by less are one: the rounding of eigenvalues of stiff rotors stays below.
constexpr double one_speed = 1e-8;

/// A speed where the sign of a criterion may change; several that are one speed.
struct Breakpoint {
    enum class Kind { change, pinned, critical }; ///< ascending: of several the last one counts
    double speed = 0;
    Kind kind = Kind::change;
};

std::vector<Breakpoint> merged(std::vector<Breakpoint> all) {
    std::ranges::sort(all, {}, &Breakpoint::speed);
    std::vector<Breakpoint> out;
    for (const Breakpoint &point : all) {
        if (!out.empty() && point.speed - out.back().speed < one_speed * point.speed)
            out.back().kind = std::max(out.back().kind, point.kind);
        else
            out.push_back(point);
    }
    return out;
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

/// From the signs between these speeds.
std::vector<results::Interval> bands_between(const SpeedFunction &criterion,
                                             std::vector<Breakpoint> points, double from,
                                             double to) {
    using Kind = Breakpoint::Kind;
    points = merged(std::move(points));
    points.insert(points.begin(), {from, Kind::critical}); // the range begins there
    points.push_back({to, Kind::critical});
    std::vector<results::Interval> bands;
    bool before = false;
    double middle_before = from;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const double middle = (points[i].speed + points[i + 1].speed) / 2;
        const bool balanced = criterion(middle) < 0;
        if (balanced != before) {
            double end = points[i].speed;
            if (points[i].kind != Kind::critical) {
                const double zero = zero_at(criterion, end, middle_before, middle);
                // With a pole close beside the zero a counted root is the surer one.
                const bool sure = points[i].kind == Kind::pinned;
                end = sure && std::abs(zero - end) >= 1e-9 * end ? end : zero;
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

} // namespace

std::vector<results::Interval> sharp_bands(const SpeedFunction &criterion,
                                           const std::vector<double> &critical,
                                           const std::vector<double> &pinned, double from,
                                           double to) {
    std::vector<Breakpoint> points;
    for (const double speed : critical)
        points.push_back({speed, Breakpoint::Kind::critical});
    for (const double speed : pinned)
        points.push_back({speed, Breakpoint::Kind::pinned});
    return bands_between(criterion, std::move(points), from, to);
}

std::vector<results::Interval> bands_between_changes(const SpeedFunction &criterion,
                                                     const std::vector<double> &changes,
                                                     double from, double to) {
    std::vector<Breakpoint> points;
    for (const double speed : changes)
        points.push_back({speed, Breakpoint::Kind::change});
    return bands_between(criterion, std::move(points), from, to);
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

/// How far rounding can move an end: what it makes of the criterion beside it, over the slope there
/// (of a root as of a pole: near both the ratio is that of the end itself), rad/s.
double blur_of(double end, const Judged &criterion) {
    // Of the speed: outside the rounding of an end, near enough for one slope.
    constexpr double offset = 1e-5;
    double blur = 0;
    for (const double side : {-offset, offset}) {
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

} // namespace

std::vector<results::KnownErrors> end_errors(const std::string &which,
                                             const std::vector<results::Interval> &bands,
                                             const results::Interval &range,
                                             const Judged &criterion, const SpeedFunction *finer,
                                             std::vector<results::Sentence> &notes) {
    const auto judged = [&](double end, bool upper, double edge) -> std::optional<double> {
        if (end == edge)
            return 0.0;
        const auto error = error_of(end, upper, bands, criterion, finer);
        if (!error)
            notes.emplace_back("{}: the band end at {} has no counterpart on a finer mesh, so "
                               "its error is not known",
                               which, as::speed(end));
        return error;
    };
    std::vector<results::KnownErrors> out;
    for (const results::Interval &band : bands)
        out.emplace_back(judged(band.from, false, range.from), judged(band.to, true, range.to));
    return out;
}

void judge_band_ends(const BalanceScene &scene, BalanceForm &form, results::BalanceResult &result) {
    const bool rigid = scene.rotor.shaft.rigid;
    const bool exact = rigid && scene.harmonics == 0;
    BalanceScene finer_scene = scene;
    finer_scene.order = rigid ? scene.order : mesh_error::finer_order(scene.order);
    finer_scene.harmonics *= 2;
    const assembly::Discretization d(scene.rotor, finer_scene.order);
    BalanceForm finer = finer_scene.form_at_planes(d);
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
        each[i]->errors = end_errors(name(i), each[i]->bands, {scene.from, scene.to}, given,
                                     exact ? nullptr : &fine, notes);
    }
    if (exact)
        return;
    const BalanceBreakpoints points =
        balance_breakpoints(finer_scene, d, finer.receptance().undamped());
    for (std::size_t i = 0; i < each.size() && points.sharp; ++i) {
        const SpeedFunction fine = [&](double speed) { return finer.value(i, speed); };
        const std::size_t there =
            sharp_bands(fine, points.critical, points.pinned[i], scene.from, scene.to).size();
        if (there != each[i]->bands.size())
            notes.emplace_back(model::Weight::warning,
                               "{}: {} bands on this mesh, {} on a finer one: some are "
                               "narrower than the error of the mesh",
                               name(i), each[i]->bands.size(), there);
    }
}

} // namespace whirl::criterion
