#pragma once

#include "modes/roots/branches.h"

#include <vector>

namespace whirl::modes {

/// Roots at one end of a step that cannot be distinguished.
using Cluster = std::vector<const Root *>;

[[nodiscard]] Cluster cluster(const RootsAt &spectrum, const std::vector<int> &numbers);

/// A step that a cluster is followed over.
struct ClusterStep {
    double from = 0, to = 0; ///< rad/s
    bool is_long = false;    ///< powers of the speed can show
};

/// All grow, or all die out, throughout a step: which is which does not matter. Where roots meet,
/// their mean goes on smoothly, and they leave it as the square root of a smooth function does.
/// @param a,b  the same motions at its ends
[[nodiscard]] bool all_alike(const Cluster &a, const Cluster &b, double step);

/// None of them comes to the imaginary axis throughout a step, so that as many grow as at its ends.
/// The polynomial with just these roots is smooth in the speed even where they meet: cubics through
/// its coefficients and their rates are trusted as far as parabolas do not leave them, and by
/// Rouché's theorem no root passes the axis while what is left open of the polynomial is less than
/// its modulus there.
[[nodiscard]] bool off_the_axis(const Cluster &a, const Cluster &b, const ClusterStep &step);

/// Those of each end are one root within rounding: which is which does not matter.
[[nodiscard]] bool one_root(const Cluster &a, const Cluster &b);

/// As many at both ends, and at one of them they are zero but for rounding: so of balls near rest,
/// over long steps.
[[nodiscard]] bool zero_but_for_rounding(const Cluster &a, const Cluster &b);

} // namespace whirl::modes
