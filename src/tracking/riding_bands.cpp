#include "tracking/riding_bands.h"

#include "tracking/crossing_search.h"
#include "tracking/locked_whirl.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace whirl::tracking {

namespace {

/// What the motions at a speed are to a multiple of it.
struct Sides {
    double speed = 0;
    std::ptrdiff_t below = 0;
    std::ptrdiff_t on = 0; ///< other than by standing still in the rotor
    double real = 0;       ///< 1/s, mean of those on it
};

class BandSearch {
  public:
    BandSearch(const SweepNodes &sweep, double multiple) : _sweep(sweep), _multiple(multiple) {
        for (std::size_t k = 0; k < sweep.count(); ++k) {
            _nodes.push_back(sides(sweep.spectrum(k)));
            _wanted = std::max(_wanted, static_cast<int>(sweep.spectrum(k).modes.size()));
        }
    }

    [[nodiscard]] std::vector<RidingBand> find() {
        for (std::size_t k = 0; k < _nodes.size(); ++k) {
            if (rides(_nodes[k]))
                take(k, k, _nodes[k]);
            if (k + 1 < _nodes.size())
                if (const std::optional<Sides> inside = between(_nodes[k], _nodes[k + 1]))
                    take(k, k + 1, *inside);
        }
        return std::move(_bands);
    }

  private:
    const SweepNodes &_sweep;
    double _multiple;
    int _wanted = 0;
    std::vector<Sides> _nodes;
    std::vector<RidingBand> _bands;

    /// Still in the rotor, on the spin speed itself.
    [[nodiscard]] bool stands(const modes::WhirlMode &mode, double speed) const {
        return _multiple == 1 && locked(mode, speed);
    }
    [[nodiscard]] Sides sides(const modes::Spectrum &spectrum) const {
        Sides out{spectrum.speed};
        for (const modes::WhirlMode &mode : spectrum.modes) {
            if (stands(mode, spectrum.speed))
                continue;
            const int side = side_of(mode, spectrum.speed, _multiple);
            out.below += side < 0 ? 1 : 0;
            out.on += side == 0 ? 1 : 0;
            out.real += side == 0 ? mode.eigenvalue.real() : 0;
        }
        out.real /= static_cast<double>(std::max<std::ptrdiff_t>(1, out.on));
        return out;
    }
    [[nodiscard]] Sides at(double speed) const { return sides(_sweep.solver().at(speed, _wanted)); }
    /// On the multiple to both sides too: no mere crossing.
    [[nodiscard]] bool rides(const Sides &here) const {
        constexpr double beside = 1e-8;
        return here.speed != 0 && here.on > 0 &&
               (at(here.speed * (1 + beside)).on > 0 || at(here.speed * (1 - beside)).on > 0);
    }

    /// A speed inside a band between two others where numbers below the multiple differ, by halves.
    [[nodiscard]] std::optional<Sides> between(Sides a, const Sides &b) const {
        if (a.on > 0 || b.on > 0 || a.below == b.below || a.speed * b.speed <= 0)
            return std::nullopt;
        double far = b.speed;
        while (std::abs(far - a.speed) > resolved * std::abs(far)) {
            const Sides middle = at((a.speed + far) / 2);
            if (middle.on > 0)
                return rides(middle) ? std::optional(middle) : std::nullopt;
            if (middle.below == a.below)
                a = middle;
            else
                far = middle.speed;
        }
        return std::nullopt;
    }

    /// Last speed inside, between one inside and one outside.
    [[nodiscard]] Sides end_between(Sides inside, double outside) const {
        while (std::abs(outside - inside.speed) > resolved * std::abs(inside.speed)) {
            const Sides middle = at((inside.speed + outside) / 2);
            if (middle.on > 0)
                inside = middle;
            else
                outside = middle.speed;
        }
        return inside;
    }

    /// From a speed inside, between the speeds k and l of the sweep, to the ends of the band.
    void take(std::size_t k, std::size_t l, const Sides &inside) {
        const auto covers = [&inside](const RidingBand &band) {
            return band.interval.from <= inside.speed && inside.speed <= band.interval.to;
        };
        if (std::any_of(_bands.begin(), _bands.end(), covers))
            return;
        Sides first = inside;
        for (; k > 0 && _nodes[k].on > 0; --k)
            first = _nodes[k];
        first = _nodes[k].on > 0 ? _nodes[k] : end_between(first, _nodes[k].speed);
        Sides last = inside;
        for (; l + 1 < _nodes.size() && _nodes[l].on > 0; ++l)
            last = _nodes[l];
        last = _nodes[l].on > 0 ? _nodes[l] : end_between(last, _nodes[l].speed);
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
            if (node.lines[i] == no_line || stands(mode, speed) ||
                (line != no_line && distance >= least))
                continue;
            line = node.lines[i];
            least = distance;
        }
        return line;
    }
};

} // namespace

std::vector<RidingBand> riding_bands(const SweepNodes &sweep, double multiple) {
    if (multiple != std::round(multiple))
        return {};
    return BandSearch(sweep, multiple).find();
}

} // namespace whirl::tracking
