#include "ends/sweep.h"

#include "ends/branches.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace whirl::ends {

namespace {

/// Over the speed. Steps shorter than the first with equal counts at both ends are taken as
/// unchanged. A change in a step shorter than the second is placed in its middle: some 1e5 units of
/// rounding.
constexpr double minute = 1e-7;
constexpr double least = 2e-11;
constexpr int most_spectra = 4000;

class Sweep {
  public:
    Sweep(const AllMotions &motions, int piece, const std::vector<double> &speeds)
        : _motions(motions), _piece(piece),
          _scale(std::max(std::abs(speeds.front()), std::abs(speeds.back()))) {
        Spectrum before = spectrum_at(speeds.front());
        for (std::size_t k = 1; k < speeds.size(); ++k) {
            Spectrum now = spectrum_at(speeds[k]);
            through(before, now);
            before = std::move(now);
        }
    }

    Swept found;

  private:
    const AllMotions &_motions;
    int _piece;
    double _scale; ///< largest speed, rad/s
    int _spectra_left = most_spectra;

    Spectrum spectrum_at(double speed) {
        --_spectra_left;
        Spectrum out = _motions.at(speed, _piece);
        Count &count = found.counts[speed];
        count = {};
        for (const Root &root : out.roots) {
            const double size = std::abs(root.value);
            count.growing += root.sign() > 0 ? 1 : 0;
            count.unknown += root.sign() == 0 && _motions.within_reach(size) ? 1 : 0;
            count.hidden += _motions.hides_growth(root) ? 1 : 0;
            count.resolved += root.sign() > 0 && size <= _motions.resolved_up_to() ? 1 : 0;
        }
        return out;
    }

    void through(const Spectrum &a, const Spectrum &b) {
        const double step = b.speed - a.speed;
        const double size = std::max(std::abs(a.speed), std::abs(b.speed));
        const Branches branches = followed(a, b);
        std::optional<double> cut = where_to_refine(branches, a, b, _scale);
        if (!cut) {
            cut = take(a, b, branches);
            if (!cut)
                return;
        }
        if (step < minute * size && a.growing() == b.growing())
            return;
        if (step < least * size) {
            take_abrupt(a, b);
            return;
        }
        if (_spectra_left <= 0) {
            found.doubtful.push_back({a.speed, b.speed});
            return;
        }
        const Spectrum middle = spectrum_at(a.speed + std::clamp(*cut, 1e-3, 1 - 1e-3) * step);
        through(a, middle);
        through(middle, b);
    }

    /// @returns where to solve next before the changes of a step are known: in the middle, where
    /// the branches do not explain how many grow at its ends; between two real roots that pass
    /// zero, as refining one could find the other
    std::optional<double> take(const Spectrum &a, const Spectrum &b, const Branches &branches) {
        std::vector<Change> changes;
        std::vector<double> real_roots; // where in the step
        int sum = 0;
        for (const Branch &branch : branches.branches) {
            const int gain = (branch.to->sign() > 0 ? 1 : 0) - (branch.from->sign() > 0 ? 1 : 0);
            sum += gain;
            const double t = gain != 0 ? branch.zero() : 0;
            const std::complex<double> value = branch.at(t);
            if (gain == 0 || value.imag() < -1e-9 * _scale)
                continue;
            if (value.imag() < 1e-9 * _scale && t > 0 && t < 1)
                real_roots.push_back(t);
            changes.push_back({a.speed + t * (b.speed - a.speed),
                               a.speed,
                               b.speed,
                               {value.real(), std::abs(value.imag())},
                               gain,
                               branch.from->sign() * branch.to->sign() != 0});
        }
        if (sum != b.growing() - a.growing())
            return branches.middle;
        std::ranges::sort(real_roots);
        for (std::size_t k = 1; k < real_roots.size(); ++k)
            if ((real_roots[k] - real_roots[k - 1]) * (b.speed - a.speed) >
                minute * std::abs(b.speed))
                return (real_roots[k] + real_roots[k - 1]) / 2;
        found.changes.insert(found.changes.end(), changes.begin(), changes.end());
        return std::nullopt;
    }

    /// A change within the shortest step: the growing root farthest from all that grow at the other
    /// end, and of several the one that grows least.
    void take_abrupt(const Spectrum &a, const Spectrum &b) {
        const int gain = b.growing() - a.growing();
        const Spectrum &more = gain > 0 ? b : a;
        const Spectrum &fewer = gain > 0 ? a : b;
        const auto from_growing = [&fewer](const Root &root) {
            double out = std::numeric_limits<double>::infinity();
            for (const Root &other : fewer.roots)
                if (other.sign() > 0)
                    out = std::min(out, std::abs(other.value - root.value));
            return out;
        };
        const Root *best = nullptr;
        for (const Root &root : more.roots)
            if (root.sign() > 0 && root.value.imag() >= 0 &&
                (best == nullptr || std::pair(-from_growing(root), root.value.real()) <
                                        std::pair(-from_growing(*best), best->value.real())))
                best = &root;
        Change change{(a.speed + b.speed) / 2, a.speed, b.speed, 0, gain, false, false};
        if (best != nullptr) {
            change.value = best->value;
            change.undamped = fewer.nearest(best->value).sign() == 0;
        }
        found.changes.push_back(change);
    }
};

} // namespace

Swept swept(const AllMotions &motions, int piece, const std::vector<double> &speeds) {
    return Sweep(motions, piece, speeds).found;
}

} // namespace whirl::ends
