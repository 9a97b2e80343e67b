#include "analyses/samples/statistics.h"

#include "analyses/random.h"

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <boost/math/statistics/univariate_statistics.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace whirl::analyses {

namespace {

double value_of(const model::UncertainInput &input, double share) {
    switch (input.distribution) {
    case model::Distribution::normal:
        return input.mean -
               input.deviation * std::numbers::sqrt2 * boost::math::erfc_inv(2 * share);
    case model::Distribution::uniform:
        return input.from + (input.to - input.from) * share;
    case model::Distribution::values:
        break;
    }
    const auto place = static_cast<std::size_t>(share * static_cast<double>(input.values.size()));
    return input.values.at(place);
}

constexpr double tail = 0.025; ///< on either side of an interval of 95 %

/// The largest of 1 .. n for which a condition holds that holds up to some number and no further;
/// 0: for none.
template <class Condition> std::size_t last_of(std::size_t n, const Condition &holds) {
    std::size_t low = 0;
    std::size_t high = n + 1;
    while (high - low > 1) {
        const std::size_t middle = (low + high) / 2;
        (holds(middle) ? low : high) = middle;
    }
    return low;
}

void add_moments(const std::vector<double> &values, results::SampledAnswer &answer) {
    const auto n = static_cast<double>(values.size());
    const auto [mean, second, third, fourth] = boost::math::statistics::first_four_moments(values);
    answer.mean = mean;
    if (values.size() < 2)
        return;
    const double variance = second * n / (n - 1);
    const double deviation = std::sqrt(variance);
    answer.deviation = deviation;
    const boost::math::students_t student(n - 1);
    answer.mean_error =
        boost::math::quantile(boost::math::complement(student, tail)) * deviation / std::sqrt(n);
    if (values.size() < 4)
        return;
    // Variance of the sample variance, by its fourth moment.
    const double spread = (fourth - (n - 3) / (n - 1) * variance * variance) / n;
    constexpr double normal = 1.959963984540054;
    answer.deviation_error =
        deviation > 0 ? normal * std::sqrt(std::max(spread, 0.0)) / (2 * deviation) : 0;
}

} // namespace

std::vector<double> draw(const model::SamplesSettings &settings, int sample) {
    std::mt19937_64 bits = bits_of(settings.seed, sample);
    std::vector<double> values;
    for (const model::UncertainInput &input : settings.vary)
        values.push_back(value_of(input, share_of(bits())));
    return values;
}

results::SampleQuantile quantile_of(const std::vector<double> &sorted, double share) {
    const std::size_t n = sorted.size();
    const auto size = static_cast<double>(n);
    // A product such as 0.07 * 100 must not count one more by rounding.
    const double wanted = std::ceil(size * share * (1 - 1e-14));
    const auto rank = std::clamp<std::size_t>(static_cast<std::size_t>(wanted), 1, n);
    results::SampleQuantile out{share, sorted[rank - 1], {}, {}};
    // B samples lie below the quantile; the k-th is above it where B < k, below it where B >= k.
    const boost::math::binomial_distribution<double> below(size, share);
    const std::size_t low = last_of(n, [&](std::size_t k) {
        return boost::math::cdf(below, static_cast<double>(k - 1)) <= tail;
    });
    if (low > 0)
        out.low = sorted[low - 1];
    const std::size_t inside = last_of(n, [&](std::size_t k) {
        const auto count = static_cast<double>(k - 1);
        return boost::math::cdf(boost::math::complement(below, count)) > tail;
    });
    if (inside < n)
        out.high = sorted[inside];
    return out;
}

void describe_values(const std::vector<double> &shares, results::SampledAnswer &answer) {
    std::vector<double> sorted;
    for (const std::optional<double> &value : answer.values)
        if (value)
            sorted.push_back(*value);
    answer.present = static_cast<int>(sorted.size());
    if (sorted.empty())
        return;
    std::ranges::sort(sorted);
    for (const double share : shares)
        answer.quantiles.push_back(quantile_of(sorted, share));
    add_moments(sorted, answer);
}

} // namespace whirl::analyses
