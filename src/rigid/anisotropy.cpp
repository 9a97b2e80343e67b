#include "rigid/anisotropy.h"

#include "closed_form/anisotropic_rotor.h"
#include "model/case.h"
#include "rigid/composite_rotor.h"
#include "rigid/projection.h"

#include <algorithm>
#include <cmath>

namespace whirl::rigid {

namespace {

constexpr int speed_steps = 400; ///< of a figure's axis
constexpr int polar_steps = 600; ///< of a figure's axis: smooth

std::string reason_against(const model::Rotor &rotor, const Inertia &whole,
                           closed_form::ReducedSupports &supports) {
    if (!rotor.balancers.empty())
        return "the balls of a balancer move";
    std::string why;
    const auto reduced = reduced_supports(rotor, whole.center(), why);
    if (!reduced)
        return why;
    supports = *reduced;
    if (!tilts_alone(supports, 1e-6)) // positions and coefficients are inputs with seven digits
        return "the bearings are not symmetric about the centre of mass";
    if (!(supports.c_beta > 0))
        return "no bearing resists tilting";
    return "";
}

std::optional<results::ChartBand> band_of(const closed_form::AnisotropicRotor &rotor) {
    const auto band = closed_form::unstable_band(rotor);
    if (!band)
        return std::nullopt;
    return results::ChartBand{band->from, band->to};
}

/// A speed that leaves the critical speeds and the unstable band well in sight; near the spherical
/// rotor they run off to infinity.
double largest_speed(const results::AnisotropyChart &chart) {
    double speed = 3 * chart.p;
    if (!chart.critical_speeds.empty())
        speed = std::max(speed, 1.5 * chart.critical_speeds.back());
    if (chart.unstable)
        speed = std::max(speed, 1.5 * chart.unstable->to.value_or(2 * chart.unstable->from));
    return std::min(speed, 10 * chart.p);
}

void add_curves_over_anisotropy(results::AnisotropyChart &chart,
                                closed_form::AnisotropicRotor rotor) {
    const double to = largest_speed(chart);
    for (int i = 1; i <= speed_steps; ++i) {
        const double speed = to * i / speed_steps;
        chart.speed.push_back(speed);
        rotor.damping = chart.h;
        chart.limit.push_back(closed_form::permissible_anisotropy(rotor, speed));
        rotor.damping = 0;
        chart.undamped.push_back(closed_form::permissible_anisotropy(rotor, speed));
    }
}

void add_curves_over_polar_inertia(results::AnisotropyChart &chart,
                                   closed_form::AnisotropicRotor rotor) {
    // From a slender rotor to one beyond the last critical speed, C = 1 + a; a body has C <= 2.
    const double from = std::max(0.0, std::min(0.4, chart.C - 0.1));
    const double to = std::min(2.0, std::max(chart.C, 1 + chart.anisotropy) + 0.15);
    for (int i = 0; i <= polar_steps; ++i) {
        rotor.polar_inertia = from + (to - from) * i / polar_steps;
        chart.polar.push_back(rotor.polar_inertia);
        chart.critical_over_polar.push_back(closed_form::critical_speeds(rotor));
        chart.unstable_over_polar.push_back(band_of(rotor));
    }
}

} // namespace

std::optional<results::AnisotropyChart> anisotropy_chart(const model::Rotor &rotor,
                                                         const Inertia &whole,
                                                         std::vector<results::Sentence> &notes) {
    if (rotor.anisotropies.empty())
        return std::nullopt;
    closed_form::ReducedSupports supports;
    const std::string why = reason_against(rotor, whole, supports);
    if (!why.empty()) {
        notes.emplace_back("no chart of critical speeds and stability over the anisotropy: {}",
                           why);
        return std::nullopt;
    }
    const double A = whole.diametral();
    results::AnisotropyChart chart;
    chart.C = whole.polar / A;
    chart.anisotropy = std::abs(anisotropy_of(rotor, {}).value()) / A;
    chart.p = std::sqrt(supports.c_beta / A);
    chart.h = supports.h_beta / A;
    const closed_form::AnisotropicRotor rigid{chart.C, chart.anisotropy, chart.p, chart.h};
    chart.critical_speeds = closed_form::critical_speeds(rigid);
    chart.unstable = band_of(rigid);
    const closed_form::PermissibleAnisotropy permissible =
        closed_form::permissible_anisotropy(rigid);
    chart.permissible = permissible.anisotropy;
    chart.permissible_speed = permissible.spin_speed;
    add_curves_over_anisotropy(chart, rigid);
    add_curves_over_polar_inertia(chart, rigid);
    return chart;
}

std::optional<double> rigid_permissible_anisotropy(const model::Rotor &rotor, double from,
                                                   double to) {
    if (!rotor.balancers.empty() || rotor.anisotropies.size() != 1 || rotor.shaft.asymmetric() ||
        rotor.bearings_depend_on_speed())
        return std::nullopt;
    const std::optional<RigidRotor> body = rigid_projection(rotor);
    if (!body || body->supports.c_beta <= 0 || !tilts_alone(body->supports, 1e-9))
        return std::nullopt;
    const closed_form::AnisotropicRotor tilt{body->C / body->A, 0,
                                             std::sqrt(body->supports.c_beta / body->A),
                                             body->supports.h_beta / body->A};
    const auto [least, largest] = model::range_of_moduli(from, to);
    return body->A * closed_form::permissible_anisotropy(tilt, least, largest).anisotropy;
}

} // namespace whirl::rigid
