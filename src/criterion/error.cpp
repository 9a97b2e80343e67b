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

/// Fills in the errors of one list of bands. Ends without a counterpart get a note.
/// @param which  bands, in words
void judge(const BalanceScene &scene, const std::string &which, const Judged &criterion,
           const SpeedFunction *finer, results::BalanceBands &of, std::vector<std::string> &notes) {
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
    for (const results::SpeedBand &band : of.bands)
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
    std::vector<std::string> &notes = result.model.notes;
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
