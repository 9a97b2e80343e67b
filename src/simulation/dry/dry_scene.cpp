#include "simulation/dry/dry_state.h"

#include "model/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace whirl::simulation {

namespace {

constexpr double turn = 2 * std::numbers::pi; ///< rad
constexpr double angle_rounding = 1e-9;             ///< rad, of angles as they are written in a case

/// The gaps between neighbours around one race.
void add_gaps(const balancers::TouchingRow &row, int first, const std::vector<double> &angles,
              std::vector<Gap> &gaps) {
    std::vector<std::pair<double, int>> around;
    for (int i = first + row.first; i < first + row.first + row.count; ++i) {
        const double angle = angles[static_cast<std::size_t>(i)];
        around.emplace_back(angle - turn * std::floor(angle / turn), i);
    }
    std::ranges::sort(around);
    for (std::size_t k = 0; k < around.size() && around.size() > 1; ++k) {
        const auto [here, i] = around[k];
        const auto [there, j] = around[(k + 1) % around.size()];
        const double apart = there - here + (k + 1 == around.size() ? turn : 0);
        const double between =
            angles[static_cast<std::size_t>(j)] - angles[static_cast<std::size_t>(i)];
        if (apart < row.touching - angle_rounding)
            throw model::BadInput(fmt::format(
                "simulate.ball_angles: expected balls that do not overlap, {:.6g} rad apart or "
                "more, got {:.6g} rad between two that cannot pass each other (contact = true)",
                row.touching, apart));
        gaps.push_back({i, j, apart - between, row.touching, row.restitution});
    }
}

} // namespace

DryState dry_state(const MovingParts &parts, const std::vector<double> &angles, double rate) {
    DryState dry;
    dry.rate = rate;
    for (const FreeParts &free : parts.free) {
        const int first = static_cast<int>(dry.resists.size());
        for (const balancers::TouchingRow &row : free.motion->touching())
            add_gaps(row, first, angles, dry.gaps);
        for (int i = 0; i < free.motion->size(); ++i)
            dry.resists.push_back(free.motion->resists(i));
    }
    dry.closed.assign(dry.gaps.size(), false);
    dry.slip.assign(dry.resists.size(), 0);
    return dry;
}

} // namespace whirl::simulation
