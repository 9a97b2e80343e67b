#include "tracking/crossing_search.h"

#include "results/campbell.h"
#include "results/damping.h"
#include "results/formulation.h"
#include "results/whirl.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace whirl::tracking {

int side_of(const modes::WhirlMode &mode, double speed, double multiple) {
    const double target = multiple * std::abs(speed);
    const double distance = mode.eigenvalue.imag() - target;
    return std::abs(distance) <= std::max(resolved, mode.rounding) * target ? 0
           : distance > 0                                                   ? 1
                                                                            : -1;
}

bool locked_to_rotor(results::Form form, const modes::WhirlMode &mode, double speed,
                     double multiple) {
    return multiple == 1 && results::in_rotating_axes(form) && locked(mode, speed);
}

StepEnd end_of(const modes::Spectrum &spectrum, const Eigen::VectorXcd &rates, std::size_t place,
               double multiple) {
    const modes::WhirlMode &mode = spectrum.modes[place];
    const double target = multiple * std::abs(spectrum.speed);
    const double turn = std::signbit(spectrum.speed) ? -multiple : multiple;
    const double rate = rates(static_cast<Eigen::Index>(place)).imag();
    return {spectrum.speed, mode.eigenvalue.imag() - target, rate - turn,
            std::max(resolved, mode.rounding) * std::max(target, mode.eigenvalue.imag())};
}

/// A node given by the sweep: roots that lie on it.
void CrossingSearch::visit(const Node &node) {
    for (std::size_t i = 0; i < node.lines.size(); ++i)
        if (node.lines[i] != no_line)
            take_if_root(node, i);
}

void CrossingSearch::search(const Node &a, const Node &b, const std::vector<Link> &links,
                            int depth) {
    // Lines may be lost where a motion begins to stand.
    if (_multiple == 1 && _solver.form() == results::Form::hill &&
        locked_motions(a.snapshot.spectrum) != locked_motions(b.snapshot.spectrum))
        find_lock_ends(a, b, no_line);
    for (const Link &link : links) {
        const std::optional<double> speed = next_speed(a, b, link, depth);
        if (!speed)
            continue;
        split(a, b, links, *speed, depth);
        return;
    }
}

/// Ends of bands in which a motion stands still in the rotor, each once: by the numbers of such
/// motions, not by lines, which such motions leave and join.
void CrossingSearch::find_lock_ends(const Node &a, const Node &b, int line) {
    const double from = a.snapshot.spectrum.speed;
    const double to = b.snapshot.spectrum.speed;
    const bool known = std::ranges::any_of(
        _ends, [from, to](const BandEnd &end) { return end.speed >= from && end.speed <= to; });
    const bool tried = std::ranges::any_of(
        _tried, [from, to](const auto &part) { return part.first <= from && to <= part.second; });
    if (known || tried || from * to <= 0)
        return;
    _tried.emplace_back(from, to);
    for (const LockEnd &end : lock_ends(_solver, from, to, wanted_of(a, b)))
        if (line == no_line)
            take_lock_end(end, a, b);
        else
            take_lock_end(end, line);
}

/// For the line of the motion that leaves the band there, between two nodes.
void CrossingSearch::take_lock_end(const LockEnd &end, const Node &a, const Node &b) {
    int line = _solver.form() == results::Form::hill ? leaving_line(a, b) : no_line;
    if (line == no_line)
        line = slowest_line(node_at(_solver, end.outside, a, b), false);
    for (const Node *node : {&a, &b}) // it may not have been followed to there
        if (line == no_line)
            line = slowest_line(*node, true);
    take_lock_end(end, line);
}

/// A line that is there at one node and real at the other.
void CrossingSearch::follow_to_zero(Node there, Node gone, int line) {
    for (int halves = 0; halves < 20; ++halves) {
        const std::optional<std::size_t> at = place_of(there, line);
        if (!at || end(there, *at, true).distance <= 0)
            return;
        const double from = there.snapshot.spectrum.speed;
        const double to = gone.snapshot.spectrum.speed;
        Node middle = node_at(_solver, (from + to) / 2, there, gone);
        const std::optional<std::size_t> now = place_of(middle, line);
        if (!now) {
            gone = std::move(middle);
            continue;
        }
        const Link link{*at, *now, line};
        if (from < to)
            search(there, middle, {link});
        else
            search(middle, there, {{link.to, link.from, line}});
        there = std::move(middle);
    }
}

/// The line that stands still at one of two nodes and not at the other, if there is just one.
int CrossingSearch::leaving_line(const Node &a, const Node &b) const {
    int line = no_line;
    for (std::size_t i = 0; i < a.lines.size(); ++i) {
        const std::optional<std::size_t> j = place_of(b, a.lines[i]);
        if (a.lines[i] == no_line || !j || held(a, i) == held(b, *j))
            continue;
        if (line != no_line)
            return no_line;
        line = a.lines[i];
    }
    return line;
}

/// The line of the motion that turns least as seen from the rotor.
int CrossingSearch::slowest_line(const Node &node, bool or_stands) const {
    int line = no_line;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < node.lines.size(); ++i) {
        const double frequency =
            turn_in_rotor(mode_at(node, i), node.snapshot.spectrum.speed, _solver.form());
        if (node.lines[i] != no_line && (or_stands || frequency != 0) && frequency < least) {
            least = frequency;
            line = node.lines[i];
        }
    }
    return line;
}

void CrossingSearch::take_lock_end(const LockEnd &end, int line) {
    _ends.push_back({end.speed, end.outside < end.speed, line});
    if (line != no_line)
        take(line, end.speed, end.real);
}

StepEnd CrossingSearch::end(const Node &node, std::size_t place, bool towards_higher) const {
    const modes::ModeBasis &basis = node.snapshot.basis;
    return end_of(node.snapshot.spectrum, towards_higher ? basis.rate_above : basis.rate_below,
                  place, _multiple);
}

bool CrossingSearch::held(const Node &node, std::size_t place) const {
    return locked_to_rotor(_solver.form(), mode_at(node, place), node.snapshot.spectrum.speed,
                           _multiple);
}

/// Of the two whirls of a motion in rotating axes, at the spin speed plus and minus the
/// frequency seen from the rotor, the first: where the larger one changes the frequency jumps.
bool CrossingSearch::upper_whirl(const Node &node, std::size_t place) const {
    if (!results::in_rotating_axes(_solver.form()))
        return true;
    const modes::WhirlMode &mode = mode_at(node, place);
    const double speed = node.snapshot.spectrum.speed;
    const bool positive = (mode.whirl == results::Whirl::forward) == (speed > 0);
    return (positive ? mode.eigenvalue.imag() : -mode.eigenvalue.imag()) >= speed;
}

/// A node may lie within the tolerance of a root found before.
void CrossingSearch::take(int line, double speed, double real, double margin) {
    const double frequency = _multiple * std::abs(speed);
    const bool known = std::ranges::any_of(_out.found, [&](const results::Crossing &other) {
        return other.multiple == _multiple && other.mode == line &&
               std::abs(other.speed - speed) <= 1e2 * std::max(resolved * std::abs(speed), margin);
    });
    if (!known)
        _out.found.push_back(
            {_multiple, speed, frequency, line, results::damping_of({real, frequency})});
}

void CrossingSearch::take_if_root(const Node &node, std::size_t place) {
    if (held(node, place) || mode_at(node, place).eigenvalue.imag() == 0)
        return;
    const StepEnd here = end(node, place, true);
    if (std::abs(here.distance) > here.tolerance)
        return;
    // One Newton step more where the line is not parallel to the multiple.
    const double step = here.distance / here.slope;
    const bool sound = std::abs(step) < 1e3 * resolved * std::abs(here.speed);
    take(node.lines[place], here.speed - (sound ? step : 0), mode_at(node, place).eigenvalue.real(),
         here.margin());
}

/// Speed at which this link has to be solved, or none.
std::optional<double> CrossingSearch::next_speed(const Node &a, const Node &b, const Link &link,
                                                 int depth) {
    const StepEnd from = end(a, link.from, true);
    const StepEnd to = end(b, link.to, false);
    const double width = to.speed - from.speed;
    if (mode_at(a, link.from).eigenvalue.imag() == 0 || mode_at(b, link.to).eigenvalue.imag() == 0)
        return std::nullopt;
    const bool short_enough = width <= std::max(from.margin(), to.margin());
    const bool hold_a = held(a, link.from);
    const bool hold_b = held(b, link.to);
    if (hold_a != hold_b)
        find_lock_ends(a, b, link.line);
    if (hold_a || hold_b)
        return std::nullopt;
    const std::optional<double> speed = next_probe(from, to, depth);
    if (speed && results::in_rotating_axes(_solver.form()) && jumps_past(from, to, _multiple))
        return std::nullopt;
    // At the spin speed itself one goes over into the other without a jump.
    if (speed && _multiple != 1 && upper_whirl(a, link.from) != upper_whirl(b, link.to))
        return depth < 12 ? std::optional((from.speed + to.speed) / 2) : std::nullopt;
    if (speed && (short_enough || depth > 70)) {
        settle_short(a, b, link, from, to);
        return std::nullopt;
    }
    // A cubic that fails again and again is that of a jump: halves find it.
    return speed && depth > 8 && depth % 2 == 0 ? (from.speed + to.speed) / 2 : speed;
}

/// Nothing is left to split: a root to the accuracy of the eigenvalues, or a jump, where the
/// larger whirl of an asymmetric rotor changes (no crossing) or two lines change places.
void CrossingSearch::settle_short(const Node &a, const Node &b, const Link &link,
                                  const StepEnd &from, const StepEnd &to) {
    const bool first = std::abs(from.distance) <= std::abs(to.distance);
    const StepEnd &best = first ? from : to;
    const modes::WhirlMode &mode = first ? mode_at(a, link.from) : mode_at(b, link.to);
    if (std::abs(best.distance) <= 1e3 * best.tolerance)
        take(link.line, best.speed, mode.eigenvalue.real(), best.margin());
    else if (!results::in_rotating_axes(_solver.form()))
        _out.unsettled.push_back({from.speed, to.speed, mode_at(a, link.from).eigenvalue.imag()});
}

void CrossingSearch::split(const Node &a, const Node &b, const std::vector<Link> &links,
                           double speed, int depth) {
    // On a root itself a vibration in one direction stands still in the rotor, by rounding as two
    // motions: beside it, by less than its tolerance.
    const double beside = speed + 0.3 * resolved * std::abs(speed);
    const bool hill = _solver.form() == results::Form::hill;
    Node middle =
        node_at(_solver, hill && beside < b.snapshot.spectrum.speed ? beside : speed, a, b);
    // Lines that came through this step but are in neither pairing keep out of it.
    std::set<int> wanted;
    for (const Link &link : links)
        wanted.insert(link.line);
    for (int &line : middle.lines)
        if (wanted.count(line) == 0)
            line = no_line;
    visit(middle);
    search(a, middle, links_between(a, middle, a.lines), depth + 1);
    search(middle, b, links_between(middle, b, middle.lines), depth + 1);
}

} // namespace whirl::tracking
