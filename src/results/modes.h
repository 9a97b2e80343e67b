#pragma once

#include "results/model_summary.h"
#include "results/whirl.h"

#include <complex>
#include <string>
#include <vector>

namespace whirl::results {

/// A mode shape at one speed, at stations fine enough to draw.
struct ModeShape {
    std::string label;
    std::complex<double> eigenvalue; ///< 1/s
    Whirl whirl = Whirl::forward;
    double forward_fraction = 1;
    std::vector<std::complex<double>> x; ///< deflections, largest modulus 1
    std::vector<std::complex<double>> y;
};

struct ModesResult {
    ModelSummary model;
    double speed = 0;      ///< rad/s
    std::vector<double> z; ///< m
    std::vector<ModeShape> modes;
};

} // namespace whirl::results
