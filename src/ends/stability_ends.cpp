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

/// At rest nothing is told from nothing: the part of the largest speed that is left out there.
constexpr double at_rest = 1e-6;

/// Speeds to begin with in one piece of the range, which is ascending and does not cross zero.
std::vector<double> base_speeds(double from, double to, const std::vector<double> &looks,
                                double top, double step) {
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
    out.insert(out.end(), looks.begin(), looks.end());
    std::ranges::sort(out);
    out.erase(std::unique(out.begin(), out.end()), out.end());
    std::erase_if(out, [&](double speed) { return speed < low || speed > high; });
    return out;
}

/// A change as the whole rotor has it, with what it does to the number of growing motions.
struct Found {
    WholeMotion motion;
    EndKind kind = EndKind::pair;
    int gain = 0;
    double place = 0; ///< the same change of the reduced rotor, whose motions are counted, rad/s
};

class EndSearch {
  public:
    EndSearch(const AllMotions &motions, const std::vector<double> &looks, int steps)
        : _motions(motions) {
        const RotorPieces &rotor = motions.rotor();
        const double from = rotor.from(0);
        const double to = rotor.to(rotor.pieces() - 1);
        const double top = std::max(std::abs(from), std::abs(to));
        for (int piece = 0; piece < rotor.pieces(); ++piece) {
            const auto speeds =
                base_speeds(rotor.from(piece), rotor.to(piece), looks, top, (to - from) / steps);
            if (speeds.size() < 2)
                continue;
            const Swept range = swept(motions, piece, speeds);
            for (const Change &change : range.changes)
                if (std::abs(change.speed) > 1.01 * at_rest * top)
                    take(change, piece);
            _counts.insert(range.counts.begin(), range.counts.end());
            _out.doubtful.insert(_out.doubtful.end(), range.doubtful.begin(), range.doubtful.end());
        }
    }

    EndsFound ends() {
        std::ranges::sort(_found, {}, [](const Found &a) { return a.motion.speed; });
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
        for (const auto &[speed, count] : _counts)
            _out.undamped = _out.undamped || (count.unknown > 0 && std::abs(speed) > slow * top &&
                                              !at_an_end(speed));
        for (std::size_t i = 0; i < _found.size(); ++i) {
            const Found &found = _found[i];
            StabilityEnd end;
            end.speed = found.motion.speed;
            end.kind = found.kind;
            end.growing_below = growing[i];
            end.growing_above = growing[i + 1];
            if (end.growing_below + found.gain != end.growing_above)
                _out.doubtful.push_back({end.speed, end.speed});
            fill_frequency(end, found.motion);
            end.resolved.motion = resolved(found);
            end.resolved.below = resolved_growing[passed];
            passed += end.resolved.motion ? 1 : 0;
            end.resolved.above = resolved_growing[passed];
            if (end.growing_below != end.growing_above)
                _out.ends.push_back(end);
            if (found.kind != EndKind::collision)
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

    /// The root of a change, and the speed at which that of the reduced rotor is all but on the
    /// axis: from farther away another root that is as near to zero would be found.
    [[nodiscard]] std::pair<double, Root> at_the_axis(const Change &change, int piece) const {
        double speed = change.speed;
        std::complex<double> value = change.value;
        constexpr int most = 4;
        constexpr double enough = 1e-4; // of the speed
        for (int step = 1;; ++step) {
            const Spectrum there = _motions.at(speed, piece);
            const Root &root = there.nearest(value);
            const double off = -root.value.real() / root.rate.real();
            const double next = std::clamp(speed + off, change.from, change.to);
            const bool leads = change.smooth && std::isfinite(off) && root.sign() != 0;
            if (!leads || step == most || std::abs(off) <= enough * std::abs(speed))
                return {speed, root};
            value = root.value + (next - speed) * root.rate;
            speed = next;
        }
    }

    void take(const Change &change, int piece) {
        const auto [place, root] = at_the_axis(change, piece);
        WholeMotion guess = _motions.lifted(root, place);
        // A pair that has come to the real axis moves along it as two.
        const bool standing = root.value.imag() == 0 || change.value.imag() == 0;
        guess.value = {0, standing ? 0 : std::abs(root.value.imag())};
        if (root.value.imag() < 0) {
            guess.right = guess.right.conjugate().eval();
            guess.left = guess.left.conjugate().eval();
        }
        const bool collide = change.undamped && !standing;
        const auto exact = collide ? std::nullopt : on_the_axis(_motions.whole(), guess, standing);
        const double reach = 3 * (change.to - change.from) + 1e-4 * std::abs(change.speed);
        const bool confirmed = exact && std::abs(exact->speed - change.speed) <= reach;
        const int single = change.gain > 0 ? 1 : -1;
        if (confirmed && (standing || exact->rate.real() * single > 0)) {
            _found.push_back({*exact, standing ? EndKind::zero : EndKind::pair,
                              standing ? change.gain : 2 * single, change.speed});
        } else if (!change.smooth && change.from != change.to &&
                   change.to - change.from < 1e-9 * std::abs(change.speed)) {
            guess.value = {0, std::abs(change.value.imag())};
            _found.push_back({guess, EndKind::collision, change.gain, change.speed});
        } else if (change.smooth) {
            _out.doubtful.push_back({change.from, change.to});
        }
    }

    /// Two changes that led to one and the same root: the other one's is missing.
    void doubt_doubles() {
        constexpr double same = 1e-9;
        constexpr double parallel = 1 - 1e-6;
        for (std::size_t i = 1; i < _found.size(); ++i) {
            const WholeMotion &a = _found[i - 1].motion;
            const WholeMotion &b = _found[i].motion;
            if (_found[i].kind == _found[i - 1].kind && _found[i].kind != EndKind::collision &&
                std::abs(a.speed - b.speed) <= same * std::abs(b.speed) &&
                std::abs(a.value - b.value) <= same * std::abs(b.speed) &&
                std::abs(a.right.dot(b.right)) > parallel * a.right.norm() * b.right.norm())
                _out.doubtful.push_back({a.speed, b.speed});
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
        constexpr int none = -1;
        std::vector<int> out(found.size() + 1, none);
        std::size_t passed = 0;
        const auto apart = [&](std::size_t k, double speed) {
            return k >= found.size() || std::abs(found[k].place - speed) > 1e-9 * std::abs(speed);
        };
        std::vector<std::pair<std::size_t, std::pair<double, Count>>> seen;
        for (const auto &[speed, count] : _counts) {
            while (passed < found.size() && found[passed].place <= speed)
                ++passed;
            if (!apart(passed, speed) || (passed > 0 && !apart(passed - 1, speed)))
                continue;
            out[passed] = std::max(out[passed], count.*counted);
            seen.push_back({passed, {speed, count}});
        }
        for (const auto &[interval, look] : seen)
            if (look.second.*counted + look.second.unknown < out[interval])
                _out.doubtful.push_back({look.first, look.first});
        for (std::size_t k = 0; k < out.size(); ++k)
            if (out[k] == none)
                out[k] = k > 0 ? out[k - 1] + found[k - 1].gain : 0;
        return out;
    }
};

} // namespace

EndsFound find_ends(const AllMotions &motions, const std::vector<double> &looks, int steps) {
    return EndSearch(motions, looks, steps).ends();
}

} // namespace whirl::ends
