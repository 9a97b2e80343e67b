#include "cli/summary.h"

#include "cli/table.h"
#include "cli/words.h"
#include "results/stability.h"

#include <fmt/format.h>

namespace whirl::cli {

namespace {

std::string bands_text(const std::string &title,
                       const std::vector<std::pair<double, double>> &bands) {
    if (bands.empty())
        return title + ": none in this range\n";
    Table table({"from rad/s", "to rad/s", "from rpm", "to rpm", "width rad/s"});
    for (const auto &[from, to] : bands)
        table.add({precise(from), precise(to), readable(from * rpm), readable(to * rpm),
                   readable(to - from)});
    return title + ":\n" + table.text();
}

/// Unstable bands with the errors of their ends.
std::string unstable_text(const results::StabilityResult &result) {
    if (result.unstable.empty())
        return "Unstable: none in this range\n";
    Table table({"from rad/s", "to rad/s", "from rpm", "to rpm", "width rad/s", "error of from",
                 "error of to"});
    for (std::size_t i = 0; i < result.unstable.size(); ++i) {
        const auto &[from, to] = result.unstable[i];
        const bool known = i < result.unstable_error.size();
        const auto error = known ? result.unstable_error[i] : std::pair(0.0, 0.0);
        table.add({precise(from), precise(to), readable(from * rpm), readable(to * rpm),
                   readable(to - from), rough(known ? std::optional(error.first) : std::nullopt),
                   rough(known ? std::optional(error.second) : std::nullopt)});
    }
    return "Unstable:\n" + table.text();
}

/// Of one speed: what becomes of a small motion there.
std::string verdict_text(const results::StabilityResult &result) {
    const std::string growth = readable(result.growth.front());
    switch (result.verdict.front()) {
    case results::Verdict::stable:
        return fmt::format("Stable: every motion dies out, the slowest with {} 1/s\n", growth);
    case results::Verdict::neutral:
        return "Neither stable nor unstable: no motion grows, some do not die out either (no "
               "damping)\n";
    case results::Verdict::unstable:
        return fmt::format("Unstable: a whirl grows with {} 1/s\n", growth);
    case results::Verdict::diverges:
        return fmt::format("Unstable: it diverges, a real root of +{} 1/s\n", growth);
    default:
        return "No answer at this speed\n";
    }
}

std::string speeds_text(const std::string &title, const std::vector<double> &speeds) {
    std::string text = title + ":";
    for (const double speed : speeds)
        text += fmt::format(" {}", precise(speed));
    return speeds.empty() ? "" : text + " rad/s\n";
}

} // namespace

std::string summary(const model::Case &scene, const results::StabilityResult &result) {
    std::string text = heading(scene, "Stability, " + range_text(result.speeds));
    text += result.speeds.size() == 1 ? verdict_text(result) : unstable_text(result);
    text += speeds_text("Critical speeds, balls held, undamped", result.critical_speeds);
    text += speeds_text("A root is zero at", result.zero_root_speeds);
    text +=
        speeds_text("Additional speeds (rotor pinned at the balancers)", result.additional_speeds);
    if (result.family) {
        const auto &family = *result.family;
        text += "\n" + bands_text(fmt::format("Unstable with some of {} arrangements of the balls",
                                              family.arrangements),
                                  family.unstable);
        text += bands_text("Unstable with every arrangement", family.always_unstable);
        text += bands_text("Critical speeds over the arrangements", family.critical_speeds);
    }
    if (!result.permissible.empty()) {
        Table table(
            {"anisotropy at", "largest dI kg m2", "most there can be", "rigid closed form"});
        for (const auto &entry : result.permissible)
            table.add({place(entry.name, entry.z),
                       entry.dI ? precise(entry.dI) : "stable up to the most", precise(entry.most),
                       precise(entry.closed_form)});
        text += "\nPermissible inertial anisotropy over this range:\n" + table.text();
    }
    return text + model_text(result.model);
}

} // namespace whirl::cli
