#include "tracking/bands/locked_intervals.h"

#include "tracking/crossing_search.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>

namespace whirl::tracking {

namespace {

using results::Locked;

bool overlap(const Locked &a, const Locked &b) { return a.from < b.to && b.from < a.to; }

/// Lines that stand still at a node.
std::vector<int> locked_lines(const Node &node) {
    std::vector<int> out;
    for (std::size_t i = 0; i < node.lines.size(); ++i)
        if (node.lines[i] != no_line && locked(mode_at(node, i), node.snapshot.spectrum.speed))
            out.push_back(node.lines[i]);
    return out;
}

/// Intervals of one sense of the spin, opened and closed by the ends of bands in ascending order.
/// Modes at rest in rotating axes are not distinguished: the band that opened last is closed first,
/// so that nothing depends on the grid of the lines.
class OpenIntervals {
  public:
    /// @param already  motions that stand still from the beginning
    OpenIntervals(double low, std::ptrdiff_t already)
        : _open(static_cast<std::size_t>(already), {1, no_line, low, low}) {}

    void pass(const BandEnd &end) {
        if (end.enters) {
            _open.push_back({1, end.line, end.speed, end.speed});
            return;
        }
        if (_open.empty())
            return;
        _open.back().to = end.speed;
        if (_open.back().mode == no_line)
            _open.back().mode = end.line;
        _closed.push_back(_open.back());
        _open.pop_back();
    }

    [[nodiscard]] std::vector<Locked> closed_at(double high) {
        for (Locked &open : _open) {
            open.to = high;
            _closed.push_back(open);
        }
        return std::move(_closed);
    }

  private:
    std::vector<Locked> _open, _closed;
};

/// Names an interval by the line that is locked at most speeds inside it, and not in another one at
/// the same time. Those without such a speed or line are dropped.
void name_by_lines(const SweepNodes &sweep, std::vector<Locked> &intervals) {
    for (Locked &interval : intervals) {
        if (interval.mode != no_line)
            continue;
        std::map<int, int> votes;
        for (std::size_t k = 0; k < sweep.count(); ++k)
            if (sweep.speed(k) >= interval.from && sweep.speed(k) <= interval.to)
                for (const int line : locked_lines(sweep.bare(k)))
                    ++votes[line];
        std::map<int, int> free = votes;
        for (const Locked &other : intervals)
            if (overlap(interval, other))
                free.erase(other.mode);
        if (!free.empty())
            votes = free;
        const auto most =
            std::ranges::max_element(votes, {}, [](const auto &a) { return a.second; });
        if (most != votes.end())
            interval.mode = most->first;
    }
    std::erase_if(intervals, [](const Locked &interval) { return interval.mode == no_line; });
}

/// Number of modes locked at the beginning of a range: from their number in the middle of the
/// widest stretch between two ends. (Near rest rounding decides whether balls are at rest.)
std::ptrdiff_t locked_from(const modes::SpectrumSolver &solver, int wanted,
                           const std::vector<BandEnd> &ends, double low, double high) {
    std::ptrdiff_t entered = 0; // up to the widest stretch
    std::ptrdiff_t net = 0;
    double middle = low;
    double widest = 0;
    double before = low;
    const auto stretch_to = [&](double speed) {
        if (speed - before > widest) {
            widest = speed - before;
            middle = (speed + before) / 2;
            entered = net;
        }
        before = speed;
    };
    for (const BandEnd &end : ends) {
        stretch_to(end.speed);
        net += end.enters ? 1 : -1;
    }
    stretch_to(high);
    const modes::Spectrum there = solver.at(middle, wanted, modes::Errors::of_right_vectors);
    return std::max<std::ptrdiff_t>(0, locked_motions(there) - entered);
}

std::vector<Locked> of_one_sense(const SweepNodes &sweep, const std::vector<BandEnd> &ends,
                                 int wanted, double low, double high) {
    std::vector<BandEnd> inside;
    std::ranges::copy_if(ends, std::back_inserter(inside),
                         [&](const BandEnd &end) { return end.speed > low && end.speed < high; });
    OpenIntervals intervals(low, locked_from(sweep.solver(), wanted, inside, low, high));
    for (const BandEnd &end : inside)
        intervals.pass(end);
    return intervals.closed_at(high);
}

bool on_multiple(const modes::SpectrumSolver &solver, const modes::WhirlMode &mode, double speed,
                 double multiple) {
    // At rest a motion without a frequency is on every multiple; nothing else is known of it.
    return !locked_to_rotor(solver.form(), mode, speed, multiple) &&
           side_of(mode, speed, multiple) == 0;
}

/// Follows one line over its speeds on a multiple.
class LineOnMultiple {
  public:
    LineOnMultiple(const SweepNodes &sweep, double multiple, int line)
        : _sweep(sweep), _multiple(multiple), _line(line) {}

    void find(std::vector<Locked> &out) const {
        for (std::size_t k = 0; k + 1 < _sweep.count(); ++k) {
            std::size_t last = k;
            while (last + 1 < _sweep.count() && joined(last))
                ++last;
            if (last == k)
                continue;
            const double a = k > 0 ? end_between(k, k - 1) : _sweep.speed(k);
            const double b =
                last + 1 < _sweep.count() ? end_between(last, last + 1) : _sweep.speed(last);
            out.push_back({_multiple, _line, a, b});
            k = last;
        }
    }

  private:
    const SweepNodes &_sweep;
    double _multiple;
    int _line;

    [[nodiscard]] bool on(const Node &node) const {
        const auto place = place_of(node, _line);
        return place && on_multiple(_sweep.solver(), mode_at(node, *place),
                                    node.snapshot.spectrum.speed, _multiple);
    }
    [[nodiscard]] bool on(std::size_t k) const {
        const int place = _sweep.lines()[static_cast<std::size_t>(_line)].place[k];
        return place != Line::absent &&
               on_multiple(_sweep.solver(),
                           _sweep.spectrum(k).modes[static_cast<std::size_t>(place)],
                           _sweep.speed(k), _multiple);
    }
    [[nodiscard]] bool joined(std::size_t k) const {
        if (!on(k) || !on(k + 1) || (_sweep.speed(k) == 0 && _sweep.speed(k + 1) == 0))
            return false;
        // Off the middle, where a line symmetric about it would be too.
        const double between = 0.37 * _sweep.speed(k) + 0.63 * _sweep.speed(k + 1);
        return on(node_at(_sweep.solver(), between, _sweep.full(k), _sweep.full(k + 1)));
    }
    /// Between a speed on the multiple and one where the line is not.
    [[nodiscard]] double end_between(std::size_t inside, std::size_t outside) const {
        if (_sweep.speed(outside) == 0) // there the multiple is zero too
            return 0;
        Node in = _sweep.full(inside);
        Node out = _sweep.full(outside);
        const auto speed = [](const Node &node) { return node.snapshot.spectrum.speed; };
        for (int i = 0; i < 60 && std::abs(speed(out) - speed(in)) > resolved * std::abs(speed(in));
             ++i) {
            Node middle = node_at(_sweep.solver(), (speed(in) + speed(out)) / 2, in, out);
            (on(middle) ? in : out) = std::move(middle);
        }
        return speed(in);
    }
};

} // namespace

std::vector<Locked> intervals_locked_to_rotor(const SweepNodes &sweep, std::vector<BandEnd> ends,
                                              int wanted) {
    std::ranges::sort(ends, {}, &BandEnd::speed);
    const double low = sweep.speed(0);
    const double high = sweep.speed(sweep.count() - 1);
    std::vector<Locked> out;
    for (const auto &[a, b] :
         {std::pair(low, std::min(high, 0.0)), std::pair(std::max(low, 0.0), high)}) {
        if (!(a < b))
            continue;
        const std::vector<Locked> more = of_one_sense(sweep, ends, wanted, a, b);
        out.insert(out.end(), more.begin(), more.end());
    }
    name_by_lines(sweep, out);
    return out;
}

std::vector<Locked> intervals_on_multiple(const SweepNodes &sweep, double multiple) {
    std::vector<Locked> out;
    for (std::size_t line = 0; line < sweep.lines().size(); ++line)
        LineOnMultiple(sweep, multiple, static_cast<int>(line)).find(out);
    return out;
}

} // namespace whirl::tracking
