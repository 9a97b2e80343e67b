#include "cli/summary.h"

#include "cli/summary_balance.h"
#include "cli/summary_show.h"
#include "cli/table.h"
#include "cli/words.h"
#include "results/accuracy.h"
#include "results/campbell.h"
#include "results/critical.h"
#include "results/formulation.h"
#include "results/modes.h"
#include "results/show.h"
#include "results/whirl.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::cli {

std::string summary(const model::Case &scene, const results::CampbellResult &result) {
    std::string text = heading(scene, "Campbell diagram, " + range_text(result.speeds));
    if (result.speeds.empty())
        return text + model_text(result.model);
    const std::size_t last = result.speeds.size() - 1;
    Table table({"mode", "rad/s", "Hz", "rpm", "damping ratio", "whirl", "error"});
    std::vector<results::CampbellMode> modes = result.modes; // as they stand at this speed
    std::stable_sort(modes.begin(), modes.end(), [last](const auto &a, const auto &b) {
        return a.frequency[last].value_or(0) < b.frequency[last].value_or(0);
    });
    for (const results::CampbellMode &mode : modes) {
        const std::optional<double> w = mode.frequency[last];
        table.add({mode.label, precise(w), readable(times(w, hertz)), readable(times(w, rpm)),
                   readable(mode.damping_ratio[last]), results::whirl_name(mode.whirl[last]),
                   rough(mode.error[last])});
    }
    text += fmt::format("Whirl modes at {:.6g} rpm ({:.6g} rad/s):\n{}", result.speeds[last] * rpm,
                        result.speeds[last], table.text());
    Table crossings({"line", "rpm", "rad/s", "Hz", "mode"});
    for (const results::Crossing &crossing : result.crossings)
        crossings.add({fmt::format("{:.6g}x", crossing.multiple), readable(crossing.speed * rpm),
                       precise(crossing.speed), readable(crossing.speed * hertz),
                       result.modes[static_cast<std::size_t>(crossing.mode)].label});
    if (!crossings.empty())
        text += fmt::format("\nCrossings with multiples of the spin speed:\n{}", crossings.text());
    return text + model_text(result.model);
}

std::string summary(const model::Case &scene, const results::CriticalResult &result) {
    std::string text = heading(scene, "Critical speeds");
    Table table({"", "rpm", "rad/s", "Hz", "whirl", "error"});
    int number = 0;
    for (const results::CriticalSpeed &critical : result.critical_speeds)
        table.add(
            {std::to_string(++number), readable(critical.speed * rpm), precise(critical.speed),
             readable(critical.speed * hertz), results::whirl_name(critical.whirl),
             rough(std::isfinite(critical.error) ? std::optional(critical.error) : std::nullopt)});
    text += table.empty() ? "  none found\n" : table.text();
    return text + model_text(result.model);
}

std::string summary(const model::Case &scene, const results::ModesResult &result) {
    std::string text = heading(scene, fmt::format("Mode shapes at {:.6g} rpm", result.speed * rpm));
    Table table({"mode", "rad/s", "Hz", "damping ratio", "whirl"});
    for (const results::ModeShape &mode : result.modes) {
        const double w = mode.eigenvalue.imag();
        const double modulus = std::abs(mode.eigenvalue);
        table.add({mode.label, precise(w), readable(w * hertz),
                   readable(modulus > 0 ? 0.0 - mode.eigenvalue.real() / modulus : 0.0),
                   results::whirl_name(mode.whirl)});
    }
    return text + table.text() + model_text(result.model);
}

std::string summary(const model::Case &scene, const results::ShowResult &result) {
    std::string text = heading(scene, fmt::format("A {} rotor", result.type));
    Table table({"mass", readable(result.mass) + " kg"});
    table.add({"of the shaft", readable(result.shaft_mass) + " kg"});
    table.add({"length", readable(result.length) + " m"});
    table.add({"centre of mass", "z = " + readable(result.center_of_mass) + " m"});
    table.add({"diametral inertia Id", readable(result.Id) + " kg m2"});
    table.add({"polar inertia Ip", readable(result.Ip) + " kg m2"});
    if (result.dI.value_or(0) > 0)
        table.add({"anisotropy dI", readable(*result.dI) + " kg m2"});
    text += table.text() + "\n" + rotating_parts_text(result);
    // Commands that use the same form for the same reason share a line.
    std::vector<std::pair<std::string, std::string>> forms;
    for (const auto &[command, formulation] : result.formulations) {
        const std::string what =
            fmt::format("{} form ({})", results::form_name(formulation.form), formulation.why);
        const auto same = std::find_if(forms.begin(), forms.end(),
                                       [&what](const auto &form) { return form.second == what; });
        if (same == forms.end())
            forms.emplace_back(command, what);
        else
            same->first += ", " + command;
    }
    for (const auto &[commands, what] : forms)
        text += fmt::format("  {}: {}\n", commands, what);
    for (const std::string &note : result.model.notes)
        text += fmt::format("note: {}\n", note);
    return text;
}

std::string summary(const model::Case &scene, const results::AccuracyResult &result) {
    std::string text = heading(scene, fmt::format("Speed and error at {:.6g} rpm, against {}",
                                                  result.speed * rpm, result.reference));
    Table table({"family", "order", "elements", "unknowns", "ms", "estimate", "true error"});
    for (const results::AccuracyRow &row : result.rows)
        table.add({row.family, std::to_string(row.order), std::to_string(row.elements),
                   std::to_string(row.unknowns), fmt::format("{:.3g}", row.seconds * 1e3),
                   rough(row.error_estimate), rough(row.true_error)});
    return text + table.text() + model_text(result.model);
}

std::string summary(const model::Case &scene, const results::BalanceResult &result) {
    return heading(scene, "Auto-balancing, " + range_text(result.speeds)) + balance_text(result) +
           model_text(result.model);
}

} // namespace whirl::cli
