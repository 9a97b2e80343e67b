#include "report/held_motions.h"

#include "report/common/csv.h"
#include "report/common/html.h"
#include "report/common/table.h"
#include "report/common/words.h"

#include <fmt/format.h>

#include <algorithm>

namespace whirl::report {

using results::HeldMotion;
using results::HeldSweep;
using results::ManyStarts;
using results::MotionEnd;
using results::MotionJump;
using results::SteadyState;
using results::SteadyStates;

namespace {

const char *going(bool up) { return up ? "up" : "down"; }

/// What balancers do that are in no steady state.
/// @param known  there are states to compare with
const char *without_state(bool at_rest, bool known) {
    return !at_rest ? "moving" : known ? "at rest elsewhere" : "at rest";
}

/// "balanced", "coincident 2".
std::string state_name(const SteadyStates &states, std::size_t place) {
    const SteadyState &state = states.states[place];
    const auto same = std::ranges::count_if(states.states, [&state](const SteadyState &other) {
        return other.kind == state.kind && other.speed == state.speed;
    });
    return results::steady_kind_name(state.kind) +
           (same > 1 ? fmt::format(" {}", state.branch) : std::string());
}

/// A motion beside the state that it came to rest in.
struct HeldRow {
    const HeldMotion &motion;
    const SteadyStates *states;
    bool balancers;

    [[nodiscard]] Json state() const {
        if (!balancers)
            return {};
        return motion.state ? state_name(*states, *motion.state)
                            : without_state(motion.at_rest, states != nullptr);
    }
    [[nodiscard]] const SteadyState *steady() const {
        return motion.state ? &states->states[*motion.state] : nullptr;
    }
};

std::vector<HeldRow> rows_of(const HeldSweep &sweep) {
    std::vector<HeldRow> rows;
    for (const HeldMotion &motion : sweep.motions)
        rows.push_back({motion, sweep.states ? &*sweep.states : nullptr, !motion.planes.empty()});
    return rows;
}

const Columns<HeldRow> held_columns{
    {InFiles("direction"), ForReaders("Going"),
     [](const auto &row) { return going(row.motion.up); }},
    {InFiles("speed"), ForReaders("speed", "{:.6g}"), Quantity::speed,
     [](const auto &row) { return row.motion.speed; }},
    {InCsv("largest"), ForReaders("amplitude", "{:.5g}"), Quantity::amplitude,
     [](const auto &row) { return row.motion.largest(); }},
    {"planes", Quantity::amplitude, [](const auto &row) { return row.motion.planes; }},
    {"amplitude", Quantity::amplitude, [](const auto &row) { return row.motion.amplitude; }},
    {"rms", Quantity::amplitude, [](const auto &row) { return row.motion.rms; }},
    {"balls", Quantity::angle, [](const auto &row) { return row.motion.angles; }},
    {"rates", Quantity::speed, [](const auto &row) { return row.motion.rates; }},
    {InFiles("settled"), [](const auto &row) { return row.motion.settled; }},
    {ForReaders("settled"), [](const auto &row) { return row.motion.settled ? "yes" : "no"; }},
    {InFiles("at_rest"), [](const auto &row) { return row.motion.at_rest; }},
    {InFiles("state"), ForReaders("balancers"), Quantity::number,
     [](const auto &row) { return row.state(); }},
    {InFiles("branch"), Quantity::number,
     [](const auto &row) { return row.steady() ? Json(row.steady()->branch) : Json(); }},
    {InFiles("state_amplitude"), ForReaders("of that state", "{:.5g}"), Quantity::amplitude,
     [](const auto &row) { return row.steady() ? Json(row.steady()->residual) : Json(); }},
    {InCsv("angles"), ForReaders("angles,"), Quantity::angle,
     [](const auto &row, const Units &units) { return angles_text(row.motion.angles, units); }}};

const Columns<MotionJump> jump_columns{
    {"direction", [](const auto &jump) { return going(jump.up); }},
    {"from", Quantity::speed, &MotionJump::from},
    {"to", Quantity::speed, &MotionJump::to},
    {"before", Quantity::amplitude, &MotionJump::before},
    {"after", Quantity::amplitude, &MotionJump::after}};

std::string sweep_answer(const HeldSweep &sweep, const Units &units) {
    std::string text;
    for (const MotionJump &jump : sweep.jumps)
        text += fmt::format("  jump going {} between {} and {}: amplitude {} to {}\n",
                            going(jump.up), units.text(Quantity::speed, jump.from, 5),
                            units.text(Quantity::speed, jump.to, 5),
                            units.text(Quantity::amplitude, jump.before, 4),
                            units.text(Quantity::amplitude, jump.after, 4));
    if (sweep.jumps.empty())
        text += "  no jumps\n";
    for (const auto &[from, to] : sweep.hysteresis)
        text += from == to ? fmt::format("  at {} the motion depends on where the speed comes "
                                         "from\n",
                                         units.text(Quantity::speed, from, 5))
                           : fmt::format("  from {} to {} the motion depends on where the speed "
                                         "comes from\n",
                                         units.text(Quantity::speed, from, 5),
                                         units.text(Quantity::speed, to, 5));
    return text;
}

/// A way in which motions end, beside the others.
struct EndRow {
    const ManyStarts &starts;
    const MotionEnd &end;

    [[nodiscard]] const SteadyState *steady() const {
        return end.state ? &starts.states->states[*end.state] : nullptr;
    }
};

std::vector<EndRow> ends_of(const ManyStarts &starts) {
    std::vector<EndRow> rows;
    for (const MotionEnd &end : starts.ends)
        rows.push_back({starts, end});
    return rows;
}

const Columns<EndRow> end_columns{
    {"state", ForReaders("End"), [](const auto &row) { return end_name(row.starts, row.end); }},
    {"branch", Quantity::number,
     [](const auto &row) { return row.steady() ? Json(row.steady()->branch) : Json(); }},
    {"stable", Quantity::number,
     [](const auto &row) {
         return row.steady() && row.steady()->stable ? Json(*row.steady()->stable) : Json();
     }},
    {"angles", Quantity::angle,
     [](const auto &row) { return row.steady() ? Json(row.steady()->angles) : Json(); }},
    {"count", ForReaders("motions"), [](const auto &row) { return row.end.count; }},
    {"probability", ForReaders("share", "{:.4g}"), Quantity::number,
     [](const auto &row) { return row.end.share; }},
    {"low", ForReaders("95 % from", "{:.4g}"), Quantity::number,
     [](const auto &row) { return row.end.low; }},
    {"high", ForReaders("to", "{:.4g}"), Quantity::number,
     [](const auto &row) { return row.end.high; }},
    {"least_amplitude", ForReaders("amplitude from", "{:.4g}"), Quantity::amplitude,
     [](const auto &row) { return row.end.least; }},
    {"largest_amplitude", ForReaders("to", "{:.4g}"), Quantity::amplitude,
     [](const auto &row) { return row.end.largest; }},
    {"state_amplitude", ForReaders("of that state", "{:.4g}"), Quantity::amplitude,
     [](const auto &row) { return row.steady() ? Json(row.steady()->residual) : Json(); }},
    {"unsettled", ForReaders("still changing"), [](const auto &row) { return row.end.unsettled; }}};

/// A start and its end.
struct StartRow {
    const ManyStarts &starts;
    const results::StartedMotion &start;

    template <class Of> [[nodiscard]] Json of(const Of &value) const {
        return start.motion ? Json(value(*start.motion)) : Json();
    }
};

std::vector<StartRow> starts_of(const ManyStarts &starts) {
    std::vector<StartRow> rows;
    for (const results::StartedMotion &start : starts.motions)
        rows.push_back({starts, start});
    return rows;
}

const Columns<StartRow> started_columns{
    {"start_angles", Quantity::angle, [](const auto &row) { return row.start.start_angles; }},
    {InCsv("start_angles"), Quantity::angle,
     [](const auto &row, const Units &units) {
         return angles_text(row.start.start_angles, units);
     }},
    {"end", Quantity::number,
     [](const auto &row) { return row.start.end ? Json(*row.start.end) : Json(); }},
    {InCsv("end"),
     [](const auto &row) {
         return row.start.end ? end_name(row.starts, row.starts.ends[*row.start.end])
                              : std::string();
     }},
    {InFiles("amplitude"), Quantity::amplitude,
     [](const auto &row) { return row.of([](const HeldMotion &m) { return m.largest(); }); }},
    {InFiles("settled"), Quantity::number,
     [](const auto &row) { return row.of([](const HeldMotion &m) { return m.settled; }); }},
    {"balls", Quantity::angle,
     [](const auto &row) { return row.of([](const HeldMotion &m) { return m.angles; }); }},
    {InCsv("angles"), Quantity::angle, [](const auto &row, const Units &units) {
         return row.start.motion ? angles_text(row.start.motion->angles, units) : std::string();
     }}};

std::string starts_heading(const ManyStarts &starts) {
    return fmt::format(
        "{} motions from {}", starts.motions.size() - static_cast<std::size_t>(starts.left_out),
        starts.grid.empty() ? std::string("starts at random")
                            : fmt::format("a grid of {0} by {0} starts", starts.grid.size()));
}

} // namespace

std::string end_name(const ManyStarts &starts, const MotionEnd &end) {
    return end.state ? state_name(*starts.states, *end.state)
                     : without_state(end.at_rest, starts.states.has_value());
}

Json sweep_json(const std::optional<HeldSweep> &sweep, const Units &units) {
    return sweep ? json_rows(held_columns, rows_of(*sweep), units) : Json();
}

Json jumps_json(const std::optional<HeldSweep> &sweep, const Units &units) {
    return sweep ? json_rows(jump_columns, sweep->jumps, units) : Json();
}

Json hysteresis_json(const std::optional<HeldSweep> &sweep, const Units &units) {
    return sweep ? json_list(sweep->hysteresis,
                             [&units](const auto &range) {
                                 return written(units, Quantity::speed,
                                                std::vector{range.first, range.second});
                             })
                 : Json();
}

Json starts_json(const std::optional<ManyStarts> &starts, const Units &units) {
    if (!starts)
        return {};
    return {{"kind", starts->grid.empty() ? "random" : "grid"},
            {"left_out", starts->left_out},
            {"grid", written(units, Quantity::angle, starts->grid)},
            {"ends", json_rows(end_columns, ends_of(*starts), units)},
            {"motions", json_rows(started_columns, starts_of(*starts), units)}};
}

std::string sweep_text(const HeldSweep &sweep, const Units &units) {
    constexpr std::size_t most = 12; // rows on the terminal
    const std::vector<HeldRow> all = rows_of(sweep);
    std::vector<HeldRow> rows;
    const std::size_t step = (all.size() + most - 1) / most;
    for (std::size_t k = 0; k < all.size(); k += step)
        rows.push_back(all[k]);
    return fmt::format("Sweep in time, {} speeds held:\n", sweep.motions.size()) +
           sweep_answer(sweep, units) + "\n" + text_table(held_columns, rows, units) +
           (step > 1 ? fmt::format("  one in {}; all are in sweep_in_time.csv\n", step) : "");
}

std::string starts_text(const ManyStarts &starts, const Units &units) {
    return "\n" + starts_heading(starts) + ":\n\n" +
           text_table(end_columns, ends_of(starts), units);
}

Section sweep_section(const HeldSweep &sweep, const Units &units) {
    return {"Sweep in time", element("pre", escaped(sweep_answer(sweep, units))) +
                                 page_table(held_columns, rows_of(sweep), units)};
}

Section starts_section(const ManyStarts &starts, const Units &units) {
    return {"Ends of " + starts_heading(starts), page_table(end_columns, ends_of(starts), units)};
}

TableFile sweep_table(const HeldSweep &sweep) {
    return {"sweep_in_time", [&sweep](const Units &units) {
                return csv_table(held_columns, rows_of(sweep), units);
            }};
}

TableFile starts_table(const ManyStarts &starts) {
    return {"starts", [&starts](const Units &units) {
                return csv_table(started_columns, starts_of(starts), units);
            }};
}

} // namespace whirl::report
