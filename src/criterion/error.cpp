#include "criterion/error.h"

#include "criterion/bands.h"
#include "linalg/roots.h"
#include "synchronous/critical_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::criterion {

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

/// A band end with its neighbours: it is looked for half way to them.
struct Neighbourhood {
    double below = 0;
    double above = 0;
};

Neighbourhood around(const std::vector<results::SpeedBand> &bands, double end) {
    Neighbourhood out{end / 2, end * 1.5};
    for (const results::SpeedBand &band : bands)
        for (const double other : {band.from, band.to}) {
            if (other < end)
                out.below = std::max(out.below, (other + end) / 2);
            if (other > end)
                out.above = std::min(out.above, (other + end) / 2);
        }
    return out;
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
std::optional<double> error_of(double end, bool upper, const std::vector<results::SpeedBand> &bands,
                               const Judged &judged, const SpeedFunction *finer) {
    const SpeedFunction &criterion = judged.value;
    const Neighbourhood limits = around(bands, end);
    const auto again = end_near(criterion, end, upper, limits.below, limits.above);
    // Bracketing ends at 1e-13 of the speed.
    const double error =
        2e-13 * end + 3 * std::abs(again.value_or(end) - end) + 2 * blur_of(end, judged);
    if (finer == nullptr)
        return error;
    const auto other = end_near(*finer, end, upper, limits.below, limits.above);
    if (!other)
        return std::nullopt;
    return error + mesh_error::estimate_safety * std::abs(*other - end);
}

/// Fills in the errors of one list of bands. @returns ends without a counterpart.
std::vector<double> judge(const BalanceScene &scene, const Judged &criterion,
                          const SpeedFunction *finer, results::BalanceBands &of) {
    std::vector<double> lonely;
    of.errors.clear();
    const auto judged = [&](double end, bool upper, double edge) -> std::optional<double> {
        if (end == edge)
            return 0.0;
        const auto error = error_of(end, upper, of.bands, criterion, finer);
        if (!error)
            lonely.push_back(end);
        return error;
    };
    for (const results::SpeedBand &band : of.bands)
        of.errors.emplace_back(judged(band.from, false, scene.from),
                               judged(band.to, true, scene.to));
    return lonely;
}

/// Numbers of bands of all planes and of all together, by counts; empty where they are not counted.
std::vector<std::size_t> counted_bands(const BalanceScene &scene, const BalanceBreakpoints &points,
                                       BalanceForm &form) {
    std::vector<std::size_t> counts;
    if (!points.sharp)
        return counts;
    const auto count = [&](int plane, const std::vector<double> &pinned) {
        const SpeedFunction criterion = [&](double speed) { return form.value(plane, speed); };
        counts.push_back(
            sharp_bands(criterion, points.critical, pinned, scene.from, scene.to).size());
    };
    for (std::size_t i = 0; i < scene.planes.size(); ++i)
        count(static_cast<int>(i), points.pinned[i]);
    count(BalanceForm::all_planes, points.pinned_all);
    return counts;
}

void note_lonely(const std::string &which, const std::vector<double> &ends,
                 std::vector<std::string> &notes) {
    for (const double end : ends)
        notes.push_back(fmt::format("{}: the end of a band at {:.6g} rad/s is not there on a finer "
                                    "model; its error is not known",
                                    which, end));
}

} // namespace

void judge_band_ends(const BalanceScene &scene, BalanceForm &form, results::BalanceResult &result) {
    const bool rigid = scene.rotor.shaft.rigid;
    const assembly::Discretization d(scene.rotor,
                                     rigid ? scene.order : mesh_error::finer_order(scene.order));
    BalanceForm finer(d, scene.formulation.form, scene.places(d), scene.plane_positions());
    std::vector<std::string> &notes = result.model.notes;
    const auto judge_one = [&](const std::string &which, int plane, results::BalanceBands &of) {
        const Judged given{[&](double speed) { return form.value(plane, speed); },
                           [&](double speed) { return form.rounding(plane, speed); }};
        const SpeedFunction fine = [&](double speed) { return finer.value(plane, speed); };
        note_lonely(which, judge(scene, given, rigid ? nullptr : &fine, of), notes);
    };
    for (std::size_t i = 0; i < result.planes.size(); ++i)
        judge_one(fmt::format("plane {}", i + 1), static_cast<int>(i), result.planes[i].bands);
    if (result.planes.size() == 1)
        result.joint.bands.errors = result.planes[0].bands.errors;
    else
        judge_one("all planes together", BalanceForm::all_planes, result.joint.bands);
    if (rigid)
        return;
    const std::vector<std::size_t> counts =
        counted_bands(scene, balance_breakpoints(scene, d, finer.receptance().undamped()), finer);
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const bool joint = i == result.planes.size();
        const results::BalanceBands &of = joint ? result.joint.bands : result.planes[i].bands;
        if (counts[i] != of.bands.size() && !(joint && result.planes.size() == 1))
            notes.push_back(fmt::format(
                "{}: {} bands here, {} on a finer model: some are narrower than the error of the "
                "mesh",
                joint ? std::string("all planes together") : fmt::format("plane {}", i + 1),
                of.bands.size(), counts[i]));
    }
}

} // namespace whirl::criterion
