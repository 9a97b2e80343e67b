#include "analyses/stability.h"

#include "analyses/names/mode_naming.h"
#include "analyses/notes/driven_motions.h"
#include "analyses/placed_balls.h"
#include "analyses/stability_ends.h"
#include "analyses/stability_map.h"
#include "analyses/steady_states.h"
#include "balancers/balanced_position.h"
#include "balancers/kind.h"
#include "ends/band_ends.h"
#include "ends/band_errors.h"
#include "ends/permissible.h"
#include "ends/speed_families.h"
#include "linalg/check.h"
#include "model/case.h"
#include "model/errors.h"
#include "model/variants.h"
#include "operation/level1.h"
#include "process/progress.h"
#include "results/formulation.h"
#include "results/sentence.h"
#include "stability/band_finder.h"
#include "stability/hill/hill_motions.h"
#include "stability/rotor_at_speeds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace whirl::analyses {

namespace {

using results::Sentence;
namespace as = results::as;

/// Ends of bands at which a root passes zero are roots of det K too, which are sharper.
void sharpen(results::StabilityResult &result, std::vector<ends::EndOfGrowth> &roots,
             const std::vector<stability::ZeroRootSpeed> &standing) {
    std::vector<double *> ends;
    for (results::Interval &band : result.unstable)
        ends.insert(ends.end(), {&band.from, &band.to});
    for (results::StabilityEnd &end : result.ends)
        if (end.kind == results::EndKind::zero)
            ends.push_back(&end.speed);
    for (ends::EndOfGrowth &root : roots)
        if (root.kind == results::EndKind::zero)
            ends.push_back(&root.speed);
    for (double *end : ends)
        for (const stability::ZeroRootSpeed &at : standing)
            if (at.exact && std::abs(*end - at.speed) < 1e-7 * std::abs(at.speed))
                *end = at.speed;
}

/// Those inside the range; spinning the other way, the rotor has the same ones with a minus.
std::vector<stability::ZeroRootSpeed> inside(const std::vector<stability::ZeroRootSpeed> &standing,
                                             double from, double to) {
    std::vector<stability::ZeroRootSpeed> out;
    for (const double sense : {-1.0, 1.0})
        for (const stability::ZeroRootSpeed &at : standing)
            if (const double speed = sense * at.speed; speed >= from && speed <= to)
                out.push_back({speed, at.exact});
    std::ranges::sort(out, {}, &stability::ZeroRootSpeed::speed);
    return out;
}

std::vector<double> speeds_of(const std::vector<stability::ZeroRootSpeed> &standing) {
    std::vector<double> out(standing.size());
    std::ranges::transform(standing, out.begin(), &stability::ZeroRootSpeed::speed);
    return out;
}

/// Those of the range of the grid; none where they cannot be resolved beside the other roots.
std::vector<stability::ZeroRootSpeed>
zero_root_or_none(const assembly::Discretization &d, const balancers::Arrangement &arrangement,
                  bool frozen, const std::vector<double> &grid, bool &failed,
                  const Eigen::MatrixXd *shapes = nullptr) {
    const double top = std::max(std::abs(grid.front()), std::abs(grid.back()));
    try {
        return inside(stability::zero_root_speeds(d, arrangement, frozen, top, shapes),
                      grid.front(), grid.back());
    } catch (const linalg::SolverError &) {
        failed = true;
        return {};
    }
}

/// Makes form hill ready to look at the speeds of a grid, as many of them as it can describe.
void begin(stability::BandFinder &finder, std::vector<double> &grid,
           stability::StabilityModel &model) {
    if (finder.hill() == nullptr)
        return;
    finder.keep(grid);
    // The shapes of the whole grid at once: more of them later would mean to begin anew.
    if (grid.size() > 1)
        try {
            (void)finder.good_shapes(grid);
        } catch (const stability::NotSettled &) { // which give_up_unsettled looks at
        }
    give_up_unsettled(finder, grid, model);
}

/// The bands of each arrangement, those of the first known already.
/// @param first   unstable bands of the first arrangement
/// @param finder_of_first  with which they were found
results::ArrangementFamily family_of(const std::vector<balancers::Arrangement> &arrangements,
                                     const std::vector<results::Interval> &first,
                                     const stability::BandFinder &finder_of_first,
                                     const std::vector<double> &grid) {
    const stability::StabilityModel &model = finder_of_first.model();
    results::ArrangementFamily out;
    out.arrangements = static_cast<int>(arrangements.size());
    std::vector<std::vector<double>> critical;
    std::vector<std::vector<double>> additional;
    std::vector<results::Interval> some;
    for (std::size_t k = 0; k < arrangements.size(); ++k) {
        std::optional<stability::BandFinder> other;
        if (k > 0)
            other.emplace(model, arrangements[k], finder_of_first);
        const auto bands = other ? bands_between_ends(*other, grid).found.bands : first;
        out.always_unstable = k == 0 ? bands : stability::common(out.always_unstable, bands);
        some.insert(some.end(), bands.begin(), bands.end());
        if (model.form == results::Form::rotating && !model.rotor.bearings_depend_on_speed()) {
            const assembly::Discretization undamped(model::without_damping(model.rotor),
                                                    model.order);
            const auto shapes = other ? other->good_shapes(grid) : nullptr; // first: in full
            const auto speeds = [&](bool frozen) {
                return speeds_of(zero_root_or_none(undamped, arrangements[k], frozen, grid,
                                                   out.incomplete, shapes.get()));
            };
            critical.push_back(speeds(true));
            additional.push_back(speeds(false));
        }
        process::report_progress(0.9 * static_cast<double>(k + 1) /
                                 static_cast<double>(arrangements.size()));
    }
    out.unstable = stability::joined(std::move(some));
    out.critical_speeds = ends::intervals_of(critical);
    out.additional_speeds = ends::intervals_of(additional);
    for (const model::Balancer &balancer : model.rotor.balancers) {
        const auto interval = balancers::anisotropy_interval(balancer);
        constexpr double unknown = std::numeric_limits<double>::quiet_NaN(); // null in the result
        out.anisotropy.push_back(interval ? results::Interval{interval->least, interval->largest}
                                          : results::Interval{unknown, unknown});
    }
    return out;
}

/// Critical and additional speeds, and those at which a root is zero; band ends among them.
/// @param roots  of these ends
void search_zero_roots(const stability::BandFinder &finder, const std::vector<double> &grid,
                       std::vector<ends::EndOfGrowth> &roots, results::StabilityResult &result) {
    const stability::StabilityModel &model = finder.model();
    const balancers::Arrangement &arrangement = finder.arrangement();
    const assembly::Discretization &d = finder.discretization();
    bool failed = false;
    const assembly::Discretization undamped(model::without_damping(model.rotor), model.order);
    result.critical_speeds =
        speeds_of(zero_root_or_none(undamped, arrangement, true, grid, failed));
    const auto free = zero_root_or_none(d, arrangement, false, grid, failed);
    if (!model.rotor.balancers.empty()) {
        result.additional_speeds =
            speeds_of(zero_root_or_none(undamped, arrangement, false, grid, failed));
        if (model.rotor.damped())
            result.additional_speeds_damped = speeds_of(free);
    }
    for (const stability::ZeroRootSpeed &standing : free)
        if (standing.exact)
            result.zero_root_speeds.push_back(standing.speed);
    sharpen(result, roots, free);
    if (failed)
        result.model.notes.emplace_back(model::Weight::warning,
                                        "critical or additional speeds could not be resolved "
                                        "beside the other roots: they are not listed");
}

/// What there is of a rotor that is the same at all speeds.
void answer_once(const stability::BandFinder &finder, const results::Interval &range,
                 results::StabilityResult &result) {
    const stability::StabilityModel &model = finder.model();
    result.model.unknowns = finder.unknowns();
    ends::AllMotions motions(finder.discretization(), model.form, finder.arrangement(), nullptr,
                             range.from, range.to);
    count_resolved_if_driven(motions, model.rotor);
    add_growth_of_all_speeds(motions, result);
    separate_resolved(motions, model, {}, result);
}

/// The bands, critical and additional speeds and what depends on the arrangement of the balls.
void search(const std::vector<double> &speeds, stability::StabilityModel &model,
            results::StabilityResult &result) {
    std::vector<double> grid = described(speeds, model);
    const std::vector<balancers::Arrangement> arrangements =
        balancers::sampled_arrangements(model.rotor, 16);
    const balancers::Arrangement &arrangement = arrangements.front(); // as the case gives it
    stability::BandFinder finder(model, arrangement);
    const assembly::Discretization &d = finder.discretization();
    result.model.elements = static_cast<int>(d.shaft_mesh().spans.size());
    if (stability::same_at_all_speeds(model, d)) {
        answer_once(finder, {grid.front(), grid.back()}, result);
        return;
    }
    begin(finder, grid, model);
    const bool range = grid.size() > 1;
    std::optional<ends::AllMotions> all;
    std::optional<process::Stage> stage(std::in_place, "growth at the speeds", 0.0, 0.3);
    if (model.form == results::Form::hill) {
        add_hill_growth(finder, model.from, result);
    } else {
        all.emplace(finder, grid);
        count_resolved_if_driven(*all, model.rotor);
        add_growth(*all, result);
    }
    std::vector<ends::EndOfGrowth> roots;
    if (range) {
        stage.emplace("unstable bands", 0.3, 0.6);
        roots = search_bands(finder, all ? &*all : nullptr, grid, result);
        settle_rounding({result.growth, result.verdict}, result.speeds, result.unstable,
                        model.rotor.damped());
    }
    result.model.unknowns = finder.unknowns();
    result.harmonics = finder.hill() != nullptr ? finder.hill()->harmonics() : 0;
    if (model.form == results::Form::rotating && !model.rotor.bearings_depend_on_speed())
        search_zero_roots(finder, grid, roots, result);
    if (range) {
        stage.emplace("errors of the bands", 0.6, 0.65);
        if (!all || !std::isfinite(all->resolved_up_to()))
            result.unstable_error =
                ends::band_errors(finder, result.unstable, {grid.front(), grid.back()}, roots);
    }
    if (all)
        separate_resolved(*all, model, roots, result);
    stage.emplace("permissible anisotropy", 0.65, 0.8);
    try {
        result.permissible = ends::permissible_anisotropies(finder, grid, result.unstable);
    } catch (const stability::NotSettled &failure) { // a slow speed, with another anisotropy
        result.model.notes.emplace_back(model::Weight::warning,
                                        "permissible anisotropies are not listed: {}",
                                        failure.sentence());
    }
    if (!range)
        return;
    stage.emplace("arrangements of the balls", 0.8, 1.0);
    if (arrangements.size() > 1)
        result.family = family_of(arrangements, result.unstable, finder, grid);
}

/// Growth, bands and what hangs on them.
void answer(const model::Case &scene, const std::vector<double> &grid,
            stability::StabilityModel &model, results::StabilityResult &result) {
    result.neutral_pairs = neutral_pairs(scene.rotor);
    if (!model.conservative) {
        search(grid, model, result);
        add_neutral_balls(scene.rotor, result);
        return;
    }
    result.growth.assign(result.speeds.size(), 0.0);
    result.verdict.assign(result.speeds.size(), results::Verdict::neutral);
    const assembly::Discretization d(scene.rotor, model.order);
    result.model.elements = static_cast<int>(d.shaft_mesh().spans.size());
    result.model.unknowns = 2 * d.planar_size();
}

/// Level II is required where one clearance of the bearings requires it.
void judge_all_clearances(results::StabilityResult &result) {
    if (!result.level1)
        return;
    for (const results::StabilityResult &one : result.clearances)
        if (one.level1 && one.level1->level_two == true && result.level1->level_two != true) {
            result.level1->level_two = true;
            result.level1->verdict = {"with the {} clearance of the bearings {}",
                                      model::fit_name(one.fit), one.level1->verdict};
        }
}

void add_level1(const model::Case &scene, const stability::StabilityModel &model,
                results::StabilityResult &result) {
    if (!scene.level1)
        return;
    try {
        const process::Stage stage("added cross coupling", 0.95, 1.0);
        result.level1 = operation::level1(scene, model.order, result.model.notes);
    } catch (const model::AnalysisFailure &failure) {
        result.model.notes.push_back(failure.sentence());
    } catch (const model::BadInput &failure) { // all else is answered
        result.model.notes.emplace_back(model::Weight::warning, "no answer to {}",
                                        failure.sentence());
    }
}

void add_notes(const model::Case &scene, const stability::StabilityModel &model,
               results::StabilityResult &result) {
    std::vector<results::Sentence> &notes = result.model.notes;
    if (model.conservative)
        notes.emplace_back(model::Weight::information,
                           "undamped with a positive definite stiffness: the energy is conserved "
                           "and bounds the motion at every speed");
    if (result.speeds.size() == 1)
        notes.emplace_back(model::Weight::information,
                           "one speed: stable or unstable there; bands need a range of [speeds]");
    if (model.form == results::Form::hill)
        notes.emplace_back(
            model::Weight::information,
            "critical speeds are not listed: with bearings that differ between their directions "
            "nothing stands still in rotating axes");
    if (model.from > 0)
        notes.emplace_back("below {} the {} at every speed: nothing is said of these speeds",
                           as::speed(model.from),
                           model.harmonics > 0
                               ? "Hill series (its harmonics lie 2 x speed apart) does not settle"
                               : "motion over half a turn could not be found");
    const bool has_balancers = !scene.rotor.balancers.empty();
    if (results::in_rotating_axes(model.form) && !scene.rotor.damped() && has_balancers)
        notes.emplace_back("the bearings have no damping: the balls' drag acts as internal damping "
                           "and drives every motion slower than the rotor");
    if (result.family && result.family->incomplete)
        notes.emplace_back("for some arrangements critical or additional speeds could not be "
                           "resolved: their intervals may be too narrow");
    if (result.all_imbalances == true)
        notes.emplace_back(
            model::Weight::information,
            "the balls stand where all imbalances of the rotor ask for, elsewhere at every speed; "
            "critical and additional speeds and permissible anisotropies, which are those of balls "
            "at one place, are not listed");
    note_missing(result.no_position, notes);
    if (result.neutral_pairs > 0)
        notes.emplace_back(model::Weight::information,
                           "balls beyond two, and on one diameter beyond one, can move without "
                           "changing the balance: that many neutral pairs 0, -h beside the "
                           "eigenvalues computed");
}

} // namespace

UnstableBands unstable_bands_of(stability::StabilityModel model, const std::vector<double> &grid,
                                const balancers::Arrangement &arrangement, bool with_errors,
                                const stability::BandFinder *like) {
    UnstableBands out;
    if (model.conservative)
        return out;
    using stability::BandFinder;
    out.finder = like ? std::make_shared<BandFinder>(model, arrangement, *like)
                      : std::make_shared<BandFinder>(model, arrangement);
    BandFinder &finder = *out.finder;
    std::vector<double> known = described(grid, model);
    begin(finder, known, model);
    if (known.size() > 1) {
        BandsBetween between = bands_between_ends(finder, known);
        out.bands = std::move(between.found.bands);
        out.doubtful = std::move(between.found.doubtful);
        if (with_errors)
            out.errors =
                ends::band_errors(finder, out.bands, {known.front(), known.back()}, between.roots);
        out.roots = std::move(between.roots);
    }
    const auto not_resolved = [&](double from, double to) {
        out.bands.push_back({from, to});
        if (with_errors)
            out.errors.emplace_back(0, 0);
    };
    if (!known.empty() && known.back() < grid.back())
        not_resolved(known.back(), grid.back());
    if (known.empty() || known.front() > grid.front())
        not_resolved(grid.front(), known.empty() ? grid.back() : known.front());
    return out;
}

UnstableBands unstable_bands_of(const model::Case &scene, bool with_errors) {
    const auto grid = stability::search_speeds(model::required_speeds(scene));
    const stability::StabilityModel model = stability::stability_model(scene, grid);
    std::vector<Sentence> ignored;
    if (const auto placed = placed_by_all_imbalances(scene, model.order, grid, ignored)) {
        UnstableBands out;
        if (grid.size() > 1) {
            PlacedBands found = placed_bands(scene, model.order, *placed, grid, 0, with_errors);
            out.bands = std::move(found.range.grows);
            out.errors = std::move(found.errors);
        }
        return out;
    }
    return unstable_bands_of(model, grid, balancers::arrangement_at_balance(scene.rotor),
                             with_errors);
}

UnstableBands unstable_bands_of(const model::Case &scene, const balancers::Arrangement &arrangement,
                                bool with_errors) {
    const auto grid = stability::search_speeds(model::required_speeds(scene));
    return unstable_bands_of(stability::stability_model(scene, grid), grid, arrangement,
                             with_errors);
}

/// The case with the bearings of one clearance, without what is asked of it with `table` alone.
model::Case scene_with_fit(model::Case scene, model::BearingFit fit) {
    scene.rotor = model::with_fit(std::move(scene.rotor), fit);
    scene.standard.reset();
    scene.map.reset();
    scene.states.reset();
    return scene;
}

results::StabilityResult stability(const model::Case &scene, const CaseWith &with) {
    results::StabilityResult result;
    result.speeds = model::required_speeds(scene).values();
    const std::vector<double> grid = stability::search_speeds(*scene.speeds);
    stability::StabilityModel model = stability::stability_model(scene, grid);
    result.model.formulation = model.formulation;
    result.model.order = model.order;
    const auto placed = placed_by_all_imbalances(scene, model.order, grid, result.model.notes);
    if (!scene.rotor.balancers.empty())
        result.all_imbalances = placed != nullptr;
    const auto all_but_map = [&] {
        if (placed)
            answer_for_placed_balls(scene, model.order, *placed, grid, result);
        else
            answer(scene, grid, model, result);
        name_modes(result.ends, ModesBeside(scene, model.order), model.form_of_lines);
        add_level1(scene, model, result);
        result.states = steady_states_of(scene, result.model.notes, with);
    };
    if (scene.map && !scene.map->y.values.empty()) // which the other processes need not wait with
        result.map = stability_map(*scene.map, with, all_but_map);
    else
        all_but_map();
    if (result.map && !result.map->why.empty())
        result.model.notes.emplace_back("some points of the map are empty: {}", result.map->why);
    add_notes(scene, model, result);
    if (!placed)
        note_drives(model, result);
    if (scene.standard)
        for (const model::BearingFit fit : scene.standard->fits)
            if (fit != model::BearingFit::given) {
                result.clearances.push_back(stability(scene_with_fit(scene, fit), with));
                result.clearances.back().fit = fit;
            }
    judge_all_clearances(result);
    return result;
}

} // namespace whirl::analyses
