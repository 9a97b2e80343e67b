#include "ends/band_ends.h"

#include "results/formulation.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace whirl::ends {

namespace {

using results::EndKind;
using results::StabilityEnd;
using stability::Motion;
using stability::MotionsAt;

int growing(const std::vector<Motion> &motions) {
    return static_cast<int>(std::ranges::count_if(motions, &Motion::grows));
}

bool begins_or_ends_growth(const StabilityEnd &end) {
    return (end.growing_below > 0) != (end.growing_above > 0);
}

/// The motions at a speed, and how many of them grow.
struct Probe {
    double speed = 0;
    std::vector<Motion> motions;
    int count = 0;
};

/// Distance from a known end, over the speed, at which motions are counted on either side.
constexpr double offset = 1e-9;

class CountSearch {
  public:
    /// @param edges  ends of bands
    CountSearch(const MotionsAt &at, std::vector<double> edges)
        : _at(at), _edges(std::move(edges)) {}

    [[nodiscard]] Probe probe(double speed) const {
        Probe out{speed, _at(speed), 0};
        out.count = growing(out.motions);
        return out;
    }
    void between(const Probe &a, const Probe &b) {
        const std::optional<double> edge = edge_between(a.speed, b.speed);
        if (a.count == b.count || (!edge && lost_in_noise(a, b)))
            return;
        if (edge || b.speed - a.speed <= 1e-10 * std::abs(b.speed)) {
            const Probe &more = b.count > a.count ? b : a;
            StabilityEnd end;
            end.speed = edge.value_or((a.speed + b.speed) / 2);
            constexpr double aside = 1e-5; // right beside the end damped ones hardly die out
            const double to_fewer = b.count > a.count ? -1 : 1;
            // without damping two neutral motions meet and part
            const auto still = std::ranges::count_if(
                _at(end.speed + to_fewer * aside * std::abs(end.speed)), &Motion::neutral);
            end.kind = still >= 2 ? EndKind::collision : EndKind::multiplier;
            end.growing_below = a.count;
            end.growing_above = b.count;
            end.frequency_rotating = std::abs(least_growing(more.motions).value.imag());
            ends.push_back(end);
            return;
        }
        const Probe middle = probe((a.speed + b.speed) / 2);
        between(a, middle);
        between(middle, b);
    }

    std::vector<StabilityEnd> ends;

  private:
    const MotionsAt &_at;
    std::vector<double> _edges;

    /// The end of a band that lies in this step, if it is the only one: known better than bisection
    /// would find it.
    [[nodiscard]] std::optional<double> edge_between(double low, double high) const {
        const auto inside = [&](double edge) { return edge > low && edge < high; };
        if (high - low > 3 * offset * std::abs(high) || std::ranges::count_if(_edges, inside) != 1)
            return std::nullopt;
        return *std::ranges::find_if(_edges, inside);
    }

    /// The motions that grow at one of two close speeds are only hidden by rounding at the other,
    /// as those of balls are near rest, where growth falls with a power of the speed: beyond a
    /// stability limit they would decay or be neutral.
    [[nodiscard]] static bool lost_in_noise(const Probe &a, const Probe &b) {
        constexpr double close = 0.3;       // of the speed
        constexpr double same_order = 0.02; // a sixth power leaves 0.1
        const Probe &more = a.count > b.count ? a : b;
        const Probe &fewer = a.count > b.count ? b : a;
        if (b.speed - a.speed > close * std::abs(more.speed) ||
            std::abs(fewer.speed) > std::abs(more.speed))
            return false;
        const std::vector<double> growth = growths(more.motions);
        const std::vector<double> left = growths(fewer.motions);
        for (auto k = static_cast<std::size_t>(fewer.count); std::cmp_less(k, more.count); ++k)
            if (k >= left.size() || left[k] <= same_order * growth[k])
                return false;
        return true;
    }

    /// Real parts, largest first, those within rounding of zero too.
    [[nodiscard]] static std::vector<double> growths(const std::vector<Motion> &motions) {
        std::vector<double> out;
        for (const Motion &motion : motions)
            out.push_back(motion.value.real());
        std::sort(out.rbegin(), out.rend());
        return out;
    }

    /// The growing motion with the smallest growth.
    [[nodiscard]] static const Motion &least_growing(const std::vector<Motion> &motions) {
        const Motion *out = &motions.front();
        for (const Motion &motion : motions)
            if (motion.grows() && (!out->grows() || motion.value.real() < out->value.real()))
                out = &motion;
        return *out;
    }
};

} // namespace

std::vector<results::Interval> bands_of(const EndsFound &found, const results::Interval &range) {
    std::vector<results::Interval> out;
    double start = range.from;
    bool unstable = found.growing_from > 0;
    for (const StabilityEnd &end : found.ends) {
        if (!begins_or_ends_growth(end))
            continue;
        if (unstable)
            out.push_back({start, end.speed});
        start = end.speed;
        unstable = end.growing_above > 0;
    }
    if (unstable)
        out.push_back({start, range.to});
    return out;
}

EndsFound multiplier_ends(const MotionsAt &at, const std::vector<double> &speeds,
                          const std::vector<results::Interval> &bands) {
    std::vector<double> probe_speeds = speeds;
    std::vector<double> edges;
    for (const auto &[from, to] : bands) { // their ends are known: no halving is needed there
        probe_speeds.push_back((from + to) / 2);
        for (const double end : {from, to}) {
            if (end == speeds.front() || end == speeds.back())
                continue; // a border of the range
            const double step = std::min(offset * std::abs(end), (to - from) / 8);
            probe_speeds.insert(probe_speeds.end(), {end - step, end + step});
            edges.push_back(end);
        }
    }
    std::ranges::sort(probe_speeds);
    CountSearch search(at, std::move(edges));
    EndsFound out;
    std::optional<Probe> before;
    for (const double speed : probe_speeds) {
        if (speed < speeds.front() || speed > speeds.back())
            continue;
        Probe now = search.probe(speed);
        if (before)
            search.between(*before, now);
        before = std::move(now);
    }
    out.ends = std::move(search.ends);
    if (before) // of the first speed, or of the first at which rounding does not hide it
        out.growing_from = out.ends.empty() ? before->count : out.ends.front().growing_below;
    return out;
}

} // namespace whirl::ends
