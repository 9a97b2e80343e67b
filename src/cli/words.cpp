#include "cli/words.h"

#include "results/formulation.h"
#include "results/model_summary.h"

#include <fmt/format.h>

namespace whirl::cli {

/// Ten digits: what the elements are made for. "-" for what is missing.
std::string precise(std::optional<double> value) {
    return value ? fmt::format("{:#.10g}", *value) : "-";
}
std::string readable(std::optional<double> value) {
    return value ? fmt::format("{:.6g}", *value) : "-";
}
std::string rough(std::optional<double> value) {
    return value ? fmt::format("{:.1e}", *value) : "-";
}
std::optional<double> times(std::optional<double> value, double factor) {
    return value ? std::optional(*value * factor) : std::nullopt;
}

std::string heading(const model::Case &scene, const std::string &what) {
    return fmt::format("{}\n{}\n\n", scene.title.empty() ? scene.name : scene.title, what);
}

std::string model_text(const results::ModelSummary &model) {
    std::string text =
        fmt::format("\nmodel: {} form ({})\n", results::form_name(model.formulation.form),
                    model.formulation.why);
    text +=
        fmt::format("       {} elements of {}, {} unknowns, {:.3g} s\n", model.elements,
                    model.order == 1 ? "the classical kind" : fmt::format("order {}", model.order),
                    model.unknowns, model.seconds);
    for (const std::string &note : model.notes)
        text += fmt::format("note: {}\n", note);
    return text;
}

/// One place of a rotor: its name, or where it is.
std::string place(const std::string &name, double z) {
    const std::string at = fmt::format("z = {:.6g} m", z);
    return name.empty() ? at : fmt::format("{} ({})", name, at);
}

/// "4000 rpm", "0 to 4000 rpm".
std::string range_text(const std::vector<double> &speeds) {
    if (speeds.empty())
        return "no speed";
    return speeds.size() == 1 ? fmt::format("at {:.6g} rpm", speeds.front() * rpm)
                              : fmt::format("{:.6g} to {:.6g} rpm, {} speeds", speeds.front() * rpm,
                                            speeds.back() * rpm, speeds.size());
}

} // namespace whirl::cli
