#include "report/pictures/figures.h"

#include "report/pictures/style.h"
#include "results/held_motion.h"
#include "results/steady_states.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace whirl::report {

using results::SteadyBorder;
using results::SteadyState;
using results::SteadyStates;

namespace {

constexpr std::array<const char *, 7> kind_colours{"#007D5A", "#0072B2", "#D55E00", "#B0305C",
                                                   "#7A5200", "#5B4FB0", "#555555"};

/// States that look alike: what the masses do, and whether they stay there.
using Look = std::pair<SteadyState::Kind, std::optional<bool>>;
struct DrawnStates {
    std::vector<PlotPoint> line, points;
};
using ByLook = std::map<Look, DrawnStates>;

PlotPoint drawn_at(const Units &units, double speed, double amplitude) {
    return {units(Quantity::speed, speed), units(Quantity::amplitude, amplitude)};
}

/// @param at  a state or a border
PlotPoint drawn(const Units &units, const SteadyStates &states, const auto &at) {
    if (!states.over)
        return drawn_at(units, at.speed, at.residual);
    return {at.value, units(Quantity::amplitude, at.residual)};
}

/// Lines from one state of a branch to the next, with the change of stability between them if there
/// is one, and to where the branch begins and ends.
ByLook drawn_branches(const Units &units, const SteadyStates &states) {
    std::map<int, std::vector<const SteadyState *>> branches;
    for (const SteadyState &state : states.states)
        branches[state.branch].push_back(&state);
    std::vector<double> places = states.places();
    std::ranges::sort(places);
    const auto at = [&states](const auto &of) { return states.place(of); };
    const auto place = [&](const SteadyState &state) {
        return std::ranges::lower_bound(places, at(state)) - places.begin();
    };
    ByLook out;
    // Never through standstill: the states of the other sense of rotation are others.
    const auto piece = [&](const SteadyState &of, const auto &from, const auto &to) {
        if ((from.speed < 0) != (to.speed < 0))
            return;
        add_piece(out[{of.kind, of.stable}].line, drawn(units, states, from),
                  drawn(units, states, to));
    };
    for (const auto &[number, branch] : branches) {
        const SteadyState &first = *branch.front();
        const SteadyState &last = *branch.back();
        for (const SteadyState *state : branch)
            out[{state->kind, state->stable}].points.push_back(drawn(units, states, *state));
        for (const SteadyBorder &border : states.borders)
            if ((border.branch == number || border.other == number) && at(border) < at(first))
                piece(first, border, first);
        for (std::size_t i = 1; i < branch.size(); ++i) {
            const SteadyState &from = *branch[i - 1];
            const SteadyState &to = *branch[i];
            if (place(to) != place(from) + 1)
                continue;
            const auto border = std::ranges::find_if(states.borders, [&](const auto &one) {
                return one.branch == from.branch && at(one) > at(from) && at(one) < at(to);
            });
            if (border == states.borders.end() || from.stable == to.stable) {
                piece(from, from, to);
            } else {
                piece(from, from, *border);
                piece(to, *border, to);
            }
        }
        for (const SteadyBorder &border : states.borders)
            if ((border.branch == number || border.other == number) && at(border) > at(last))
                piece(last, last, border);
    }
    return out;
}

/// The top of the axis: all states, but for those beside a resonance that would press the others
/// onto the axis.
/// @param values  further amplitudes that are drawn
double top_of(const Units &units, const SteadyStates &states, std::vector<double> values,
              bool &cut) {
    constexpr double most = 12; // times the median
    for (const SteadyState &state : states.states)
        if (state.residual > 0)
            values.push_back(units(Quantity::amplitude, state.residual));
    std::ranges::sort(values);
    // Balanced planes leave rounding: they are no measure of the others.
    if (!values.empty())
        std::erase_if(values, [last = values.back()](double v) { return v < 1e-9 * last; });
    if (values.empty())
        return 1;
    const double median = values[values.size() / 2];
    cut = values.back() > most * median;
    return 1.06 * (cut ? most * median : values.back());
}

/// @param motions  drawn over the states
Chart chart_with(const model::Case &scene, const SteadyStates &states, const Units &units,
                 const std::string &title, const std::vector<ChartCurve> &motions) {
    constexpr std::size_t apart = 40; // more points would run into each other
    ChartPanel panel{
        490, states.over ? along_axis(units, *states.over) : along_speeds(units, states.speeds),
        chart_axis(units, "Largest amplitude of a plane", Quantity::amplitude)};
    const ByLook branches = drawn_branches(units, states);
    for (std::size_t kind = 0; kind < kind_colours.size(); ++kind)
        for (const std::optional<bool> stable : stabilities) {
            const auto found = branches.find({static_cast<SteadyState::Kind>(kind), stable});
            if (found == branches.end())
                continue;
            ChartCurve curve = branch_curve(results::steady_kind_name(found->first.first), stable,
                                            kind_colours.at(kind));
            const std::size_t places = states.places().size();
            if (places > 1) {
                curve.points = found->second.line;
                panel.curves.push_back(curve);
            }
            if (places > apart)
                continue;
            curve.points = found->second.points;
            curve.width = 0;
            curve.marker = 0.7;
            panel.curves.push_back(curve);
        }
    const std::array<std::tuple<SteadyBorder::Kind, int, const char *>, 5> marks{
        {{SteadyBorder::Kind::fold, 8, "fold"},
         {SteadyBorder::Kind::limit, 4, "masses just reach"},
         {SteadyBorder::Kind::wall, 10, "a ball meets a wall"},
         {SteadyBorder::Kind::zero, 2, "real root crosses zero"},
         {SteadyBorder::Kind::pair, 12, "limit cycle begins (Hopf)"}}};
    for (const auto &[kind, point, name] : marks) {
        std::vector<PlotPoint> at;
        for (const SteadyBorder &border : states.borders)
            if (border.kind == kind)
                at.push_back(drawn(units, states, border));
        add_marks(panel, name, point, std::move(at));
    }
    std::vector<double> amplitudes;
    for (const ChartCurve &motion : motions) {
        panel.curves.push_back(motion);
        for (const PlotPoint &point : motion.points)
            amplitudes.push_back(point.y.value_or(0));
    }
    bool cut = false;
    panel.y.high = top_of(units, states, std::move(amplitudes), cut);
    panel.y.low = -0.03 * *panel.y.high;
    return {title + ": " + title_of(scene),
            std::string("solid: stable, dashed: unstable, dotted: neither or not known") +
                (cut ? "; larger amplitudes are cut off" : ""),
            {panel}};
}

} // namespace

Chart states_chart(const model::Case &scene, const SteadyStates &states, const Units &units) {
    return chart_with(scene, states, units, "Steady states", {});
}

Chart held_sweep_chart(const model::Case &scene, const results::HeldSweep &sweep,
                       const Units &units) {
    ChartCurve up{"motion, speed going up", {}, {"", "#000000", "1", 9}, 2, 1.3};
    ChartCurve down{"motion, speed going down", {}, {"", "#C4347A", "1", 11}, 2, 1.3};
    SteadyStates states = sweep.states.value_or(SteadyStates{});
    states.speeds.clear();
    for (const results::HeldMotion &motion : sweep.motions) {
        (motion.up ? up : down).points.push_back(drawn_at(units, motion.speed, motion.largest()));
        if (motion.up)
            states.speeds.push_back(motion.speed);
    }
    std::vector<ChartCurve> motions{up};
    if (!down.points.empty()) {
        down.points.insert(down.points.begin(), up.points.back()); // where it turns back
        motions.push_back(down);
    }
    return chart_with(scene, states, units, "Sweep in time", motions);
}

} // namespace whirl::report
