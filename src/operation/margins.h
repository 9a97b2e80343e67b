#pragma once

#include "model/operation.h"
#include "results/critical.h"
#include "results/margins.h"
#include "results/response.h"
#include "results/sentence.h"

#include <optional>
#include <string>
#include <vector>

namespace whirl::operation {

/// Separation margin that a critical speed with an amplification factor AF must have, % (API 617;
/// API 684 SP6.8.2.10; docs/theory.md, "Operating speeds"): below the minimum operating speed
/// 17 (1 - 1/(AF - 1.5)), at most 16, above the maximum continuous speed 10 more, at most 26; 0 for
/// AF < 2.5, which counts as critically damped.
/// @param amplification  none: without limit
[[nodiscard]] double required_margin(std::optional<double> amplification, results::MarginSide side);

/// Side, margin found and required, and whether the former is enough. Found below the range: share
/// of the minimum operating speed; above: of the maximum continuous speed. Inside the range, its
/// ends among it, and up to the trip speed no margin is enough.
/// @param speed  of the critical speed, rad/s
[[nodiscard]] results::SeparationMargin margin_of(double speed, std::optional<double> amplification,
                                                  const model::Operation &operation);

/// Margins of all critical speeds that an imbalance can excite, ascending, without those of AF <
/// 2.5. The amplification factor is that of the peak of the response by its half-power points,
/// where the critical speed has one within its half-power width: of each probe, the one that reads
/// most first, as each must have its margin; without probes of the station that moves most; else
/// that of the synchronous eigenvalue. Peaks that belong to no critical speed of the list get a
/// line of their own.
/// @param backward_too  bearings differ between their directions: imbalance excites backward whirl;
///                      it is listed where it has a peak
/// @param notes         say why critical speeds with AF >= 2.5 by their damping have no margin, of
///                      which probes the peak has no factor, and that damping is not known
[[nodiscard]] std::vector<results::SeparationMargin>
separation_margins(const model::Operation &operation,
                   const std::vector<results::CriticalSpeed> &critical_speeds,
                   const std::vector<results::ResponsePeak> &peaks, bool backward_too,
                   std::vector<results::Sentence> &notes);

/// Peaks that would be judged and could be too near, of critical speeds that count or may count,
/// and that have no amplification factor.
[[nodiscard]] std::vector<const results::ResponsePeak *>
peaks_without_factor(const model::Operation &operation,
                     const std::vector<results::CriticalSpeed> &critical_speeds,
                     const std::vector<results::ResponsePeak> &peaks);

/// Speed from which critical speeds matter: below it every margin is enough, rad/s.
[[nodiscard]] double lowest_relevant_speed(const model::Operation &operation);
/// Speed up to which critical speeds matter: above it every margin is enough, rad/s.
[[nodiscard]] double highest_relevant_speed(const model::Operation &operation);

} // namespace whirl::operation
