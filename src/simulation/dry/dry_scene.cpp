#include "simulation/dry/dry_state.h"

#include "model/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace whirl::simulation {

namespace {

constexpr double turn = 2 * std::numbers::pi; ///< rad
constexpr double rounding = 1e-9;             ///< rad, of angles as they are written in a case

/// An angle as one of the first turn.
double within_turn(double angle) { return angle - turn * std::floor(angle / turn); }

/// @param given  the case gives the start
std::string of_start(bool given) {
    return given ? "simulate.ball_angles: expected "
                 : "simulate.ball_angles: missing, and where balls are spread evenly they overlap: "
                   "expected a start with ";
}

/// The gaps between neighbours around one race.
void add_gaps(const balancers::TouchingRow &row, int first, const std::vector<double> &angles,
              bool given, std::vector<Gap> &gaps) {
    std::vector<std::pair<double, int>> around;
    for (int i = first + row.first; i < first + row.first + row.count; ++i)
        around.emplace_back(within_turn(angles[static_cast<std::size_t>(i)]), i);
    std::ranges::sort(around);
    for (std::size_t k = 0; k < around.size() && around.size() > 1; ++k) {
        const auto [here, i] = around[k];
        const auto [there, j] = around[(k + 1) % around.size()];
        const double apart = there - here + (k + 1 == around.size() ? turn : 0);
        const double between =
            angles[static_cast<std::size_t>(j)] - angles[static_cast<std::size_t>(i)];
        if (apart < row.touching - rounding)
            throw model::BadInput(fmt::format(
                "{}balls that do not overlap, {:.6g} rad apart or "
                "more, got {:.6g} rad between two that cannot pass each other (contact = true)",
                of_start(given), row.touching, apart));
        const bool parted =
            std::ranges::any_of(row.walls, [&, from = here](const balancers::Wall &wall) {
                return within_turn((wall.before + wall.behind) / 2 - from) < apart;
            });
        if (!parted)
            gaps.push_back({i, j, apart - between, row.touching, row.restitution});
    }
}

/// Those between a part and the walls on both sides of it.
void add_walls(const balancers::TouchingRow &row, int i, double angle, bool given,
               std::vector<Gap> &gaps) {
    double behind = turn; // the wall that it follows
    double before = turn; // the one that it stands before
    for (const balancers::Wall &wall : row.walls) {
        const double into = within_turn(angle - wall.before);
        const double width = wall.behind - wall.before;
        if (into > rounding && into < width - rounding)
            throw model::BadInput(
                fmt::format("{}balls beside the walls of their race, with no "
                            "centre from {:.6g} to {:.6g} rad, got one at {:.6g} rad",
                            of_start(given), wall.before, wall.behind, angle));
        const auto free = [](double gap) { return gap > turn - rounding ? gap - turn : gap; };
        behind = std::min(behind, free(within_turn(angle - wall.behind)));
        before = std::min(before, free(within_turn(wall.before - angle)));
    }
    gaps.push_back({-1, i, behind - angle, 0, row.restitution});
    gaps.push_back({i, -1, before + angle, 0, row.restitution});
}

} // namespace

DryState dry_state(const MovingParts &parts, const std::vector<double> &angles, double rate,
                   bool given) {
    DryState dry;
    dry.rate = rate;
    for (const FreeParts &free : parts.free) {
        const int first = static_cast<int>(dry.resists.size());
        for (const balancers::TouchingRow &row : free.motion->touching()) {
            if (!row.pass)
                add_gaps(row, first, angles, given, dry.gaps);
            for (int i = first + row.first; i < first + row.first + row.count; ++i)
                if (!row.walls.empty())
                    add_walls(row, i, angles[static_cast<std::size_t>(i)], given, dry.gaps);
        }
        for (int i = 0; i < free.motion->size(); ++i)
            dry.resists.push_back(free.motion->resists(i));
    }
    dry.closed.assign(dry.gaps.size(), false);
    dry.slip.assign(dry.resists.size(), 0);
    return dry;
}

} // namespace whirl::simulation
