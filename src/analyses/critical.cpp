#include "analyses/critical.h"

#include "analyses/campbell.h"
#include "analyses/critical_map/critical_map.h"
#include "analyses/names/mode_naming.h"
#include "analyses/notes/ball_positions.h"
#include "analyses/notes/growth.h"
#include "analyses/response.h"
#include "assembly/discretization.h"
#include "linalg/check.h"
#include "mesh_error/estimate.h"
#include "model/errors.h"
#include "model/mass.h"
#include "model/variants.h"
#include "modes/formulation.h"
#include "operation/margins.h"
#include "process/processes.h"
#include "results/critical.h"
#include "results/damping.h"
#include "results/formulation.h"
#include "results/model_summary.h"
#include "results/sentence.h"
#include "rigid/shaft.h"
#include "synchronous/critical_error.h"
#include "synchronous/critical_speeds.h"
#include "tracking/line_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace whirl::analyses {

namespace {

using results::Sentence;
namespace as = results::as;

/// Critical speeds of an asymmetric rotor are those without damping (A. N. Gorbenko's Omega_K);
/// with it, no motion stands still but at the ends of the unstable ranges.
model::Case undamped(model::Case scene) {
    scene.rotor = model::without_damping(std::move(scene.rotor));
    return scene;
}

void note_damping(results::Form form, bool damped, results::ModelSummary &model) {
    if (damped)
        model.notes.emplace_back(
            model::Weight::information,
            form == results::Form::rotating
                ? "critical speeds of the asymmetric rotor are those without damping; with it a "
                  "root is zero at the ends of the unstable ranges, which stability lists"
                : "critical speeds of the damped rotor are Im of the synchronous eigenvalue; "
                  "crossings of a Campbell diagram differ from them by the order of the damping "
                  "ratio squared. Those with a damping ratio above 1/sqrt(2) make no peak and are "
                  "not listed: `campbell` has their crossings");
}

void note_balls_held(results::Form form, results::ModelSummary &model) {
    if (form == results::Form::rotating)
        model.notes.emplace_back(model::Weight::information,
                                 "forward critical speeds only, the balls of balancers held in "
                                 "place; stability lists the speeds at which they are free");
}

/// Among speeds the first one at or after a crossing that names lines, where the whirl of a line is
/// that of its name: next to a range over which it keeps the frequency of the spin it has both.
std::size_t place_of_name(const std::vector<double> &naming, const std::vector<double> &speeds,
                          double crossing) {
    const auto next = std::ranges::lower_bound(naming, crossing);
    const double name = next == naming.end() ? naming.back() : *next;
    const auto place = std::ranges::lower_bound(speeds, name) - speeds.begin();
    return static_cast<std::size_t>(std::min(place, std::ssize(speeds) - 1));
}

/// Of an asymmetric rotor on bearings that differ between their directions: the speeds at which a
/// free motion has the frequency of the spin, whatever its damping, and the ends of ranges over
/// which it stays there. Nothing stands still in any axes, so that they are the crossings of the
/// lines of the Campbell diagram with 1x, over the speeds of the case.
results::CriticalResult critical_of_hill(const model::Case &scene, bool judged) {
    if (!scene.speeds || scene.speeds->count < 2)
        throw model::BadInput(fmt::format(
            "{}: speeds: expected the range in which critical speeds of an asymmetric rotor on "
            "bearings that differ between their directions are looked for, got {}",
            scene.file.string(), scene.speeds ? "one speed" : "none"));
    model::Case bare = scene;
    bare.campbell.multiples = {1};
    HillCrossings found = hill_crossings(bare);
    const std::vector<double> naming = tracking::naming_speeds(*scene.speeds);
    results::CriticalResult result;
    result.model = std::move(found.diagram.model);
    for (std::size_t i = 0; i < found.by_mesh.size(); ++i) {
        const results::Crossing &crossing = found.diagram.crossings[i];
        const double ratio = crossing.damping.ratio.value_or(0);
        if (ratio > 1 / std::numbers::sqrt2)
            continue; // no peak
        results::CriticalSpeed critical;
        critical.speed = crossing.speed;
        critical.damping = crossing.damping;
        critical.real = -ratio / std::sqrt(1 - ratio * ratio) * crossing.frequency;
        const results::CampbellMode &line =
            found.diagram.modes[static_cast<std::size_t>(crossing.mode)];
        critical.mode = line.label;
        critical.whirl = line.whirl[place_of_name(naming, found.diagram.speeds, crossing.speed)];
        critical.error_parts.rounding = 1e-11; // to which crossings are found
        if (!scene.rotor.shaft.rigid)
            critical.error_parts.mesh =
                found.by_mesh[i].value_or(std::numeric_limits<double>::infinity());
        critical.error = critical.error_parts.sum();
        result.critical_speeds.push_back(critical);
    }
    const auto [from, to] = std::minmax(scene.speeds->from, scene.speeds->to);
    result.complete = {std::min(from, 0.0), std::max(to, 0.0)};
    if (from > 0)
        result.doubtful.push_back({0, from});
    if (to < 0)
        result.doubtful.push_back({to, 0});
    if (!judged)
        return result;
    const auto unknown = [](const results::CriticalSpeed &c) { return !std::isfinite(c.error); };
    if (std::ranges::any_of(result.critical_speeds, unknown)) { // by all of a finer rotor
        const process::Alone alone; // the others have no critical speeds to judge
        model::Case fine = scene;
        fine.rotor.shaft.order_auto = false;
        fine.rotor.shaft.order = std::min(mesh_error::finer_order(result.model.order), 30);
        const auto finer = critical_of_hill(fine, false).critical_speeds;
        const bool same = finer.size() == result.critical_speeds.size();
        for (std::size_t i = 0; i < finer.size() && same; ++i) {
            results::CriticalSpeed &critical = result.critical_speeds[i];
            critical.error_parts.mesh =
                mesh_error::estimate_safety * std::abs(finer[i].speed / critical.speed - 1);
            critical.error = critical.error_parts.sum();
        }
        if (!same)
            result.model.notes.emplace_back(
                model::Weight::warning,
                "finer elements have another number of critical speeds in the range: errors are "
                "not known; raise shaft.order");
    }
    result.model.notes.emplace_back(
        model::Weight::information,
        "rotor and bearings both differ between their directions: critical speeds are those in the "
        "range of speeds at which a free motion has the frequency of the spin, and the ends of "
        "ranges over which it keeps it");
    return result;
}

/// The modes asked for, more while they are in the range of the case.
void keep_lowest(synchronous::SynchronousModes &list, int wanted, double top) {
    const auto in_range = static_cast<std::size_t>(std::ranges::count_if(
        list.modes, [top](const modes::WhirlMode &m) { return m.eigenvalue.imag() <= top; }));
    const std::size_t keep =
        std::min(list.modes.size(), std::max(static_cast<std::size_t>(wanted), in_range));
    list.modes.resize(keep);
    if (!list.branches.empty())
        list.branches.resize(keep);
}

/// A direction in which a case spins its rotor.
struct SpinRange {
    int spin = 1;   ///< sign of the speeds
    double top = 0; ///< up to this |speed| all critical speeds are wanted, rad/s
};

/// A rotor whose bearings or seals couple the planes has other critical speeds when it spins from y
/// to x. Machines operate at positive speeds.
std::vector<SpinRange> spin_ranges(const model::Case &scene) {
    const model::SpeedRange range = scene.speeds.value_or(model::SpeedRange{});
    const double lowest = std::min(range.from, range.to);
    double highest = std::max(range.from, range.to);
    if (scene.operation)
        highest = std::max(highest, operation::highest_relevant_speed(*scene.operation));
    std::vector<SpinRange> out;
    if (highest > 0 || lowest >= 0)
        out.push_back({1, highest});
    if (lowest < 0)
        out.push_back({-1, -lowest});
    return out;
}

/// From the slower to the faster one, as signed speeds ascend.
results::Interval signed_interval(int spin, double slow, double fast) {
    return spin > 0 ? results::Interval{slow, fast} : results::Interval{-fast, -slow};
}

/// Which critical speeds the list can lack, in words.
/// @param last  |speed| of the fastest of this spin that is listed, rad/s
void note_completeness(const synchronous::SynchronousModes &found, bool more_wanted,
                       const SpinRange &range, double last, bool rigid,
                       results::CriticalResult &result) {
    std::vector<results::Sentence> &notes = result.model.notes;
    (range.spin > 0 ? result.complete.to : result.complete.from) = range.spin * found.complete_to;
    for (const auto &[slow, fast] : found.doubtful) {
        const results::Interval doubtful = signed_interval(range.spin, slow, fast);
        result.doubtful.push_back(doubtful);
        if (more_wanted || slow <= std::max(range.top, last))
            notes.emplace_back(
                model::Weight::warning,
                "critical speeds from {} may be missing: the count there is not certain",
                as::speed.range(doubtful.from, doubtful.to));
    }
    if (more_wanted && std::isinf(found.complete_to) && found.doubtful.empty())
        notes.emplace_back(model::Weight::information,
                           rigid ? "the rotor has no more critical speeds than the ones listed"
                                 : "the model has no more critical speeds than the ones listed "
                                   "(all were counted); a finer mesh can have more");
    else if (!std::isinf(found.complete_to) && (more_wanted || found.complete_to < last))
        notes.emplace_back(model::Weight::information, "the list is complete up to {}",
                           as::speed(range.spin * found.complete_to));
}

/// A shaft that does not bend: what its bearings let it do is lost in the rounding of its
/// stiffness.
void note_rounding(const model::Rotor &rotor, results::CriticalResult &result) {
    const double shaft = rotor.shaft.rigid ? 0 : rigid::bending_stiffness(rotor);
    double bearings = 0;
    for (const model::Bearing &bearing : rotor.bearings)
        bearings += bearing.rows.front().k.trace() / 2;
    constexpr double far = 1e9; // of the 1e16 that double precision holds
    const bool lost = std::ranges::any_of(result.critical_speeds,
                                          [](const auto &c) { return !(c.error < 1e-6); });
    if (lost && bearings > 0 && shaft > far * bearings)
        result.model.notes.emplace_back(
            model::Weight::warning,
            "the shaft (48 EI/L^3 = {}) is {} times as stiff as its bearings: rounding hides the "
            "slow motions, critical speeds can be wrong by their errors or missing; shaft.rigid = "
            "true gives those of the rigid rotor",
            as::stiffness(shaft, 3), as::number(shaft / bearings, 1));
}

/// A shaft almost without mass: the motions of its elements are far faster than all others.
Sentence light_shaft_text(const model::Rotor &rotor) {
    constexpr double light = 1e-3; // of the rotor
    const double shaft = model::mass_of(rotor.shaft);
    const double all = model::mass_of_shaft_and_discs(rotor);
    if (!(shaft < light * all) || rotor.shaft.segments.empty())
        return {};
    return Sentence("\nnote: the shaft has {} of {} only, with a density of {} (rho): steel has {}",
                    as::mass(shaft, 2), as::mass(all, 4),
                    as::density(rotor.shaft.segments.front().material.rho), as::density(7850));
}

/// Adds those of one sign.
/// @param shapes  to begin with; null: the rotor's own
void add_speeds(const model::Case &scene, const assembly::Discretization &d, const SpinRange &range,
                bool judged, const synchronous::SharedShapes *shapes,
                results::CriticalResult &result) {
    results::ModelSummary &model = result.model;
    const results::Form form = model.formulation.form;
    const int wanted = scene.campbell.modes;
    // In rotating axes the same motion in two directions counts twice.
    const int ask = form == results::Form::rotating ? 2 * wanted : wanted;
    synchronous::SynchronousModes list =
        synchronous::all_synchronous_modes(d, form, ask, range.top, shapes, range.spin);
    keep_lowest(list, ask, range.top);
    const std::vector<results::ErrorParts> errors =
        judged ? synchronous::errors_by_finer_model(d, form, list, model.notes)
               : std::vector<results::ErrorParts>(list.modes.size(),
                                                  {std::numeric_limits<double>::infinity(), 0, 0});
    std::vector<results::CriticalSpeed> speeds;
    for (std::size_t i = 0; i < list.modes.size(); ++i) {
        const modes::WhirlMode &mode = list.modes[i];
        speeds.push_back({range.spin * mode.eigenvalue.imag(),
                          mode.whirl,
                          mode.eigenvalue.real(),
                          errors[i].sum(),
                          mode.residual,
                          results::damping_of(modes::determined_value(mode)),
                          {},
                          errors[i],
                          mode.plane});
    }
    if (range.spin < 0)
        std::ranges::reverse(speeds);
    if (judged) {
        const results::Interval all = signed_interval(range.spin, 0, range.top);
        if (form == results::Form::rotating)
            drop_second_directions(speeds, wanted, all);
        const bool more_wanted = static_cast<int>(speeds.size()) < wanted;
        double last = 0;
        for (const results::CriticalSpeed &critical : speeds)
            last = std::max(last, std::abs(critical.speed));
        note_completeness(list, more_wanted, range, last, scene.rotor.shaft.rigid, result);
    }
    result.critical_speeds.insert(range.spin > 0 ? result.critical_speeds.end()
                                                 : result.critical_speeds.begin(),
                                  speeds.begin(), speeds.end());
}

/// Critical speeds with elements of one order.
results::CriticalResult of_order(const model::Case &scene, const results::Formulation &formulation,
                                 int order, bool judged,
                                 const synchronous::SharedShapes *shapes = nullptr) {
    results::CriticalResult result;
    results::ModelSummary &model = result.model;
    const results::Form form = formulation.form;
    model.formulation = formulation;
    model.order = order;
    const assembly::Discretization d(scene.rotor, order);
    model.elements = static_cast<int>(d.shaft_mesh().spans.size());
    model.unknowns = form == results::Form::planar ? d.planar_size() : 2 * d.planar_size();
    result.complete = {0, 0};
    for (const SpinRange &range : spin_ranges(scene))
        add_speeds(scene, d, range, judged, shapes, result);
    if (judged)
        note_rounding(scene.rotor, result);
    return result;
}

double largest_error(const results::CriticalResult &result) {
    double largest = 0;
    for (const results::CriticalSpeed &critical : result.critical_speeds)
        largest = std::max(largest, critical.error);
    return largest;
}

/// With order = "auto" the lowest at which every critical speed listed meets the tolerance.
results::CriticalResult of_resolved_order(const model::Case &scene,
                                          const results::Formulation &formulation, bool judged,
                                          const synchronous::SharedShapes *shapes) {
    const model::Shaft &shaft = scene.rotor.shaft;
    if (!shaft.order_auto || shaft.rigid || !judged)
        return of_order(scene, formulation, shaft.rigid ? 1 : shaft.order, judged, shapes);
    results::CriticalResult result;
    (void)mesh_error::lowest_order(shaft.tolerance, [&](int order) {
        result = of_order(scene, formulation, order, judged);
        return largest_error(result);
    });
    return result;
}

results::CriticalResult critical_of(const model::Case &as_given, bool judged,
                                    const synchronous::SharedShapes *shapes = nullptr) {
    const results::Formulation formulation =
        modes::without_planar_damped(modes::choose_formulation(as_given), as_given.rotor);
    if (formulation.form == results::Form::hill)
        return critical_of_hill(as_given, judged);
    const model::Case scene =
        formulation.form == results::Form::rotating ? undamped(as_given) : as_given;
    results::CriticalResult result;
    try {
        result = of_resolved_order(scene, formulation, judged, shapes);
    } catch (const linalg::SolverError &) {
        throw model::AnalysisFailure(Sentence(
            "the critical speeds could not be found: the eigensolver did not converge or missed "
            "some; stiffnesses, dampings, densities or element lengths may differ by more orders "
            "of magnitude than double precision holds (campbell shows crossings speed by speed){}",
            light_shaft_text(scene.rotor)));
    }
    if (formulation.form == results::Form::rotating && as_given.rotor.damped())
        for (results::CriticalSpeed &critical : result.critical_speeds)
            critical.damping = {};
    note_damping(formulation.form, as_given.rotor.damped(), result.model);
    note_balls_held(formulation.form, result.model);
    if (formulation.form == results::Form::rotating)
        note_other_positions(scene.rotor, result.model.notes);
    return result;
}

results::CriticalMap map_of(const model::Case &scene, results::ModelSummary &model) {
    try {
        return critical_map(scene, model);
    } catch (const linalg::SolverError &) {
        throw model::AnalysisFailure(
            "the critical speed map could not be made: the eigensolver did not converge or missed "
            "some; a narrower range of stiffness may do (critical_map.from, critical_map.to)");
    }
}

/// Of the response to imbalance, where there is one and a range of speeds.
std::vector<results::ResponsePeak> peaks_for_margins(const model::Case &scene,
                                                     results::ModelSummary &model) {
    const bool driven = !model::with_balancer_imbalances(scene.rotor).imbalances.empty();
    if (!driven || !scene.speeds || scene.speeds->count < 2)
        return {};
    try {
        return response_peaks(scene, false).peaks;
    } catch (const model::Failure &failure) { // or a form that only the critical speeds have
        model.notes.emplace_back(
            "margins: amplification factors from damping, as the response is not known: {}",
            failure.sentence());
        return {};
    }
}

/// Those that `critical` lists for a case, out of more of them or of both directions of a motion.
std::vector<results::CriticalSpeed> listed(const model::Case &scene,
                                           const results::CriticalResult &found) {
    std::vector<results::CriticalSpeed> out = found.critical_speeds;
    if (found.model.formulation.form == results::Form::hill) // all of its range
        return out;
    results::Interval all{0, 0};
    for (const SpinRange &range : spin_ranges(scene))
        (range.spin > 0 ? all.to : all.from) = range.spin * range.top;
    drop_second_directions(out, scene.campbell.modes, all);
    return out;
}

} // namespace

void drop_second_directions(std::vector<results::CriticalSpeed> &speeds, int wanted,
                            const results::Interval &all) {
    const auto same = [](const results::CriticalSpeed &a, const results::CriticalSpeed &b) {
        return a.whirl == b.whirl && std::abs(a.speed - b.speed) < 1e-9 * std::abs(a.speed) &&
               std::abs(a.real - b.real) < 1e-9 * std::abs(a.speed);
    };
    speeds.erase(std::unique(speeds.begin(), speeds.end(), same), speeds.end());
    const auto first = std::ranges::find_if(speeds, [](const auto &c) { return c.speed >= 0; });
    auto negative = static_cast<int>(first - speeds.begin());
    auto positive = static_cast<int>(speeds.end() - first);
    for (; positive > wanted && speeds.back().speed > all.to; --positive)
        speeds.pop_back();
    auto kept = speeds.begin();
    for (; negative > wanted && kept->speed < all.from; --negative)
        ++kept;
    speeds.erase(speeds.begin(), kept);
}

results::CriticalResult critical_speeds(const model::Case &scene, bool map,
                                        const std::vector<results::ResponsePeak> *peaks) {
    results::CriticalResult result = critical_of(scene, true);
    const ModesBeside modes(scene, result.model.order);
    if (result.model.formulation.form != results::Form::hill)
        name_modes(result.critical_speeds, modes);
    add_separation_margins(scene, result, peaks);
    if (map)
        result.map = map_of(scene, result.model);
    note_growing_motions(modes, result.model);
    return result;
}

results::CriticalResult unjudged_critical_speeds(const model::Case &scene,
                                                 const synchronous::SharedShapes *shapes) {
    return critical_of(scene, false, shapes);
}

std::vector<results::CriticalSpeed> listed_critical_speeds(const model::Case &scene) {
    return listed(scene, unjudged_critical_speeds(scene));
}

void add_separation_margins(const model::Case &scene, results::CriticalResult &result,
                            const std::vector<results::ResponsePeak> *peaks) {
    if (!scene.operation)
        return;
    result.margins = operation::separation_margins(
        *scene.operation, listed(scene, result),
        peaks ? *peaks : peaks_for_margins(scene, result.model),
        !scene.rotor.bearings_rotation_invariant(), result.model.notes);
}

std::optional<synchronous::SharedShapes> shapes_for_samples(const model::Case &scene, int order,
                                                            double highest) {
    constexpr double beyond = 1.2; // of a rotor that is stiffer
    try {
        return synchronous::shared_shapes(assembly::Discretization(scene.rotor, order),
                                          beyond * highest, scene.campbell.modes);
    } catch (const linalg::SolverError &) {
        return std::nullopt;
    }
}

} // namespace whirl::analyses
