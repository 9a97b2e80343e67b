#include "cli/summary_simulate.h"

#include "cli/table.h"

#include <fmt/format.h>

#include <numbers>

namespace whirl::cli {

namespace {

constexpr double rpm = 30 / std::numbers::pi;
constexpr double degree = std::numbers::pi / 180;

std::string angles_text(const std::vector<double> &angles) {
    std::string text;
    for (const double angle : angles)
        text += fmt::format("{}{:.2f}", text.empty() ? "" : " ", angle / degree);
    return text;
}

} // namespace

std::string summary(const model::Case &scene, const results::SimulateResult &result) {
    std::string text =
        fmt::format("{}\nMotion in time, {:.6g} s, {:.6g} revolutions, {:.6g} rpm at the end\n\n",
                    scene.title.empty() ? scene.name : scene.title, result.time, result.revolutions,
                    result.speed * rpm);
    text +=
        fmt::format("Outcome: {}\n  {}\n", results::outcome_name(result.outcome), result.evidence);
    if (result.residual_ratio)
        text +=
            fmt::format("  left of the amplitude without balls: {:.4g}\n", *result.residual_ratio);
    if (result.linear_growth)
        text += fmt::format("  by its eigenvalues the balanced position is {}: {:.4g} 1/s\n",
                            *result.linear_growth > 0 ? "unstable, small motions grow" : "stable",
                            *result.linear_growth);
    if (result.decision_time)
        text += fmt::format("  a motion of {:.3g} s would decide\n", *result.decision_time);
    Table table({"balancer", "kind", "capacity E", "amplitude m", "without balls m",
                 "final angles in the rotor, deg"});
    for (const results::BalancerMotion &b : result.balancers)
        table.add({b.name.empty() ? fmt::format("z = {:.6g} m", b.z) : b.name, b.kind,
                   b.capacity ? fmt::format("{:.4g}", *b.capacity) : "-",
                   fmt::format("{:.4g}", b.amplitude), fmt::format("{:.4g}", b.reference),
                   angles_text(b.angles)});
    text += "\n" + table.text();
    for (const results::OtherStart &start : result.other_starts)
        text += fmt::format(
            "from another start ({}): {}{}\n", angles_text(start.start_angles),
            results::outcome_name(start.outcome),
            start.residual_ratio ? fmt::format(", residual {:.4g}", *start.residual_ratio) : "");
    const results::MotionAudit &audit = result.audit;
    text += fmt::format("\nmodel: {} shapes of the shaft with its lowest {} modes (order {}, {} "
                        "elements); relative error by it {:.1e} in response, {:.1e} in whirl "
                        "speeds\n",
                        result.shapes, result.modes, result.model.order, result.model.elements,
                        result.response_error, result.frequency_error);
    text +=
        fmt::format("       {}, {} steps, {:.3g} s; energy missing {:.1e} J of {:.3g} J, angular "
                    "momentum {:.1e} of {:.3g} kg m2/s\n",
                    result.integrator, result.steps, result.model.seconds, audit.energy_error,
                    audit.energy_scale, audit.momentum_error, audit.momentum_scale);
    for (const std::string &note : result.model.notes)
        text += fmt::format("note: {}\n", note);
    return text;
}

} // namespace whirl::cli
