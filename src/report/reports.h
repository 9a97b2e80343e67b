#pragma once

#include "report/report.h"

namespace whirl::results {
struct AccuracyResult;
struct BalanceResult;
struct CampbellResult;
struct CriticalResult;
struct MachineReport;
struct ModesResult;
struct ResponseResult;
struct RigidLimitResult;
struct SamplesResult;
struct ShowResult;
struct SimulateResult;
struct StabilityResult;
struct SweepResult;
struct WeightsResult;
} // namespace whirl::results

namespace whirl::report {

/// The report of each command; in the source of its name.
[[nodiscard]] Report describe(const model::Case &scene, const results::AccuracyResult &result);
[[nodiscard]] Report describe(const model::Case &scene, const results::BalanceResult &result);
[[nodiscard]] Report describe(const model::Case &scene, const results::CampbellResult &result);
[[nodiscard]] Report describe(const model::Case &scene, const results::CriticalResult &result);
[[nodiscard]] Report describe(const model::Case &scene, const results::MachineReport &result);
[[nodiscard]] Report describe(const model::Case &scene, const results::ModesResult &result);
[[nodiscard]] Report describe(const model::Case &scene, const results::ResponseResult &result);
[[nodiscard]] Report describe(const model::Case &scene, const results::RigidLimitResult &result);
[[nodiscard]] Report describe(const model::Case &scene, const results::SamplesResult &result);
[[nodiscard]] Report describe(const model::Case &scene, const results::ShowResult &result);
[[nodiscard]] Report describe(const model::Case &scene, const results::SimulateResult &result);
[[nodiscard]] Report describe(const model::Case &scene, const results::StabilityResult &result);
[[nodiscard]] Report describe(const model::Case &scene, const results::SweepResult &result);
[[nodiscard]] Report describe(const model::Case &scene, const results::WeightsResult &result);

} // namespace whirl::report
