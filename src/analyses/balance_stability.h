#pragma once

#include "model/case.h"
#include "results/balance.h"
#include "stability/rotor_at_speeds.h"

#include <optional>
#include <string>
#include <vector>

namespace whirl::analyses {

/// What the eigenvalues say of the balanced position, with the real balancers in all their planes.
struct JudgedPosition {
    /// By what it is judged, for motions in time too; none without such a position.
    std::optional<stability::StabilityModel> model;
    /// Where every motion about it dies out: what unstable_bands.h leaves of the range. None where
    /// balance.balanced_position does not ask for it.
    std::optional<results::BalancedPosition> stable;
};

/// Form and order are chosen once for all arrangements. Notes say what there is not, and why.
/// @param scene  with balancers and a range of speeds
[[nodiscard]] JudgedPosition judged_position(const model::Case &scene,
                                             std::vector<std::string> &notes);

} // namespace whirl::analyses
