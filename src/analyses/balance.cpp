#include "analyses/balance.h"

#include "analyses/steady_states.h"
#include "balancers/balanced_position.h"
#include "criterion/bands.h"
#include "criterion/pendulum.h"
#include "criterion/placement.h"
#include "criterion/rigid_form.h"
#include "criterion/rotor.h"
#include "linalg/check.h"
#include "model/errors.h"
#include "process/parallel.h"
#include "process/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

namespace whirl::analyses {

namespace {

using results::Sentence;
namespace as = results::as;

using Errors = std::vector<results::KnownErrors>;

/// Ends of the bands strictly inside the range, with their errors where these are known.
std::vector<results::BandEnd> inner_ends(const std::vector<results::Interval> &bands,
                                         const Errors &errors, double from, double to) {
    std::vector<results::BandEnd> ends;
    for (std::size_t i = 0; i < bands.size(); ++i) {
        const auto [of_lower, of_upper] = i < errors.size() ? errors[i] : Errors::value_type();
        if (bands[i].from > from)
            ends.push_back({bands[i].from, false, {}, {}, of_lower, {}, {}});
        if (bands[i].to < to)
            ends.push_back({bands[i].to, true, {}, {}, of_upper, {}, {}});
    }
    return ends;
}

/// The nearest one of the same kind, where there is one.
auto nearest_end(const std::vector<results::BandEnd> &ends, double speed, bool upper) {
    return std::ranges::min_element(ends, {}, [speed, upper](const results::BandEnd &end) {
        return std::pair(end.upper != upper, std::abs(end.speed - speed));
    });
}

/// Ends beside the rigid ones: two belong together where each is the other's nearest.
/// @param direction  of an end, BandEnd::direction
void complete(results::BalanceBands &bands, double from, double to,
              const std::function<std::optional<double>(const results::BandEnd &)> &direction) {
    bands.ends = inner_ends(bands.bands, bands.errors, from, to);
    for (results::BandEnd &end : bands.ends)
        end.direction = direction(end);
    const std::vector<results::BandEnd> rigid =
        inner_ends(bands.rigid_bands.value_or(std::vector<results::Interval>{}), {}, from, to);
    for (results::BandEnd &end : bands.ends) {
        const auto partner = nearest_end(rigid, end.speed, end.upper);
        // Farther apart than by half, they have nothing to do with each other.
        if (partner != rigid.end() && partner->upper == end.upper &&
            std::abs(end.speed / partner->speed - 1) < 0.5 &&
            nearest_end(bands.ends, partner->speed, end.upper)->speed == end.speed) {
            end.rigid = partner->speed;
            end.relative_difference = end.speed / partner->speed - 1;
        }
        for (const double pinned : bands.pinned)
            if (end.upper && std::abs(pinned / end.speed - 1) < 1e-6)
                end.pinned = pinned;
    }
}

void fill_bands(const criterion::BalanceScene &s, const criterion::BalanceBreakpoints &points,
                criterion::BalanceForm &form, results::BalanceResult &result) {
    const std::vector<results::BalanceBands *> each = criterion::bands_of_each(result);
    for (std::size_t i = 0; i < each.size(); ++i) {
        const criterion::SpeedFunction of = [&](double speed) { return form.value(i, speed); };
        const std::vector<double> &pinned = points.pinned[i];
        each[i]->pinned = pinned;
        each[i]->bands =
            points.sharp ? criterion::sharp_bands(of, points.critical, pinned, s.from, s.to)
                         : criterion::bands_between_changes(of, form.sign_changes(i, s.from, s.to),
                                                            s.from, s.to);
    }
}

void fill_rigid(const model::Case &scene, const criterion::BalanceScene &s,
                criterion::BalanceForm &form, results::BalanceResult &result) {
    double mass = 0; // kg
    for (const model::Balancer &balancer : scene.rotor.balancers)
        mass += balancers::mass_of(balancer);
    if (s.formulation.form != results::Form::hill)
        result.rigid = criterion::rigid_equivalent(s.body, s.anisotropy, mass);
    if (result.rigid && s.has_range()) {
        for (results::BalancePlane &plane : result.planes)
            plane.bands.rigid_bands =
                criterion::rigid_plane_bands(*result.rigid, plane.z, s.from, s.to);
        result.joint.bands.rigid_bands =
            criterion::rigid_joint_bands(*result.rigid, s.plane_positions(), s.from, s.to);
    }
    const std::vector<results::BalanceBands *> each = criterion::bands_of_each(result);
    for (std::size_t i = 0; i < each.size(); ++i)
        complete(*each[i], s.from, s.to, [&](const results::BandEnd &end) {
            // Outside of the band, near enough for the eigenvalue that changes its sign to be the
            // largest one.
            constexpr double beside = 1e-6;
            const double outside = end.speed * (end.upper ? 1 + beside : 1 - beside);
            return i < result.planes.size() ? form.worst_direction(i, outside) : std::nullopt;
        });
    if (result.planes.size() == 1)
        result.joint.bands = result.planes.front().bands;
}

/// One row a speed: the eigenvalues, the diagonal, the worst imbalances.
void fill_signature(const criterion::BalanceScene &s, criterion::BalanceForm &form,
                    results::BalanceResult &result) {
    const std::size_t count = s.planes.size();
    const auto eigenvalues = static_cast<std::ptrdiff_t>(form.receptance().size());
    const auto row = [&](double speed) {
        const results::SignaturePoint point = form.signature(speed);
        std::vector<double> values = point.eigenvalues;
        values.push_back(point.negative);
        values.push_back(point.relative);
        for (std::size_t i = 0; i < count; ++i)
            values.push_back(form.value(i, speed));
        for (const std::complex<double> &s_i : point.worst)
            values.insert(values.end(), {s_i.real(), s_i.imag()});
        return values;
    };
    const std::vector<std::vector<double>> rows = process::rows_at(s.speeds, row);
    for (std::size_t k = 0; k < rows.size(); ++k) {
        auto next = rows[k].begin();
        results::SignaturePoint point;
        point.speed = s.speeds[k];
        point.eigenvalues.assign(next, next + eigenvalues);
        next += eigenvalues;
        point.negative = static_cast<int>(*next++);
        point.relative = *next++;
        for (results::BalancePlane &plane : result.planes)
            plane.criterion.push_back(*next++);
        for (std::size_t i = 0; i < count; ++i, next += 2)
            point.worst.emplace_back(*next, *(next + 1));
        result.joint.signature.push_back(point);
    }
}

void fill_notes(const model::Case &scene, const criterion::BalanceScene &s,
                results::BalanceResult &result) {
    std::vector<results::Sentence> &notes = result.model.notes;
    const model::Rotor &rotor = scene.rotor;
    if (!rotor.balancers.empty())
        notes.emplace_back("the criterion is that of balancers without mass: the rotor is taken "
                           "without their balls and pendulums");
    const bool hill = s.formulation.form == results::Form::hill;
    if (hill)
        notes.emplace_back(
            "neither the rotor nor its bearings are the same from every direction: judged is the "
            "mean of the work over a turn, for imbalances in every direction of the rotor, with "
            "motions up to {} times the spin speed; not judged is whether these motions are stable "
            "(see stability), and there is no rigid closed form",
            2 * s.harmonics + 1);
    else if (s.formulation.form == results::Form::rotating)
        notes.emplace_back(
            "the rotor is not axisymmetric: bands hold for imbalances in every direction of it");
    if (!hill && !rotor.bearings_isotropic())
        notes.emplace_back(
            s.formulation.form == results::Form::rotating
                ? "the rigid closed form leaves out what couples x and y in the bearings"
                : "bearings differ between x and y: the criterion takes the forward part "
                  "of the receptance, the rigid closed form the mean stiffness");
    if (rotor.damped() && !hill)
        notes.emplace_back("the rigid closed form has no damping");
    const auto pedestal = [](const model::Bearing &b) {
        return b.pedestal && !b.pedestal->mass.isZero(0);
    };
    if (std::ranges::any_of(rotor.bearings, pedestal) && !hill)
        notes.emplace_back("the rigid closed form leaves out the masses of the pedestals");
    if (rotor.bearings_depend_on_speed() && !hill)
        notes.emplace_back("the rigid closed form takes the bearings as at {}", as::speed(s.from));
    if (!result.rigid && !hill)
        notes.emplace_back("no rigid closed form: the supports do not hold a rigid rotor");
    if (result.joint.rank < static_cast<int>(s.planes.size()) && !rotor.shaft.rigid)
        notes.emplace_back("correction planes at one place count once");
    if (!s.has_range())
        notes.emplace_back("one speed only: bands need a range of speeds");
}

results::BalanceResult empirical_criterion(const model::Case &scene,
                                           const criterion::BalanceScene &s,
                                           const assembly::Discretization &d) {
    const process::Stage stage("empirical criterion", 0, 0.1);
    criterion::BalanceForm form = s.form_at_planes(d);
    results::BalanceResult result;
    result.model.formulation = s.formulation;
    result.model.order = s.order;
    result.model.elements = static_cast<int>(d.shaft_mesh().spans.size());
    result.model.unknowns = form.receptance().unknowns();
    result.speeds = s.speeds;
    for (const model::CorrectionPlane &plane : s.planes)
        result.planes.push_back({plane.name, plane.z, {}, {}});
    result.joint.rank = form.rank();
    const criterion::BalanceBreakpoints points =
        criterion::balance_breakpoints(s, d, form.receptance().undamped());
    result.sharp = points.sharp;
    result.critical_speeds = points.critical;
    process::report_progress(0.3);
    if (s.has_range())
        fill_bands(s, points, form, result);
    process::report_progress(0.6);
    if (s.has_range())
        criterion::judge_band_ends(s, form, result);
    process::report_progress(0.9);
    fill_rigid(scene, s, form, result);
    fill_signature(s, form, result);
    fill_notes(scene, s, result);
    return result;
}

/// Where all balanced states are known to be unstable the balancers do not stay in them.
void take_stability(const results::SteadyStates &states, const std::vector<double> &speeds,
                    results::BalanceSupply &supply) {
    for (std::size_t k = 0; k < speeds.size(); ++k) {
        constexpr double same = 1e-12; // of the speed: the grids are made alike
        bool any = false, all_unstable = true;
        for (const results::SteadyState &state : states.states)
            if (state.kind == results::SteadyState::Kind::balanced &&
                std::abs(state.speed - speeds[k]) <= same * speeds[k]) {
                any = true;
                all_unstable = all_unstable && state.stable == false;
            }
        const bool in_place = supply.with_balancers[k] == results::Supply::balanced ||
                              supply.with_balancers[k] == results::Supply::unkept;
        if (!any || !all_unstable || !in_place)
            continue;
        supply.with_balancers[k] = results::Supply::unstable;
        for (results::LeftAt &left : supply.left) {
            left.amplitude.balancers[k].reset();
            if (left.force)
                left.force->balancers[k].reset();
        }
    }
}

} // namespace

results::BalanceResult balance(const model::Case &scene, bool map) {
    const criterion::BalanceScene s(scene);
    const assembly::Discretization d(s.rotor, s.order);
    try {
        results::BalanceResult result = empirical_criterion(scene, s, d);
        if (map) {
            const process::Stage stage("placement of the correction planes", 0.1, 0.25);
            result.placement = criterion::placement(s, d, result.critical_speeds);
        }
        {
            const process::Stage stage("what the balancers must supply", 0.25, 0.3);
            add_supply(scene, s, result);
        }
        {
            const process::Stage stage("pendulums", 0.3, 0.4);
            result.pendulum = criterion::pendulum_balance(scene, s, result.model.notes);
        }
        if (s.has_range() && !scene.rotor.balancers.empty())
            judge_real_balancers(scene, s.order, result);
        result.states = steady_states_of(scene, result.model.notes);
        if (result.supply && result.states)
            take_stability(*result.states, result.speeds, *result.supply);
        result.findings = balance_findings(result, scene);
        return result;
    } catch (const linalg::SolverError &error) {
        throw model::AnalysisFailure(Sentence("balance: {}", error.sentence()));
    }
}

} // namespace whirl::analyses
