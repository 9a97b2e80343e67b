#include "tracking/crossings.h"

#include "assembly/discretization.h"
#include "results/campbell.h"
#include "results/damping.h"
#include "results/formulation.h"
#include "tracking/bands/locked_bands.h"
#include "tracking/bands/locked_intervals.h"
#include "tracking/bands/locked_whirl.h"
#include "tracking/crossing_nodes.h"
#include "tracking/crossing_search.h"
#include "tracking/crossing_step.h"
#include "tracking/followed_crossings.h"
#include "tracking/followed_lines.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace whirl::tracking {

namespace {

using results::Locked;

/// Bends of bearing tables strictly inside a step: a frequency has a kink there. So has the
/// multiple at rest, which the slopes at the ends of a step over it show; in rotating axes a mode
/// is no forward or backward whirl there, and no line is to be followed to it.
std::vector<double> kinks(const model::Rotor &rotor, double from, double to) {
    const std::vector<double> bends = rotor.table_bends();
    return {std::ranges::upper_bound(bends, from), std::ranges::lower_bound(bends, to)};
}

bool inside(const Locked &interval, double a, double b) {
    return interval.from <= a && interval.to >= b;
}

bool overlap_of(const Locked &interval, double a, double b) {
    return interval.from <= b && interval.to >= a;
}

/// The steps of the sweep, searched where a line may cross.
class Sweep {
  public:
    explicit Sweep(const SweepNodes &nodes) : _nodes(nodes) {}

    void run(double multiple, Crossings &out) const {
        CrossingSearch search(_nodes.solver(), multiple, out);
        const std::vector<LockedBand> of_series =
            hill() ? locked_bands(_nodes, multiple) : std::vector<LockedBand>();
        const std::vector<Locked> on_multiple =
            hill() ? intervals_of(of_series, out.found) : intervals_on_multiple(_nodes, multiple);
        const bool bands = multiple == 1 && _nodes.count() > 1 &&
                           results::in_rotating_axes(_nodes.solver().form());
        const int wanted = bands ? wanted_for_bands() : 0;
        if (bands)
            find_bands(search, wanted, of_series);
        const std::vector<FollowedCrossing> plain = followed_crossings(_nodes, multiple);
        for (const FollowedCrossing &crossing : plain)
            search.take(crossing.line, crossing.speed, crossing.real);
        for (std::size_t k = 0; k < _nodes.count(); ++k) {
            if (any_on(k, multiple))
                search.visit(_nodes.bare(k));
            if (k + 1 < _nodes.count())
                search_step(search, k, multiple, on_multiple, plain);
        }
        drop_inside(on_multiple, multiple, hill(), out.found);
        if (!bands || !hill()) // else they are among those locked to the rotor
            out.locked.insert(out.locked.end(), on_multiple.begin(), on_multiple.end());
        if (bands) {
            const std::vector<Locked> to_rotor =
                intervals_locked_to_rotor(_nodes, search.band_ends(), wanted);
            out.locked.insert(out.locked.end(), to_rotor.begin(), to_rotor.end());
        }
    }

  private:
    const SweepNodes &_nodes;

    [[nodiscard]] bool hill() const { return _nodes.solver().form() == results::Form::hill; }

    [[nodiscard]] bool inside_range(double speed) const {
        return speed > _nodes.speed(0) && speed < _nodes.speed(_nodes.count() - 1);
    }

    /// Of bands of periodic equations their ends inside the range are crossings.
    [[nodiscard]] std::vector<Locked> intervals_of(const std::vector<LockedBand> &bands,
                                                   std::vector<results::Crossing> &found) const {
        std::vector<Locked> on_multiple;
        for (const auto &[interval, real_from, real_to] : bands) {
            on_multiple.push_back(interval);
            for (const auto &[speed, real] :
                 {std::pair(interval.from, real_from), std::pair(interval.to, real_to)})
                if (inside_range(speed)) {
                    const double frequency = interval.multiple * std::abs(speed);
                    found.push_back({interval.multiple, speed, frequency, interval.mode,
                                     results::damping_of({real, frequency})});
                }
        }
        return on_multiple;
    }

    /// What a search found on lines that stay on the multiple: the speeds that it tried. In bands
    /// of periodic equations lines begin and end, and only the ends count.
    /// @param bands  the intervals are such bands
    static void drop_inside(const std::vector<Locked> &on_multiple, double multiple, bool bands,
                            std::vector<results::Crossing> &found) {
        std::erase_if(found, [&](const results::Crossing &c) {
            return c.multiple == multiple &&
                   std::ranges::any_of(on_multiple, [&](const Locked &interval) {
                       if (bands && (c.speed == interval.from || c.speed == interval.to))
                           return false;
                       const double margin = 1e3 * resolved * std::abs(c.speed);
                       return (bands || interval.mode == c.mode) &&
                              c.speed >= interval.from - margin && c.speed <= interval.to + margin;
                   });
        });
    }

    /// The line goes through a band of periodic equations in this step, or begins or ends in it.
    [[nodiscard]] bool passes(const Locked &band, const Link &link, std::size_t k) const {
        if (!overlap_of(band, _nodes.speed(k), _nodes.speed(k + 1)))
            return false;
        const auto side = [&](std::size_t node, std::size_t place) {
            return side_of(_nodes.spectrum(node).modes[place], _nodes.speed(node), band.multiple);
        };
        return side(k, link.from) * side(k + 1, link.to) <= 0;
    }

    void search_step(CrossingSearch &search, std::size_t k, double multiple,
                     const std::vector<Locked> &on_multiple,
                     const std::vector<FollowedCrossing> &known) const {
        const std::vector<double> rows =
            kinks(_nodes.solver().discretization().rotor(), _nodes.speed(k), _nodes.speed(k + 1));
        std::vector<Link> links = _nodes.links(k);
        std::erase_if(links, [&](const Link &link) {
            return std::ranges::any_of(on_multiple, [&](const Locked &interval) {
                return (interval.mode == link.line &&
                        inside(interval, _nodes.speed(k), _nodes.speed(k + 1))) ||
                       (hill() && passes(interval, link, k));
            });
        });
        std::erase_if(links, [&](const Link &link) {
            return std::ranges::any_of(known, [&](const FollowedCrossing &crossing) {
                return crossing.step == k && crossing.line == link.line;
            });
        });
        emerge(search, k, multiple);
        if (!rows.empty() || may_cross(k, links, multiple))
            step(search, k, rows, links);
    }

    /// Number of modes so that all that are locked to the rotor at the ends of the range are among
    /// them.
    [[nodiscard]] int wanted_for_bands() const {
        auto wanted = static_cast<int>(_nodes.spectrum(0).modes.size());
        for (const std::size_t k : {std::size_t{0}, _nodes.count() - 1})
            for (int attempt = 0; attempt < 6; ++attempt) {
                const double speed = _nodes.speed(k);
                const bool known = std::ssize(_nodes.spectrum(k).modes) == wanted;
                const modes::Spectrum at =
                    known ? _nodes.spectrum(k) : _nodes.solver().at(speed, wanted);
                const bool beyond = static_cast<int>(at.modes.size()) < wanted ||
                                    at.modes.back().eigenvalue.imag() > std::abs(speed);
                if (beyond)
                    break;
                wanted += std::max(4, wanted / 2);
            }
        return wanted;
    }

    /// Of a Hill series: ends in the steps over which the number of locked modes changes, or, where
    /// speeds cost little, may change for a while.
    /// @param known  steps that hold one of these are not searched again
    [[nodiscard]] std::vector<LockEnd>
    lock_ends_by_steps(int wanted, const std::vector<LockedBand> &known) const {
        std::vector<LockEnd> ends;
        for (std::size_t k = 0; k + 1 < _nodes.count(); ++k) {
            const double from = _nodes.speed(k);
            const double to = _nodes.speed(k + 1);
            if (from * to <= 0 || std::ranges::any_of(known, [&](const LockedBand &band) {
                    return band.interval.from > from && band.interval.to < to;
                }))
                continue;
            const modes::Spectrum &here = _nodes.spectrum(k);
            const modes::Spectrum &next = _nodes.spectrum(k + 1);
            std::vector<LockEnd> more;
            if (_nodes.solver().by_matrix())
                more = lock_ends(_nodes.solver(), here, _nodes.rates(k).above, next,
                                 _nodes.rates(k + 1).below);
            else if (locked_motions(here) != locked_motions(next))
                more = lock_ends(_nodes.solver(), from, to, wanted);
            ends.insert(ends.end(), more.begin(), more.end());
        }
        return ends;
    }

    /// Ends of bands of locked motion over the whole range, the same whatever its grid.
    /// @param known  of periodic equations
    void find_bands(CrossingSearch &search, int wanted,
                    const std::vector<LockedBand> &known) const {
        for (const auto &[interval, real_from, real_to] : known)
            for (const auto &[speed, outside, real] :
                 {std::tuple(interval.from, _nodes.speed(0), real_from),
                  std::tuple(interval.to, _nodes.speed(_nodes.count() - 1), real_to)})
                if (inside_range(speed))
                    search.take_lock_end({speed, outside, real, {}}, interval.mode);
        const std::vector<LockEnd> ends =
            hill() ? lock_ends_by_steps(wanted, known)
                   : lock_ends_over(_nodes.solver(), _nodes.speed(0),
                                    _nodes.speed(_nodes.count() - 1), wanted);
        for (std::size_t k = 0; k + 1 < _nodes.count(); ++k)
            for (const LockEnd &end : ends)
                if ((_nodes.speed(k) <= end.speed) != (_nodes.speed(k + 1) <= end.speed))
                    search.take_lock_end(end, _nodes.full(k), _nodes.full(k + 1));
    }

    /// Whether a mode at a speed may lie on the multiple.
    [[nodiscard]] bool any_on(std::size_t k, double multiple) const {
        const modes::Spectrum &spectrum = _nodes.spectrum(k);
        for (std::size_t i = 0; i < spectrum.modes.size(); ++i) {
            const StepEnd here = end_of(spectrum, _nodes.rates(k).above, i, multiple);
            if (!(std::abs(here.distance) > here.tolerance))
                return true;
        }
        return false;
    }

    [[nodiscard]] bool may_cross(std::size_t k, const std::vector<Link> &links,
                                 double multiple) const {
        const modes::Spectrum &first = _nodes.spectrum(k);
        const modes::Spectrum &second = _nodes.spectrum(k + 1);
        return std::ranges::any_of(links, [&](const Link &link) {
            const results::Form form = _nodes.solver().form();
            const StepEnd here = end_of(first, _nodes.rates(k).above, link.from, multiple);
            const StepEnd there = end_of(second, _nodes.rates(k + 1).below, link.to, multiple);
            return locked_to_rotor(form, first.modes[link.from], first.speed, multiple) !=
                       locked_to_rotor(form, second.modes[link.to], second.speed, multiple) ||
                   (next_probe(here, there, 0).has_value() &&
                    !(results::in_rotating_axes(form) && jumps_past(here, there, multiple)));
        });
    }

    /// Lines that turn real within a step come down to zero frequency there, and through every
    /// multiple that they were above.
    void emerge(CrossingSearch &search, std::size_t k, double multiple) const {
        for (std::size_t line = 0; line < _nodes.lines().size(); ++line) {
            const Line &l = _nodes.lines()[line];
            const bool first = l.place[k] != Line::absent;
            if (first == (l.place[k + 1] != Line::absent))
                continue;
            const Absence why = l.absence[first ? k + 1 : k];
            const std::size_t present = first ? k : k + 1;
            // At rest every multiple is zero too; of a series speeds next to it cost most.
            if (hill() && _nodes.speed(first ? k + 1 : k) == 0)
                continue;
            const auto place = static_cast<std::size_t>(l.place[present]);
            const Rates &rates = _nodes.rates(present);
            const StepEnd end = end_of(_nodes.spectrum(present), first ? rates.above : rates.below,
                                       place, multiple);
            if ((why == Absence::overdamped || why == Absence::divergent) && end.distance > 0)
                search.follow_to_zero(_nodes.full(present), _nodes.full(first ? k + 1 : k),
                                      static_cast<int>(line));
        }
    }

    void step(CrossingSearch &search, std::size_t k, const std::vector<double> &rows,
              const std::vector<Link> &links) const {
        const Node low = _nodes.full(k);
        const Node high = _nodes.full(k + 1);
        if (rows.empty()) {
            search.search(low, high, links);
            return;
        }
        std::vector<Node> nodes{low};
        for (const double row : rows) {
            nodes.push_back(node_at(_nodes.solver(), row, nodes.back(), high));
            search.visit(nodes.back());
        }
        nodes.push_back(high);
        for (std::size_t i = 1; i < nodes.size(); ++i)
            search.search(nodes[i - 1], nodes[i],
                          links_between(nodes[i - 1], nodes[i], nodes[i - 1].lines));
    }
};

template <class List, class Key> void sort_from(List &list, std::ptrdiff_t first, Key key) {
    std::stable_sort(list.begin() + first, list.end(),
                     [key](const auto &a, const auto &b) { return a.*key < b.*key; });
}

} // namespace

std::vector<char> lines_drawn(const std::vector<Line> &lines,
                              const std::vector<modes::Spectrum> &spectra, int modes,
                              const Crossings &crossed) {
    std::vector<char> out = among_lowest(lines, spectra, modes);
    for (const results::Crossing &crossing : crossed.found)
        out[static_cast<std::size_t>(crossing.mode)] = 1;
    for (const Locked &band : crossed.locked)
        out[static_cast<std::size_t>(band.mode)] = 1;
    return out;
}

Crossings crossings(const modes::SpectrumSolver &solver, const Tracking &tracking,
                    const std::vector<modes::Spectrum> &spectra,
                    const std::vector<double> &multiples) {
    Crossings out;
    const SweepNodes nodes(solver, tracking, spectra);
    const Sweep sweep(nodes);
    for (const double multiple : multiples) {
        const auto first = std::ssize(out.found);
        const auto first_locked = std::ssize(out.locked);
        sweep.run(multiple, out);
        sort_from(out.found, first, &results::Crossing::speed);
        sort_from(out.locked, first_locked, &Locked::from);
    }
    return out;
}

} // namespace whirl::tracking
