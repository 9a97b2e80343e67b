#include "report/common/words.h"

#include "report/common/text_width.h"
#include "results/balance.h"
#include "results/enum_name.h"
#include "results/formulation.h"
#include "results/model_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::report {

std::string with_powers(const std::string &text) {
    static const char *const raised[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    const auto digit = [&](std::size_t i) {
        return i < text.size() && text[i] >= '0' && text[i] <= '9';
    };
    std::string out;
    for (std::size_t i = 0; i < text.size();) {
        const bool sign = i + 1 < text.size() && (text[i + 1] == '+' || text[i + 1] == '-');
        if (text[i] != 'e' || i == 0 || !digit(i - 1) || !sign || !digit(i + 2) || !digit(i + 3)) {
            out += text[i++];
            continue;
        }
        // Of 1e+07 the power alone: the 1 stands at the start or behind what is no number.
        if (out.back() == '1' && (i < 2 || !(digit(i - 2) || text[i - 2] == '.')))
            out.pop_back();
        else
            out += "·";
        out += text[i + 1] == '-' ? "10⁻" : "10";
        for (i += 2; digit(i) && text[i] == '0' && digit(i + 1);)
            ++i;
        for (; digit(i); ++i)
            out += raised[text[i] - '0'];
    }
    return out;
}

std::string joined(const std::vector<std::string> &texts, const std::string &between) {
    return fmt::format("{}", fmt::join(texts, between));
}

std::string phase_convention(bool lag) {
    return lag ? "Phases count against the spin (lag)." : "Phases count with the spin (lead).";
}

std::vector<std::size_t> spread_over(std::size_t count, std::size_t most) {
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < std::min(count, most); ++i)
        places.push_back(count <= most ? i : most < 2 ? 0 : i * (count - 1) / (most - 1));
    return places;
}

std::string capitalized(std::string text) {
    if (!text.empty() && text.front() >= 'a' && text.front() <= 'z')
        text.front() = static_cast<char>(text.front() - 'a' + 'A');
    return text;
}

std::string title_of(const model::Case &scene) {
    return printable(scene.title.empty() ? scene.name : scene.title);
}

std::string place(const std::string &name, double z, const Units &units) {
    const std::string at = "z = " + units.text(Quantity::length, z);
    return name.empty() ? at : fmt::format("{} ({})", name, at);
}

std::string angles_text(const std::vector<double> &angles, const Units &units, const char *format,
                        const char *between) {
    return joined(angles, between, [&](double angle) {
        return fmt::format(fmt::runtime(format), units(Quantity::angle, angle));
    });
}

std::string angles_text(const std::vector<std::vector<double>> &angles, const Units &units,
                        const char *format) {
    return joined(angles, " | ",
                  [&](const auto &list) { return angles_text(list, units, format); });
}

std::string range_text(const std::vector<double> &speeds, const Units &units) {
    if (speeds.empty())
        return "no speed";
    if (speeds.size() == 1)
        return "at " + units.text(Quantity::speed, speeds.front());
    return units.text(model::Sentence(
        "{}, {} speeds", model::as::speed.range(speeds.front(), speeds.back()), speeds.size()));
}

std::string plane_text(std::optional<double> plane, const Units &units) {
    constexpr double near = 10 / degrees;
    if (!plane)
        return "";
    return std::abs(*plane) <= near ? "horizontal"
           : std::abs(*plane - pi / 2) <= near
               ? "vertical"
               : "in one plane, " + units.text(Quantity::angle, *plane, 3);
}

std::string whirl_text(results::Whirl whirl, std::optional<double> plane, const Units &units) {
    const std::string name = results::whirl_name(whirl);
    if (!plane)
        return name;
    const std::string direction = plane_text(plane, units);
    return whirl == results::Whirl::mixed ? direction : name + ", " + direction;
}

std::string heading(const model::Case &scene, const std::string &what) {
    return fmt::format("{}\n{}\n\n", title_of(scene), what);
}

std::string model_text(const results::ModelSummary &model, const Units &units) {
    if (model.none)
        return "\n" + model.formulation.why + "\n";
    return fmt::format("\nmodel: {} form, {} elements of order {}, {} unknowns, {}\n",
                       results::form_name(model.formulation.form), model.elements, model.order,
                       model.unknowns, units.text(Quantity::time, model.seconds, 3));
}

std::vector<std::string> note_lines(const std::vector<model::Sentence> &notes, const Units &units) {
    std::vector<std::string> lines;
    for (const model::Weight weight :
         {model::Weight::warning, model::Weight::usual, model::Weight::information})
        for (const model::Sentence &note : notes) {
            if (note.weight() != weight)
                continue;
            std::string line = (weight == model::Weight::warning ? "warning: " : "note: ") +
                               printable(units.text(note));
            if (std::ranges::find(lines, line) == lines.end())
                lines.push_back(std::move(line));
        }
    return lines;
}

std::string bands_text(const std::vector<results::Interval> &bands, const char *end, const char *to,
                       const char *between, const Units &units) {
    const std::string text = joined(bands, between, [&](const results::Interval &band) {
        return fmt::format(fmt::runtime(end), units(Quantity::speed, band.from)) + to +
               fmt::format(fmt::runtime(end), units(Quantity::speed, band.to));
    });
    return bands.empty() ? "none" : text;
}

std::string change_name(model::SweepChange change) {
    return results::enum_name(change, {"value", "factor", "shift"});
}

std::vector<std::string> entries_of(const model::SweepAxis &axis) {
    std::vector<std::string> paths;
    for (const model::SweptEntry &entry : axis.entries)
        paths.push_back(entry.path);
    return paths;
}

Json axis_json(const model::SweepAxis &axis, const Json &changes, const Units &units) {
    const auto &number = axis.dimensionless;
    return {{"path", axis.label},
            {"entries", entries_of(axis)},
            {"change", change_name(axis.change)},
            {"dimensionless", number ? Json(number->name) : Json()},
            {"balancer", number && number->balancer ? Json(*number->balancer) : Json()},
            {"values", written(units, axis.quantity, axis.values)},
            {"changes", number ? changes : Json()}}; // in SI, as numbers in the case file
}

std::string axis_name(const model::SweepAxis &axis) {
    const auto &number = axis.dimensionless;
    if (axis.is_speed())
        return number ? "Ω/ω₀" : axis.label;
    std::string name = axis.entries.size() > 1
                           ? fmt::format("{} and {} more", axis.label, axis.entries.size() - 1)
                           : axis.label;
    if (axis.change != model::SweepChange::value)
        name = fmt::format("{} of {}", change_name(axis.change), name);
    if (!number)
        return name;
    return fmt::format("{}{} (by {})", number->name,
                       number->balancer ? fmt::format(" of balancer[{}]", *number->balancer) : "",
                       name);
}

} // namespace whirl::report
