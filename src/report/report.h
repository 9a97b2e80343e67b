#pragma once

#include "model/case.h"
#include "results/accuracy.h"
#include "results/balance.h"
#include "results/campbell.h"
#include "results/critical.h"
#include "results/modes.h"
#include "results/response.h"
#include "results/rigid_limit.h"
#include "results/show.h"
#include "results/simulate.h"
#include "results/stability.h"

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
Files write_report(const model::Case &scene, const results::CampbellResult &result,
                   const std::filesystem::path &folder);
Files write_report(const model::Case &scene, const results::CriticalResult &result,
                   const std::filesystem::path &folder);
Files write_report(const model::Case &scene, const results::ResponseResult &result,
                   const std::filesystem::path &folder);
Files write_report(const model::Case &scene, const results::ModesResult &result,
                   const std::filesystem::path &folder);
Files write_report(const model::Case &scene, const results::ShowResult &result,
                   const std::filesystem::path &folder);
Files write_report(const model::Case &scene, const results::AccuracyResult &result,
                   const std::filesystem::path &folder);
Files write_report(const model::Case &scene, const results::StabilityResult &result,
                   const std::filesystem::path &folder);
Files write_report(const model::Case &scene, const results::RigidLimitResult &result,
                   const std::filesystem::path &folder);
/// Also pictures of the placement and of each pendulum balancer, where there are any.
Files write_report(const model::Case &scene, const results::BalanceResult &result,
                   const std::filesystem::path &folder);

Files write_report(const model::Case &scene, const results::SimulateResult &result,
                   const std::filesystem::path &folder);

} // namespace whirl::report
