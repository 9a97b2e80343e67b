#include "stability/hill/band_search.h"

#include "linalg/roots.h"
#include "stability/hill/hill_motions.h"
#include "stability/hill/pair_search.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace whirl::stability {

namespace {

/// Halvings of one step of the grid, one inside the other: to a millionth of it.
constexpr int deepest = 20;
/// Doubtful intervals narrower than this part of the speed are not reported.
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

/// 0.618^24 is 1e-5 of the step: the top of a parabola is flat below.
constexpr int golden_steps = 24;

/// The index at the other end of a step of a motion at this end, or nowhere.
/// @param to       of the motions at the lower end
/// @param upwards  this end is the lower one
int across(const std::vector<int> &to, int index, bool upwards) {
    if (upwards)
        return to[static_cast<std::size_t>(index)];
    const auto found = std::ranges::find(to, index);
    return found == to.end() ? Continuation::nowhere : static_cast<int>(found - to.begin());
}

} // namespace

BandSearch::BandSearch(const MotionsAt &at, const std::vector<double> &speeds)
    : _at(at), _most_halvings(2 * static_cast<int>(speeds.size()) + 200) {
    (void)probe(speeds[0], speeds[1] - speeds[0]);
    for (std::size_t k = 1; k < speeds.size(); ++k)
        (void)probe(speeds[k], speeds[k] - speeds[k - 1]);
    for (std::size_t k = 1; k < speeds.size(); ++k)
        through(_probes.at(speeds[k - 1]), _probes.at(speeds[k]), 0);
    for (auto next = std::next(_probes.begin(), 2); next != _probes.end(); ++next) {
        const Probe &before = std::prev(next, 2)->second;
        const Probe &middle = std::prev(next)->second;
        peaks(before, middle, next->second);
        dip(before, middle, next->second);
    }
}

const BandSearch::Probe &BandSearch::probe(double speed, double step) {
    Probe out{speed, _at(speed), 0};
    out.growth = growth_of(out.motions);
    _known[speed] = out.growth;
    if (out.growth > 0)
        _seeds.emplace_back(speed, step);
    return _probes[speed] = std::move(out);
}

const Continuation &BandSearch::continuation(const Probe &a, const Probe &b) {
    const auto found = _continued.find({a.speed, b.speed});
    if (found != _continued.end())
        return found->second;
    return _continued
        .emplace(std::pair(a.speed, b.speed), continued(a.speed, a.motions, b.speed, b.motions))
        .first->second;
}

/// Adds values of the two at the next known speeds on one side of a step.
/// @param at            which of the motions at the end of the step on that side they are
/// @param first,second  their eigenvalues there
void BandSearch::add_beyond(Coalescence &m, const Probe &end, std::array<int, 2> at,
                            std::complex<double> first, std::complex<double> second, bool upwards) {
    // Two more points on either side make a cubic of mean and squared difference.
    constexpr int most = 2;
    const auto alias = [&m](const Probe &probe, int index) {
        const double repeats = probe.motions[static_cast<std::size_t>(index)].repeats;
        return std::complex<double>(0, m.aliases * repeats);
    };
    second -= alias(end, at[1]);
    auto place = _probes.find(end.speed);
    const auto border = upwards ? std::prev(_probes.end()) : _probes.begin();
    for (int k = 0; k < most && place != border; ++k) {
        const Probe &here = place->second;
        const Probe &next = (upwards ? ++place : --place)->second;
        const Continuation &on = upwards ? continuation(here, next) : continuation(next, here);
        for (int &index : at) {
            index = across(on.to, index, upwards);
            if (index == Continuation::nowhere)
                return;
        }
        first = nearest_alias(first, next.motions[static_cast<std::size_t>(at[0])]);
        second = nearest_alias(second, next.motions[static_cast<std::size_t>(at[1])]);
        m.beyond.push_back({next.speed, first, second + alias(next, at[1])});
    }
}

void BandSearch::halve(const Probe &a, const Probe &b, int depth) {
    ++_halvings;
    const double half = (b.speed - a.speed) / 2;
    try {
        (void)probe(a.speed + half, half);
    } catch (const NotSettled &) { // so slow that it cannot be described
        _doubtful.push_back({a.speed, b.speed});
        return;
    }
    const Probe &middle = _probes.at(a.speed + half);
    through(a, middle, depth + 1);
    through(middle, b, depth + 1);
}

void BandSearch::through(const Probe &a, const Probe &b, int depth) {
    const Continuation &next = continuation(a, b);
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
            _doubtful.push_back({a.speed, b.speed});
    }
    if (unstable && !carried)
        window_between(a.speed, b.speed);
}

/// @returns whether all of them could be judged.
bool BandSearch::coalescences_resolved(const Continuation &next, const Probe &a,
                                       const Probe &b) try {
    for (Coalescence m : next.coalescences) {
        const auto unstable_at = [](const Probe &probe, std::complex<double> value) {
            return probe.growth > 0 && value.real() > 0;
        };
        // Of a motion that grows at one end it is known that a band ends in between.
        if (unstable_at(a, m.first_from) || unstable_at(a, m.second_from) ||
            unstable_at(b, m.first_to) || unstable_at(b, m.second_to))
            continue;
        const bool known = m.ordered || m.aliases == 0; // which of them is the alias
        if (m.action == 0 && known) {
            add_beyond(m, b, m.index_to, m.first_to, m.second_to, true);
            add_beyond(m, a, m.index_from, m.first_from, m.second_from, false);
        }
        const CoalescenceVerdict verdict = examine(_at, m);
        if (verdict.kind == CoalescenceVerdict::Kind::unsure)
            return false;
        if (verdict.kind == CoalescenceVerdict::Kind::grows)
            _seeds.emplace_back(verdict.speed, 1e-3 * (b.speed - a.speed));
    }
    return true;
} catch (const NotSettled &) { // next to rest it can ask for any speed
    return false;
}

bool BandSearch::one_grows_through(const Continuation &next, const Probe &a, const Probe &b) {
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
void BandSearch::window_between(double from, double to) {
    // Growth falls from one side and rises to the other.
    int steps = 0;
    const auto [speed, growth] = linalg::least_between(
        [this](double x) { return growth_of(_at(x)); }, from, to,
        [&steps](double, double, double least) { return least <= 0 || ++steps > golden_steps; });
    if (growth <= 0)
        _known[speed] = -1;
}

/// Of motions that die out at three neighbouring speeds.
void BandSearch::peaks(const Probe &a, const Probe &b, const Probe &c) {
    const std::vector<int> &to_b = continuation(a, b).to;
    const std::vector<int> &to_c = continuation(b, c).to;
    for (std::size_t i = 0; i < a.motions.size(); ++i) {
        const int j = to_b[i];
        const int k = j == Continuation::nowhere ? j : to_c[static_cast<std::size_t>(j)];
        if (k == Continuation::nowhere)
            continue;
        const Motion &at_a = a.motions[i];
        const Motion &at_b = b.motions[static_cast<std::size_t>(j)];
        const Motion &at_c = c.motions[static_cast<std::size_t>(k)];
        const bool upper = at_b.value.imag() >= 0 || // of conjugates one
                           (at_a.value.imag() >= 0 && at_c.value.imag() >= 0);
        if (upper && at_a.decays() && at_b.decays() && at_c.decays())
            peak_of({a.speed, b.speed, c.speed}, {at_a.value, at_b.value, at_c.value});
    }
}

void BandSearch::peak_of(const std::array<double, 3> &speeds,
                         const std::array<std::complex<double>, 3> &values) {
    const auto [from, middle, to] = speeds;
    const double y0 = values[0].real();
    const double y1 = values[1].real();
    const double y2 = values[2].real();
    if (y1 < y0 || y1 < y2)
        return;
    const double top = vertex(from, y0, middle, y1, to, y2);
    // Allowance for a peak sharper than the parabola.
    if (top + 2 * (top - y1) + 0.25 * (y1 - std::min(y0, y2)) <= 0)
        return;
    const auto value_at = [&](double x) { // of the motion, by interpolation of the three
        const double share = (x - speeds[0]) / (speeds[1] - speeds[0]);
        const double rest = (x - speeds[1]) / (speeds[2] - speeds[1]);
        return x <= speeds[1] ? values[0] * (1 - share) + values[1] * share
                              : values[1] * (1 - rest) + values[2] * rest;
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
        from, to, [&](double, double, double) { return unstable || ++steps > golden_steps; });
    if (unstable)
        _seeds.emplace_back(found, 1e-3 * (to - from));
}

/// A stable window under a dip of the largest growth.
void BandSearch::dip(const Probe &a, const Probe &b, const Probe &c) {
    const double y0 = a.growth;
    const double y1 = b.growth;
    const double y2 = c.growth;
    if (std::min({y0, y1, y2}) <= 0 || y1 > y0 || y1 > y2)
        return;
    const double bottom = -vertex(a.speed, -y0, b.speed, -y1, c.speed, -y2);
    if (bottom - 2 * (y1 - bottom) - 0.25 * (std::max(y0, y2) - y1) < 0)
        window_between(a.speed, c.speed);
}

} // namespace whirl::stability
