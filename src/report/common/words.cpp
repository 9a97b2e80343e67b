#include "report/common/words.h"

#include "results/balance.h"
#include "results/formulation.h"
#include "results/model_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::report {

std::string readable(double value, int digits) {
    std::string text = fmt::format("{:.{}g}", value, digits);
    constexpr double long_number = 1e6;
    if (std::abs(value) < 1 || text.find('e') == std::string::npos)
        return text;
    const double rounded = std::stod(text);
    return std::abs(rounded) < long_number ? fmt::format("{:.0f}", rounded) : text; // 1230
}

std::string short_speed(double value) {
    return std::abs(value) < 1000 || std::abs(value) >= 1e6 ? readable(value, 4)
                                                            : fmt::format("{:.0f}", value);
}

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

std::string title_of(const model::Case &scene) {
    return scene.title.empty() ? scene.name : scene.title;
}

std::string place(const std::string &name, double z) {
    const std::string at = fmt::format("z = {:.6g} {}", z * metres, unit_name("length", "m"));
    return name.empty() ? at : fmt::format("{} ({})", name, at);
}

std::string place_text(const std::string &name, double z) {
    std::vector<std::string> parts;
    for (std::size_t from = 0; from < name.size();) {
        const std::size_t to = std::min(name.find(", ", from), name.size());
        const std::string part = name.substr(from, to - from);
        if (std::find(parts.begin(), parts.end(), part) == parts.end())
            parts.push_back(part);
        from = to + 2;
    }
    parts.push_back(fmt::format("z = {:.4g} {}", z * metres, unit_name("length", "m")));
    return joined(parts, ", ");
}

std::string range_text(const std::vector<double> &speeds) {
    if (speeds.empty())
        return "no speed";
    if (speeds.size() == 1)
        return fmt::format("at {:.6g} rpm", speeds.front() * rpm);
    return fmt::format("{:.6g} to {:.6g} rpm, {} speeds", speeds.front() * rpm, speeds.back() * rpm,
                       speeds.size());
}

std::string heading(const model::Case &scene, const std::string &what) {
    return fmt::format("{}\n{}\n\n", kept_as_written(title_of(scene)), what);
}

std::string model_text(const results::ModelSummary &model) {
    const std::string kind =
        model.order == 1 ? "the classical kind" : fmt::format("order {}", model.order);
    return fmt::format("\nmodel: {} form ({})\n       {} elements of {}, {} unknowns, {:.3g} s\n",
                       results::form_name(model.formulation.form), model.formulation.why,
                       model.elements, kind, model.unknowns, model.seconds) +
           notes_text(model);
}

std::string notes_text(const results::ModelSummary &model) {
    std::string text;
    const Units units = Units::of_readers(written_units());
    for (const model::Sentence &note : model.notes)
        text += fmt::format("note: {}\n", kept_as_written(units.text(note)));
    return text;
}

std::string bands_text(const std::vector<results::Interval> &bands, const char *end, const char *to,
                       const char *between, double factor) {
    const std::string text = joined(bands, between, [&](const results::Interval &band) {
        return fmt::format(fmt::runtime(end), band.from * factor) + to +
               fmt::format(fmt::runtime(end), band.to * factor);
    });
    return bands.empty() ? "none" : text;
}

} // namespace whirl::report
