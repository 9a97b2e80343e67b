#pragma once

#include "results/model_summary.h"

#include <optional>
#include <string>
#include <vector>

namespace whirl::results {

/// An uncertain entry of the case and what was drawn for it.
struct SampledInput {
    std::string path;
    model::Quantity quantity = model::Quantity::number;
    std::string distribution;   ///< in words: "normal", "uniform" or "values"
    std::vector<double> values; ///< one a sample, SI
};

/// The least value at or below which this share of the samples lies.
struct SampleQuantile {
    double share = 0;
    double value = 0;
    /// Between these two samples lies the quantile of all rotors that could be drawn, with 95 % and
    /// whatever the distribution; none: the samples are too few to bound it on that side.
    std::optional<double> low, high;
};

/// One number that a rotor answers with, over all samples.
struct SampledAnswer {
    std::string of; ///< "critical", "peaks" or "ends"
    Sentence name;  ///< "forward 1"
    model::Quantity quantity = model::Quantity::number;
    std::optional<double> nominal;       ///< of the case as it is
    std::optional<double> nominal_error; ///< relative, by elements and rounding; none: not known
    std::vector<std::optional<double>> values; ///< one a sample; none: failed, or no such answer
    std::vector<SampleQuantile> quantiles;     ///< of those that are there
    std::optional<double> mean, deviation;     ///< none: too few values
    /// Half widths of 95 % intervals of both, from sampling.
    std::optional<double> mean_error, deviation_error;
    int present = 0; ///< samples that have it
};

/// Samples that failed for one reason.
struct SampleFailure {
    std::string message;
    std::vector<int> samples; ///< from 0
};

struct SamplesResult {
    ModelSummary model; ///< of the case as it is
    int count = 0;
    int failed = 0;
    int seed = 0;
    std::vector<SampledInput> inputs;
    std::vector<SampledAnswer> answers;
    std::vector<SampleFailure> failures;
};

} // namespace whirl::results
