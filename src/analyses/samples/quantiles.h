#pragma once

#include "results/samples.h"

#include <vector>

namespace whirl::analyses {

/// Quantile of sorted values: an order statistic, so that the quantile of an increasing function
/// of a sample is that function of the quantile. Its interval of 95 % by the binomial distribution
/// of how many samples lie below: exact for every continuous distribution.
[[nodiscard]] results::SampleQuantile quantile_of(const std::vector<double> &sorted, double share);

/// Fills in quantiles, mean and deviation from the values of the answer. Interval of the mean by
/// Student's distribution, of the deviation by the fourth moment: both for many samples.
void describe_values(const std::vector<double> &shares, results::SampledAnswer &answer);

} // namespace whirl::analyses
