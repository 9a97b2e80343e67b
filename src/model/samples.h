#pragma once

#include "model/quantity.h"

#include <string>
#include <vector>

namespace whirl::model {

/// In the order of the words of a case file.
enum class Distribution {
    normal,
    uniform,
    values ///< one of a list, each equally likely
};

/// An entry of the case that is not known for certain. Numbers in the SI unit of the entry.
struct UncertainInput {
    std::string path; ///< as --set takes it
    Quantity quantity = Quantity::number;
    Distribution distribution = Distribution::normal;
    double mean = 0;            ///< of normal
    double deviation = 0;       ///< of normal: standard deviation
    double from = 0, to = 0;    ///< of uniform
    std::vector<double> values; ///< of values
};

/// Which answers of many rotors are wanted: `of` and `at` of [samples] and [sweep].
struct WantedAnswers {
    bool critical = true;   ///< critical speeds
    bool peaks = false;     ///< peaks of the response to imbalance
    bool ends = false;      ///< ends of the unstable bands
    bool residual = false;  ///< what a motion in time leaves of the unbalanced amplitude
    bool damping = false;   ///< logarithmic decrements of the whirl modes at `at`
    bool margins = false;   ///< separation margins of the critical speeds
    bool operating = false; ///< amplitudes and forces at the operating speeds
    std::vector<double> at; ///< spin speeds, rad/s
};

/// Entries of [samples].
struct SamplesSettings {
    int count = 1;
    int seed = 1;
    WantedAnswers of;
    std::vector<double> quantiles{0.05, 0.5, 0.95}; ///< ascending, each inside (0, 1)
    std::vector<UncertainInput> vary;
};

} // namespace whirl::model
