#include "analyses/notes/driven_motions.h"

#include "analyses/stability_ends.h"
#include "balancers/arrangement.h"
#include "ends/band_ends.h"
#include "ends/finer_ends.h"
#include "ends/growth.h"
#include "model/errors.h"
#include "stability/unstable_bands.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace whirl::analyses {

namespace {

using results::Sentence;
namespace as = results::as;

/// A bearing or seal has negative damping, at some speed.
bool has_negative_damping(const model::Rotor &rotor) {
    return !rotor.every_row(
        [](const model::BearingCoefficients &at) { return !model::pushes_away(at.c); });
}

/// Something drives motions of every frequency: an axial torque without a potential, which does
/// work on every shape whose ends tilt, or negative damping in a bearing. The number of motions
/// that grow is then that of the unknowns, and the fast ones are not those of the shaft.
bool drives_every_frequency(const model::Rotor &rotor) {
    return !rotor.shaft.rigid &&
           (!rotor.shaft.torque_has_potential() || has_negative_damping(rotor));
}

/// By finer elements, of ends that are roots.
void add_errors(const ends::AllMotions &motions, const stability::StabilityModel &model,
                const std::vector<ends::EndOfGrowth> &roots,
                std::vector<results::StabilityEnd> &ends) {
    std::optional<ends::FinerEnds> finer;
    for (results::StabilityEnd &end : ends) {
        const auto root = std::ranges::find_if(
            roots, [&end](const auto &known) { return known.speed == end.speed; });
        if (root == roots.end())
            continue;
        if (!finer)
            finer.emplace(motions.discretization(), model.form,
                          balancers::arrangement_at_balance(model.rotor));
        constexpr double reach = 0.1; // of the speed: farther away it is another one
        end.resolved.error = finer->error(*root, end.growing_above > end.growing_below ? 1 : -1,
                                          reach * std::abs(end.speed));
    }
}

/// Bands between the ends of resolved motions, with the errors of these.
void add_resolved_bands(results::StabilityResult &result) {
    const std::vector<double> &speeds = result.speeds;
    ends::EndsFound found{result.ends, result.resolved_growth.front() > 0 ? 1 : 0, {}, {}};
    if (!found.ends.empty())
        found.growing_from = found.ends.front().growing_below;
    result.resolved_unstable = ends::bands_of(found, {speeds.front(), speeds.back()});
    const auto error_of = [&](double speed) {
        for (const results::StabilityEnd &end : result.ends)
            if (end.speed == speed)
                return end.resolved.error.value_or(std::numeric_limits<double>::quiet_NaN());
        return 0.0; // the border of the range
    };
    for (const auto &[from, to] : result.resolved_unstable)
        result.resolved_unstable_error.emplace_back(error_of(from), error_of(to));
}

/// Where faster motions grow: between neighbouring speeds that differ in that, by halving. A band
/// between two speeds at which none grows is not seen: of motions that hang on the mesh.
struct FasterBands {
    std::vector<results::Interval> bands;
    std::vector<results::EndErrors> errors;
};
FasterBands faster_bands(const ends::AllMotions &motions, double top,
                         const results::StabilityResult &result) {
    const std::vector<double> &speeds = result.speeds;
    FasterBands out;
    bool before = false;
    for (std::size_t i = 0; i < speeds.size(); ++i) {
        const bool here = result.unresolved_growth[i] > 0;
        if (here == std::exchange(before, here))
            continue;
        double low = i == 0 ? speeds.front() : speeds[i - 1];
        double high = speeds[i];
        constexpr int halvings = 10; // 1/1024 of a step, which is the stated error
        for (int k = 0; k < halvings && low < high; ++k) {
            const double middle = (low + high) / 2;
            const bool grows = motions.fastest_growing(middle, top).value.real() > 0;
            (grows == here ? high : low) = middle;
        }
        if (here) {
            out.bands.push_back({(low + high) / 2, speeds.back()});
            out.errors.emplace_back((high - low) / 2, 0);
        } else {
            out.bands.back().to = (low + high) / 2;
            out.errors.back().second = (high - low) / 2;
        }
    }
    return out;
}

/// All bands: of resolved motions, and of faster ones.
void join_bands(const FasterBands &faster, results::StabilityResult &result) {
    std::vector<results::Interval> all = result.resolved_unstable;
    all.insert(all.end(), faster.bands.begin(), faster.bands.end());
    std::map<double, double> error_of; // of each end, by its speed
    const auto take = [&error_of](const auto &bands, const auto &errors) {
        for (std::size_t i = 0; i < bands.size(); ++i)
            error_of.insert({{bands[i].from, errors[i].first}, {bands[i].to, errors[i].second}});
    };
    take(result.resolved_unstable, result.resolved_unstable_error);
    take(faster.bands, faster.errors);
    // Where it is not known whether faster ones grow, a band may go on.
    const auto unknown = [&](double end) {
        const std::vector<double> &speeds = result.speeds;
        for (std::size_t i = 1; i < speeds.size(); ++i)
            if (end > speeds[i - 1] && end < speeds[i] &&
                std::isnan(result.unresolved_growth[i - 1] + result.unresolved_growth[i]))
                return true;
        return false;
    };
    result.unstable = stability::joined(std::move(all));
    result.unstable_error.clear();
    for (const auto &[from, to] : result.unstable) {
        constexpr double none = std::numeric_limits<double>::quiet_NaN();
        result.unstable_error.emplace_back(unknown(from) ? none : error_of.at(from),
                                           unknown(to) ? none : error_of.at(to));
    }
}

/// Where some motion grows, or begins to: else all is said by that none does.
void note_resolved(results::StabilityResult &result) {
    if (result.unstable.empty() && result.ends.empty() && result.unresolved_ends.empty() &&
        std::ranges::all_of(result.unresolved_growth, [](double growth) { return growth <= 0; }))
        return;
    const std::size_t ends = result.unresolved_ends.size();
    result.model.notes.emplace_back(
        "this mesh resolves modes up to {} (frequencies at rest to 1 "
        "%): only those enter resolved_growth and resolved_verdict, "
        "while growth and verdict include faster unstable modes, which "
        "change with the mesh{}",
        as::frequency(result.resolved_up_to.value()),
        ends == 0 ? ""
                  : fmt::format("; unresolved_ends lists {} of faster modes, others may be "
                                "missing",
                                ends == 1 ? "one stability limit"
                                          : fmt::format("{} stability limits", ends)));
}

void note_negative_damping(const model::Rotor &rotor, results::StabilityResult &result) {
    const bool grows = std::ranges::any_of(result.growth, [](double value) { return value > 0; });
    if (grows && !rotor.shaft.rigid && has_negative_damping(rotor))
        result.model.notes.emplace_back(
            "negative damping of a bearing or seal destabilises modes of "
            "every frequency, so the largest growth rises with mesh "
            "refinement: judge the slow modes by `campbell`");
}

void note_torque(const stability::StabilityModel &model, results::StabilityResult &result) {
    const auto fastest = std::ranges::max_element(result.growth);
    if (model.rotor.shaft.torque_has_potential() || fastest == result.growth.end() ||
        !(*fastest > 0))
        return;
    const double speed = result.speeds[static_cast<std::size_t>(fastest - result.growth.begin())];
    stability::StabilityModel other = model;
    other.rotor.shaft.torque_kind = model::TorqueKind::semitangential;
    other.top = std::abs(speed);
    try {
        const ends::Growth growth(other, balancers::arrangement_at_balance(other.rotor), {speed});
        const double left = std::max(0.0, growth.at(speed));
        if (left > 0.9 * *fastest)
            return;
        result.model.notes.emplace_back(
            "this kind of axial torque has no potential and destabilises "
            "modes, by {} at {}; with torque_kind = \"semitangential\" {}; "
            "without shaft damping (beta, internal_damping) the unstable "
            "fast modes change with the mesh: judge the slow ones by "
            "`campbell`",
            as::rate(*fastest, 4), as::speed(speed),
            left > 0 ? Sentence("{} remain there", as::rate(left, 4))
                     : Sentence("no mode grows there"));
    } catch (const model::Failure &) { // no more than a note
    }
}

} // namespace

void count_resolved_if_driven(ends::AllMotions &motions, const model::Rotor &rotor) {
    if (drives_every_frequency(rotor))
        motions.count_resolved();
}

void separate_resolved(const ends::AllMotions &motions, const stability::StabilityModel &model,
                       const std::vector<ends::EndOfGrowth> &roots,
                       results::StabilityResult &result) {
    const double top = motions.resolved_up_to();
    if (!std::isfinite(top))
        return;
    result.resolved_up_to = top;
    const auto fast = std::stable_partition(result.ends.begin(), result.ends.end(),
                                            [](const auto &end) { return end.resolved.motion; });
    result.unresolved_ends.assign(fast, result.ends.end());
    result.ends.erase(fast, result.ends.end());
    for (results::StabilityEnd &end : result.ends)
        if (end.resolved.below >= 0) {
            end.growing_below = end.resolved.below;
            end.growing_above = end.resolved.above;
        }
    add_errors(motions, model, roots, result.ends);
    if (result.speeds.size() > 1) {
        add_resolved_bands(result);
        join_bands(faster_bands(motions, top, result), result);
    }
    settle_rounding({result.resolved_growth, result.resolved_verdict}, result.speeds,
                    result.resolved_unstable, model.rotor.damped());
    note_resolved(result);
}

void note_drives(const stability::StabilityModel &model, results::StabilityResult &result) {
    note_negative_damping(model.rotor, result);
    note_torque(model, result);
}

} // namespace whirl::analyses
