#include "cli/summary.h"

#include "cli/table.h"
#include "cli/words.h"

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

std::string speeds_text(const std::string &title, const std::vector<double> &speeds) {
    std::string text = title + ":";
    for (const double speed : speeds)
        text += fmt::format(" {}", precise(speed));
    return speeds.empty() ? "" : text + " rad/s\n";
}

} // namespace

std::string summary(const model::Case &scene, const analyses::StabilityResult &result) {
    std::string text = heading(scene, "Stability, " + range_text(result.speeds));
    text += bands_text("Unstable", result.unstable);
    text += speeds_text("Critical speeds, balls held", result.critical_speeds);
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
        Table table({"anisotropy at", "largest dI kg m2", "rigid closed form"});
        for (const auto &entry : result.permissible)
            table.add({place(entry.name, entry.z), precise(entry.dI), precise(entry.closed_form)});
        text += "\nPermissible inertial anisotropy over this range:\n" + table.text();
    }
    return text + model_text(result.model);
}

} // namespace whirl::cli
