#include "report/balance_pendulum.h"

#include "report/common/words.h"

#include <fmt/format.h>

namespace whirl::report {

using results::PendulumBalance;
using results::PendulumCurve;
using results::PendulumState;

namespace {

const Columns<PendulumBalance> pendulum_columns{
    {"name", &PendulumBalance::name},
    {"z", OnPage("z (m)", "{:.5g}"), &PendulumBalance::z},
    {"rho", OnPage("ρ"), &PendulumBalance::rho},
    {"threshold", OnPage("Threshold ratio"), &PendulumBalance::threshold},
    {"limit", OnPage("Limit of n"), &PendulumBalance::limit},
    {OnPage("M_Σ (kg)"), &PendulumBalance::mass},
    {OnPage("ω₀ (rad/s)", "{:.8g}"), &PendulumBalance::omega_0},
    {OnPage("H", "{:.5g}"), &PendulumBalance::external_damping},
    {OnPage("h", "{:.5g}"), &PendulumBalance::hinge_damping}};

const Columns<PendulumState> motion_columns{
    {"ratio", &PendulumState::ratio},   {"phi", &PendulumState::phi},
    {"psi", &PendulumState::psi},       {"growth", &PendulumState::growth},
    {"stable", &PendulumState::stable}, {"collision", &PendulumState::collision}};

const Columns<PendulumCurve> curve_columns{{"arm", &PendulumCurve::arm},
                                           {"pivot", &PendulumCurve::pivot},
                                           {"rho", &PendulumCurve::rho},
                                           {"H", &PendulumCurve::external_damping},
                                           {"speed_ratio", &PendulumCurve::ratios},
                                           {"approximate", &PendulumCurve::approximate},
                                           {"exact", &PendulumCurve::exact},
                                           {"stable", &PendulumCurve::stable}};

/// The balancer at one speed.
struct AtSpeed {
    const PendulumBalance &of;
    std::size_t index; ///< of the speed
    [[nodiscard]] const std::vector<PendulumState> &motions() const { return of.states[index]; }
};

/// An entry of the motion of least deflection, null where there is none.
template <class T> auto least(T PendulumState::*entry) {
    return [entry](const AtSpeed &at) {
        return at.motions().empty() ? Json() : Json(at.motions().front().*entry);
    };
}

/// The motion of least deflection fills the lists; all are in `motions`.
const Columns<AtSpeed> efficiency_columns{
    {"speeds", [](const AtSpeed &at) { return at.of.speeds[at.index]; }},
    {InText("rpm"), [](const AtSpeed &at) { return at.of.speeds[at.index] * rpm; }},
    {"approximate", InText("n planar, small", "{:.4f}", "inf"),
     [](const AtSpeed &at) { return at.of.approximate[at.index]; }},
    {"exact", InText("n on the shaft", "{:.4f}"), least(&PendulumState::ratio)},
    {"stable", least(&PendulumState::stable)},
    {InText("stable"),
     [](const AtSpeed &at) {
         const PendulumState &state = at.motions().front();
         return std::string(state.stable ? "yes" : "no") + (state.collision ? ", collide" : "");
     }},
    {"planar", [](const AtSpeed &at) { return at.of.planar[at.index]; }},
    {"phi", least(&PendulumState::phi)},
    {"psi", least(&PendulumState::psi)},
    {"collision", least(&PendulumState::collision)},
    {"motions", [](const AtSpeed &at) { return json_rows(motion_columns, at.motions()); }}};

} // namespace

Json pendulum_json(const PendulumBalance &balancer) {
    std::vector<AtSpeed> speeds;
    for (std::size_t k = 0; k < balancer.speeds.size(); ++k)
        speeds.push_back({balancer, k});
    Json json = json_row(pendulum_columns, balancer);
    json["planar_equivalent"] = {{"mass", balancer.mass},
                                 {"omega_0", balancer.omega_0},
                                 {"H", balancer.external_damping},
                                 {"h", balancer.hinge_damping}};
    json["efficiency"] = json_lists(efficiency_columns, speeds);
    json["designs"] = json_rows(curve_columns, balancer.designs);
    json["dampings"] = json_rows(curve_columns, balancer.dampings);
    return json;
}

std::string pendulum_page(const std::vector<PendulumBalance> &balancers) {
    return page_table(pendulum_columns, balancers);
}

std::string pendulum_text(const PendulumBalance &p) {
    std::vector<AtSpeed> some;
    const std::size_t step = p.speeds.size() > 12 ? p.speeds.size() / 10 : 1;
    for (std::size_t k = 0; k < p.speeds.size(); k += step)
        if (!p.states[k].empty())
            some.push_back({p, k});
    return fmt::format(
               "\nFour pendulums at z = {:.4g} m: rho = {:.5g}, better than held above {:.6g} rpm "
               "({:.4g} of the resonance), at best 1/{:.3g} of the deflection\n",
               p.z, p.rho, p.threshold * p.omega_0 * rpm, p.threshold, 1 / p.limit) +
           text_table(efficiency_columns, some);
}

} // namespace whirl::report
