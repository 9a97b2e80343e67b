#include "tracking/crossings.h"

#include "assembly/discretization.h"
#include "results/campbell.h"
#include "results/formulation.h"
#include "results/whirl.h"
#include "tracking/crossing_nodes.h"
#include "tracking/crossing_step.h"
#include "tracking/locked_whirl.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace whirl::tracking {

namespace {

/// A distance is zero below this share of the frequency, and a step too short to be split below
/// this share of the speed: eigenvalues are known to some 1e-12.
constexpr double resolved = 1e-11;

StepEnd end_of(const modes::Spectrum &spectrum, const Rates &rates, std::size_t place,
               double multiple, bool towards_higher) {
    const modes::WhirlMode &mode = spectrum.modes[place];
    const double target = multiple * std::abs(spectrum.speed);
    const double turn = std::signbit(spectrum.speed) ? -multiple : multiple;
    const auto i = static_cast<Eigen::Index>(place);
    const double rate = (towards_higher ? rates.above : rates.below)(i).imag();
    return {spectrum.speed, mode.eigenvalue.imag() - target, rate - turn,
            resolved * std::max(target, mode.eigenvalue.imag())};
}

/// Crossings of all lines with one multiple.
class CrossingSearch {
  public:
    CrossingSearch(const modes::SpectrumSolver &solver, double multiple, Crossings &out)
        : _solver(solver), _multiple(multiple), _out(out) {}

    /// A node given by the sweep: roots that lie on it.
    void visit(const Node &node) {
        for (std::size_t i = 0; i < node.lines.size(); ++i)
            if (node.lines[i] != no_line)
                take_if_root(node, i);
    }

    void search(const Node &a, const Node &b, const std::vector<Link> &links, int depth = 0) {
        for (const Link &link : links) {
            const std::optional<double> speed = look(a, b, link, depth);
            if (!speed)
                continue;
            split(a, b, links, *speed, depth);
            return;
        }
    }

    /// Ends of bands in which a motion stands still in the rotor, each once: by the numbers of such
    /// motions, not by lines, which such motions leave and join.
    void find_lock_ends(const Node &a, const Node &b, int line) {
        const double from = a.snapshot.spectrum.speed;
        const double to = b.snapshot.spectrum.speed;
        const bool known = std::any_of(_ends.begin(), _ends.end(),
                                       [from, to](double end) { return end >= from && end <= to; });
        if (known || from * to <= 0)
            return;
        for (const LockEnd &end : lock_ends(_solver, from, to, 1, wanted_of(a, b)))
            take_lock_end(end.speed, line);
    }

    /// For the line of the motion that leaves the band there, between two nodes.
    void take_lock_end(const LockEnd &end, const Node &a, const Node &b) {
        const Node outside = node_at(_solver, end.outside, a, b);
        int line = slowest_line(outside, false);
        for (const Node *node : {&a, &b}) // it may not have been followed to there
            if (line == no_line)
                line = slowest_line(*node, true);
        if (line != no_line)
            take_lock_end(end.speed, line);
    }

    /// A line that is there at one node and real at the other.
    void follow_to_zero(Node there, Node gone, int line) {
        for (int halves = 0; halves < 20; ++halves) {
            const auto place = std::find(there.lines.begin(), there.lines.end(), line);
            const auto at = static_cast<std::size_t>(place - there.lines.begin());
            if (place == there.lines.end() || end(there, at, true).distance <= 0)
                return;
            const double from = there.snapshot.spectrum.speed;
            const double to = gone.snapshot.spectrum.speed;
            Node middle = node_at(_solver, (from + to) / 2, there, gone);
            const auto now = std::find(middle.lines.begin(), middle.lines.end(), line);
            if (now == middle.lines.end()) {
                gone = std::move(middle);
                continue;
            }
            const Link link{at, static_cast<std::size_t>(now - middle.lines.begin()), line};
            if (from < to)
                search(there, middle, {link});
            else
                search(middle, there, {{link.to, link.from, line}});
            there = std::move(middle);
        }
    }

  private:
    const modes::SpectrumSolver &_solver;
    double _multiple;
    Crossings &_out;
    std::vector<double> _ends; ///< of bands of locked motion

    /// The line of the motion that turns least as seen from the rotor.
    [[nodiscard]] static int slowest_line(const Node &node, bool or_stands) {
        int line = no_line;
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < node.lines.size(); ++i) {
            const double frequency = std::abs(mode_at(node, i).frequency_rotating);
            if (node.lines[i] != no_line && (or_stands || frequency != 0) && frequency < least) {
                least = frequency;
                line = node.lines[i];
            }
        }
        return line;
    }

    void take_lock_end(double speed, int line) {
        _ends.push_back(speed);
        take(line, speed);
    }

    [[nodiscard]] StepEnd end(const Node &node, std::size_t place, bool towards_higher) const {
        const modes::ModeBasis &basis = node.snapshot.basis;
        return end_of(node.snapshot.spectrum, {basis.rate_below, basis.rate_above}, place,
                      _multiple, towards_higher);
    }

    [[nodiscard]] bool held(const Node &node, std::size_t place) const {
        return _multiple == 1 && results::in_rotating_axes(_solver.form()) &&
               locked(mode_at(node, place), node.snapshot.spectrum.speed);
    }

    /// Of the two whirls of a motion in rotating axes, at the spin speed plus and minus the
    /// frequency seen from the rotor, the first: where the larger one changes the frequency jumps.
    [[nodiscard]] bool upper_whirl(const Node &node, std::size_t place) const {
        if (!results::in_rotating_axes(_solver.form()))
            return true;
        const modes::WhirlMode &mode = mode_at(node, place);
        const double speed = node.snapshot.spectrum.speed;
        const bool positive = (mode.whirl == results::Whirl::forward) == (speed > 0);
        return (positive ? mode.eigenvalue.imag() : -mode.eigenvalue.imag()) >= speed;
    }

    /// A node may lie within the tolerance of a root found before.
    void take(int line, double speed) {
        const bool known =
            std::any_of(_out.found.begin(), _out.found.end(), [&](const results::Crossing &other) {
                return other.multiple == _multiple && other.mode == line &&
                       std::abs(other.speed - speed) <= 1e2 * resolved * std::abs(speed);
            });
        if (!known)
            _out.found.push_back({_multiple, speed, _multiple * std::abs(speed), line});
    }

    void take_if_root(const Node &node, std::size_t place) {
        if (held(node, place) || mode_at(node, place).eigenvalue.imag() == 0)
            return;
        const StepEnd here = end(node, place, true);
        if (std::abs(here.distance) > here.tolerance)
            return;
        // One Newton step more where the line is not parallel to the multiple.
        const double step = here.distance / here.slope;
        const bool sound = std::abs(step) < 1e3 * resolved * std::abs(here.speed);
        take(node.lines[place], here.speed - (sound ? step : 0));
    }

    /// Where this link has to be looked at, or none.
    std::optional<double> look(const Node &a, const Node &b, const Link &link, int depth) {
        const StepEnd from = end(a, link.from, true);
        const StepEnd to = end(b, link.to, false);
        const double width = to.speed - from.speed;
        if (mode_at(a, link.from).eigenvalue.imag() == 0 ||
            mode_at(b, link.to).eigenvalue.imag() == 0)
            return std::nullopt;
        const bool short_enough =
            width <= resolved * std::max(std::abs(from.speed), std::abs(to.speed));
        const bool hold_a = held(a, link.from);
        const bool hold_b = held(b, link.to);
        if (hold_a != hold_b)
            find_lock_ends(a, b, link.line);
        if (hold_a || hold_b)
            return std::nullopt;
        const std::optional<double> speed = where_to_look(from, to, depth);
        // At the spin speed itself one goes over into the other without a jump.
        if (speed && _multiple != 1 && upper_whirl(a, link.from) != upper_whirl(b, link.to))
            return depth < 12 ? std::optional((from.speed + to.speed) / 2) : std::nullopt;
        if (speed && (short_enough || depth > 70)) {
            settle_short(a, link, from, to);
            return std::nullopt;
        }
        // A cubic that fails again and again is that of a jump: halves find it.
        return speed && depth > 8 && depth % 2 == 0 ? (from.speed + to.speed) / 2 : speed;
    }

    /// Nothing is left to split: a root to the accuracy of the eigenvalues, or a jump, where the
    /// larger whirl of an asymmetric rotor changes (no crossing) or two lines change places.
    void settle_short(const Node &a, const Link &link, const StepEnd &from, const StepEnd &to) {
        const StepEnd &best = std::abs(from.distance) <= std::abs(to.distance) ? from : to;
        if (std::abs(best.distance) <= 1e3 * best.tolerance)
            take(link.line, best.speed);
        else if (!results::in_rotating_axes(_solver.form()))
            _out.unsettled.push_back(
                {from.speed, to.speed, mode_at(a, link.from).eigenvalue.imag()});
    }

    void split(const Node &a, const Node &b, const std::vector<Link> &links, double speed,
               int depth) {
        Node middle = node_at(_solver, speed, a, b);
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
};

/// Speeds strictly inside a step at which a frequency may have a kink: rows of bearing tables,
/// rest.
std::vector<double> kinks(const model::Rotor &rotor, double from, double to) {
    std::set<double> out;
    for (const model::Bearing &bearing : rotor.bearings)
        out.insert(bearing.speeds.begin(), bearing.speeds.end());
    out.insert(0);
    return {out.upper_bound(std::min(from, to)), out.lower_bound(std::max(from, to))};
}

/// The steps of the sweep, looked into where a line may cross.
class Sweep {
  public:
    Sweep(const modes::SpectrumSolver &solver, const Tracking &tracking,
          const std::vector<modes::Spectrum> &spectra)
        : _solver(solver), _tracking(tracking), _spectra(spectra) {}

    void run(double multiple, Crossings &out) const {
        CrossingSearch search(_solver, multiple, out);
        if (multiple == 1 && _solver.form() == results::Form::rotating && _spectra.size() > 1)
            find_bands(search);
        for (std::size_t k = 0; k < _spectra.size(); ++k) {
            search.visit(bare_node(k));
            if (k + 1 == _spectra.size())
                return;
            const std::vector<double> rows =
                kinks(_solver.discretization().rotor(), _spectra[k].speed, _spectra[k + 1].speed);
            const std::vector<Link> links = links_of(k);
            emerge(search, k, multiple);
            if (rows.empty() && !any_look(k, links, multiple))
                continue;
            step(search, k, rows, links);
        }
    }

  private:
    const modes::SpectrumSolver &_solver;
    const Tracking &_tracking;
    const std::vector<modes::Spectrum> &_spectra;

    /// Ends of bands of locked motion over the whole range, the same whatever its grid.
    void find_bands(CrossingSearch &search) const {
        const std::vector<LockEnd> ends =
            lock_ends_over(_solver, _spectra.front().speed, _spectra.back().speed,
                           static_cast<int>(_spectra.front().modes.size()));
        for (std::size_t k = 0; k + 1 < _spectra.size(); ++k)
            for (const LockEnd &end : ends)
                if ((_spectra[k].speed <= end.speed) != (_spectra[k + 1].speed <= end.speed))
                    search.take_lock_end(end, full_node(k), full_node(k + 1));
    }

    [[nodiscard]] std::vector<int> lines_at(std::size_t k) const {
        std::vector<int> out(_spectra[k].modes.size(), no_line);
        for (std::size_t line = 0; line < _tracking.lines.size(); ++line)
            if (_tracking.lines[line].place[k] != Line::absent)
                out[static_cast<std::size_t>(_tracking.lines[line].place[k])] =
                    static_cast<int>(line);
        return out;
    }

    [[nodiscard]] Node bare_node(std::size_t k) const {
        modes::ModeBasis basis;
        basis.rate_below = _tracking.rates[k].below;
        basis.rate_above = _tracking.rates[k].above;
        return {{_spectra[k], std::move(basis)}, lines_at(k)};
    }

    [[nodiscard]] Node full_node(std::size_t k) const {
        return {{_spectra[k], _solver.basis(_spectra[k])}, lines_at(k)};
    }

    [[nodiscard]] std::vector<Link> links_of(std::size_t k) const {
        std::vector<Link> out;
        for (std::size_t line = 0; line < _tracking.lines.size(); ++line) {
            const int a = _tracking.lines[line].place[k];
            const int b = _tracking.lines[line].place[k + 1];
            if (a != Line::absent && b != Line::absent)
                out.push_back({static_cast<std::size_t>(a), static_cast<std::size_t>(b),
                               static_cast<int>(line)});
        }
        return out;
    }

    [[nodiscard]] bool any_look(std::size_t k, const std::vector<Link> &links,
                                double multiple) const {
        return std::any_of(links.begin(), links.end(), [&](const Link &link) {
            const modes::WhirlMode &a = _spectra[k].modes[link.from];
            const modes::WhirlMode &b = _spectra[k + 1].modes[link.to];
            if (multiple == 1 && results::in_rotating_axes(_solver.form()) &&
                locked(a, _spectra[k].speed) != locked(b, _spectra[k + 1].speed))
                return true;
            const bool rising = _spectra[k + 1].speed > _spectra[k].speed;
            const StepEnd here =
                end_of(_spectra[k], _tracking.rates[k], link.from, multiple, rising);
            const StepEnd there =
                end_of(_spectra[k + 1], _tracking.rates[k + 1], link.to, multiple, !rising);
            return where_to_look(rising ? here : there, rising ? there : here, 0).has_value();
        });
    }

    /// Lines that turn real within a step come down to zero frequency there, and through every
    /// multiple that they were above.
    void emerge(CrossingSearch &search, std::size_t k, double multiple) const {
        for (std::size_t line = 0; line < _tracking.lines.size(); ++line) {
            const Line &l = _tracking.lines[line];
            const bool first = l.place[k] != Line::absent;
            if (first == (l.place[k + 1] != Line::absent))
                continue;
            const Absence why = l.absence[first ? k + 1 : k];
            const std::size_t present = first ? k : k + 1;
            const auto place = static_cast<std::size_t>(l.place[present]);
            const StepEnd end =
                end_of(_spectra[present], _tracking.rates[present], place, multiple, first);
            if ((why == Absence::overdamped || why == Absence::divergent) && end.distance > 0)
                search.follow_to_zero(full_node(present), full_node(first ? k + 1 : k),
                                      static_cast<int>(line));
        }
    }

    void step(CrossingSearch &search, std::size_t k, const std::vector<double> &rows,
              const std::vector<Link> &links) const {
        const Node a = full_node(k);
        const Node b = full_node(k + 1);
        const bool rising = a.snapshot.spectrum.speed < b.snapshot.spectrum.speed;
        const Node &low = rising ? a : b;
        const Node &high = rising ? b : a;
        if (rows.empty()) {
            std::vector<Link> upwards = links;
            if (!rising)
                for (Link &link : upwards)
                    std::swap(link.from, link.to);
            search.search(low, high, upwards);
            return;
        }
        std::vector<Node> nodes{low};
        for (const double row : rows) {
            nodes.push_back(node_at(_solver, row, nodes.back(), high));
            search.visit(nodes.back());
        }
        nodes.push_back(high);
        for (std::size_t i = 1; i < nodes.size(); ++i)
            search.search(nodes[i - 1], nodes[i],
                          links_between(nodes[i - 1], nodes[i], nodes[i - 1].lines));
    }
};

} // namespace

Crossings crossings(const modes::SpectrumSolver &solver, const Tracking &tracking,
                    const std::vector<modes::Spectrum> &spectra,
                    const std::vector<double> &multiples) {
    Crossings out;
    const Sweep sweep(solver, tracking, spectra);
    for (const double multiple : multiples) {
        const auto first = std::ssize(out.found);
        sweep.run(multiple, out);
        std::stable_sort(out.found.begin() + first, out.found.end(),
                         [](const results::Crossing &a, const results::Crossing &b) {
                             return a.speed < b.speed;
                         });
    }
    return out;
}

} // namespace whirl::tracking
