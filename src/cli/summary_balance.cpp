#include "cli/summary_balance.h"

#include "cli/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

namespace whirl::cli {

namespace {

constexpr double rpm = 30 / std::numbers::pi; // rev/min in one rad/s

std::string bands_text(const std::vector<results::SpeedBand> &bands, double factor) {
    std::string text;
    for (const auto &band : bands)
        text += fmt::format("{}{:.6g} to {:.6g}", text.empty() ? "" : ", ", band.from * factor,
                            band.to * factor);
    return text.empty() ? "none" : text;
}

/// Largest error of an end.
std::string errors_text(const results::BalanceBands &of) {
    double largest = 0;
    for (const auto &[at_from, at_to] : of.errors) {
        if (!at_from || !at_to)
            return "not known";
        largest = std::max({largest, *at_from, *at_to});
    }
    return of.errors.empty() ? "-" : fmt::format("{:.1e}", largest);
}

void add(Table &table, const std::string &name, const results::BalanceBands &of) {
    table.add({name, bands_text(of.bands, rpm), bands_text(of.bands, 1), errors_text(of),
               of.rigid_bands ? bands_text(*of.rigid_bands, 1) : "-"});
}

std::string placement_text(const results::Placement &map) {
    std::string text = "\nBest places for all speeds of the range:\n";
    for (const auto &[name, place] :
         {std::pair("one plane ", &map.best), std::pair("two planes", &map.best_pair)}) {
        if (place->share <= 0) {
            text += fmt::format("  {}: nowhere\n", name);
            continue;
        }
        std::string z;
        for (const double at : place->z)
            z += fmt::format("{}{:.4g}", z.empty() ? "" : " and ", at);
        text += fmt::format("  {}: z = {} m, balances {:.1f} % of the speeds, margin {:.3f}\n",
                            name, z, 100 * place->share, place->margin);
    }
    return text;
}

std::string pendulum_text(const results::PendulumBalance &p) {
    std::string text = fmt::format(
        "\nFour pendulums at z = {:.4g} m: rho = {:.5g}, better than held above {:.6g} rpm "
        "({:.4g} of the resonance), at best 1/{:.3g} of the deflection\n",
        p.z, p.rho, p.threshold * p.omega_0 * rpm, p.threshold, 1 / p.limit);
    Table table({"rpm", "n planar, small", "n on the shaft", "stable"});
    const std::size_t step = p.speeds.size() > 12 ? p.speeds.size() / 10 : 1;
    for (std::size_t k = 0; k < p.speeds.size(); k += step) {
        if (p.states[k].empty())
            continue;
        const auto &state = p.states[k].front();
        table.add(
            {fmt::format("{:.6g}", p.speeds[k] * rpm), fmt::format("{:.4f}", p.approximate[k]),
             fmt::format("{:.4f}", state.ratio),
             std::string(state.stable ? "yes" : "no") + (state.collision ? ", collide" : "")});
    }
    return text + table.text();
}

} // namespace

std::string balance_text(const results::BalanceResult &result) {
    Table table({"planes", "balanced, rpm", "rad/s", "error, rad/s", "rigid closed form, rad/s"});
    for (std::size_t i = 0; i < result.planes.size(); ++i)
        add(table,
            fmt::format("{} z = {:.4g} m",
                        result.planes[i].name.empty() ? std::to_string(i + 1)
                                                      : result.planes[i].name,
                        result.planes[i].z),
            result.planes[i].bands);
    if (result.planes.size() > 1)
        add(table, "all together", result.joint.bands);
    if (result.balanced_position)
        table.add({"real balancers, stable", bands_text(result.balanced_position->bands, rpm),
                   bands_text(result.balanced_position->bands, 1), "-", "-"});
    std::string text = table.text();
    for (const auto &run : result.simulated)
        text += fmt::format(
            "  motion in time at {:.6g} rpm: {}{}\n", run.speed * rpm, run.outcome,
            run.residual_ratio ? fmt::format(", residual {:.3g}", *run.residual_ratio) : "");
    if (!result.findings.empty())
        text += "\n";
    for (const std::string &finding : result.findings)
        text += finding + "\n";
    if (result.placement)
        text += placement_text(*result.placement);
    for (const auto &pendulum : result.pendulum)
        text += pendulum_text(pendulum);
    return text;
}

} // namespace whirl::cli
