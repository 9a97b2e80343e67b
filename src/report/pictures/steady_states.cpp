#include "report/pictures/figures.h"

#include "report/pictures/operation.h"
#include "report/pictures/style.h"
#include "results/held_motion.h"
#include "results/steady_states.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace whirl::report {

using results::SteadyBorder;
using results::SteadyState;
using results::SteadyStates;

namespace {

enum class Keeps { stable, unstable, neither };

Keeps keeps(const SteadyState &state) {
    return !state.stable ? Keeps::neither : *state.stable ? Keeps::stable : Keeps::unstable;
}

std::optional<bool> known(Keeps which) {
    return which == Keeps::neither ? std::nullopt : std::optional(which == Keeps::stable);
}

constexpr std::array<const char *, 5> kind_colours{"#007D5A", "#0072B2", "#D55E00", "#B0305C",
                                                   "#7A5200"};
const char *colour_of(SteadyState::Kind kind) {
    return kind_colours.at(static_cast<std::size_t>(kind));
}

std::string point_look(Keeps which, const char *colour) {
    return fmt::format("with points pt {} ps 0.7 lc rgb '{}'",
                       which == Keeps::stable     ? 7
                       : which == Keeps::unstable ? 6
                                                  : 1,
                       colour);
}

/// Pieces of lines, and single states, of one colour and look.
struct DrawnStates {
    std::vector<std::vector<PlotPoint>> lines;
    std::vector<PlotPoint> points;
};
using ByLook = std::map<std::pair<SteadyState::Kind, Keeps>, DrawnStates>;

PlotPoint drawn_at(const Units &units, double speed, double amplitude) {
    return {units(Quantity::speed, speed), units(Quantity::amplitude, amplitude)};
}

/// From one state of a branch to the next, with the change of stability between them if there is
/// one.
void add_piece(const Units &units, const SteadyStates &states, const SteadyState &from,
               const SteadyState &to, ByLook &out) {
    const PlotPoint first = drawn_at(units, from.speed, from.residual);
    const PlotPoint last = drawn_at(units, to.speed, to.residual);
    for (const SteadyBorder &border : states.borders)
        if (border.branch == from.branch && border.speed > from.speed && border.speed < to.speed &&
            keeps(from) != keeps(to)) {
            const PlotPoint middle = drawn_at(units, border.speed, border.residual);
            out[{from.kind, keeps(from)}].lines.push_back({first, middle});
            out[{to.kind, keeps(to)}].lines.push_back({middle, last});
            return;
        }
    out[{from.kind, keeps(from)}].lines.push_back({first, last});
}

ByLook drawn_branches(const Units &units, const SteadyStates &states) {
    std::map<int, std::vector<const SteadyState *>> branches;
    for (const SteadyState &state : states.states)
        branches[state.branch].push_back(&state);
    std::vector<double> speeds = states.speeds;
    std::ranges::sort(speeds);
    const auto place = [&speeds](double speed) {
        return std::ranges::lower_bound(speeds, speed) - speeds.begin();
    };
    ByLook out;
    for (const auto &[number, branch] : branches) {
        for (const SteadyState *state : branch)
            out[{state->kind, keeps(*state)}].points.push_back(
                drawn_at(units, state->speed, state->residual));
        for (std::size_t i = 1; i < branch.size(); ++i)
            if (place(branch[i]->speed) == place(branch[i - 1]->speed) + 1)
                add_piece(units, states, *branch[i - 1], *branch[i], out);
        for (const SteadyBorder &border : states.borders) { // where it begins or ends
            if (border.branch != number && border.other != number)
                continue;
            const PlotPoint end = drawn_at(units, border.speed, border.residual);
            if (border.speed < branch.front()->speed)
                out[{branch.front()->kind, keeps(*branch.front())}].lines.push_back(
                    {end, drawn_at(units, branch.front()->speed, branch.front()->residual)});
            if (border.speed > branch.back()->speed)
                out[{branch.back()->kind, keeps(*branch.back())}].lines.push_back(
                    {drawn_at(units, branch.back()->speed, branch.back()->residual), end});
        }
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

/// @param motions  curves that are drawn over those of the states, each in a style of its own
Figure figure_with(const model::Case &scene, const SteadyStates &states, const Units &units,
                   const std::string &title, const std::vector<NamedCurve> &motions) {
    constexpr int height = 660;
    const ByLook drawn = drawn_branches(units, states);
    const bool lines = states.speeds.size() > 1;
    constexpr std::size_t apart = 40; // more points would run into each other
    const bool points = states.speeds.size() <= apart;
    Curves curves;
    std::vector<std::string> names{"real root crosses zero"};
    for (const auto &[look, of] : drawn) {
        const auto &[kind, which] = look;
        const std::string name =
            results::steady_kind_name(kind) + (which == Keeps::stable     ? ", stable"
                                               : which == Keeps::unstable ? ", unstable"
                                                                          : ", neither");
        names.push_back(name);
        if (lines)
            curves.add_pieces(of.lines, stability_look(known(which), colour_of(kind)));
        if (points)
            curves.add(of.points, point_look(which, colour_of(kind)));
        curves.add(fmt::format("NaN {} title {}",
                               lines ? stability_look(known(which), colour_of(kind))
                                     : point_look(which, colour_of(kind)),
                               plot_text(name)));
    }
    const std::array<std::tuple<SteadyBorder::Kind, int, const char *>, 4> marks{
        {{SteadyBorder::Kind::fold, 8, "fold"},
         {SteadyBorder::Kind::limit, 4, "masses just reach"},
         {SteadyBorder::Kind::zero, 2, "real root crosses zero"},
         {SteadyBorder::Kind::pair, 12, "limit cycle begins (Hopf)"}}};
    for (const auto &[kind, point, name] : marks) {
        std::vector<PlotPoint> at;
        for (const SteadyBorder &border : states.borders)
            if (border.kind == kind)
                at.push_back(drawn_at(units, border.speed, border.residual));
        if (!at.empty()) {
            curves.add(at, fmt::format("with points pt {} ps 1.4 lw 1.6 lc rgb '#222222'", point),
                       fmt::format("'{}'", name));
            names.emplace_back(name);
        }
    }
    std::vector<double> amplitudes;
    for (std::size_t i = 0; i < motions.size(); ++i) {
        LineStyle style = series_style(i);
        style.colour = i == 0 ? "#000000" : i == 1 ? "#C4347A" : "#8A8A8A";
        curves.add(motions[i].points,
                   fmt::format("with linespoints lc rgb '{}' lw 2 dt {} pt {} ps {}", style.colour,
                               i < 2 ? "1" : "(2,3)", i == 0 ? 9 : 11, i < 2 ? "1.3" : "0"),
                   plot_text(motions[i].name));
        names.push_back(motions[i].name);
        for (const PlotPoint &point : motions[i].points)
            amplitudes.push_back(point.y.value_or(0));
    }
    bool cut = false;
    const double top = top_of(units, states, std::move(amplitudes), cut);
    const LegendedFigure figure = beside_legend(900, 1200, height, names);
    const Range x = speed_range(units, states.speeds);
    curves.add(operation_key(scene, units, x));
    const std::string panel =
        figure.panel(100, height - 70) + operation_band(scene, units, x) + grid + linear_y +
        fmt::format("set xrange [{}:{}]\nset yrange [{}:{}]\n", x.low, x.high, -0.03 * top, top) +
        axes_beside_legend(units.label("Largest amplitude of a plane", Quantity::amplitude),
                           units.label("Spin speed", Quantity::speed)) +
        curves.script() + "unset object\nunset arrow\n";
    return figure_of(figure.width, height, title + ": " + title_of(scene),
                     std::string("solid: stable, dashed: unstable, dotted: neither or not known") +
                         (cut ? "; larger amplitudes are cut off" : ""),
                     panel);
}

} // namespace

Figure states_figure(const model::Case &scene, const SteadyStates &states, const Units &units) {
    return figure_with(scene, states, units, "Steady states", {});
}

Figure held_sweep_figure(const model::Case &scene, const results::HeldSweep &sweep,
                         const Units &units) {
    NamedCurve up{"motion, speed going up", {}};
    NamedCurve down{"motion, speed going down", {}};
    std::vector<double> speeds;
    for (const results::HeldMotion &motion : sweep.motions) {
        (motion.up ? up : down).points.push_back(drawn_at(units, motion.speed, motion.largest()));
        if (motion.up)
            speeds.push_back(motion.speed);
    }
    std::vector<NamedCurve> curves{up};
    if (!down.points.empty()) {
        down.points.insert(down.points.begin(), up.points.back()); // where it turns back
        curves.push_back(down);
    }
    SteadyStates states = sweep.states.value_or(SteadyStates{});
    states.speeds = speeds;
    return figure_with(scene, states, units, "Sweep in time", curves);
}

} // namespace whirl::report
