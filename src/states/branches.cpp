#include "states/branches.h"

#include "linalg/check.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

namespace whirl::states {

namespace {

using Found = StateSearch::Found;
using results::SteadyBorder;
using Kind = results::SteadyState::Kind;
using std::numbers::pi;

/// Next to a fold angles differ by the root of this, and two are told apart to 1e-6.
constexpr double known = known_to;
/// Angles that differ by more between neighbouring places are not taken for the same state, rad.
constexpr double farthest = 1.5;
/// Two states that are about to meet stand as near as the root of what is left to that, rad.
constexpr double next_to_fold = 0.05;

/// Two ends are one: next to it they are known to no more.
bool at_one_place(double a, double b) {
    constexpr double near = 1e-6; // of the place
    return std::abs(a - b) <= near * std::abs(b);
}

class Joining {
  public:
    Joining(Followed &over, std::vector<AtPlace> &all, results::SteadyStates &out)
        : _over(over), _all(all), _out(out),
          _angles(_over.search(all.front().place).equations().parts().free_angles()),
          _range(std::max(std::abs(all.front().place), std::abs(all.back().place))) {}

    void run() {
        for (std::size_t i = 0; i < _all.size(); ++i)
            if (i == 0 || _all[i].apart)
                for (Found &found : _all[i].states)
                    found.state.branch = _next++;
            else
                between(_all[i - 1], _all[i]);
        std::ranges::stable_sort(_out.borders, {}, &SteadyBorder::speed);
    }

  private:
    Followed &_over;
    std::vector<AtPlace> &_all;
    results::SteadyStates &_out;
    Eigen::Index _angles;
    double _range; ///< the largest place, in size
    /// States of a way at a place, without what follows from them: two branches that meet are
    /// looked for at the same places.
    struct Looked {
        std::vector<Found> states;
        bool undecided = false;
    };
    std::map<std::pair<int, double>, Looked> _looked;
    int _next = 1;

    /// Largest difference of two angles, rad; of a family and of other ways to stand none counts.
    [[nodiscard]] double apart(const Found &a, const Found &b) {
        if (a.way != b.way)
            return HUGE_VAL;
        // Two balls that just reach stand on one diameter, where one of them counts as free.
        if (a.state.family && b.state.family)
            return 0;
        const Eigen::VectorXd lined = _over.search(a.place).lined_up(b.x, a.x);
        if (!_over.search(a.place).between_same_walls(a.x, lined))
            return HUGE_VAL;
        const auto x = a.x.tail(_angles);
        const auto y = lined.tail(_angles);
        double most = 0;
        for (Eigen::Index k = 0; k < _angles; ++k)
            most = std::max(most, std::abs(std::remainder(x(k) - y(k), 2 * pi)));
        return most;
    }

    /// Pairs of states at two places, nearest first.
    [[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>>
    pairs_of(const std::vector<Found> &low, const std::vector<Found> &high) {
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

    void between(const AtPlace &low, AtPlace &high) {
        for (Found &found : high.states)
            found.state.branch = 0;
        std::vector<bool> goes_on(low.states.size(), false);
        for (const auto &[i, k] : pairs_of(low.states, high.states)) {
            goes_on[i] = true;
            high.states[k].state.branch = low.states[i].state.branch;
            _over.search(low.place).line_up(high.states[k], low.states[i]);
            find_crossings(
                low.states[i], high.states[k],
                [this](const Found &a, const Found &b, double place) {
                    return at_middle(a, b, place);
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
        find_ends(ending, beginning, low.place, high.place);
        find_ends(beginning, ending, high.place, low.place);
    }

    /// Where states that are there at one place and not at the other end. At a wall two end
    /// together, or one goes on as another.
    /// @param others  there at the other place alone
    void find_ends(std::vector<const Found *> &states, std::vector<const Found *> &others,
                   double there, double gone) {
        _looked.clear();
        while (!states.empty()) {
            const Found first = *states.front();
            states.erase(states.begin());
            SteadyBorder border;
            border.branch = first.state.branch;
            // The partner with which it ends in a fold: the nearest of its way just before.
            const auto [place, last, lost] = last_of(first, there, gone);
            border.speed = place;
            border.residual = last.state.residual;
            int &growing_before = there < gone ? border.growing_below : border.growing_above;
            int &growing_after = there < gone ? border.growing_above : border.growing_below;
            growing_before = last.state.growing;
            growing_after = -1;
            if (_over.search(place).ends_at_wall(last)) {
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
            // Masses that just reach are those that balance; on a line through the centre two
            // states meet, though one of them may have begun within the step.
            const bool on_lines =
                first.state.kind == Kind::coincident || first.state.kind == Kind::split;
            if (alone && meet(last))
                border.kind = BorderKind::limit;
            else if (lost || (on_lines && !beside_another(last)))
                border.kind = BorderKind::undecided;
            else // of a branch that begins and ends between two places none is seen but this end
                border.kind = alone || on_lines ? BorderKind::fold : BorderKind::limit;
            for (auto other = states.begin(); other != states.end(); ++other) {
                if ((*other)->way != first.way)
                    continue;
                const auto [same_place, partner, partner_lost] = last_of(**other, there, gone);
                // Next to a fold two states are as near as the root of what is left to it.
                if (!at_one_place(same_place, place) || apart(partner, last) > next_to_fold)
                    continue;
                border.kind = SteadyBorder::Kind::fold;
                border.other = (*other)->state.branch;
                states.erase(other);
                break;
            }
            _out.borders.push_back(border);
        }
    }

    /// Of states that end at the same place the one that stands there as this one does; its state
    /// there. None: there is none.
    [[nodiscard]] std::optional<Found>
    take_partner(const Found &last, std::vector<const Found *> &states, double there, double gone) {
        for (auto other = states.begin(); other != states.end(); ++other) {
            if ((*other)->way == last.way)
                continue;
            Last end = last_of(**other, there, gone);
            if (!at_one_place(end.place, last.place) ||
                !_over.search(end.place).stand_alike(end.found, last))
                continue;
            end.found.state.branch = (*other)->state.branch;
            states.erase(other);
            return std::move(end.found);
        }
        return std::nullopt;
    }

    /// Whether two balls stand at one angle but for what is left next to where they meet.
    [[nodiscard]] bool meet(const Found &found) const {
        for (Eigen::Index i = 1; i <= _angles; ++i)
            for (Eigen::Index k = i + 1; k <= _angles; ++k)
                if (std::abs(std::remainder(
                        found.x(found.x.size() - i) - found.x(found.x.size() - k), 2 * pi)) <
                    next_to_fold)
                    return true;
        return false;
    }

    /// Whether another state of its way is as near as next to a fold.
    [[nodiscard]] bool beside_another(const Found &found) {
        const std::vector<Found> &states = looked_at(found.way, found.place).states;
        return std::ranges::count_if(states, [&](const Found &other) {
                   return apart(other, found) < next_to_fold;
               }) > 1;
    }

    [[nodiscard]] const Looked &looked_at(int way, double place) {
        const auto [entry, added] = _looked.try_emplace({way, place});
        Looked &out = entry->second;
        if (added)
            out.states = _over.of_way(way, place, out.undecided, StateSearch::Wanted::places);
        return out;
    }

    struct Last {
        double place;
        Found found;
        bool lost; ///< just beyond Newton's method leads nowhere: it may go on
    };
    /// The last place at which a state is found, and the state there. Of its way several may end in
    /// one step (races out of round): it is there as long as it has a partner when all of them are
    /// paired with those before, as between two places of the list.
    [[nodiscard]] Last last_of(const Found &first, double there, double gone) {
        Found last = first;
        bool lost = false;
        std::vector<Found> before = looked_at(first.way, there).states;
        while (std::abs(gone - there) > known * std::max(std::abs(there), least_place())) {
            const double middle = (there + gone) / 2;
            const auto &[states, undecided] = looked_at(first.way, middle);
            const auto own = std::ranges::min_element(
                before, {}, [&](const Found &state) { return apart(state, last); });
            const auto pairs = pairs_of(before, states);
            const auto partner = std::ranges::find_if(pairs, [&](const auto &pair) {
                return own == before.begin() + static_cast<std::ptrdiff_t>(pair.first);
            });
            if (partner != pairs.end()) {
                Found next = states[partner->second];
                _over.search(middle).line_up(next, last);
                last = std::move(next);
                there = middle;
                before = states;
            } else {
                gone = middle;
                lost = undecided;
            }
        }
        bool ignored = false;
        if (there != first.place)
            for (Found &same : _over.of_way(first.way, there, ignored, StateSearch::Wanted::all))
                if (apart(same, last) == 0) {
                    _over.search(there).line_up(same, last);
                    last = std::move(same);
                    break;
                }
        return {there, last, lost};
    }
    /// Next to zero places are known to a share of this.
    [[nodiscard]] double least_place() const {
        constexpr double share = 1e-6; // of the range
        return share * _range;
    }

    /// The state between two of one branch; none: it could not be followed.
    [[nodiscard]] std::optional<Found> at_middle(const Found &low, const Found &high,
                                                 double place) {
        if (low.state.family) {
            bool undecided = false;
            std::vector<Found> states =
                _over.of_way(low.way, place, undecided, StateSearch::Wanted::all);
            if (states.empty())
                return std::nullopt;
            states.front().state.branch = low.state.branch;
            return std::move(states.front());
        }
        Eigen::VectorXd guess = low.x.tail(_angles);
        for (Eigen::Index k = 0; k < _angles; ++k)
            guess(k) += std::remainder(high.x.tail(_angles)(k) - guess(k), 2 * pi) / 2;
        std::optional<Found> out = _over.followed(low, guess, place);
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
    const double from = low.place;
    const double to = high.place;
    bool lost = false;
    if (to - from > known_to * std::max(std::abs(from), std::abs(to)) && depth < 60) {
        const double place = (from + to) / 2;
        if (const std::optional<Found> middle = between(low, high, place)) {
            halve(low, *middle, between, depth + 1, out);
            halve(*middle, high, between, depth + 1, out);
            return;
        }
        lost = true; // somewhere between them, or the two are not of one branch
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
    const bool pair = swing > 1e-7 * std::abs(more.state.speed);
    border.kind = lost   ? SteadyBorder::Kind::undecided
                  : pair ? SteadyBorder::Kind::pair
                         : SteadyBorder::Kind::zero;
    if (pair && !lost)
        border.frequency = swing;
    out.push_back(border);
}

} // namespace

void find_crossings(const Found &low, const Found &high, const Between &between,
                    std::vector<SteadyBorder> &out) {
    halve(low, high, between, 0, out);
}

std::vector<Found> Followed::at(double place, bool &undecided) {
    std::vector<Found> out = search(place).at(speed(place), undecided);
    for (Found &found : out)
        found.place = place;
    return out;
}

std::vector<Found> Followed::of_way(int way, double place, bool &undecided,
                                    StateSearch::Wanted wanted) {
    std::vector<Found> out = search(place).of_way(way, speed(place), undecided, wanted);
    for (Found &found : out)
        found.place = place;
    return out;
}

std::optional<Found> Followed::followed(const Found &from, const Eigen::VectorXd &guess,
                                        double place) {
    std::optional<Found> out = search(place).followed(from, guess, speed(place));
    if (out)
        out->place = place;
    return out;
}

void join_branches(Followed &over, std::vector<AtPlace> &all, results::SteadyStates &out) {
    if (!all.empty())
        Joining(over, all, out).run();
}

} // namespace whirl::states
