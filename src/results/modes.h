#pragma once

#include "results/model_summary.h"
#include "results/whirl.h"

#include <complex>
#include <optional>
#include <string>
#include <vector>

namespace whirl::results {

/// What one part takes of the power that a mode loses over a cycle.
struct Dissipation {
    std::string of;          ///< "bearing", "seal", "pedestal", "internal damping", ...
    std::optional<double> z; ///< m; none: along the shaft
    std::string name;
    /// Negative: it feeds a motion that others damp. None: what is taken and what is fed cancel, or
    /// both are too little to be told from rounding.
    std::optional<double> share;
};

/// A mode shape at one speed, at stations fine enough to draw.
struct ModeShape {
    std::string label;
    double at = 0;                   ///< spin speed, rad/s
    std::complex<double> eigenvalue; ///< 1/s
    Whirl whirl = Whirl::forward;
    double forward_fraction = 1;
    std::vector<std::complex<double>> x; ///< deflections, largest modulus 1
    std::vector<std::complex<double>> y;
    std::vector<Dissipation> dissipation; ///< empty: nothing takes or feeds energy
    /// In which all orbits nearly lie as lines, from x towards y, rad; none: they are ellipses.
    std::optional<double> plane{};
};

struct ModesResult {
    ModelSummary model;
    double speed = 0;             ///< rad/s
    std::vector<double> z;        ///< m
    std::vector<ModeShape> modes; ///< at that speed
    /// Over a range of speeds: at each critical speed the mode that is critical there.
    std::vector<ModeShape> critical;
};

} // namespace whirl::results
