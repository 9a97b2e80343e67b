// Report of the command campbell.

#include "results/campbell.h"

#include "report/common/csv.h"
#include "report/common/error_parts.h"
#include "report/common/words.h"
#include "report/pictures/figures.h"
#include "report/reports.h"
#include "report/sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace whirl::report {

using results::CampbellMode;
using results::CampbellResult;
using results::Crossing;
using results::Locked;

namespace {

/// A mode at one speed.
struct ModeAt {
    double speed; ///< rad/s
    const CampbellMode *mode;
    std::size_t index; ///< of the speed

    [[nodiscard]] std::optional<double> frequency() const { return mode->frequency.at(index); }
    [[nodiscard]] std::string whirl(const Units &units) const {
        return whirl_text(mode->whirl.at(index), plane(), units);
    }
    [[nodiscard]] std::optional<double> plane() const {
        return index < mode->plane.size() ? mode->plane[index] : std::nullopt;
    }
};

/// The entry of a list of the mode.
template <class List> auto entry_of(List CampbellMode::*list) {
    return [list](const ModeAt &at) { return (at.mode->*list).at(at.index); };
}

/// One of the parts of the error.
auto part(double results::ErrorParts::*which) {
    return [which](const ModeAt &at) {
        const std::optional<results::ErrorParts> &parts = at.mode->error_parts.at(at.index);
        return parts ? std::optional((*parts).*which) : std::nullopt;
    };
}

/// The frequency, or why there is none.
Json frequency_or_why(const ModeAt &at) {
    return at.frequency() ? Json(*at.frequency()) : Json(at.mode->absent.at(at.index));
}

const Columns<ModeAt> mode_columns = with_error_parts<ModeAt>(
    {{InCsv("speed"), Quantity::speed, &ModeAt::speed},
     {InCsv("mode"), Titled("Mode"), [](const auto &at) { return at.mode->label; }},
     {InFiles("frequency"), InText("").and_si(precise), Quantity::frequency, &ModeAt::frequency},
     {OnPage("Frequency", "{:.10g}").and_si("{:.10g}"), Quantity::frequency, frequency_or_why},
     {InText(""), Quantity::speed, &ModeAt::frequency},
     {InFiles("real"), OnPage("Real part"), Quantity::rate, entry_of(&CampbellMode::real)},
     {InFiles("damping_ratio"), Titled("Damping ratio"), Quantity::number,
      entry_of(&CampbellMode::damping_ratio)},
     {InFiles("log_dec"), Quantity::number, entry_of(&CampbellMode::log_dec)},
     {InFiles("whirl"), entry_of(&CampbellMode::whirl)},
     {Titled("Whirl"), [](const ModeAt &at, const Units &units) { return at.whirl(units); }},
     {"forward_share", InCsv("forward_fraction"), OnPage("Forward share", "{:.4g}"),
      Quantity::number, entry_of(&CampbellMode::forward_fraction)},
     {"forward_fraction", Quantity::number,
      entry_of(&CampbellMode::forward_fraction)}, // its older name
     {InFiles("error"), RelativeError(), entry_of(&CampbellMode::error)},
     {InFiles("residual"), Quantity::number, entry_of(&CampbellMode::residual)},
     {InFiles("plane"), Quantity::angle, &ModeAt::plane}},
    part);

std::vector<ModeAt> over_speeds(const CampbellResult &result, const CampbellMode &mode) {
    std::vector<ModeAt> rows;
    for (std::size_t i = 0; i < result.speeds.size(); ++i)
        rows.push_back({result.speeds[i], &mode, i});
    return rows;
}

std::vector<ModeAt> at_speed(const CampbellResult &result, std::size_t index) {
    std::vector<ModeAt> rows;
    for (const CampbellMode &mode : result.modes)
        rows.push_back({result.speeds[index], &mode, index});
    return rows;
}

/// By frequency, those without one last; none of what goes on as other lines.
std::vector<ModeAt> at_last_speed(const CampbellResult &result) {
    std::vector<ModeAt> modes = at_speed(result, result.speeds.size() - 1);
    std::erase_if(modes, [](const ModeAt &at) {
        return !at.frequency() && at.mode->absent.at(at.index) == "not followed";
    });
    std::stable_sort(modes.begin(), modes.end(), [](const ModeAt &a, const ModeAt &b) {
        constexpr double none = std::numeric_limits<double>::infinity();
        return a.frequency().value_or(none) < b.frequency().value_or(none);
    });
    return modes;
}

std::string label_of(const CampbellResult &result, int mode) {
    const auto index = static_cast<std::size_t>(mode);
    return index < result.modes.size() ? result.modes[index].label : "";
}

Columns<Crossing> crossing_columns(const CampbellResult &result) {
    const auto label = [&result](const Crossing &crossing) {
        return label_of(result, crossing.mode);
    };
    return {{OnPage("Mode"), label},
            {"multiple", OnPage("Multiple", "{:.5g}×"), InText("line", "{:.6g}x"), Quantity::number,
             &Crossing::multiple},
            {"speed", OnPage("Spin speed", "{:.10g}").and_si("{:.10g}"), InText("").and_si(precise),
             Quantity::speed, &Crossing::speed},
            {"frequency", OnPage("Whirl frequency", "{:.10g}"), Quantity::frequency,
             &Crossing::frequency},
            {InText(""), Quantity::frequency, &Crossing::speed},
            {"damping_ratio", Titled("Damping ratio"), Quantity::number,
             [](const auto &crossing) { return crossing.damping.ratio; }},
            {"log_dec", Quantity::number,
             [](const auto &crossing) { return crossing.damping.log_dec; }},
            {"amplification", OnPage("Amplification factor", "{:.5g}"),
             InText("amplification", "{:.5g}"), Quantity::number,
             [](const auto &crossing) { return crossing.damping.amplification; }},
            {Titled("Damped"),
             [](const auto &crossing) { return crossing.damping.heavy() ? "heavily" : ""; }},
            {"heavily_damped", [](const auto &c) { return c.damping.heavy(); }},
            {"mode", &Crossing::mode},
            {InText("mode"), label}};
}

Columns<Locked> locked_columns(const CampbellResult &result) {
    const auto label = [&result](const Locked &locked) { return label_of(result, locked.mode); };
    return {{OnPage("Mode"), label},
            {"multiple", OnPage("Multiple", "{:.5g}×"), InText("line", "{:.6g}x"), Quantity::number,
             &Locked::multiple},
            {"mode", &Locked::mode},
            {"from", AllDigits("From"), Quantity::speed, &Locked::from},
            {"to", AllDigits("To"), Quantity::speed, &Locked::to},
            {InText("mode"), label}};
}

Json mode_json(const CampbellResult &result, const CampbellMode &mode, const Units &units) {
    Json json{{"label", mode.label}};
    json["absent"] = json_list(
        mode.absent, [](const std::string &why) { return why.empty() ? Json() : Json(why); });
    if (!mode.frequency_rotating.empty())
        json["frequency_rotating"] = written(units, Quantity::frequency, mode.frequency_rotating);
    if (!mode.other_frequency.empty())
        json["other_frequency"] = written(units, Quantity::frequency, mode.other_frequency);
    take_entries(json, json_lists(mode_columns, over_speeds(result, mode), units));
    return json;
}

Json json_of(const CampbellResult &result, const Units &units) {
    Json json = json_object(5);
    json["speeds"] = written(units, Quantity::speed, result.speeds);
    json["modes"] =
        json_list(result.modes, [&](const auto &mode) { return mode_json(result, mode, units); });
    json["crossings"] = json_rows(crossing_columns(result), result.crossings, units);
    json["locked"] = json_rows(locked_columns(result), result.locked, units);
    json["divergence"] = written(units, Quantity::rate, result.divergence);
    return json;
}

std::string csv_of(const CampbellResult &result, const Units &units) {
    const std::vector<CsvHeading> head = csv_head(mode_columns);
    std::string csv = csv_head_line(head, units);
    for (std::size_t i = 0; i < result.speeds.size(); ++i)
        csv += csv_rows(head, mode_columns, at_speed(result, i), units);
    return csv;
}

std::vector<Section> sections_of(const CampbellResult &result, const Units &units) {
    const std::string crossings =
        result.crossings.empty()
            ? "<p>No mode crosses a multiple of the spin speed in this range.</p>\n"
            : page_table(crossing_columns(result), result.crossings, units);
    std::vector<Section> sections{{"Critical speeds (1×) and other crossings", crossings}};
    add_table(sections, "Modes that stay on a multiple of the spin speed", locked_columns(result),
              result.locked, units);
    if (!result.speeds.empty())
        sections.push_back(
            {"Whirl modes at " + units.text(Quantity::speed, result.speeds.back()),
             page_table(mode_columns, at_speed(result, result.speeds.size() - 1), units)});
    return sections;
}

std::string text_of(const model::Case &scene, const CampbellResult &result, const Units &units) {
    std::string text = heading(scene, "Campbell diagram, " + range_text(result.speeds, units));
    if (result.speeds.empty())
        return text + model_text(result.model, units);
    const double last = result.speeds.back();
    const std::string in_si = // in the unit asked for it is the same once more
        units.asked(Quantity::speed) ? ""
                                     : fmt::format(" ({})", Units().text(Quantity::speed, last));
    text += fmt::format("Whirl modes at {}{}:\n{}", units.text(Quantity::speed, last), in_si,
                        text_table(mode_columns, at_last_speed(result), units));
    return text +
           text_table("\nCrossings with multiples of the spin speed:\n", crossing_columns(result),
                      result.crossings, units) +
           text_table("\nModes that stay on a multiple of the spin speed:\n",
                      locked_columns(result), result.locked, units) +
           model_text(result.model, units);
}

/// The modes that grow at some speed, each with the lowest such speed.
model::Sentence growing_modes(const CampbellResult &result) {
    std::vector<model::Sentence> growing;
    for (const CampbellMode &mode : result.modes)
        for (std::size_t i = 0; i < result.speeds.size(); ++i)
            if (grows(mode, i)) {
                growing.emplace_back("{} from {} on", mode.label,
                                     model::as::speed(result.speeds[i], 4));
                break;
            }
    return growing.empty() ? "none of them grows"
                           : model::Sentence("growing: {}", model::joined(growing, ", "));
}

/// Critical speeds of the range and growth, in one sentence.
model::Sentence answer_of(const CampbellResult &result) {
    std::vector<double> critical;
    for (const Crossing &crossing : result.crossings)
        if (crossing.multiple == 1 && !crossing.damping.heavy())
            critical.push_back(crossing.speed);
    std::sort(critical.begin(), critical.end());
    return {"{} modes from {}; {}; {}", result.modes.size(),
            model::as::speed.range(result.speeds.front(), result.speeds.back(), 4),
            critical.empty() ? model::Sentence("no resonance with the spin speed")
                             : model::Sentence("resonances with the spin speed at {}",
                                               model::as::speed.list(critical, 5)),
            growing_modes(result)};
}

std::vector<Section> brief_of(const CampbellResult &result, const Units &units) {
    std::vector<Section> sections;
    add_table(sections, "Crossings with multiples of the spin speed", crossing_columns(result),
              result.crossings, units, brief_rows);
    return sections;
}

} // namespace

Report describe(const model::Case &scene, const CampbellResult &result) {
    Report report =
        report_of<CampbellResult>("campbell", "Campbell diagram", scene, result,
                                  {json_of, csv_of, sections_of, text_of, campbell_chart});
    if (!result.speeds.empty()) // complete: on the first process
        report.answer = answer_of(result);
    report.brief = [&result](const Units &units) { return brief_of(result, units); };
    return report;
}

} // namespace whirl::report
