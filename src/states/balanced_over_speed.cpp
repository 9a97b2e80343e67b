#include "states/balanced_over_speed.h"

#include "linalg/check.h"
#include "linalg/roots.h"
#include "model/errors.h"
#include "results/sentence.h"
#include "states/branches.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace whirl::states {

namespace {

using Found = StateSearch::Found;
using results::SteadyBorder;
namespace as = results::as;

/// At rest every position is steady: the speeds next to rest stand for it.
constexpr double next_to_rest = 1e-3;

std::vector<double> without_rest(const std::vector<double> &speeds) {
    std::vector<double> out;
    const double beside = next_to_rest * extremes_of(speeds).slowest;
    const bool around = speeds.front() <= 0 && speeds.back() >= 0;
    for (const double speed : speeds)
        if (speed < 0)
            out.push_back(speed);
    if (around && speeds.front() < 0)
        out.push_back(-beside);
    if (around && speeds.back() > 0)
        out.push_back(beside);
    for (const double speed : speeds)
        if (speed > 0)
            out.push_back(speed);
    return out;
}

enum class Fate { missing, grows, dies_out };

Fate fate_of(const std::optional<Found> &found) {
    if (!found)
        return Fate::missing;
    return found->state.growing == 0 ? Fate::dies_out : Fate::grows;
}

/// What happens over a range, from speed to speed.
class Walk {
  public:
    Walk(const BalancedOverSpeed &position, int arrangement, const std::vector<double> &speeds)
        : _position(position), _arrangement(arrangement) {
        for (const double speed : without_rest(speeds))
            _points.push_back({speed, at(speed)});
        leave_undecided_out();
        // A range that begins or ends at rest does so.
        _from = speeds.front();
        _to = speeds.back();
    }

    BalancedRange run() {
        add_extremes();
        Fate fate = fate_of(_points.front().found);
        double since = _from;
        const auto change = [&](double speed, Fate to) {
            if (to == fate)
                return;
            close(since, speed, fate);
            since = speed;
            fate = to;
        };
        for (std::size_t i = 1; i < _points.size(); ++i) {
            const Point &low = _points[i - 1];
            const Point &high = _points[i];
            if (low.speed < 0 && high.speed > 0) {
                change(0, fate_of(high.found));
                continue;
            }
            const std::size_t known = _out.borders.size();
            look_between(low, high);
            for (std::size_t k = known; k < _out.borders.size(); ++k) {
                const SteadyBorder &border = _out.borders[k];
                change(border.speed, border.growing_above == -1  ? Fate::missing
                                     : border.growing_above == 0 ? Fate::dies_out
                                                                 : Fate::grows);
            }
            change(high.speed, fate_of(high.found)); // nothing, but for what is not known
        }
        close(since, _to, fate);
        return std::move(_out);
    }

  private:
    struct Point {
        double speed;
        std::optional<Found> found;
    };
    const BalancedOverSpeed &_position;
    int _arrangement;
    std::vector<Point> _points;
    double _from = 0, _to = 0;
    BalancedRange _out;

    [[nodiscard]] std::optional<Found> at(double speed) const {
        return _position.at(speed, _arrangement);
    }

    void close(double from, double to, Fate fate) {
        if (to > from && fate != Fate::dies_out)
            (fate == Fate::missing ? _out.missing : _out.grows).push_back({from, to});
    }

    /// At low speed the growth of a damped rotor drowns in rounding: such speeds say nothing.
    void leave_undecided_out() {
        const auto undecided = [](const Point &point) {
            return point.found && !point.found->state.stable && point.found->damped;
        };
        if (!std::ranges::all_of(_points, undecided))
            std::erase_if(_points, undecided);
    }

    /// Between speeds at which nothing grows something can, where the growth is largest; or the
    /// other way round.
    void add_extremes() {
        std::vector<Point> more;
        for (std::size_t i = 1; i + 1 < _points.size(); ++i) {
            const Point &low = _points[i - 1];
            const Point &high = _points[i + 1];
            const Fate fate = fate_of(_points[i].found);
            if (fate == Fate::missing || fate_of(low.found) != fate ||
                fate_of(high.found) != fate || low.speed * high.speed < 0)
                continue;
            const double sign = fate == Fate::dies_out ? 1 : -1;
            const double top = sign * _points[i].found->state.growth;
            if (!(top >= sign * low.found->state.growth && top >= sign * high.found->state.growth))
                continue;
            if (auto other = other_fate(low.speed, high.speed, sign, fate))
                more.push_back(std::move(*other));
        }
        for (Point &point : more)
            _points.push_back(std::move(point));
        std::ranges::sort(_points, {}, &Point::speed);
    }

    [[nodiscard]] std::optional<Point> other_fate(double from, double to, double sign,
                                                  Fate fate) const {
        constexpr double narrow = 1e-5; // of two steps of the grid
        std::optional<Point> other;
        (void)linalg::least_between(
            [&](double speed) {
                Point point{speed, at(speed)};
                const double value = point.found ? -sign * point.found->state.growth : HUGE_VAL;
                if (fate_of(point.found) != fate)
                    other = std::move(point);
                return value;
            },
            from, to,
            [&](double low, double high, double) {
                return other.has_value() || high - low < narrow * (to - from);
            });
        return other;
    }

    void look_between(const Point &low, const Point &high) {
        if (low.found.has_value() == high.found.has_value()) {
            if (low.found)
                cross(*low.found, *high.found);
            return;
        }
        const bool below = low.found.has_value();
        const Found last =
            last_of(below ? *low.found : *high.found, below ? high.speed : low.speed);
        SteadyBorder limit;
        limit.kind = SteadyBorder::Kind::limit;
        limit.speed = last.state.speed;
        limit.residual = last.state.residual;
        limit.growing_below = below ? last.state.growing : -1;
        limit.growing_above = below ? -1 : last.state.growing;
        if (below)
            cross(*low.found, last);
        _out.borders.push_back(limit);
        if (!below)
            cross(last, *high.found);
    }

    [[nodiscard]] Found last_of(Found last, double gone) const {
        while (std::abs(gone - last.state.speed) > known_to * std::abs(last.state.speed)) {
            const double speed = (gone + last.state.speed) / 2;
            if (auto found = at(speed))
                last = std::move(*found);
            else
                gone = speed;
        }
        return last;
    }

    void cross(const Found &low, const Found &high) {
        find_crossings(
            low, high, [this](const Found &, const Found &, double speed) { return at(speed); },
            _out.borders);
    }
};

} // namespace

BalancedOverSpeed::BalancedOverSpeed(const model::Case &scene, const std::vector<double> &speeds)
    : _search(scene, next_to_rest * extremes_of(speeds).slowest, extremes_of(speeds).fastest) {
    if (!_search.can_balance())
        throw model::AnalysisFailure(
            "a balanced position that follows all imbalances over the speed is that of balancers "
            "with two balls or rings and more in each plane, in round races, without pendulums");
}

int BalancedOverSpeed::arrangements(int most) const {
    return _search.free_motions() > 0 ? most : 1;
}

int BalancedOverSpeed::neutral_pairs() const { return _search.free_motions(); }

std::optional<Found> BalancedOverSpeed::at(double speed, int arrangement) const {
    if (speed == 0)
        return std::nullopt;
    try {
        return _search.balanced(speed, arrangement);
    } catch (const linalg::SolverError &error) {
        throw model::AnalysisFailure(results::Sentence("no balanced position at {}: {}",
                                                       as::speed(speed), error.sentence()));
    }
}

BalancedRange BalancedOverSpeed::over(const std::vector<double> &speeds, int arrangement) const {
    return Walk(*this, arrangement, speeds).run();
}

std::optional<double> BalancedOverSpeed::same_border(const SteadyBorder &border) const {
    // Far more than a mesh moves an end, far less than ends lie apart.
    constexpr double beside = 1e-4;
    std::vector<double> around{border.speed * (1 - beside), border.speed * (1 + beside)};
    std::ranges::sort(around);
    for (const SteadyBorder &other : over(around).borders)
        if (other.growing_below == border.growing_below &&
            other.growing_above == border.growing_above)
            return other.speed;
    return std::nullopt;
}

} // namespace whirl::states
