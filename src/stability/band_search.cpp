#include "stability/band_search.h"

#include "linalg/roots.h"
#include "stability/pair_search.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace whirl::stability {

namespace {

/// Halvings of one step of the grid, one inside the other: to a millionth of it.
constexpr int deepest = 20;
/// Doubt within so small a part of the speed hides no band that counts.
constexpr double minute = 1e-7;

/// Vertex of the parabola through three points, the middle one the highest: how high it is.
double vertex(double x0, double y0, double x1, double y1, double x2, double y2) {
    const double left = (y1 - y0) / (x1 - x0);
    const double right = (y2 - y1) / (x2 - x1);
    const double curvature = (right - left) / (x2 - x0);
    if (curvature == 0)
        return y1;
    const double slope = left + curvature * (x1 - x0);
    return y1 - slope * slope / (4 * curvature);
}

constexpr int golden_steps = 24;

} // namespace

BandSearch::BandSearch(const MotionsAt &at, const std::vector<double> &speeds)
    : _at(at), _grid_step(speeds[1] - speeds[0]),
      _most_halvings(2 * static_cast<int>(speeds.size()) + 200) {
    for (std::size_t k = 0; k < speeds.size(); ++k)
        (void)look(speeds[k], k > 0 ? speeds[k] - speeds[k - 1] : _grid_step);
    for (std::size_t k = 1; k < speeds.size(); ++k)
        through(_looks.at(speeds[k - 1]), _looks.at(speeds[k]), 0);
    for (std::size_t k = 1; k < _steps.size(); ++k) {
        peaks(_steps[k - 1], _steps[k]);
        dips(_steps[k - 1], _steps[k]);
    }
}

const BandSearch::Look &BandSearch::look(double speed, double step) {
    Look &out = _looks[speed];
    out = {speed, _at(speed), 0};
    out.growth = growth_of(out.motions);
    _known[speed] = out.growth;
    if (out.growth > 0)
        _seeds.emplace_back(speed, step);
    return out;
}

const Continuation &BandSearch::continuation(const Look &a, const Look &b) {
    const auto found = _continued.find({a.speed, b.speed});
    if (found != _continued.end())
        return found->second;
    return _continued
        .emplace(std::pair(a.speed, b.speed), continued(a.speed, a.motions, b.speed, b.motions))
        .first->second;
}

/// Follows the two to the next speeds that were looked at on either side.
void BandSearch::add_beyond(Coalescence &m, const Look &a, const Look &b) {
    constexpr int most = 2; // on each side
    if (!m.ordered && m.copies != 0)
        return; // which of them is the copy is not known
    const auto add = [&m](const Look &look, const std::array<int, 2> &index, PairValues &last) {
        const Motion &one = look.motions[static_cast<std::size_t>(index[0])];
        const Motion &other = look.motions[static_cast<std::size_t>(index[1])];
        last = {look.speed, copy_next_to(last.first, one), copy_next_to(last.second, other)};
        m.beyond.push_back(last);
        m.beyond.back().second += std::complex<double>(0, m.copies * other.repeats);
    };
    const auto own = [&m](std::complex<double> second, const Look &look, int index) {
        const double repeats = look.motions[static_cast<std::size_t>(index)].repeats;
        return second - std::complex<double>(0, m.copies * repeats);
    };
    std::array<int, 2> at = m.index_to;
    PairValues last{b.speed, m.first_to, own(m.second_to, b, at[1])};
    auto place = _looks.find(b.speed);
    for (int k = 0; k < most && std::next(place) != _looks.end(); ++k, ++place) {
        const Look &next = std::next(place)->second;
        const Continuation &on = continuation(place->second, next);
        for (int &index : at)
            index = index == Continuation::nowhere ? index : on.to[static_cast<std::size_t>(index)];
        if (at[0] == Continuation::nowhere || at[1] == Continuation::nowhere)
            break;
        add(next, at, last);
    }
    at = m.index_from;
    last = {a.speed, m.first_from, own(m.second_from, a, at[1])};
    place = _looks.find(a.speed);
    for (int k = 0; k < most && place != _looks.begin(); ++k, --place) {
        const Look &next = std::prev(place)->second;
        const std::vector<int> &to = continuation(next, place->second).to;
        for (int &index : at) {
            const auto found = std::ranges::find(to, index);
            if (index == Continuation::nowhere || found == to.end())
                return;
            index = static_cast<int>(found - to.begin());
        }
        add(next, at, last);
    }
}

void BandSearch::halve(const Look &a, const Look &b, int depth) {
    ++_halvings;
    const double half = (b.speed - a.speed) / 2;
    const Look &middle = look(a.speed + half, half);
    through(a, middle, depth + 1);
    through(middle, b, depth + 1);
}

void BandSearch::through(const Look &a, const Look &b, int depth) {
    const Continuation next = continuation(a, b);
    const bool unstable = a.growth > 0 && b.growth > 0;
    // Where one motion grows all the way it does not matter what becomes of the others.
    const bool carried = unstable && one_grows_through(next, a, b);
    const bool resolved =
        carried || (!next.doubtful && (unstable || coalescences_resolved(next, a, b)));
    if (!resolved) {
        const bool small =
            b.speed - a.speed <= minute * std::max(std::abs(a.speed), std::abs(b.speed));
        if (!small && depth < deepest && _halvings < _most_halvings) {
            halve(a, b, depth);
            return;
        }
        if (!small)
            _doubtful.emplace_back(a.speed, b.speed);
    }
    if (unstable && !carried)
        window_between(a, b);
    Step step{a.speed, b.speed, a.growth, b.growth, {}};
    for (int i = 0; i < std::ssize(a.motions); ++i) {
        const int j = next.to[static_cast<std::size_t>(i)];
        if (j == Continuation::nowhere)
            continue;
        const Motion &from = a.motions[static_cast<std::size_t>(i)];
        const Motion &to = b.motions[static_cast<std::size_t>(j)];
        const bool decays = from.value.real() < -from.noise && to.value.real() < -to.noise;
        if (from.value.imag() >= 0 || to.value.imag() >= 0) // of conjugates one
            step.strands.push_back({i, j, from.value, to.value, decays});
    }
    _steps.push_back(std::move(step));
}

/// @returns whether all of them could be judged.
bool BandSearch::coalescences_resolved(const Continuation &next, const Look &a, const Look &b) {
    for (Coalescence coalescence : next.coalescences) {
        const auto unstable_at = [](const Look &look, std::complex<double> value) {
            return look.growth > 0 && value.real() > 0;
        };
        // Of a motion that grows at one end it is known that a band ends in between.
        if (unstable_at(a, coalescence.first_from) || unstable_at(a, coalescence.second_from) ||
            unstable_at(b, coalescence.first_to) || unstable_at(b, coalescence.second_to))
            continue;
        if (coalescence.action == 0)
            add_beyond(coalescence, a, b);
        const CoalescenceVerdict verdict = examine(_at, coalescence);
        if (verdict.kind == CoalescenceVerdict::Kind::unsure)
            return false;
        if (verdict.kind == CoalescenceVerdict::Kind::grows)
            _seeds.emplace_back(verdict.speed, 1e-3 * (b.speed - a.speed));
    }
    return true;
}

bool BandSearch::one_grows_through(const Continuation &next, const Look &a, const Look &b) {
    for (int i = 0; i < std::ssize(a.motions); ++i) {
        const int j = next.to[static_cast<std::size_t>(i)];
        if (j != Continuation::nowhere && a.motions[static_cast<std::size_t>(i)].grows() &&
            b.motions[static_cast<std::size_t>(j)].grows())
            return true;
    }
    return false;
}

/// Between two unstable speeds at which different motions grow there can be a stable window: the
/// speed of least growth, where that is none.
void BandSearch::window_between(const Look &a, const Look &b) {
    // Growth falls from one side and rises to the other.
    int steps = 0;
    const auto [speed, growth] = linalg::least_between(
        [this](double x) { return growth_of(_at(x)); }, a.speed, b.speed,
        [&steps](double, double, double least) { return least <= 0 || ++steps > golden_steps; });
    if (growth <= 0)
        _known[speed] = -1;
}

void BandSearch::peaks(const Step &before, const Step &after) {
    if (before.to != after.from)
        return;
    for (const Strand &one : before.strands)
        for (const Strand &other : after.strands)
            if (one.index_to == other.index_from && one.decays && other.decays)
                peak_of(one, other, before, after);
}

void BandSearch::peak_of(const Strand &before, const Strand &after, const Step &a, const Step &b) {
    const double y0 = before.from.real();
    const double y1 = before.to.real();
    const double y2 = after.to.real();
    if (y1 < y0 || y1 < y2)
        return;
    const double top = vertex(a.from, y0, a.to, y1, b.to, y2);
    // A peak sharper than a parabola: a reserve of what is seen of it.
    if (top + 2 * (top - y1) + 0.25 * (y1 - std::min(y0, y2)) <= 0)
        return;
    const auto value_at = [&](double x) { // of the motion, by interpolation of the three
        const double share = (x - a.from) / (a.to - a.from);
        const double rest = (x - a.to) / (b.to - a.to);
        return x <= a.to ? before.from * (1 - share) + before.to * share
                         : after.from * (1 - rest) + after.to * rest;
    };
    bool unstable = false;
    double found = 0;
    int steps = 0;
    (void)linalg::least_between(
        [&](double x) {
            const std::vector<Motion> motions = _at(x);
            const auto expected = value_at(x);
            const auto nearest = std::ranges::min_element(
                motions, {}, [&](const Motion &m) { return std::abs(m.value - expected); });
            if (nearest->grows() && !unstable) {
                unstable = true;
                found = x;
            }
            return -nearest->value.real();
        },
        a.from, b.to, [&](double, double, double) { return unstable || ++steps > golden_steps; });
    if (unstable)
        _seeds.emplace_back(found, 1e-3 * (b.to - a.from));
}

/// A stable window under a dip of the largest growth.
void BandSearch::dips(const Step &before, const Step &after) {
    const double y0 = before.growth_from;
    const double y1 = before.growth_to;
    const double y2 = after.growth_to;
    if (before.to != after.from || std::min({y0, y1, y2}) <= 0 || y1 > y0 || y1 > y2)
        return;
    const double bottom = -vertex(before.from, -y0, before.to, -y1, after.to, -y2);
    if (bottom - 2 * (y1 - bottom) - 0.25 * (std::max(y0, y2) - y1) >= 0)
        return;
    int steps = 0;
    const auto [speed, growth] = linalg::least_between(
        [this](double x) { return growth_of(_at(x)); }, before.from, after.to,
        [&steps](double, double, double least) { return least <= 0 || ++steps > golden_steps; });
    if (growth <= 0)
        _known[speed] = -1;
}

} // namespace whirl::stability
