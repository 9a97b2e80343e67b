#pragma once

#include "results/model_summary.h"

#include <optional>
#include <string>
#include <vector>

namespace whirl::results {

struct AccuracyRow {
    std::string family; ///< "classical" or "order-p"
    int order = 1;
    int elements = 1; ///< of the whole shaft
    /// "full": one speed with the whole rotor, from its assembly on. "reduced": one of the speeds
    /// of a sweep in which modes are refined from those on few shapes, with its part of what is
    /// done once.
    std::string method = "full";
    int unknowns = 0;
    double seconds = 0;
    std::optional<double> error_estimate; ///< largest relative over the modes
    std::optional<double> true_error;     ///< against `reference`
};

struct AccuracyResult {
    ModelSummary model;
    std::string reference;                     ///< what true_error is measured against
    double speed = 0;                          ///< rad/s
    std::vector<double> reference_frequencies; ///< rad/s
    std::vector<AccuracyRow> rows;
};

} // namespace whirl::results
