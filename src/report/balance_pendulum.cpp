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
    {"z", OnPage("z", "{:.5g}"), Quantity::length, &PendulumBalance::z},
    {"rho", OnPage("ρ"), Quantity::number, &PendulumBalance::rho},
    {"threshold", OnPage("Threshold ratio"), Quantity::number, &PendulumBalance::threshold},
    {"limit", OnPage("Limit of n"), Quantity::number, &PendulumBalance::limit},
    {OnPage("M_Σ"), Quantity::mass, &PendulumBalance::mass},
    {OnPage("ω₀", "{:.8g}"), Quantity::frequency, &PendulumBalance::omega_0},
    {OnPage("H", "{:.5g}"), Quantity::number, &PendulumBalance::external_damping},
    {OnPage("h", "{:.5g}"), Quantity::number, &PendulumBalance::hinge_damping}};

const Columns<PendulumState> motion_columns{{"ratio", Quantity::number, &PendulumState::ratio},
                                            {"phi", Quantity::angle, &PendulumState::phi},
                                            {"psi", Quantity::angle, &PendulumState::psi},
                                            {"growth", Quantity::rate, &PendulumState::growth},
                                            {"stable", &PendulumState::stable},
                                            {"collision", &PendulumState::collision}};

const Columns<PendulumCurve> curve_columns{
    {"arm", Quantity::length, &PendulumCurve::arm},
    {"pivot", Quantity::length, &PendulumCurve::pivot},
    {"rho", Quantity::number, &PendulumCurve::rho},
    {"H", Quantity::number, &PendulumCurve::external_damping},
    {"speed_ratio", Quantity::number, &PendulumCurve::ratios},
    {"approximate", Quantity::number, &PendulumCurve::approximate},
    {"exact", Quantity::number, &PendulumCurve::exact},
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
    {"speeds", InText(""), Quantity::speed,
     [](const AtSpeed &at) { return at.of.speeds[at.index]; }},
    {"approximate", InText("n planar, small", "{:.4f}", "inf"), Quantity::number,
     [](const AtSpeed &at) { return at.of.approximate[at.index]; }},
    {"exact", InText("n on the shaft", "{:.4f}"), Quantity::number, least(&PendulumState::ratio)},
    {"stable", Quantity::number, least(&PendulumState::stable)},
    {InText("stable"),
     [](const AtSpeed &at) {
         const PendulumState &state = at.motions().front();
         return std::string(state.stable ? "yes" : "no") + (state.collision ? ", collide" : "");
     }},
    {"planar", Quantity::number, [](const AtSpeed &at) { return at.of.planar[at.index]; }},
    {"phi", Quantity::angle, least(&PendulumState::phi)},
    {"psi", Quantity::angle, least(&PendulumState::psi)},
    {"collision", Quantity::number, least(&PendulumState::collision)},
    {"motions", Quantity::number, [](const AtSpeed &at, const Units &units) {
         return json_rows(motion_columns, at.motions(), units);
     }}};

} // namespace

Json pendulum_json(const PendulumBalance &balancer, const Units &units) {
    std::vector<AtSpeed> speeds;
    for (std::size_t k = 0; k < balancer.speeds.size(); ++k)
        speeds.push_back({balancer, k});
    Json json = json_row(pendulum_columns, balancer, units);
    json["planar_equivalent"] = {{"mass", written(units, Quantity::mass, balancer.mass)},
                                 {"omega_0", written(units, Quantity::frequency, balancer.omega_0)},
                                 {"H", balancer.external_damping},
                                 {"h", balancer.hinge_damping}};
    json["efficiency"] = json_lists(efficiency_columns, speeds, units);
    json["designs"] = json_rows(curve_columns, balancer.designs, units);
    json["dampings"] = json_rows(curve_columns, balancer.dampings, units);
    return json;
}

std::string pendulum_page(const std::vector<PendulumBalance> &balancers, const Units &units) {
    return page_table(pendulum_columns, balancers, units);
}

std::string pendulum_text(const PendulumBalance &p, const Units &units) {
    std::vector<AtSpeed> some;
    const std::size_t step = p.speeds.size() > 12 ? p.speeds.size() / 10 : 1;
    for (std::size_t k = 0; k < p.speeds.size(); k += step)
        if (!p.states[k].empty())
            some.push_back({p, k});
    return fmt::format(
               "\nFour pendulums at z = {}: rho = {:.5g}, better than held above {} ({:.4g} of the "
               "resonance), at best 1/{:.3g} of the deflection\n",
               units.text(Quantity::length, p.z, 4), p.rho,
               units.text(Quantity::speed, p.threshold * p.omega_0), p.threshold, 1 / p.limit) +
           text_table(efficiency_columns, some, units);
}

} // namespace whirl::report
