#pragma once

#include "model/samples.h"
#include "results/samples.h"

#include <vector>

namespace whirl::analyses {

/// The values of all uncertain inputs in one sample, in their order. They follow from the seed and
/// the number of the sample alone: not from the samples before it, nor from the process, nor from
/// inputs further down the list.
[[nodiscard]] std::vector<double> draw(const model::SamplesSettings &settings, int sample);

/// Quantile of sorted values: an order statistic, so that the quantile of an increasing function
/// of a sample is that function of the quantile. Its interval of 95 % by the binomial distribution
/// of how many samples lie below: exact for every continuous distribution.
[[nodiscard]] results::SampleQuantile quantile_of(const std::vector<double> &sorted, double share);

/// Fills in quantiles, mean and deviation from the values of the answer. Interval of the mean by
/// Student's distribution, of the deviation by the fourth moment: both for many samples.
void describe_values(const std::vector<double> &shares, results::SampledAnswer &answer);

} // namespace whirl::analyses
