#include "report/steady_states.h"

#include "report/common/table.h"

#include <fmt/format.h>

#include <algorithm>

namespace whirl::report {

using results::SteadyState;
using results::SteadyStates;

namespace {

/// Angles of one balancer after the other.
std::string state_angles(const SteadyState &state, const Units &units) {
    std::string text;
    for (const std::vector<double> &balancer : state.angles) {
        text += text.empty() ? "" : " | ";
        for (std::size_t i = 0; i < balancer.size(); ++i)
            text += fmt::format("{}{:.5g}", i > 0 ? " " : "", units(Quantity::angle, balancer[i]));
    }
    return text;
}

Json stable_json(const SteadyState &state) { return state.stable ? Json(*state.stable) : Json(); }

std::string stable_text(const SteadyState &state) {
    return state.stable ? *state.stable ? "stable" : "unstable"
           : state.family && state.least_growth < 0 && state.growth > 0 ? "some of the family"
                                                                        : "neutral";
}

const Columns<SteadyState> state_columns{
    {"speed", ForReaders("Speed", "{:.8g}"), Quantity::speed, &SteadyState::speed},
    {"kind", ForReaders("kind"),
     [](const auto &state) { return results::steady_kind_name(state.kind); }},
    {"angles", Quantity::angle, &SteadyState::angles},
    {ForReaders("angles"), Quantity::angle, state_angles},
    {"family", &SteadyState::family},
    {"stable", Quantity::number, stable_json},
    {ForReaders("stability"), stable_text},
    {"growth", ForReaders("growth", "{:.5g}"), Quantity::rate, &SteadyState::growth},
    {"least_growth", Quantity::rate, &SteadyState::least_growth},
    {"growing", &SteadyState::growing},
    {"residual", ForReaders("residual", "{:.5g}"), Quantity::amplitude, &SteadyState::residual},
    {"amplitudes", Quantity::amplitude, &SteadyState::amplitudes},
    {"defect", Quantity::number, &SteadyState::defect},
    {"branch", &SteadyState::branch}};

const Columns<results::SteadyBorder> border_columns{
    {"speed", ForReaders("Speed", "{:.10g}"), Quantity::speed, &results::SteadyBorder::speed},
    {"kind", ForReaders("what happens"),
     [](const auto &border) { return results::steady_border_name(border.kind); }},
    {"branch", ForReaders("branch"), &results::SteadyBorder::branch},
    {"other", ForReaders("with branch"), Quantity::number,
     [](const auto &border) { return border.other ? Json(*border.other) : Json(); }},
    {"growing_below", ForReaders("growing below"), &results::SteadyBorder::growing_below},
    {"growing_above", ForReaders("growing above"), &results::SteadyBorder::growing_above},
    {"frequency", ForReaders("frequency in rotating axes", "{:.6g}"), Quantity::frequency,
     &results::SteadyBorder::frequency},
    {"residual", ForReaders("residual", "{:.5g}"), Quantity::amplitude,
     &results::SteadyBorder::residual}};

/// As many rows as somebody reads; the file has all.
constexpr std::size_t most_rows = 60;

std::vector<SteadyState> first_rows(const SteadyStates &states) {
    const auto count = static_cast<std::ptrdiff_t>(std::min(most_rows, states.states.size()));
    return {states.states.begin(), states.states.begin() + count};
}

std::string heading_of(const SteadyStates &states) {
    return fmt::format("Steady states, {} at {} {}{}", states.states.size(), states.speeds.size(),
                       states.speeds.size() == 1 ? "speed" : "speeds",
                       states.states.size() > most_rows ? fmt::format(", the first {}", most_rows)
                                                        : std::string());
}

} // namespace

Json states_json(const std::optional<SteadyStates> &states, const Units &units) {
    return states ? json_rows(state_columns, states->states, units) : Json();
}

Json state_borders_json(const std::optional<SteadyStates> &states, const Units &units) {
    return states ? json_rows(border_columns, states->borders, units) : Json();
}

Json states_undecided_json(const std::optional<SteadyStates> &states, const Units &units) {
    return states ? written(units, Quantity::speed, states->undecided) : Json();
}

std::string states_text(const SteadyStates &states, const Units &units) {
    return text_table("\n" + heading_of(states) + ":\n", state_columns, first_rows(states), units) +
           text_table(
               "\nWhere branches of steady states end, and roots cross the imaginary axis:\n",
               border_columns, states.borders, units);
}

std::vector<Section> states_sections(const SteadyStates &states, const Units &units) {
    if (states.states.empty())
        return {};
    std::vector<Section> out{
        {heading_of(states), page_table(state_columns, first_rows(states), units)}};
    if (!states.borders.empty())
        out.push_back({"Where branches of steady states end, and roots cross the imaginary axis",
                       page_table(border_columns, states.borders, units)});
    return out;
}

} // namespace whirl::report
