#include "report/steady_states.h"

#include "report/common/csv.h"
#include "report/common/words.h"
#include "report/sections.h"

#include <fmt/format.h>

#include <algorithm>

namespace whirl::report {

using results::SteadyState;
using results::SteadyStates;

namespace {

std::optional<int> known_count(int count) {
    return count == results::not_counted ? std::nullopt : std::optional(count);
}

std::string stable_text(const SteadyState &state) {
    if (!state.why.empty() && !state.stable)
        return "not known";
    return state.stable ? *state.stable ? "stable" : "unstable"
           : state.family && state.least_growth < 0 && state.growth > 0 ? "some of the family"
                                                                        : "neutral";
}

const Columns<SteadyState> state_columns{
    {InFiles("speed"), ForReaders("Speed", "{:.8g}"), Quantity::speed, &SteadyState::speed},
    {InFiles("kind"), ForReaders("kind"),
     [](const auto &state) { return results::steady_kind_name(state.kind); }},
    {"angles", Quantity::angle, &SteadyState::angles},
    {ForReaders("angles"), Quantity::angle,
     [](const auto &state, const Units &units) { return angles_text(state.angles, units); }},
    {InCsv("angles"), Quantity::angle,
     [](const auto &state, const Units &units) { return angles_text(state.angles, units, "{}"); }},
    {"wall_forces", Quantity::force, &SteadyState::wall_forces},
    {InFiles("family"), &SteadyState::family},
    {InFiles("stable"), &SteadyState::stable},
    {ForReaders("stability"), stable_text},
    {InFiles("growth"), ForReaders("growth", "{:.5g}"), Quantity::rate, &SteadyState::growth},
    {"growth_error", Quantity::rate, &SteadyState::growth_error},
    {"least_growth", Quantity::rate, &SteadyState::least_growth},
    {InFiles("growing"), [](const auto &state) { return known_count(state.growing); }},
    {InFiles("residual"), ForReaders("residual", "{:.5g}"), Quantity::amplitude,
     &SteadyState::residual},
    {"amplitudes", Quantity::amplitude, &SteadyState::amplitudes},
    {"defect", Quantity::number, &SteadyState::defect},
    {InFiles("branch"), &SteadyState::branch},
    {"why", [](const auto &state) { return known_name(state.why); }}};

const Columns<results::SteadyBorder> border_columns{
    {"speed", ForReaders("Speed", "{:.10g}"), Quantity::speed, &results::SteadyBorder::speed},
    {"kind", ForReaders("what happens"),
     [](const auto &border) { return results::steady_border_name(border.kind); }},
    {"branch", ForReaders("branch"), &results::SteadyBorder::branch},
    {"other", ForReaders("with branch"), &results::SteadyBorder::other},
    {"growing_below", ForReaders("growing below"),
     [](const auto &border) { return known_count(border.growing_below); }},
    {"growing_above", ForReaders("growing above"),
     [](const auto &border) { return known_count(border.growing_above); }},
    {"frequency", ForReaders("frequency in rotating axes", "{:.6g}"), Quantity::frequency,
     &results::SteadyBorder::frequency},
    {"residual", ForReaders("residual", "{:.5g}"), Quantity::amplitude,
     &results::SteadyBorder::residual}};

/// The columns with one of the value over which the states are followed, if it is no speed; in JSON
/// it is null then.
template <class Row> Columns<Row> with_value(Columns<Row> columns, const SteadyStates &states) {
    const auto second = columns.begin() + 1;
    if (!states.over) {
        columns.insert(second, {"value", Quantity::number, [](const Row &) { return Json(); }});
        return columns;
    }
    const std::string name = axis_name(*states.over);
    columns.insert(second, {"value", InCsv(name), ForReaders(name, "{:.10g}"),
                            states.over->quantity, &Row::value});
    return columns;
}

constexpr const char *borders_heading =
    "Where branches of steady states end, and roots cross the imaginary axis";

/// As many rows as somebody reads; the file has all.
constexpr std::size_t most_rows = 60;

std::vector<SteadyState> first_rows(const SteadyStates &states) {
    const auto count = static_cast<std::ptrdiff_t>(std::min(most_rows, states.states.size()));
    return {states.states.begin(), states.states.begin() + count};
}

std::string heading_of(const SteadyStates &states) {
    const std::size_t places = states.places().size();
    const auto words = [&](const char *one, const char *more) { return places == 1 ? one : more; };
    return fmt::format("Steady states, {} at {} {}{}", states.states.size(), places,
                       states.over ? words("value", "values") : words("speed", "speeds"),
                       states.states.size() > most_rows ? fmt::format(", the first {}", most_rows)
                                                        : std::string());
}

} // namespace

Json states_json(const std::optional<SteadyStates> &states, const Units &units) {
    return states ? json_rows(with_value(state_columns, *states), states->states, units) : Json();
}

Json state_borders_json(const std::optional<SteadyStates> &states, const Units &units) {
    return states ? json_rows(with_value(border_columns, *states), states->borders, units) : Json();
}

Json states_undecided_json(const std::optional<SteadyStates> &states, const Units &units) {
    return states ? written(units, states->over ? states->over->quantity : Quantity::speed,
                            states->undecided)
                  : Json();
}

Json states_over_json(const std::optional<SteadyStates> &states, const Units &units) {
    if (!states || !states->over)
        return {};
    return axis_json(*states->over, states->changes, units);
}

std::string states_text(const SteadyStates &states, const Units &units) {
    return text_table("\n" + heading_of(states) + ":\n", with_value(state_columns, states),
                      first_rows(states), units) +
           text_table(fmt::format("\n{}:\n", borders_heading), with_value(border_columns, states),
                      states.borders, units);
}

std::vector<Section> states_sections(const SteadyStates &states, const Units &units) {
    if (states.states.empty())
        return {};
    std::vector<Section> out;
    add_table(out, heading_of(states), with_value(state_columns, states), first_rows(states),
              units);
    add_table(out, borders_heading, with_value(border_columns, states), states.borders, units);
    return out;
}

TableFile states_table(const SteadyStates &states) {
    return {"steady_states", [&states](const Units &units) {
                return csv_table(with_value(state_columns, states), states.states, units);
            }};
}

} // namespace whirl::report
