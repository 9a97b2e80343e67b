#pragma once

#include "results/damping.h"
#include "results/error_parts.h"
#include "results/model_summary.h"
#include "results/whirl.h"

#include <optional>
#include <string>
#include <vector>

namespace whirl::results {

/// One whirl mode along the spin speeds; each list has one entry a speed.
struct CampbellMode {
    std::string label;                                ///< "1B", "1F", "2B", ..., "3M"
    std::vector<std::optional<double>> frequency;     ///< rad/s
    std::vector<std::string> absent;                  ///< why there is no frequency, in a word
    std::vector<std::optional<double>> real;          ///< 1/s
    std::vector<std::optional<double>> damping_ratio; ///< -Re/|lambda|
    std::vector<std::optional<double>> log_dec;       ///< -2 pi Re/Im
    std::vector<Whirl> whirl;
    std::vector<double> forward_fraction;        ///< share of the orbits that is forward, 0..1
    std::vector<std::optional<double>> error;    ///< relative estimate for |lambda|
    std::vector<std::optional<double>> residual; ///< relative, of the eigenpair
    std::vector<std::optional<double>> frequency_rotating; ///< rad/s; rotating forms only
    /// Twice the spin speed less `frequency`, rad/s, where the motion has that one too: rotating
    /// form only, none where its deflections are less than a tenth of the larger ones.
    std::vector<std::optional<double>> other_frequency{};
    std::vector<std::optional<ErrorParts>> error_parts{}; ///< of `error`
    /// In which all orbits nearly lie as lines, from x towards y, rad; none: they are ellipses.
    std::vector<std::optional<double>> plane{};
};

/// A mode's frequency equals a multiple of the spin speed.
struct Crossing {
    double multiple = 1;
    double speed = 0;     ///< rad/s
    double frequency = 0; ///< rad/s
    int mode = 0;         ///< index into CampbellResult::modes
    Damping damping;      ///< at the crossing itself
};

/// A mode's frequency is a multiple of the spin speed over a whole interval of speeds, as of balls
/// that stand still in the rotor.
struct Locked {
    double multiple = 1;
    int mode = 0;    ///< index into CampbellResult::modes
    double from = 0; ///< rad/s; where the range of speeds ends, if it goes on beyond
    double to = 0;
};

struct CampbellResult {
    ModelSummary model;
    std::vector<double> speeds; ///< rad/s
    std::vector<CampbellMode> modes;
    std::vector<Crossing> crossings;
    std::vector<Locked> locked; ///< ascending by `from` within each multiple
    /// The largest real eigenvalue that grows at each speed, 1/s: divergence.
    std::vector<std::optional<double>> divergence;
};

} // namespace whirl::results
