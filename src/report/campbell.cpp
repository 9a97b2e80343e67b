// Report of the command campbell.

#include "results/campbell.h"

#include "report/common/csv.h"
#include "report/common/error_parts.h"
#include "report/common/table.h"
#include "report/common/words.h"
#include "report/pictures/figures.h"
#include "report/reports.h"

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
Json hertz_or_why(const ModeAt &at) {
    return at.frequency() ? Json(*at.frequency() * hertz) : Json(at.mode->absent.at(at.index));
}

const Columns<ModeAt> mode_columns = with_error_parts<ModeAt>(
    {{InCsv("speed [rad/s]"), &ModeAt::speed},
     {InCsv("mode"), OnPage("Mode"), InText("mode"), [](const auto &at) { return at.mode->label; }},
     {"frequency", InCsv("frequency [rad/s]"), OnPage("Frequency (rad/s)", "{:.10g}"),
      InText("rad/s", precise), &ModeAt::frequency},
     {OnPage("Frequency (Hz)", "{:.10g}"), hertz_or_why},
     {InText("Hz"), in(hertz, &ModeAt::frequency)},
     {InText("rpm"), in(rpm, &ModeAt::frequency)},
     {"real", InCsv("real [1/s]"), OnPage("Real part (1/s)"), entry_of(&CampbellMode::real)},
     {"damping_ratio", InCsv("damping_ratio"), OnPage("Damping ratio"), InText("damping ratio"),
      entry_of(&CampbellMode::damping_ratio)},
     {"log_dec", InCsv("log_dec"), entry_of(&CampbellMode::log_dec)},
     {"whirl", InCsv("whirl"), OnPage("Whirl"), InText("whirl"), entry_of(&CampbellMode::whirl)},
     {"forward_share", InCsv("forward_fraction"), OnPage("Forward share", "{:.4g}"),
      entry_of(&CampbellMode::forward_fraction)},
     {"forward_fraction", entry_of(&CampbellMode::forward_fraction)}, // its older name
     {"error", InCsv("error"), OnPage("Relative error", "{:.2g}"), InText("error", rough),
      entry_of(&CampbellMode::error)},
     {"residual", InCsv("residual"), entry_of(&CampbellMode::residual)}},
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
    return {
        {OnPage("Mode"), label},
        {"multiple", OnPage("Multiple", "{:.5g}×"), InText("line", "{:.6g}x"), &Crossing::multiple},
        {OnPage("Spin speed (rpm)", "{:.10g}"), InText("rpm"), in(rpm, &Crossing::speed)},
        {"speed", OnPage("Spin speed (rad/s)", "{:.10g}"), InText("rad/s", precise),
         &Crossing::speed},
        {"frequency", &Crossing::frequency},
        {OnPage("Whirl frequency (Hz)", "{:.10g}"), in(hertz, &Crossing::frequency)},
        {InText("Hz"), in(hertz, &Crossing::speed)},
        {"damping_ratio", OnPage("Damping ratio"), InText("damping ratio"),
         [](const auto &crossing) { return crossing.damping.ratio; }},
        {"log_dec", [](const auto &crossing) { return crossing.damping.log_dec; }},
        {"amplification", OnPage("Amplification factor", "{:.5g}"),
         InText("amplification", "{:.5g}"),
         [](const auto &crossing) { return crossing.damping.amplification; }},
        {OnPage("Damped"), InText("damped"),
         [](const auto &crossing) { return crossing.damping.heavy() ? "heavily" : ""; }},
        {"heavily_damped", [](const auto &c) { return c.damping.heavy(); }},
        {"mode", &Crossing::mode},
        {InText("mode"), label}};
}

Columns<Locked> locked_columns(const CampbellResult &result) {
    const auto label = [&result](const Locked &locked) { return label_of(result, locked.mode); };
    return {
        {OnPage("Mode"), label},
        {"multiple", OnPage("Multiple", "{:.5g}×"), InText("line", "{:.6g}x"), &Locked::multiple},
        {"mode", &Locked::mode},
        {OnPage("From (rpm)", "{:.10g}"), InText("from rpm"), in(rpm, &Locked::from)},
        {OnPage("To (rpm)", "{:.10g}"), InText("to rpm"), in(rpm, &Locked::to)},
        {"from", OnPage("From (rad/s)", "{:.10g}"), InText("from rad/s", precise), &Locked::from},
        {"to", OnPage("To (rad/s)", "{:.10g}"), InText("to rad/s", precise), &Locked::to},
        {InText("mode"), label}};
}

Json mode_json(const CampbellResult &result, const CampbellMode &mode) {
    Json json{{"label", mode.label}};
    json["absent"] = json_list(
        mode.absent, [](const std::string &why) { return why.empty() ? Json() : Json(why); });
    if (!mode.frequency_rotating.empty())
        json["frequency_rotating"] = mode.frequency_rotating;
    if (!mode.other_frequency.empty())
        json["other_frequency"] = mode.other_frequency;
    take_entries(json, json_lists(mode_columns, over_speeds(result, mode)));
    return json;
}

Json json_of(const CampbellResult &result, const Units &) {
    Json json = json_object(5);
    json["speeds"] = result.speeds;
    json["modes"] =
        json_list(result.modes, [&](const auto &mode) { return mode_json(result, mode); });
    json["crossings"] = json_rows(crossing_columns(result), result.crossings);
    json["locked"] = json_rows(locked_columns(result), result.locked);
    json["divergence"] = result.divergence;
    return json;
}

std::string csv_of(const CampbellResult &result, const Units &) {
    const std::vector<std::string> head = csv_head(mode_columns);
    std::string csv = csv_head_line(head);
    for (std::size_t i = 0; i < result.speeds.size(); ++i)
        csv += csv_rows(head, mode_columns, at_speed(result, i));
    return csv;
}

std::vector<Section> sections_of(const CampbellResult &result, const Units &) {
    const std::string crossings =
        result.crossings.empty()
            ? "<p>No mode crosses a multiple of the spin speed in this range.</p>\n"
            : page_table(crossing_columns(result), result.crossings);
    std::vector<Section> sections{{"Critical speeds (1×) and other crossings", crossings}};
    if (!result.locked.empty())
        sections.push_back({"Modes that stay on a multiple of the spin speed",
                            page_table(locked_columns(result), result.locked)});
    if (!result.speeds.empty())
        sections.push_back({fmt::format("Whirl modes at {:.6g} rpm", result.speeds.back() * rpm),
                            page_table(mode_columns, at_speed(result, result.speeds.size() - 1))});
    return sections;
}

std::string text_of(const model::Case &scene, const CampbellResult &result, const Units &) {
    std::string text = heading(scene, "Campbell diagram, " + range_text(result.speeds));
    if (result.speeds.empty())
        return text + model_text(result.model);
    const double last = result.speeds.back();
    const std::string beside = // in the unit asked for it is the same once more
        written_factor("speed") ? "" : fmt::format(" ({:.6g} rad/s)", last);
    text += fmt::format("Whirl modes at {:.6g} rpm{}:\n{}", last * rpm, beside,
                        text_table(mode_columns, at_last_speed(result)));
    return text +
           text_table("\nCrossings with multiples of the spin speed:\n", crossing_columns(result),
                      result.crossings) +
           text_table("\nModes that stay on a multiple of the spin speed:\n",
                      locked_columns(result), result.locked) +
           model_text(result.model);
}

} // namespace

Report describe(const model::Case &scene, const CampbellResult &result) {
    return report_of<CampbellResult>("campbell", "Campbell diagram", scene, result,
                                     {json_of, csv_of, sections_of, text_of, campbell_figure});
}

} // namespace whirl::report
