#include "criterion/rotor.h"

#include "forced/forced_motion.h"
#include "mesh_error/estimate.h"
#include "model/case.h"
#include "model/errors.h"
#include "model/variants.h"
#include "process/parallel.h"
#include "synchronous/parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::criterion {

namespace {

std::vector<model::CorrectionPlane> planes_of(const model::Case &scene) {
    std::vector<model::CorrectionPlane> planes = scene.rotor.planes;
    if (planes.empty())
        planes = scene.rotor.balancer_planes();
    if (planes.empty())
        throw model::BadInput(fmt::format(
            "{}: plane: expected at least one [[plane]] with its z, or a [[balancer]] whose plane "
            "counts, got neither",
            scene.file.string()));
    return planes;
}

model::SpeedRange checked_range(const model::Case &scene) {
    const model::SpeedRange &range = model::required_speeds(scene);
    if (range.from < 0 || (range.count > 1 && range.to <= range.from) ||
        (range.count == 1 && range.from <= 0))
        throw model::BadInput(
            fmt::format("{}: speeds: expected spin speeds from 0 up (one alone: above 0), got "
                        "from = {:.6g} rad/s, to = {:.6g} rad/s, count = {}",
                        scene.file.string(), range.from, range.to, range.count));
    return range;
}

/// Dampers that lock make other resonances: those of the rotor held at its damped bearings.
std::vector<model::Bearing> damped_of(std::vector<model::Bearing> bearings) {
    std::erase_if(bearings, [](const model::Bearing &bearing) {
        return std::ranges::all_of(bearing.rows, [](const auto &row) { return row.c.isZero(0); });
    });
    return bearings;
}

/// Every bearing has a symmetric stiffness that pushes back in every direction, and a symmetric
/// mass; nor does a torque couple x and y; else inertia counts would say nothing.
bool bearings_push_back(const model::Rotor &rotor) {
    if (rotor.shaft.axial_torque != 0)
        return false;
    const auto pushes_back = [](const Eigen::Matrix2d &k) {
        return model::symmetric(k) && !model::pushes_away(k);
    };
    return rotor.every_row([&](const model::BearingCoefficients &row) {
        return pushes_back(row.k) && pushes_back(row.kt) && model::symmetric(row.m);
    });
}

void append(std::vector<double> &list, const std::vector<double> &more) {
    list.insert(list.end(), more.begin(), more.end());
}

/// Speeds at which the bearings are read: the start, and with tables their rows and the end.
std::vector<double> reading_speeds(const BalanceScene &scene) {
    std::vector<double> speeds{scene.from};
    if (!scene.rotor.bearings_depend_on_speed())
        return speeds;
    for (const double row : synchronous::table_speeds(scene.rotor))
        if (row > scene.from && row < scene.to)
            speeds.push_back(row);
    if (scene.to > scene.from)
        speeds.push_back(scene.to);
    return speeds;
}

/// Resonances of the undamped forms of a damped rotor, or of one with bearing tables. One with
/// the bearings of one row counts as far as the neighbouring rows.
std::vector<double> hints_of(const BalanceScene &scene) {
    const model::Rotor undamped = model::with_conservative_supports(scene.rotor);
    const assembly::Discretization d(undamped, scene.order);
    const std::vector<double> speeds = reading_speeds(scene);
    const std::vector<assembly::Combination> places = deflections_at(d, scene.planes);
    const std::vector<assembly::Combination> locked =
        deflections_at(d, damped_of(scene.rotor.bearings));
    std::vector<double> hints;
    for (std::size_t k = 0; k < speeds.size(); ++k) {
        const double from = k == 0 ? scene.from : speeds[k - 1];
        const double to = k + 1 < speeds.size() ? speeds[k + 1] : scene.to;
        const UndampedRotor at_speed(d, undamped.bearings_isotropic(), speeds[k]);
        append(hints, at_speed.critical_speeds(from, to));
        append(hints, at_speed.pinned_critical_speeds(places, from, to));
        for (const assembly::Combination &place : places)
            append(hints, at_speed.pinned_critical_speeds({place}, from, to));
        if (!locked.empty())
            append(hints, at_speed.pinned_critical_speeds(locked, from, to));
    }
    std::ranges::sort(hints);
    return hints;
}

} // namespace

BalanceScene::BalanceScene(const model::Case &scene)
    : planes(planes_of(scene)), rotor(scene.rotor) {
    const model::SpeedRange range = checked_range(scene);
    speeds = range.values();
    to = range.count == 1 ? range.from : range.to;
    // At rest there is no criterion; this near to it nothing but zero speeds of a free rotor stand.
    from = range.count == 1 ? range.from : std::max(range.from, 1e-6 * range.to);
    rotor.balancers.clear();
    rotor.anisotropies.clear();
    rotor.planes = planes;
    body = rigid::rigid_body(rotor, from);
    model::Case bare = scene;
    bare.rotor = rotor;
    formulation = forced::response_formulation(bare);
    // It is judged by frequencies; a rotor that is not axisymmetric has but the one form.
    order = rotor.rotating_anisotropy() ? mesh_error::resolve_order(bare, formulation)
                                        : mesh_error::resolve_order_in_best_form(bare);
}

std::vector<double> BalanceScene::plane_positions() const {
    std::vector<double> z;
    for (const model::CorrectionPlane &plane : planes)
        z.push_back(plane.z);
    return z;
}

std::vector<results::BalanceBands *> bands_of_each(results::BalanceResult &result) {
    std::vector<results::BalanceBands *> all;
    for (results::BalancePlane &plane : result.planes)
        all.push_back(&plane.bands);
    if (result.planes.size() > 1)
        all.push_back(&result.joint.bands);
    return all;
}

BalanceBreakpoints balance_breakpoints(const BalanceScene &scene, const assembly::Discretization &d,
                                       bool undamped) {
    BalanceBreakpoints out;
    const bool planar = scene.rotor.bearings_isotropic();
    out.sharp =
        undamped && !scene.rotor.bearings_depend_on_speed() && bearings_push_back(scene.rotor);
    out.pinned.resize(scene.planes.size() + 1);
    if (!scene.has_range())
        return out;
    if (!out.sharp) {
        out.hints = hints_of(scene);
        return out;
    }
    const UndampedRotor form(d, planar, scene.from);
    const std::vector<assembly::Combination> places = deflections_at(d, scene.planes);
    out.critical = form.critical_speeds(scene.from, scene.to);
    for (std::size_t i = 0; i < places.size(); ++i)
        out.pinned[i] = form.pinned_critical_speeds({places[i]}, scene.from, scene.to);
    out.pinned.back() = form.pinned_critical_speeds(places, scene.from, scene.to);
    return out;
}

} // namespace whirl::criterion
