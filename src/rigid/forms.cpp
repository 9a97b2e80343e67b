#include "rigid/forms.h"

#include "balancers/arrangement.h"
#include "closed_form/composite_rotor_equations.h"
#include "closed_form/rigid_rotor_criterion.h"
#include "model/errors.h"
#include "rigid/anisotropy.h"
#include "rigid/projection.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace whirl::rigid {

namespace {

/// Of the composite rotor, balancers at their balanced position.
Inertia inertia_at_balance(const model::Rotor &rotor) {
    Inertia sum = inertia_of(rotor);
    for (const balancers::BalancerElement &element :
         balancers::balancer_elements(rotor, balancers::arrangement_at_balance(rotor)))
        sum.a += element.anisotropy;
    // What balls and imbalance leave of each other by rounding is no anisotropy.
    if (std::abs(sum.a) < 1e-14 * sum.polar)
        sum.a = 0;
    return sum;
}

/// Bearings about the centre of mass of the whole: the projection is about that of the rotor
/// without balancers.
closed_form::RotatingCoefficients coefficients_of(const Inertia &whole, const RigidRotor &body) {
    const double shift = body.center - whole.center(); // w_body = w + shift phi
    closed_form::RotatingCoefficients c;
    c.mass = whole.mass;
    c.mean_inertia = whole.diametral();
    c.polar_inertia = whole.polar;
    c.anisotropy = whole.a;
    const closed_form::ReducedSupports &s = body.supports;
    c.supports.c_x = s.c_x;
    c.supports.c_y = s.c_y + shift * s.c_x;
    c.supports.c_beta = s.c_beta + 2 * shift * s.c_y + shift * shift * s.c_x;
    c.supports.h_x = s.h_x;
    c.supports.h_y = s.h_y + shift * s.h_x;
    c.supports.h_beta = s.h_beta + 2 * shift * s.h_y + shift * shift * s.h_x;
    return c;
}

closed_form::TwoSupportRotor two_supports(const closed_form::RotatingCoefficients &c) {
    return {c.mass,         c.mean_inertia, c.polar_inertia,
            c.supports.c_x, c.supports.c_y, c.supports.c_beta};
}

/// Targets from ascending values; of equal ones the first, whose counterpart is farthest off.
void add_ascending(std::vector<RigidTarget> &targets, RigidTarget like,
                   const std::vector<double> &values) {
    std::vector<int> different;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (i == 0 || values[i] - values[i - 1] > 1e-9 * values[i])
            different.push_back(static_cast<int>(i));
    const results::Sentence name = like.quantity;
    for (const int &i : different) {
        like.index = i;
        like.closed_form = values[static_cast<std::size_t>(i)];
        if (different.size() > 1)
            like.quantity = results::Sentence("{} {}", name, &i - different.data() + 1);
        targets.push_back(like);
    }
}

/// With the multiplicity they have in the model: in its rotating form, of twice the size, each of
/// the two principal planes brings its own, even where they are equal.
std::vector<double> criticals_of(const closed_form::RotatingCoefficients &c, bool rotating) {
    return rotating ? closed_form::critical_speeds(c) : closed_form::resonances(two_supports(c));
}

/// Planes of correction, or the balancers where the case names none.
std::vector<std::pair<results::Sentence, double>> planes_of(const model::Rotor &rotor) {
    std::vector<std::pair<results::Sentence, double>> planes;
    const auto add = [&planes](const auto &items) {
        for (const auto &item : items)
            planes.emplace_back(item.name.empty()
                                    ? results::Sentence("z = {}", results::as::length(item.z))
                                    : results::Sentence("{}", item.name),
                                item.z);
    };
    if (rotor.planes.empty())
        add(rotor.balancer_planes());
    else
        add(rotor.planes);
    return planes;
}

void add_additional(std::vector<RigidTarget> &targets, closed_form::RotatingCoefficients c,
                    const Inertia &whole, const model::Rotor &rotor) {
    for (const auto &[name, z] : planes_of(rotor)) {
        c.balancer_position = z - whole.center();
        RigidTarget target;
        target.kind = RigidQuantity::additional;
        target.quantity = results::Sentence("additional speed, pinned at {}", name);
        target.z = z;
        if (rotor.rotating_anisotropy())
            add_ascending(targets, target, closed_form::additional_speeds(c));
        else if (const auto speed =
                     closed_form::additional_speed(two_supports(c), c.balancer_position))
            add_ascending(targets, target, {*speed});
    }
}

/// Place of a value in an ascending list that contains it.
int place_of(double value, const std::vector<double> &ascending) {
    const auto nearest = std::ranges::min_element(ascending, [value](double a, double b) {
        return std::abs(a - value) < std::abs(b - value);
    });
    return static_cast<int>(nearest - ascending.begin());
}

/// Ends of the unstable range of a rotor whose tilt does not move its centre of mass.
void add_unstable(RigidForms &forms, const closed_form::RotatingCoefficients &c) {
    // Relative, of what must cancel for tilt and translation to be apart.
    constexpr double rounding = 1e-9;
    if (!tilts_alone(c.supports, rounding)) {
        forms.notes.emplace_back("no closed form of the unstable range: the bearings are not "
                                 "symmetric about the centre of mass");
        return;
    }
    closed_form::AnisotropicRotor tilt = closed_form::tilt_rotor(c);
    const auto band = closed_form::unstable_band(tilt);
    if (!band) {
        forms.notes.emplace_back("as a rigid rotor it is stable at every speed");
        return;
    }
    const std::vector<double> all = criticals_of(c, true);
    const std::vector<double> of_tilt = closed_form::critical_speeds(tilt);
    RigidTarget target;
    target.kind = RigidQuantity::unstable_from;
    target.quantity = band->to ? "unstable range, lower end" : "unstable above";
    target.closed_form = band->from;
    target.index = place_of(of_tilt.front(), all);
    if (band->to)
        target.upper = place_of(of_tilt.back(), all);
    forms.targets.push_back(target);
    if (!band->to)
        return;
    target.kind = RigidQuantity::unstable_to;
    target.quantity = "unstable range, upper end";
    target.closed_form = *band->to;
    forms.targets.push_back(target);
}

void add_permissible(RigidForms &forms, const model::Case &scene) {
    if (!scene.speeds || scene.speeds->count < 2)
        return;
    const auto dI = rigid_permissible_anisotropy(scene.rotor, scene.speeds->from, scene.speeds->to);
    if (!dI || !std::isfinite(*dI) || !(*dI > 1e-9 * forms.inertia.diametral()))
        return;
    RigidTarget target;
    target.kind = RigidQuantity::permissible;
    target.quantity = "permissible anisotropy";
    target.of = model::Quantity::inertia;
    target.closed_form = *dI;
    std::tie(target.from, target.to) = model::range_of_moduli(scene.speeds->from, scene.speeds->to);
    forms.targets.push_back(target);
}

} // namespace

model::Case rigid_limit_scene(const model::Case &scene, std::vector<results::Sentence> &notes) {
    model::Case out = scene;
    if (scene.rotor.shaft.damped_outside())
        throw model::AnalysisFailure("the rigid rotor has no closed form: the shaft has damping of "
                                     "its own (alpha, beta or modal_damping)");
    if (scene.rotor.shaft.axial_torque != 0)
        throw model::AnalysisFailure("the rigid rotor has no closed form: the shaft carries an "
                                     "axial torque");
    bool tables = false;
    for (std::size_t i = 0; i < out.rotor.bearings.size(); ++i) {
        model::Bearing &bearing = out.rotor.bearings[i];
        const std::size_t others = out.rotor.supports().size();
        const std::string place =
            fmt::format("the rigid rotor has no closed form: {}[{}] ",
                        bearing.seal ? "seal" : "bearing", bearing.seal ? i - others : i);
        if (bearing.has_mass())
            throw model::AnalysisFailure(place + "has mass");
        if (bearing.pedestal)
            throw model::AnalysisFailure(place + "stands on a pedestal");
        tables = tables || bearing.depends_on_speed();
        bearing.rows = {bearing.at(0)};
        bearing.speeds.clear();
    }
    for (std::size_t i = 0; i < out.rotor.bearings.size(); ++i) {
        model::Rotor one;
        one.bearings = {out.rotor.bearings[i]};
        if (!one.bearings_isotropic())
            throw model::AnalysisFailure(fmt::format(
                "the rigid rotor has no closed form: bearing[{}] differs between x and y or "
                "couples them",
                i));
    }
    if (tables)
        notes.emplace_back(model::Weight::information,
                           "bearing tables are read at zero speed in both models");
    return out;
}

RigidForms rigid_forms(const model::Case &scene) {
    const model::Rotor &rotor = scene.rotor;
    const auto body = rigid_projection(rotor);
    if (!body)
        throw model::AnalysisFailure("the rigid rotor has no closed form with these bearings");
    RigidForms forms;
    forms.inertia = inertia_at_balance(rotor);
    forms.bearing_stiffness = body->supports.c_x;
    const closed_form::RotatingCoefficients c = coefficients_of(forms.inertia, *body);
    const auto &s = c.supports;
    if (!(s.c_x > 0) || !(s.c_beta > 0) ||
        s.c_x * s.c_beta - s.c_y * s.c_y <= 1e-12 * s.c_x * s.c_beta)
        throw model::AnalysisFailure(
            "the rigid rotor has no critical speeds to compare with: the bearings leave it free to "
            "move or to tilt");
    closed_form::TwoSupportRotor whole = two_supports(c);
    whole.anisotropy = std::abs(c.anisotropy);
    forms.omega_0 = std::sqrt(whole.k11 / whole.mass);
    forms.partial_frequencies = closed_form::partial_frequencies(whole);
    forms.z_max = closed_form::farthest_plane(whole);
    RigidTarget critical;
    critical.quantity =
        rotor.balancers.empty() ? "forward critical speed" : "critical speed with balancers held";
    add_ascending(forms.targets, critical, criticals_of(c, rotor.rotating_anisotropy()));
    add_additional(forms.targets, c, forms.inertia, rotor);
    if (std::abs(c.anisotropy) > 0 && rotor.balancers.empty()) {
        add_unstable(forms, c);
        add_permissible(forms, scene);
    }
    if (rotor.damped())
        forms.notes.emplace_back(model::Weight::information,
                                 "critical and additional speeds are undamped in both models");
    return forms;
}

} // namespace whirl::rigid
