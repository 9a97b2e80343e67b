#pragma once

#include <functional>
#include <vector>

namespace whirl::closed_form::detail {

/// Balls in at most four groups, each of equal angles.
struct GroupedPosition {
    std::vector<int> counts;    ///< balls in each group
    std::vector<double> angles; ///< rad, one per group

    [[nodiscard]] std::vector<double> ball_angles() const;
};

/// Partitions of n into exactly `parts` positive counts, descending.
[[nodiscard]] std::vector<std::vector<int>> partitions(int balls, int parts);

/// Calls visit(position, sector) for balanced positions of the groups: all of them for two groups,
/// those on a grid of the free angles for three and four. Mirror images (all angles negated) are
/// left out. A sector collects neighbouring positions.
void scan_balanced(const std::vector<int> &counts, double capacity,
                   const std::function<void(const GroupedPosition &, int)> &visit);

/// Returns to balance by minimum-norm Newton steps on the group angles; false where that fails.
bool restore_balance(GroupedPosition &position, double capacity);

/// Climbs `objective` along the balanced positions of the same groups by a compass search in the
/// tangent space with shrinking steps, to steps of 1e-9 rad.
void climb(GroupedPosition &position, double capacity,
           const std::function<double(const GroupedPosition &)> &objective);

} // namespace whirl::closed_form::detail
