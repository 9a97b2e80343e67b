#include "analyses/balance.h"

#include "analyses/placed_balls.h"
#include "analyses/simulate.h"
#include "analyses/stability.h"
#include "analyses/stability_ends.h"
#include "balancers/arrangement.h"
#include "balancers/kind.h"
#include "criterion/first_order.h"
#include "ends/growth.h"
#include "linalg/check.h"
#include "model/errors.h"
#include "model/variants.h"
#include "process/processes.h"
#include "process/progress.h"
#include "results/sentence.h"
#include "results/simulate.h"
#include "stability/rotor_at_speeds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <optional>

namespace whirl::analyses {

namespace {

using results::Sentence;
namespace as = results::as;

/// What `bands`, ascending and apart, leave of the range.
std::vector<results::Interval> rest_of(const std::vector<results::Interval> &bands, double from,
                                       double to) {
    std::vector<results::Interval> rest;
    double start = from;
    for (const results::Interval &band : bands) {
        if (band.from > start)
            rest.push_back({start, band.from});
        start = std::max(start, band.to);
    }
    if (start < to)
        rest.push_back({start, to});
    return rest;
}

/// Arrangements looked at where the balls have a choice; each takes a search of its own.
constexpr int arrangements = 6;

/// Errors of the ends of `rest`: those of the ends of the unstable bands beside it.
std::vector<results::EndErrors> errors_of(const std::vector<results::Interval> &rest,
                                          const UnstableBands &unstable) {
    std::vector<results::EndErrors> out;
    for (const results::Interval &band : rest) {
        out.emplace_back(0, 0); // at a border of the range
        for (std::size_t i = 0; i < unstable.bands.size(); ++i) {
            if (unstable.bands[i].to == band.from)
                out.back().first = unstable.errors[i].second;
            if (unstable.bands[i].from == band.to)
                out.back().second = unstable.errors[i].first;
        }
    }
    return out;
}

results::BalancedPosition stable_speeds(const stability::StabilityModel &model,
                                        const model::SpeedRange &range,
                                        std::vector<results::Sentence> &notes) {
    const std::vector<double> grid = stability::search_speeds(range);
    const double from = range.from;
    const double to = range.to;
    results::BalancedPosition out;
    std::vector<results::Interval> sometimes_unstable;
    std::vector<results::Interval> always_unstable;
    std::shared_ptr<const stability::BandFinder> of_first;
    for (const balancers::Arrangement &arrangement :
         balancers::sampled_arrangements(model.rotor, arrangements)) {
        const bool first = out.arrangements == 0;
        const UnstableBands unstable =
            unstable_bands_of(model, grid, arrangement, first, of_first.get());
        const std::vector<results::Interval> bands = stability::joined(unstable.bands);
        if (first) {
            of_first = unstable.finder;
            out.bands = rest_of(bands, from, to);
            out.errors = errors_of(out.bands, unstable);
            note_lost_motions(unstable.doubtful, "the motions about the balanced position", notes);
        }
        always_unstable = first ? bands : stability::common(always_unstable, bands);
        sometimes_unstable.insert(sometimes_unstable.end(), bands.begin(), bands.end());
        ++out.arrangements;
    }
    out.with_every = rest_of(stability::joined(sometimes_unstable), from, to);
    out.with_some = rest_of(always_unstable, from, to);
    return out;
}

/// The same where all imbalances together say where the balls stand.
results::BalancedPosition stable_speeds_of_placed(const model::Case &scene, int order,
                                                  const states::BalancedOverSpeed &position,
                                                  const std::vector<double> &grid) {
    const double from = grid.front();
    const double to = grid.back();
    results::BalancedPosition out;
    out.all_imbalances = true;
    out.arrangements = position.arrangements(arrangements);
    std::vector<results::Interval> sometimes;
    std::vector<results::Interval> always;
    for (int k = 0; k < out.arrangements; ++k) {
        const bool first = k == 0;
        const PlacedBands found = placed_bands(scene, order, position, grid, k, first);
        UnstableBands other; // where it grows or there is none
        other.bands = found.range.grows;
        other.errors = found.errors;
        other.bands.insert(other.bands.end(), found.range.missing.begin(),
                           found.range.missing.end());
        other.errors.insert(other.errors.end(), found.missing_errors.begin(),
                            found.missing_errors.end());
        const std::vector<results::Interval> bands = stability::joined(other.bands);
        if (first) {
            out.bands = rest_of(bands, from, to);
            out.errors = errors_of(out.bands, other);
            out.missing = found.range.missing;
        }
        always = first ? bands : stability::common(always, bands);
        sometimes.insert(sometimes.end(), bands.begin(), bands.end());
    }
    out.with_every = rest_of(stability::joined(sometimes), from, to);
    out.with_some = rest_of(always, from, to);
    return out;
}

/// What the eigenvalues say of the balanced position, with the real balancers in all their planes.
struct JudgedPosition {
    /// By what it is judged, for motions in time too; none without such a position.
    std::optional<stability::StabilityModel> model;
    /// Where all imbalances together say where the balls stand: instead.
    std::unique_ptr<states::BalancedOverSpeed> placed;
    /// Where every motion about it dies out: what unstable_bands.h leaves of the range. None where
    /// balance.balanced_position does not ask for it.
    std::optional<results::BalancedPosition> stable;
};

/// Form and order are chosen once for all arrangements. Notes say what there is not, and why.
JudgedPosition judged_position(const model::Case &scene, int order,
                               std::vector<results::Sentence> &notes) {
    JudgedPosition out;
    try {
        const model::SpeedRange &range = model::required_speeds(scene);
        const std::vector<double> grid = stability::search_speeds(range);
        out.placed = placed_by_all_imbalances(scene, order, grid, notes);
        if (out.placed) {
            if (scene.balance.balanced_position)
                out.stable = stable_speeds_of_placed(scene, order, *out.placed, grid);
            return out;
        }
        out.model = stability::stability_model(scene, grid);
        if (scene.balance.balanced_position)
            out.stable = stable_speeds(*out.model, range, notes);
    } catch (const model::BadInput &error) {
        notes.emplace_back("no balanced position to look at: {}", error.sentence());
    } catch (const model::AnalysisFailure &failure) {
        notes.emplace_back("the balanced position was not judged: {}", failure.sentence());
    }
    return out;
}

/// Why the first order says nothing of balancers; empty: it does.
std::string not_at_first_order(const model::Rotor &rotor, results::Form form) {
    if (results::in_rotating_axes(form))
        return "the rotor without its balancers is not axisymmetric";
    if (!rotor.damped())
        return "nothing damps the rotor, whose whirls the drag of the balancers drives";
    const auto swings = [](const model::Balancer &balancer) {
        return !balancers::kind_of(balancer)->swung().empty();
    };
    if (std::ranges::any_of(rotor.balancers, swings))
        return "pendulums swing as fast as the rotor turns, however light they are";
    return {};
}

/// The motions of the balancers alone to first order in their mass. None where these do not tell
/// whether the balanced position keeps; a note says why.
std::optional<results::FirstOrder> first_order_of(const model::Case &scene, int order,
                                                  const JudgedPosition &position,
                                                  const results::BalanceResult &result,
                                                  std::vector<results::Sentence> &notes) {
    if (!position.stable)
        return std::nullopt;
    const std::string why = not_at_first_order(scene.rotor, result.model.formulation.form);
    if (!why.empty()) {
        notes.emplace_back("first order in the balancers' mass not answered: {}", why);
        return std::nullopt;
    }
    std::vector<double> seeds = stability::search_speeds(*scene.speeds);
    seeds.front() = std::max(seeds.front(), criterion::least_speed(*scene.speeds));
    for (const results::BalancePlane &plane : result.planes)
        for (const results::BandEnd &end : plane.bands.ends)
            seeds.push_back(end.speed);
    for (const results::BandEnd &end : result.joint.bands.ends)
        seeds.push_back(end.speed);
    const auto places = [&](double speed) -> std::optional<balancers::Arrangement> {
        if (!position.placed)
            return balancers::arrangement_at_balance(scene.rotor);
        const auto found = position.placed->at(speed);
        return found ? std::optional(found->state.angles) : std::nullopt;
    };
    try {
        return criterion::first_order(scene.rotor, places, order, seeds, result.speeds, notes);
    } catch (const model::Failure &failure) {
        notes.emplace_back("first order in the balancers' mass not answered: {}",
                           failure.sentence());
    }
    return std::nullopt;
}

/// What the eigenvalues of the balanced position say at a speed; nothing where there is no such
/// position or no spectrum.
/// @param speeds  ascending, that it is asked for: one reduced rotor does for all of them
std::optional<double> growth_at(const JudgedPosition &position, const std::vector<double> &speeds,
                                double speed, std::optional<ends::Growth> &growth) {
    try {
        if (position.placed) {
            const auto found = position.placed->at(speed);
            return found ? std::optional(found->state.growth) : std::nullopt;
        }
        if (!position.model)
            return std::nullopt;
        const model::Rotor &rotor = position.model->rotor;
        if (!growth)
            growth.emplace(*position.model, balancers::arrangement_at_balance(rotor), speeds);
        const double found = growth->at(speed);
        return std::isnan(found) ? std::nullopt : std::optional(found);
    } catch (const model::Failure &) {
        return std::nullopt;
    } catch (const linalg::SolverError &) {
        return std::nullopt;
    }
}

/// Motions in time with the real balancers, from the start that the case gives, at
/// balance.simulated speeds inside the range; [simulate] says how long. Runs that fail are named
/// in a note. Process 0 only.
/// @param position  by what the growth beside them is judged
std::vector<results::SimulatedSpeed> simulated_speeds(const model::Case &scene,
                                                      const JudgedPosition &position,
                                                      std::vector<results::Sentence> &notes) {
    std::vector<results::SimulatedSpeed> out;
    const int count = scene.balance.simulated;
    if (count == 0 || process::process_rank() != 0)
        return out;
    model::Case run = scene;
    if (!run.simulate.held.empty()) // as long as the motion before the sweep
        run.simulate.time =
            std::prev(std::ranges::lower_bound(run.simulate.run_up, run.simulate.held.front().from,
                                               {}, &std::pair<double, double>::first))
                ->first;
    run.simulate.held.clear();
    run.simulate.starts.reset();
    run.simulate.run_up.clear();
    run.simulate.torque.reset();
    run.simulate.other_starts.clear();
    const double step = (scene.speeds->to - scene.speeds->from) / count;
    std::vector<double> speeds;
    for (int i = 0; i < count; ++i)
        speeds.push_back(scene.speeds->from + (i + 0.5) * step); // inside, never at rest
    std::optional<ends::Growth> growth;
    for (int i = 0; i < count; ++i) {
        const double speed = speeds[static_cast<std::size_t>(i)];
        run.speeds = model::SpeedRange{speed, speed, 1};
        const process::Stage stage(Sentence("motion in time at {}", as::speed(speed)),
                                   static_cast<double>(i) / count, (i + 1.0) / count);
        try {
            const results::SimulateResult result = simulate(run);
            if (result.restart) // interrupted: what there is
                return out;
            out.push_back({speed, results::outcome_name(result.outcome), result.residual_ratio,
                           growth_at(position, speeds, speed, growth)});
        } catch (const model::AnalysisFailure &failure) {
            notes.emplace_back("no motion in time at {}: {}", as::speed(speed), failure.sentence());
        }
    }
    return out;
}

} // namespace

void judge_real_balancers(const model::Case &scene, int order, results::BalanceResult &result) {
    const model::BalanceSettings &asked = scene.balance;
    if (!asked.balanced_position && asked.simulated == 0)
        return;
    std::vector<results::Sentence> &notes = result.model.notes;
    model::Case real = scene;
    real.rotor = model::with_order(std::move(real.rotor), order);
    real.formulation = model::FormChoice::automatic;
    std::optional<process::Stage> stage(std::in_place, "linear stability with real balancers", 0.4,
                                        0.7);
    JudgedPosition position = judged_position(real, order, notes);
    result.first_order = first_order_of(real, order, position, result, notes);
    result.balanced_position = std::move(position.stable);
    if (result.balanced_position)
        note_missing(result.balanced_position->missing, notes);
    stage.emplace("motions in time", 0.7, 1.0);
    result.simulated = simulated_speeds(real, position, notes);
}

} // namespace whirl::analyses
