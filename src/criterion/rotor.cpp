#include "criterion/rotor.h"

#include "forced/forced_motion.h"
#include "mesh_error/estimate.h"
#include "model/case.h"
#include "model/errors.h"
#include "model/variants.h"
#include "modes/formulation.h"
#include "process/parallel.h"
#include "rigid/inertia.h"
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
            "{}: plane: missing, expected at least one [[plane]] to balance in, as z = 0.5, or a "
            "[[balancer]], whose plane counts",
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

/// The series in twice the spin speed has settled where twice the terms change the criterion by
/// less than this share of itself. Looked at over the whole range, and on the median: beside a
/// resonance, which more terms move a little, it changes by more, and the errors of band ends say
/// how much.
int settled_harmonics(const BalanceScene &scene) {
    constexpr double settled = 1e-10; // of the criterion: far below what its ends are known to
    constexpr int probed = 17;        // speeds of the range
    constexpr int most = 32;          // harmonics: beyond, the series is said not to settle
    const assembly::Discretization d(scene.rotor, scene.order);
    const std::vector<assembly::Combination> places = deflections_at(d, scene.planes);
    std::vector<double> speeds{scene.to};
    if (scene.has_range())
        speeds = model::SpeedRange{scene.from, scene.to, probed}.values();
    const auto forms = [&](int harmonics) {
        synchronous::ForwardReceptance receptance(d, results::Form::hill, places, harmonics);
        std::vector<Eigen::MatrixXcd> out;
        for (const double speed : speeds)
            out.push_back(synchronous::hermitian_part(receptance.at(speed)));
        return out;
    };
    std::vector<Eigen::MatrixXcd> before = forms(1);
    for (int harmonics = 1; harmonics < most; harmonics *= 2) {
        std::vector<Eigen::MatrixXcd> with = forms(2 * harmonics);
        std::vector<double> changes;
        for (std::size_t k = 0; k < with.size(); ++k)
            changes.push_back((with[k] - before[k]).norm() / with[k].norm());
        const auto median = changes.begin() + static_cast<std::ptrdiff_t>(changes.size() / 2);
        std::nth_element(changes.begin(), median, changes.end());
        if (*median < settled)
            return harmonics;
        before = std::move(with);
    }
    throw model::AnalysisFailure("the Hill series of a rotor that is not axisymmetric on "
                                 "anisotropic bearings does not settle at these speeds; raise "
                                 "speeds.from");
}

/// Of a rotor that is not axisymmetric that of the motions in rotating axes, on bearings that
/// differ between their directions the series.
results::Formulation criterion_formulation(const model::Case &bare) {
    return bare.rotor.rotating_anisotropy() ? modes::choose_formulation(bare)
                                            : forced::response_formulation(bare);
}

} // namespace

BalanceScene::BalanceScene(const model::Case &scene)
    : planes(planes_of(scene)), rotor(scene.rotor) {
    const model::SpeedRange range = checked_range(scene);
    speeds = range.values();
    to = range.count == 1 ? range.from : range.to;
    from = range.count == 1 ? range.from : std::max(range.from, least_speed(range));
    rotor.balancers.clear();
    rotor.planes = planes;
    body = rigid::rigid_body(rotor, from);
    anisotropy = std::abs(rigid::inertia_of(rotor).a);
    model::Case bare = scene;
    bare.rotor = rotor;
    formulation = criterion_formulation(bare);
    // It is judged by frequencies; a rotor that is not axisymmetric has but the one form.
    order = rotor.rotating_anisotropy() ? mesh_error::resolve_order(bare, formulation)
                                        : mesh_error::resolve_order_in_best_form(bare);
    if (formulation.form == results::Form::hill)
        harmonics = settled_harmonics(*this);
}

std::vector<double> BalanceScene::plane_positions() const {
    std::vector<double> z;
    for (const model::CorrectionPlane &plane : planes)
        z.push_back(plane.z);
    return z;
}

BalanceForm BalanceScene::form_at_planes(const assembly::Discretization &d) const {
    return {d, formulation.form, deflections_at(d, planes), plane_positions(), harmonics};
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
    out.sharp =
        undamped && !scene.rotor.bearings_depend_on_speed() && bearings_push_back(scene.rotor);
    out.pinned.resize(scene.planes.size() + 1);
    if (!scene.has_range())
        return out;
    if (!out.sharp)
        return out;
    const UndampedRotor form(d, scene.formulation.form, scene.from, scene.harmonics);
    const std::vector<assembly::Combination> places = deflections_at(d, scene.planes);
    out.critical = form.critical_speeds(scene.from, scene.to);
    for (std::size_t i = 0; i < places.size(); ++i)
        out.pinned[i] = form.pinned_critical_speeds({places[i]}, scene.from, scene.to);
    out.pinned.back() = form.pinned_critical_speeds(places, scene.from, scene.to);
    return out;
}

} // namespace whirl::criterion
