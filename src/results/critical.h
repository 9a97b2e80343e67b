#pragma once

#include "results/critical_map.h"
#include "results/damping.h"
#include "results/error_parts.h"
#include "results/margins.h"
#include "results/model_summary.h"
#include "results/whirl.h"

#include <optional>
#include <string>
#include <vector>

namespace whirl::results {

struct CriticalSpeed {
    double speed = 0; ///< rad/s
    Whirl whirl = Whirl::forward;
    double real = 0;  ///< 1/s, of the synchronous eigenvalue
    double error = 0; ///< relative estimate
    double residual = 0;
    Damping damping;  ///< of the synchronous eigenvalue; empty: the speed is that without damping
    std::string mode; ///< name of its line in the Campbell diagram; empty: not known
    ErrorParts error_parts{}; ///< of `error`
};

struct CriticalResult {
    ModelSummary model;
    std::vector<CriticalSpeed> critical_speeds; ///< ascending
    /// Where the case has operating speeds; ascending, without those of AF < 2.5.
    std::optional<std::vector<SeparationMargin>> margins;
    std::optional<CriticalMap> map; ///< where it was asked for
};

} // namespace whirl::results
