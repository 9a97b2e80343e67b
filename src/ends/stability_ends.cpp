#include "ends/stability_ends.h"

#include "assembly/planes.h"
#include "ends/sweep.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace whirl::ends {

namespace {

using results::EndKind;
using results::StabilityEnd;
using Complex = std::complex<double>;

/// Next to rest all roots are neutral within rounding: this part of the largest speed is left out.
constexpr double at_rest = 1e-6;

/// Speeds to begin with in one piece of the range, which is ascending and does not cross zero.
std::vector<double> base_speeds(double from, double to, double top, double step) {
    const double rest = at_rest * top;
    const double low = std::abs(from) < rest ? rest : from;
    const double high = std::abs(to) < rest ? -rest : to;
    std::vector<double> out{low, high};
    for (double speed = rest; speed < step; speed *= 100) // balls: powers of the speed
        for (const double signed_speed : {-speed, speed})
            out.push_back(signed_speed);
    const int steps = std::max(2, static_cast<int>(std::ceil((high - low) / step)));
    for (int k = 1; k < steps; ++k)
        out.push_back(low + (high - low) * k / steps);
    std::ranges::sort(out);
    out.erase(std::unique(out.begin(), out.end()), out.end());
    std::erase_if(out, [&](double speed) { return speed < low || speed > high; });
    return out;
}

/// A change as the whole rotor has it, with what it does to the number of growing motions.
struct Found {
    EndOfGrowth motion; ///< a collision that the whole rotor does not have: of the reduced one
    int gain = 0;
    bool together = false; ///< with others that rounding does not distinguish
    double place = 0; ///< the same change of the reduced rotor, whose motions are counted, rad/s
};

class EndSearch {
  public:
    EndSearch(const AllMotions &motions, int steps) : _motions(motions) {
        const RotorPieces &rotor = motions.rotor();
        const double from = rotor.from(0);
        const double to = rotor.to(rotor.pieces() - 1);
        const double top = std::max(std::abs(from), std::abs(to));
        for (int piece = 0; piece < rotor.pieces(); ++piece) {
            const auto speeds =
                base_speeds(rotor.from(piece), rotor.to(piece), top, (to - from) / steps);
            if (speeds.size() < 2)
                continue;
            const Swept range = swept(motions, piece, speeds);
            _counts.insert(range.counts.begin(), range.counts.end());
            for (const Change &change : range.changes)
                if (std::abs(change.speed) > 1.01 * at_rest * top)
                    take(change, piece);
            _out.doubtful.insert(_out.doubtful.end(), range.doubtful.begin(), range.doubtful.end());
        }
    }

    EndsFound ends() {
        std::ranges::sort(_found, {}, [](const Found &a) { return a.motion.speed; });
        take_together();
        doubt_doubles();
        const std::vector<int> growing = growing_between(_found, &Count::growing);
        std::vector<Found> counted;
        std::ranges::copy_if(_found, std::back_inserter(counted),
                             [this](const Found &found) { return resolved(found); });
        const std::vector<int> resolved_growing = std::isfinite(_motions.resolved_up_to())
                                                      ? growing_between(counted, &Count::resolved)
                                                      : growing;
        std::size_t passed = 0; // of those
        _out.growing_from = growing.front();
        const double top = _counts.empty() ? 0
                                           : std::max(std::abs(_counts.begin()->first),
                                                      std::abs(_counts.rbegin()->first));
        constexpr double slow = 0.05; // balls near rest: powers of the speed
        for (const auto &[speed, count] : _counts) {
            if (count.hidden > 0 && std::abs(speed) > slow * top && !at_an_end(speed))
                _out.doubtful.push_back({speed, speed});
        }
        for (std::size_t i = 0; i < _found.size(); ++i) {
            const Found &found = _found[i];
            StabilityEnd end;
            end.speed = found.motion.speed;
            end.kind = found.motion.kind;
            end.growing_below = growing[i];
            end.growing_above = growing[i + 1];
            if (end.growing_below + found.gain != end.growing_above && !found.together &&
                !hidden_at(end.speed))
                _out.doubtful.push_back({end.speed, end.speed});
            fill_frequency(end, found.motion);
            end.resolved.motion = resolved(found);
            end.resolved.below = resolved_growing[passed];
            passed += end.resolved.motion ? 1 : 0;
            end.resolved.above = resolved_growing[passed];
            if (end.growing_below != end.growing_above)
                _out.ends.push_back(end);
            if (found.motion.inward != 0)
                _out.roots.push_back(found.motion);
        }
        return std::move(_out);
    }

  private:
    const AllMotions &_motions;
    std::vector<Found> _found;
    std::map<double, Count> _counts;
    EndsFound _out;

    [[nodiscard]] bool resolved(const Found &found) const {
        return std::abs(found.motion.value) <= _motions.resolved_up_to();
    }

    [[nodiscard]] bool at_an_end(double speed) const {
        return std::ranges::any_of(_found, [speed](const Found &found) {
            return std::abs(found.motion.speed - speed) <= 1e-6 * std::abs(speed);
        });
    }

    /// The root of a change, and the speed at which it is on the axis for the reduced rotor: from
    /// farther away refinement could find another root that is as near to zero. By Newton's method
    /// from the cubic's root; a band that is narrow in the step of the sweep can begin or end far
    /// from there, and is enclosed by how many motions grow.
    [[nodiscard]] std::pair<double, Root> at_the_axis(const Change &change, int piece) const {
        constexpr int newton = 4, most = 60; // steps
        constexpr double enough = 1e-4;      // of the speed
        double low = change.from;
        double high = change.to;
        double speed = change.speed;
        double frequency = change.value.imag();
        for (int step = 1;; ++step) {
            const Spectrum there = _motions.at(speed, piece);
            const Root &root = there.nearest({0, frequency});
            const double off = -root.value.real() / root.rate.real();
            if (!change.smooth || !std::isfinite(off) || root.sign() == 0 || step == most)
                return {speed, root};
            (is_before(change, there, root) ? low : high) = speed;
            const double next = speed + off;
            const bool inside = next >= low && next <= high;
            if (inside && std::abs(off) <= enough * std::abs(speed))
                return {speed, root};
            const double to = inside && step < newton ? next : (low + high) / 2;
            frequency = root.value.imag() + (to - speed) * root.rate.imag();
            speed = to;
        }
    }

    /// As many motions grow as before the change, or where others change in its step, the motion
    /// itself does not yet.
    [[nodiscard]] bool is_before(const Change &change, const Spectrum &there,
                                 const Root &root) const {
        const int before = _counts.at(change.from).growing;
        const int after = _counts.at(change.to).growing;
        if (after - before == change.gain &&
            (there.growing() == before || there.growing() == after))
            return there.growing() == before;
        return (root.sign() > 0) == (change.gain < 0);
    }

    void take(const Change &change, int piece) {
        const auto [place, root] = at_the_axis(change, piece);
        WholeMotion guess = _motions.lifted(root, place);
        // A pair on the real axis moves as two real roots, which rounding does not distinguish from
        // a pair where they part.
        constexpr double both_parts = 3;
        const bool at_zero = root.value.imag() == 0 || change.value.imag() == 0 ||
                             std::abs(root.value) <= both_parts * root.noise;
        guess.value = {0, at_zero ? 0 : std::abs(root.value.imag())};
        if (root.value.imag() < 0) {
            guess.right = guess.right.conjugate().eval();
            guess.left = guess.left.conjugate().eval();
        }
        const bool collide = (change.undamped || _motions.conserves(place)) && !at_zero;
        const double reach = 3 * (change.to - change.from) + 1e-4 * std::abs(change.speed);
        auto exact = collide ? collision(_motions.whole(), guess, reach)
                             : on_the_axis(_motions.whole(), guess, at_zero);
        // A pair next to zero can lead to where two real roots meet, which is another motion.
        constexpr double like = 0.5;
        const bool confirmed = exact && std::abs(exact->speed - change.speed) <= reach &&
                               std::abs(exact->value) >= like * std::abs(guess.value);
        const int single = change.gain > 0 ? 1 : -1;
        // Of a pair two begin or cease to grow.
        const bool by_one = confirmed && std::abs(change.gain) == 1;
        if (!at_zero && (by_one || (!confirmed && !change.smooth)))
            if (const auto zero = zero_beside(change, guess)) {
                _found.push_back({*zero, change.gain, false, change.speed});
                return;
            }
        if (confirmed && at_zero) // its own rate is rounding where nothing damps
            exact->inward = single;
        if (confirmed && exact->inward == single) {
            _found.push_back(
                {*exact, at_zero || collide ? change.gain : 2 * single, false, change.speed});
        } else if (!change.smooth && change.from != change.to &&
                   change.to - change.from < 1e-9 * std::abs(change.speed)) {
            EndOfGrowth reduced{guess};
            reduced.kind = EndKind::collision;
            reduced.value = {0, std::abs(change.value.imag())};
            _found.push_back({reduced, change.gain, false, change.speed});
        } else if (change.smooth) {
            _out.doubtful.push_back({change.from, change.to});
        }
    }

    /// Part of the speed over which rounding hides two real roots that meet next to zero, as with
    /// hardly any damping: the root of it, with allowance.
    static constexpr double hidden = 1e-7;

    /// A pair next to zero that does not reach the axis: two real roots met, one of which passes
    /// zero.
    [[nodiscard]] std::optional<EndOfGrowth> zero_beside(const Change &change,
                                                         WholeMotion guess) const {
        if (std::abs(guess.value) > std::sqrt(hidden) * std::abs(change.speed))
            return std::nullopt;
        guess.value = 0;
        auto zero = on_the_axis(_motions.whole(), guess, true);
        return zero && std::abs(zero->speed - change.speed) <= hidden * std::abs(change.speed)
                   ? std::move(zero)
                   : std::nullopt;
    }

    /// Next to a speed rounding hides whether motions grow: as many as at the speeds on both sides.
    [[nodiscard]] bool hidden_at(double speed) const {
        const double near = hidden * std::abs(speed);
        return std::any_of(_counts.lower_bound(speed - near), _counts.upper_bound(speed + near),
                           [](const auto &probe) { return probe.second.unknown > 0; });
    }

    /// Of two real roots that meet next to zero the one that grew is lost in rounding there, and
    /// found as one of two a little later: all these changes are those of the roots which pass
    /// zero, each once, and how many grow follows from the speeds on both sides.
    void take_together() {
        std::vector<Found> out;
        const auto next_to_zero = [](const Found &found) {
            return std::abs(found.motion.value) <= std::sqrt(hidden) * std::abs(found.motion.speed);
        };
        for (Found &found : _found) {
            const bool zero = found.motion.kind == EndKind::zero;
            const bool after_zero = !out.empty() && out.back().motion.kind == EndKind::zero;
            const bool near = !out.empty() && (zero || after_zero) && next_to_zero(found) &&
                              next_to_zero(out.back()) &&
                              found.motion.speed - out.back().motion.speed <=
                                  hidden * std::abs(found.motion.speed);
            if (!near || (zero && after_zero && !same_root(out.back().motion, found.motion))) {
                out.push_back(std::move(found));
                continue;
            }
            if (!after_zero)
                out.back() = std::move(found);
            out.back().together = true;
        }
        _found = std::move(out);
    }

    [[nodiscard]] static bool same_root(const WholeMotion &a, const WholeMotion &b) {
        constexpr double same = 1e-9; // of the speed: ten thousand times what refinement leaves
        // An angle of 1.4e-3, above the rounding of vectors of one root.
        constexpr double parallel = 1 - 1e-6;
        return std::abs(a.speed - b.speed) <= same * std::abs(b.speed) &&
               std::abs(a.value - b.value) <= same * std::abs(b.speed) &&
               std::abs(a.right.dot(b.right)) > parallel * a.right.norm() * b.right.norm();
    }

    /// Two changes that were refined to the same root: the root of one of them is missing.
    void doubt_doubles() {
        for (std::size_t i = 1; i < _found.size(); ++i) {
            const Found &a = _found[i - 1];
            const Found &b = _found[i];
            if (a.motion.kind == b.motion.kind && b.motion.kind != EndKind::collision &&
                same_root(a.motion, b.motion))
                _out.doubtful.push_back({a.motion.speed, b.motion.speed});
        }
    }

    /// |Im l| in rotating axes, where there is one.
    void fill_frequency(StabilityEnd &end, const WholeMotion &motion) const {
        const double w = std::abs(motion.value.imag());
        if (results::in_rotating_axes(_motions.form())) {
            end.frequency_rotating = w;
            return;
        }
        if (!_motions.discretization().rotor().bearings_rotation_invariant()) {
            end.frequency = w;
            return;
        }
        // x + i y = (X + i Y) exp(i w t) + conj(X - i Y) exp(-i w t), over 2.
        const assembly::Planes planes(motion.right);
        const bool positive = planes.towards().norm() >= planes.against().norm();
        end.frequency_rotating = std::abs((positive ? w : -w) - end.speed);
    }

    /// How many grow between neighbouring ends, before the first one and after the last one: at
    /// every speed looked at as many, but for those that rounding hides there.
    /// @param found    changes of those that are counted
    /// @param counted  as many of them grow
    [[nodiscard]] std::vector<int> growing_between(const std::vector<Found> &found,
                                                   int Count::*counted) {
        constexpr int none = -1; // not counted yet
        std::vector<int> out(found.size() + 1, none);
        std::size_t passed = 0;
        const auto apart = [&](std::size_t k, double speed) {
            return k >= found.size() || std::abs(found[k].place - speed) > 1e-9 * std::abs(speed);
        };
        std::vector<std::pair<std::size_t, std::pair<double, Count>>> sampled;
        for (const auto &[speed, count] : _counts) {
            while (passed < found.size() && found[passed].place <= speed)
                ++passed;
            if (!apart(passed, speed) || (passed > 0 && !apart(passed - 1, speed)))
                continue;
            out[passed] = std::max(out[passed], count.*counted);
            sampled.push_back({passed, {speed, count}});
        }
        for (const auto &[interval, probe] : sampled)
            if (probe.second.*counted + probe.second.unknown + probe.second.hidden < out[interval])
                _out.doubtful.push_back({probe.first, probe.first});
        for (std::size_t k = 0; k < out.size(); ++k)
            if (out[k] == none)
                out[k] = k > 0 ? out[k - 1] + found[k - 1].gain : 0;
        // Those that rounding hides at every speed are known from the changes on both sides.
        std::vector<char> hides(out.size(), 0);
        for (const auto &[interval, probe] : sampled)
            hides[interval] = hides[interval] != 0 || probe.second.hidden > 0;
        for (std::size_t k = 1; k < out.size(); ++k)
            if (hides[k] != 0)
                out[k] = std::max(out[k], out[k - 1] + found[k - 1].gain);
        for (std::size_t k = found.size(); k-- > 0;)
            if (hides[k] != 0)
                out[k] = std::max(out[k], out[k + 1] - found[k].gain);
        return out;
    }
};

} // namespace

EndsFound find_ends(const AllMotions &motions, int steps) {
    return EndSearch(motions, steps).ends();
}

} // namespace whirl::ends
