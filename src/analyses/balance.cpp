#include "analyses/balance.h"

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
#include <utility>

namespace whirl::analyses {

namespace {

using Errors = decltype(results::BalanceBands::errors);

/// Ends of the bands strictly inside the range, with their errors where these are known.
std::vector<results::BandEnd> inner_ends(const std::vector<results::Interval> &bands,
                                         const Errors &errors, double from, double to) {
    std::vector<results::BandEnd> ends;
    for (std::size_t i = 0; i < bands.size(); ++i) {
        const auto [of_lower, of_upper] = i < errors.size() ? errors[i] : Errors::value_type();
        if (bands[i].from > from)
            ends.push_back({bands[i].from, false, {}, {}, of_lower, {}});
        if (bands[i].to < to)
            ends.push_back({bands[i].to, true, {}, {}, of_upper, {}});
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
void complete(results::BalanceBands &bands, double from, double to) {
    bands.ends = inner_ends(bands.bands, bands.errors, from, to);
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
    std::vector<double> samples;
    if (!points.sharp)
        samples = criterion::samples_around(points.hints, s.speeds, s.from, s.to);
    const std::vector<results::BalanceBands *> each = criterion::bands_of_each(result);
    for (std::size_t i = 0; i < each.size(); ++i) {
        const criterion::SpeedFunction of = [&](double speed) { return form.value(i, speed); };
        const std::vector<double> &pinned = points.pinned[i];
        each[i]->pinned = pinned;
        each[i]->bands = points.sharp
                             ? criterion::sharp_bands(of, points.critical, pinned, s.from, s.to)
                             : criterion::sampled_bands(of, samples);
    }
}

void fill_rigid(const criterion::BalanceScene &s, results::BalanceResult &result) {
    result.rigid = criterion::rigid_equivalent(s.body);
    if (result.rigid && s.has_range()) {
        for (results::BalancePlane &plane : result.planes)
            plane.bands.rigid_bands =
                criterion::rigid_plane_bands(*result.rigid, plane.z, s.from, s.to);
        result.joint.bands.rigid_bands =
            criterion::rigid_joint_bands(*result.rigid, s.plane_positions(), s.from, s.to);
    }
    for (results::BalanceBands *bands : criterion::bands_of_each(result))
        complete(*bands, s.from, s.to);
    if (result.planes.size() == 1)
        result.joint.bands = result.planes.front().bands;
}

/// One row a speed: the eigenvalues, the diagonal, the worst imbalances.
void fill_signature(const criterion::BalanceScene &s, criterion::BalanceForm &form,
                    results::BalanceResult &result) {
    const std::size_t count = s.planes.size();
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
        point.eigenvalues.assign(next, next + static_cast<std::ptrdiff_t>(count));
        next += static_cast<std::ptrdiff_t>(count);
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
    if (!rotor.anisotropies.empty())
        notes.emplace_back("the rotating anisotropies of the case are left out");
    if (!rotor.bearings_isotropic())
        notes.emplace_back("bearings differ between x and y: the criterion takes the forward part "
                           "of the receptance, the rigid closed form the mean stiffness");
    if (rotor.damped())
        notes.emplace_back("the rigid closed form has no damping");
    const auto pedestal = [](const model::Bearing &b) {
        return b.pedestal && !b.pedestal->mass.isZero(0);
    };
    if (std::ranges::any_of(rotor.bearings, pedestal))
        notes.emplace_back("the rigid closed form leaves out the masses of the pedestals");
    if (rotor.bearings_depend_on_speed())
        notes.push_back(
            fmt::format("the rigid closed form takes the bearings as at {:.6g} rad/s", s.from));
    if (!result.rigid)
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
    criterion::BalanceForm form(d, s.formulation.form, criterion::deflections_at(d, s.planes),
                                s.plane_positions());
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
    fill_rigid(s, result);
    fill_signature(s, form, result);
    fill_notes(scene, s, result);
    return result;
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
            const process::Stage stage("pendulums", 0.25, 0.4);
            result.pendulum = criterion::pendulum_balance(scene, s, result.model.notes);
        }
        if (s.has_range() && !scene.rotor.balancers.empty())
            judge_real_balancers(scene, s.order, result);
        result.findings = balance_findings(result, scene);
        return result;
    } catch (const linalg::SolverError &error) {
        throw model::AnalysisFailure(fmt::format("balance: {}", error.what()));
    }
}

} // namespace whirl::analyses
