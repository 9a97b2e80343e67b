#include "states/branches.h"

#include "linalg/check.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace whirl::states {

namespace {

using Found = StateSearch::Found;
using results::SteadyBorder;
using Kind = results::SteadyState::Kind;
using std::numbers::pi;

/// Next to a fold angles differ by the root of this, and two are told apart to 1e-6.
constexpr double known = known_to;
/// Angles that differ by more between neighbouring speeds are not taken for the same state, rad.
constexpr double farthest = 1.5;

class Joining {
  public:
    Joining(const StateSearch &search, std::vector<AtSpeed> &all, results::SteadyStates &out)
        : _search(search), _all(all), _out(out) {}

    void run() {
        for (Found &found : _all.front().states)
            found.state.branch = _next++;
        for (std::size_t i = 1; i < _all.size(); ++i)
            between(_all[i - 1], _all[i]);
        std::ranges::stable_sort(_out.borders, {}, &SteadyBorder::speed);
    }

  private:
    const StateSearch &_search;
    std::vector<AtSpeed> &_all;
    results::SteadyStates &_out;
    int _next = 1;

    [[nodiscard]] Eigen::Index angles() const { return _search.equations().parts().free_angles(); }

    /// Largest difference of two angles, rad; of a family and of other ways to stand none counts.
    [[nodiscard]] double apart(const Found &a, const Found &b) const {
        if (a.way != b.way)
            return HUGE_VAL;
        if (a.state.family)
            return 0;
        const Eigen::VectorXd x = _search.lined_up(b.x, a.x);
        if (!_search.between_same_walls(a.x, x))
            return HUGE_VAL;
        double most = 0;
        for (Eigen::Index k = 0; k < angles(); ++k) {
            const Eigen::Index at = a.x.size() - angles() + k;
            most = std::max(most, std::abs(std::remainder(a.x(at) - x(at), 2 * pi)));
        }
        return most;
    }

    /// Pairs of states at two speeds, nearest first.
    [[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>>
    pairs_of(const std::vector<Found> &low, const std::vector<Found> &high) const {
        struct Pair {
            double apart;
            std::size_t low, high;
        };
        std::vector<Pair> all;
        for (std::size_t i = 0; i < low.size(); ++i)
            for (std::size_t k = 0; k < high.size(); ++k)
                if (const double d = apart(low[i], high[k]); d < farthest)
                    all.push_back({d, i, k});
        std::ranges::sort(all, {}, &Pair::apart);
        std::vector<bool> low_taken(low.size(), false);
        std::vector<bool> high_taken(high.size(), false);
        std::vector<std::pair<std::size_t, std::size_t>> out;
        for (const Pair &pair : all) {
            if (low_taken[pair.low] || high_taken[pair.high])
                continue;
            low_taken[pair.low] = high_taken[pair.high] = true;
            out.emplace_back(pair.low, pair.high);
        }
        return out;
    }

    void between(const AtSpeed &low, AtSpeed &high) {
        for (Found &found : high.states)
            found.state.branch = 0;
        std::vector<bool> goes_on(low.states.size(), false);
        for (const auto &[i, k] : pairs_of(low.states, high.states)) {
            goes_on[i] = true;
            high.states[k].state.branch = low.states[i].state.branch;
            _search.line_up(high.states[k], low.states[i]);
            find_crossings(
                low.states[i], high.states[k],
                [this](const Found &a, const Found &b, double speed) {
                    return at_middle(a, b, speed);
                },
                _out.borders);
        }
        std::vector<const Found *> ending;
        for (std::size_t i = 0; i < goes_on.size(); ++i)
            if (!goes_on[i])
                ending.push_back(&low.states[i]);
        std::vector<const Found *> beginning;
        for (Found &found : high.states)
            if (found.state.branch == 0) {
                found.state.branch = _next++;
                beginning.push_back(&found);
            }
        find_ends(ending, beginning, low.speed, high.speed);
        find_ends(beginning, ending, high.speed, low.speed);
    }

    /// Where states that are there at one speed and not at the other end. At a wall two end
    /// together, or one goes on as another.
    /// @param others  there at the other speed alone
    void find_ends(std::vector<const Found *> &states, std::vector<const Found *> &others,
                   double there, double gone) {
        while (!states.empty()) {
            const Found first = *states.front();
            states.erase(states.begin());
            SteadyBorder border;
            border.branch = first.state.branch;
            // The partner with which it ends in a fold: the nearest of its way just before.
            const auto [speed, last, lost] = last_of(first, there, gone);
            border.speed = speed;
            border.residual = last.state.residual;
            int &growing_before = there < gone ? border.growing_below : border.growing_above;
            int &growing_after = there < gone ? border.growing_above : border.growing_below;
            growing_before = last.state.growing;
            growing_after = -1;
            if (_search.ends_at_wall(last)) {
                border.kind = SteadyBorder::Kind::wall;
                if (const auto second = take_partner(last, states, there, gone)) {
                    border.other = second->state.branch;
                } else if (const auto next = take_partner(last, others, gone, there)) {
                    border.other = next->state.branch;
                    growing_after = next->state.growing;
                }
                _out.borders.push_back(border);
                continue;
            }
            using BorderKind = SteadyBorder::Kind;
            const bool alone =
                first.state.kind == Kind::out_of_round || first.state.kind == Kind::at_wall;
            if (alone && meet(last))
                border.kind = BorderKind::limit;
            else if (lost)
                border.kind = BorderKind::undecided;
            else // of a branch that begins and ends between two speeds none is seen but this end
                border.kind = alone ? BorderKind::fold : BorderKind::limit;
            for (auto other = states.begin(); other != states.end(); ++other) {
                if ((*other)->way != first.way)
                    continue;
                const auto [same_speed, partner, partner_lost] = last_of(**other, there, gone);
                // Next to a fold two states are as near as the root of what is left to it.
                if (std::abs(same_speed - speed) > 1e-6 * std::abs(speed) ||
                    apart(partner, last) > 0.05)
                    continue;
                border.kind = SteadyBorder::Kind::fold;
                border.other = (*other)->state.branch;
                states.erase(other);
                break;
            }
            _out.borders.push_back(border);
        }
    }

    /// Of states that end at the same speed the one that stands there as this one does; its state
    /// there. None: there is none.
    [[nodiscard]] std::optional<Found> take_partner(const Found &last,
                                                    std::vector<const Found *> &states,
                                                    double there, double gone) const {
        for (auto other = states.begin(); other != states.end(); ++other) {
            if ((*other)->way == last.way)
                continue;
            Last end = last_of(**other, there, gone);
            constexpr double same_speed = 1e-6; // of it, as next to a fold
            if (std::abs(end.speed - last.state.speed) > same_speed * std::abs(end.speed) ||
                !_search.stand_alike(end.found, last))
                continue;
            end.found.state.branch = (*other)->state.branch;
            states.erase(other);
            return std::move(end.found);
        }
        return std::nullopt;
    }

    /// Whether two balls stand at one angle but for what is left next to where they meet.
    [[nodiscard]] bool meet(const Found &found) const {
        constexpr double near = 0.05; // rad, as for two states next to a fold
        for (Eigen::Index i = 1; i <= angles(); ++i)
            for (Eigen::Index k = i + 1; k <= angles(); ++k)
                if (std::abs(std::remainder(
                        found.x(found.x.size() - i) - found.x(found.x.size() - k), 2 * pi)) < near)
                    return true;
        return false;
    }

    struct Last {
        double speed;
        Found found;
        bool lost; ///< just beyond Newton's method leads nowhere: it may go on
    };
    /// The last speed at which a state is found, and the state there. Of its way several may end in
    /// one step (races out of round): it is there as long as it has a partner when all of them are
    /// paired with those before, as between two speeds of the list.
    [[nodiscard]] Last last_of(const Found &first, double there, double gone) const {
        Found last = first;
        bool ignored = false;
        bool lost = false;
        std::vector<Found> before = _search.of_way(first.way, there, ignored);
        while (std::abs(gone - there) > known * std::abs(there)) {
            const double middle = (there + gone) / 2;
            bool undecided = false;
            std::vector<Found> states = _search.of_way(first.way, middle, undecided);
            const auto own = std::ranges::min_element(
                before, {}, [&](const Found &state) { return apart(state, last); });
            const auto pairs = pairs_of(before, states);
            const auto partner = std::ranges::find_if(pairs, [&](const auto &pair) {
                return own == before.begin() + static_cast<std::ptrdiff_t>(pair.first);
            });
            if (partner != pairs.end()) {
                Found next = states[partner->second];
                _search.line_up(next, last);
                last = std::move(next);
                there = middle;
                before = std::move(states);
            } else {
                gone = middle;
                lost = undecided;
            }
        }
        return {there, last, lost};
    }

    /// The state between two of one branch; none: it could not be followed.
    [[nodiscard]] std::optional<Found> at_middle(const Found &low, const Found &high,
                                                 double speed) const {
        if (low.state.family) {
            bool undecided = false;
            std::vector<Found> states = _search.of_way(low.way, speed, undecided);
            if (states.empty())
                return std::nullopt;
            return std::move(states.front());
        }
        Eigen::VectorXd guess = low.x;
        for (Eigen::Index k = guess.size() - angles(); k < guess.size(); ++k)
            guess(k) += std::remainder(high.x(k) - low.x(k), 2 * pi) / 2;
        std::optional<Found> out = _search.followed(low, guess, speed);
        if (out && (apart(*out, low) > farthest || apart(*out, high) > farthest))
            out.reset();
        return out;
    }
};

/// @param depth  halvings so far
void halve(const Found &low, const Found &high, const Between &between, int depth,
           std::vector<SteadyBorder> &out) {
    if (low.state.growing == high.state.growing || low.state.growing < 0 ||
        high.state.growing < 0) // the eigensolver failed
        return;
    const double from = low.state.speed;
    const double to = high.state.speed;
    if (to - from > known_to * std::max(std::abs(from), std::abs(to)) && depth < 60) {
        const double speed = (from + to) / 2;
        if (const std::optional<Found> middle = between(low, high, speed)) {
            halve(low, *middle, between, depth + 1, out);
            halve(*middle, high, between, depth + 1, out);
            return;
        }
    }
    SteadyBorder border;
    border.speed = (from + to) / 2;
    border.branch = low.state.branch > 0 ? low.state.branch : high.state.branch;
    border.growing_below = low.state.growing;
    border.growing_above = high.state.growing;
    border.residual = high.state.residual;
    const Found &more = low.state.growing > high.state.growing ? low : high;
    const double swing = std::abs(more.least_growing.imag());
    // Of a real root nothing is left but rounding.
    const bool pair = swing > 1e-7 * std::abs(border.speed);
    border.kind = pair ? SteadyBorder::Kind::pair : SteadyBorder::Kind::zero;
    if (pair)
        border.frequency = swing;
    out.push_back(border);
}

} // namespace

void find_crossings(const Found &low, const Found &high, const Between &between,
                    std::vector<SteadyBorder> &out) {
    halve(low, high, between, 0, out);
}

void join_branches(const StateSearch &search, std::vector<AtSpeed> &all,
                   results::SteadyStates &out) {
    if (!all.empty())
        Joining(search, all, out).run();
}

} // namespace whirl::states
