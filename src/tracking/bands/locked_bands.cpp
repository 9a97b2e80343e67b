#include "tracking/bands/locked_bands.h"

#include "tracking/bands/branch_point.h"
#include "tracking/bands/locked_whirl.h"
#include "tracking/crossing_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace whirl::tracking {

namespace {

/// Numbers of modes below, on and above mΩ at a speed.
struct Sides {
    double speed = 0;
    std::ptrdiff_t below = 0;
    std::ptrdiff_t on = 0;          ///< without those that stand still in rotating axes
    std::ptrdiff_t synchronous = 0; ///< standing still in rotating axes
    /// Of the nearest other one, rad/s and 1/s.
    double distance = std::numeric_limits<double>::infinity();
    double real = 0;
    /// Of those on the multiple half of the least difference of real parts, 1/s.
    double split = std::numeric_limits<double>::infinity();

    /// Among others that stand still there.
    [[nodiscard]] bool is_on(std::ptrdiff_t others) const { return on > 0 || synchronous > others; }
    [[nodiscard]] Pair pair(std::ptrdiff_t others) const {
        return {speed, is_on(others) ? -split * split : distance * distance};
    }
};

class BandSearch {
  public:
    BandSearch(const SweepNodes &sweep, double multiple) : _sweep(sweep), _multiple(multiple) {
        for (std::size_t k = 0; k < sweep.count(); ++k) {
            _nodes.push_back(sides(sweep.spectrum(k)));
            _wanted = std::max(_wanted, static_cast<int>(sweep.spectrum(k).modes.size()));
        }
    }

    [[nodiscard]] std::vector<LockedBand> find() {
        for (std::size_t k = 0; k < _nodes.size(); ++k) {
            if (is_locked(_nodes[k], _nodes[k].synchronous))
                take(k, k, {_nodes[k], _nodes[k], _nodes[k]});
            if (k + 1 < _nodes.size() && !only_jumps(k))
                if (const std::optional<Inside> inside = between(_nodes[k], _nodes[k + 1]))
                    take(k, k + 1, *inside);
        }
        return std::move(_bands);
    }

  private:
    const SweepNodes &_sweep;
    double _multiple;
    int _wanted = 0;
    std::vector<Sides> _nodes;
    std::vector<LockedBand> _bands;

    [[nodiscard]] bool locked_to_rotor(const modes::WhirlMode &mode, double speed) const {
        return tracking::locked_to_rotor(results::Form::hill, mode, speed, _multiple);
    }
    [[nodiscard]] Sides sides(const modes::Spectrum &spectrum) const {
        Sides out{spectrum.speed};
        std::vector<double> real_on;
        for (const modes::WhirlMode &mode : spectrum.modes) {
            const bool stands = locked_to_rotor(mode, spectrum.speed);
            const int side = stands ? 0 : side_of(mode, spectrum.speed, _multiple);
            if (side == 0)
                real_on.push_back(mode.eigenvalue.real());
            if (stands) {
                ++out.synchronous;
                continue;
            }
            const double distance =
                std::abs(mode.eigenvalue.imag() - _multiple * std::abs(spectrum.speed));
            if (side != 0 && distance < out.distance) {
                out.distance = distance;
                out.real = mode.eigenvalue.real();
            }
            out.below += side < 0 ? 1 : 0;
            out.on += side == 0 ? 1 : 0;
        }
        out.split = half_of_least_difference(std::move(real_on));
        return out;
    }
    [[nodiscard]] Sides at(double speed) const {
        return sides(_sweep.solver().at(speed, _wanted, modes::Errors::of_right_vectors));
    }
    /// On the multiple to both sides too: no mere crossing.
    [[nodiscard]] bool is_locked(const Sides &here, std::ptrdiff_t synchronous) const {
        constexpr double offset = 1e-8; // of the speed: 1000 times the tolerance of the band's ends
        return here.speed != 0 && here.is_on(synchronous) &&
               (at(here.speed * (1 + offset)).is_on(synchronous) ||
                at(here.speed * (1 - offset)).is_on(synchronous));
    }

    /// No line comes to the multiple from this node to the next, whatever jumps across it. Of 1x
    /// every step is searched: motions that stand there may come from 3x.
    [[nodiscard]] bool only_jumps(std::size_t k) const {
        if (_multiple == 1)
            return false;
        const modes::Spectrum &first = _sweep.spectrum(k);
        const modes::Spectrum &second = _sweep.spectrum(k + 1);
        std::ptrdiff_t below = _nodes[k].below;
        std::ptrdiff_t below_next = _nodes[k + 1].below;
        for (const Link &link : _sweep.links(k)) {
            const StepEnd here =
                tracking::end_of(first, _sweep.rates(k).above, link.from, _multiple);
            const StepEnd next =
                tracking::end_of(second, _sweep.rates(k + 1).below, link.to, _multiple);
            if (here.distance * next.distance < 0 && jumps_past(here, next, _multiple)) {
                below -= here.distance < 0 ? 1 : 0;
                below_next -= next.distance < 0 ? 1 : 0;
            }
        }
        return below == below_next;
    }

    /// A speed inside a band, and the nearest known ones on both sides.
    struct Inside {
        Sides below, here, above;
    };

    /// A speed inside a band between two others where numbers below the multiple differ. (Where
    /// numbers of those that stand differ too, one begins or ends to, which is found apart.)
    [[nodiscard]] std::optional<Inside> between(Sides a, Sides b) const {
        if (a.on > 0 || b.on > 0 || a.below == b.below || a.synchronous != b.synchronous ||
            a.speed * b.speed <= 0)
            return std::nullopt;
        const std::ptrdiff_t synchronous = b.synchronous;
        const auto may_hold_band = [&] {
            const double width = std::abs(b.speed - a.speed);
            const double least = std::min(a.distance, b.distance);
            return width > resolved * std::abs(b.speed) &&
                   !jumps_across(least * least, width, b.speed);
        };
        // A line leads on as long as it gains as much as a half; across a jump it does not.
        bool leads = true;
        while (may_hold_band()) {
            const double part = leads ? passed_at(a.distance, b.distance) : 0.5;
            const Sides middle = at(a.speed + part * (b.speed - a.speed));
            if (middle.is_on(synchronous))
                return is_locked(middle, synchronous) ? std::optional(Inside{a, middle, b})
                                                      : std::nullopt;
            const double least = std::min(a.distance, b.distance);
            const double width = std::abs(b.speed - a.speed);
            (middle.below == a.below ? a : b) = middle;
            leads =
                !leads || middle.distance <= least / 2 || std::abs(b.speed - a.speed) <= width / 2;
        }
        return std::nullopt;
    }

    /// Between two speeds, as a part of the way, where a line between both distances passes the
    /// multiple; twice as far as that from an end next to it, so that both ends come close.
    [[nodiscard]] static double passed_at(double from, double to) {
        // Nearer to an end than a fifth of the step, linear interpolation would creep.
        constexpr double next = 0.2;
        const double part = from / (from + to);
        if (!std::isfinite(from) || !std::isfinite(to) || !(from + to > 0))
            return 0.5;
        return part < next ? 2 * part : (part > 1 - next ? 2 * part - 1 : part);
    }

    struct End {
        double speed = 0;
        double real = 0; ///< 1/s, of the motion that leaves there
    };

    /// Last speed inside, between one inside and one outside.
    /// @param beyond  another one, beyond the other end of the band if not inside it
    [[nodiscard]] End end_between(const Sides &inside, const Sides &outside,
                                  const Sides &beyond) const {
        const std::ptrdiff_t others = outside.synchronous;
        double real = outside.real;
        std::vector<Pair> known;
        if (beyond.speed != inside.speed)
            known.push_back(beyond.pair(others));
        const BranchPoint found = band_end(
            inside.pair(others), outside.pair(others), resolved,
            [&](double speed) {
                const Sides here = at(speed);
                if (!here.is_on(others))
                    real = here.real;
                return here.pair(others).square;
            },
            known);
        return {found.inside, real};
    }

    /// The end of a band from a speed inside it, or that of the range.
    /// @param next    known towards the end
    /// @param beyond  known on the other side
    /// @param k       of the sweep, not before `next`
    [[nodiscard]] End end_from(const Sides &inside, const Sides &next, const Sides &beyond,
                               std::size_t k, int step) const {
        const std::size_t border = step < 0 ? 0 : _nodes.size() - 1;
        const Sides *last = &inside;
        const Sides *here = &next;
        while (here->on > 0) {
            last = here;
            if (k == border)
                return {last->speed, 0};
            k = step < 0 ? k - 1 : k + 1;
            here = &_nodes[k];
        }
        return end_between(*last, *here, beyond);
    }

    /// From a speed inside, between the speeds k and l of the sweep, to the ends of the band.
    void take(std::size_t k, std::size_t l, const Inside &inside) {
        const auto covers = [speed = inside.here.speed](const LockedBand &band) {
            return band.interval.from <= speed && speed <= band.interval.to;
        };
        if (std::ranges::any_of(_bands, covers))
            return;
        End first = end_from(inside.here, inside.below, inside.above, k, -1);
        End last = end_from(inside.here, inside.above, inside.below, l, 1);
        if (first.speed > last.speed)
            std::swap(first, last);
        if (const int line = nearest_line(k); line != no_line && first.speed < last.speed)
            _bands.push_back({{_multiple, line, first.speed, last.speed}, first.real, last.real});
    }

    /// The line next to the multiple at a speed of the sweep, those that stand still apart.
    [[nodiscard]] int nearest_line(std::size_t k) const {
        const Node node = _sweep.bare(k);
        const double speed = _sweep.speed(k);
        int line = no_line;
        double least = 0;
        for (std::size_t i = 0; i < node.lines.size(); ++i) {
            const modes::WhirlMode &mode = mode_at(node, i);
            const double distance = std::abs(mode.eigenvalue.imag() - _multiple * std::abs(speed));
            if (node.lines[i] == no_line || locked_to_rotor(mode, speed) ||
                (line != no_line && distance >= least))
                continue;
            line = node.lines[i];
            least = distance;
        }
        return line;
    }
};

} // namespace

std::vector<LockedBand> locked_bands(const SweepNodes &sweep, double multiple) {
    if (multiple != std::round(multiple))
        return {};
    return BandSearch(sweep, multiple).find();
}

} // namespace whirl::tracking
