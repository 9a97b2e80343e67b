#pragma once

#include "results/campbell.h"
#include "results/critical.h"

#include <string>
#include <vector>

namespace whirl::properties {

/// What two results may differ by beside their error bars.
struct Allowance {
    double relative = 1e-13;     ///< of each eigenvalue: rounding of the input to another one
    bool more_in_second = false; ///< the second result may have further modes in between
    bool whirl = true;           ///< the sense of whirl must agree
};

/// Differences between the whirl modes of two results at speeds with the same place (`places` of
/// the first and of the second): empty where every one of the lowest `modes` of the first has a
/// partner in the second within the sum of both errors. A sentence for the worst otherwise.
[[nodiscard]] std::string spectra_difference(const results::CampbellResult &a,
                                             const std::vector<std::size_t> &places_a,
                                             const results::CampbellResult &b,
                                             const std::vector<std::size_t> &places_b, int modes,
                                             const Allowance &allowance);

/// The same for critical speeds, both ways.
[[nodiscard]] std::string critical_difference(const results::CriticalResult &a,
                                              const results::CriticalResult &b, int modes,
                                              const Allowance &allowance);

/// Crossings of the lines with multiples of the speed, both ways, within a relative difference.
[[nodiscard]] std::string crossing_difference(const results::CampbellResult &a,
                                              const results::CampbellResult &b, double relative);

} // namespace whirl::properties
