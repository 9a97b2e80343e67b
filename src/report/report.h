#pragma once

#include "analyses/balance_result.h"
#include "analyses/response_result.h"
#include "analyses/results.h"
#include "analyses/rigid_limit_result.h"
#include "analyses/simulate_result.h"
#include "analyses/stability_result.h"
#include "model/case.h"

#include <filesystem>
#include <string>
#include <vector>

namespace whirl::report {

/// What a report has written.
struct Files {
    std::vector<std::filesystem::path> paths; ///< the main picture first
    std::vector<std::string> notes;           ///< what is missing and why, for the user
};

/// Writes <command>.svg, .png, .json, .csv and report.html (and modes.vtp) into the folder, all or
/// none of them. Without gnuplot the pictures it draws are missing, which a note says.
/// @throws model::AnalysisFailure where a file cannot be written or a picture not drawn.
Files write_report(const model::Case &scene, const analyses::CampbellResult &result,
                   const std::filesystem::path &folder);
Files write_report(const model::Case &scene, const analyses::CriticalResult &result,
                   const std::filesystem::path &folder);
Files write_report(const model::Case &scene, const analyses::ResponseResult &result,
                   const std::filesystem::path &folder);
Files write_report(const model::Case &scene, const analyses::ModesResult &result,
                   const std::filesystem::path &folder);
Files write_report(const model::Case &scene, const analyses::ShowResult &result,
                   const std::filesystem::path &folder);
Files write_report(const model::Case &scene, const analyses::AccuracyResult &result,
                   const std::filesystem::path &folder);
Files write_report(const model::Case &scene, const analyses::StabilityResult &result,
                   const std::filesystem::path &folder);
Files write_report(const model::Case &scene, const analyses::RigidLimitResult &result,
                   const std::filesystem::path &folder);
/// Also pictures of the placement and of each pendulum balancer, where there are any.
Files write_report(const model::Case &scene, const analyses::BalanceResult &result,
                   const std::filesystem::path &folder);

Files write_report(const model::Case &scene, const analyses::SimulateResult &result,
                   const std::filesystem::path &folder);

} // namespace whirl::report
