// The random numbers behind the samples, and what is made of the answers, against statistics that
// are known in closed form. Seeds are fixed: the bounds are wide enough that a sound generator
// passes with nearly every seed, and a wrong distribution with none.

#include "analyses/samples/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace whirl;
using analyses::draw;
using analyses::quantile_of;
using model::Distribution;

constexpr int many = 20000;

/// Estimates are off by more than this many of their standard errors once in two million times.
constexpr double far_out = 5;

model::UncertainInput normal(double mean, double deviation) {
    model::UncertainInput input;
    input.mean = mean;
    input.deviation = deviation;
    return input;
}
model::UncertainInput uniform(double from, double to) {
    model::UncertainInput input;
    input.distribution = Distribution::uniform;
    input.from = from;
    input.to = to;
    return input;
}
model::UncertainInput one_of(const std::vector<double> &values) {
    model::UncertainInput input;
    input.distribution = Distribution::values;
    input.values = values;
    return input;
}

model::SamplesSettings settings_of(const std::vector<model::UncertainInput> &vary, int seed = 1) {
    model::SamplesSettings settings;
    settings.seed = seed;
    settings.vary = vary;
    return settings;
}

/// [input][sample].
std::vector<std::vector<double>> drawn(const model::SamplesSettings &settings, int count) {
    std::vector<std::vector<double>> out(settings.vary.size());
    for (int i = 0; i < count; ++i) {
        const std::vector<double> values = draw(settings, i);
        for (std::size_t k = 0; k < out.size(); ++k)
            out[k].push_back(values[k]);
    }
    return out;
}

double mean_of(const std::vector<double> &values) {
    double sum = 0;
    for (const double value : values)
        sum += value;
    return sum / static_cast<double>(values.size());
}

double variance_of(const std::vector<double> &values) {
    const double mean = mean_of(values);
    double sum = 0;
    for (const double value : values)
        sum += (value - mean) * (value - mean);
    return sum / static_cast<double>(values.size() - 1);
}

/// Kolmogorov's distance from a distribution, times the root of the number of values: above 2.6
/// once in 400,000 times, 2 exp(-2 x^2).
template <class Share> double distance(std::vector<double> values, const Share &share) {
    std::sort(values.begin(), values.end());
    const auto n = static_cast<double>(values.size());
    double largest = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto below = static_cast<double>(i);
        const double at = share(values[i]);
        largest = std::max({largest, at - below / n, (below + 1) / n - at});
    }
    return largest * std::sqrt(n);
}
constexpr double far_apart = 2.6;

double normal_share(double deviations) { return std::erfc(-deviations / std::sqrt(2.0)) / 2; }

TEST(Draws, NormalHasItsMeanDeviationAndShape) {
    const auto values = drawn(settings_of({normal(1e7, 1e6)}), many)[0];
    EXPECT_NEAR(mean_of(values), 1e7, far_out * 1e6 / std::sqrt(many));
    // Variance of the sample variance of a normal distribution: 2 sigma^4/(n - 1).
    EXPECT_NEAR(variance_of(values), 1e12, far_out * 1e12 * std::sqrt(2.0 / (many - 1)));
    EXPECT_LT(distance(values, [](double x) { return normal_share((x - 1e7) / 1e6); }), far_apart);
}

TEST(Draws, UniformStaysInsideAndIsFlat) {
    const auto values = drawn(settings_of({uniform(100, 300)}), many)[0];
    EXPECT_GT(*std::min_element(values.begin(), values.end()), 100);
    EXPECT_LT(*std::max_element(values.begin(), values.end()), 300);
    EXPECT_NEAR(mean_of(values), 200, far_out * 200 / std::sqrt(12.0 * many));
    EXPECT_LT(distance(values, [](double x) { return (x - 100) / 200; }), far_apart);
}

TEST(Draws, ValuesAreEquallyLikely) {
    const std::vector<double> values{10, 11, 12};
    const auto found = drawn(settings_of({one_of(values)}), many)[0];
    for (const double value : values) // binomial with probability 1/3
        EXPECT_NEAR(static_cast<double>(std::count(found.begin(), found.end(), value)), many / 3.0,
                    far_out * std::sqrt(many * 2.0 / 9));
}

TEST(Draws, InputsAndNeighbouringSamplesAndSeedsAreIndependent) {
    const std::vector<model::UncertainInput> two{normal(0, 1), normal(0, 1)};
    const auto first = drawn(settings_of(two), many);
    const auto other = drawn(settings_of(two, 2), many);
    const auto correlation = [](const std::vector<double> &a, const std::vector<double> &b,
                                std::size_t apart) {
        double sum = 0;
        for (std::size_t i = 0; i + apart < a.size(); ++i)
            sum += a[i] * b[i + apart];
        return sum / static_cast<double>(a.size());
    };
    const double bound = far_out / std::sqrt(many); // of products with variance 1
    EXPECT_NEAR(correlation(first[0], first[1], 0), 0, bound);
    EXPECT_NEAR(correlation(first[0], first[0], 1), 0, bound);
    EXPECT_NEAR(correlation(first[0], other[0], 0), 0, bound);
}

TEST(Draws, FollowFromSeedAndNumberAlone) {
    const model::SamplesSettings one = settings_of({uniform(0, 1)});
    const model::SamplesSettings two = settings_of({uniform(0, 1), normal(0, 1)});
    const std::vector<double> late = draw(one, 1000);
    (void)draw(one, 3);
    EXPECT_EQ(draw(one, 1000), late);
    EXPECT_EQ(draw(two, 1000).front(), late.front()); // whatever else varies
    EXPECT_NE(draw(one, 1001), late);
    EXPECT_NE(draw(settings_of({uniform(0, 1)}, 2), 1000), late);
}

std::vector<double> one_to(int n) {
    std::vector<double> values;
    for (int i = 1; i <= n; ++i)
        values.push_back(i);
    return values;
}

TEST(Quantiles, AreOrderStatistics) {
    EXPECT_EQ(quantile_of(one_to(5), 0.5).value, 3);
    EXPECT_EQ(quantile_of(one_to(4), 0.5).value, 2);    // half of them at or below
    EXPECT_EQ(quantile_of(one_to(100), 0.07).value, 7); // 0.07 * 100 > 7 in double precision
    EXPECT_EQ(quantile_of(one_to(200), 0.05).value, 10);
    EXPECT_EQ(quantile_of(one_to(200), 0.95).value, 190);
    EXPECT_EQ(quantile_of(one_to(3), 0.01).value, 1);
    EXPECT_EQ(quantile_of(one_to(3), 0.99).value, 3);
}

// Ranks of the interval of the median, as tables of order statistics have them.
TEST(Quantiles, IntervalsOfTheMedian) {
    struct Row {
        int n, low, high;
    };
    for (const Row &row :
         {Row{6, 1, 6}, Row{9, 2, 8}, Row{10, 2, 9}, Row{20, 6, 15}, Row{100, 40, 61}}) {
        const auto found = quantile_of(one_to(row.n), 0.5);
        EXPECT_EQ(found.low, row.low) << row.n;
        EXPECT_EQ(found.high, row.high) << row.n;
    }
    // (1/2)^5 is more than 2.5 %: five samples do not bound the median.
    EXPECT_FALSE(quantile_of(one_to(5), 0.5).low);
    EXPECT_FALSE(quantile_of(one_to(5), 0.5).high);
    // Nor 20 the quantile of 5 % from below: 0.95^20 = 0.36.
    EXPECT_FALSE(quantile_of(one_to(20), 0.05).low);
    EXPECT_TRUE(quantile_of(one_to(20), 0.05).high);
}

TEST(Quantiles, IntervalsHoldTheTruthAsOftenAsTheySay) {
    constexpr int repeats = 2000;
    constexpr int size = 40;
    for (const double share : {0.1, 0.5, 0.8}) {
        int inside = 0;
        for (int repeat = 0; repeat < repeats; ++repeat) {
            auto values = drawn(settings_of({uniform(0, 1)}, repeat), size)[0];
            std::sort(values.begin(), values.end());
            const auto found = quantile_of(values, share); // the truth is the share itself
            inside += found.low.value_or(0) <= share && share <= found.high.value_or(1) ? 1 : 0;
        }
        EXPECT_GE(inside, repeats * 0.95 - far_out * std::sqrt(repeats * 0.95 * 0.05)) << share;
    }
}

TEST(Quantiles, MeanAndDeviationHaveIntervalsThatHold) {
    constexpr int repeats = 1000;
    int mean_inside = 0;
    int deviation_inside = 0;
    for (int repeat = 0; repeat < repeats; ++repeat) {
        results::SampledAnswer answer;
        const auto values = drawn(settings_of({normal(3, 2)}, repeat), 100)[0];
        for (const double value : values)
            answer.values.emplace_back(value);
        analyses::describe_values({0.5}, answer);
        mean_inside += std::abs(*answer.mean - 3) <= *answer.mean_error ? 1 : 0;
        deviation_inside += std::abs(*answer.deviation - 2) <= *answer.deviation_error ? 1 : 0;
    }
    const double rounding = far_out * std::sqrt(repeats * 0.95 * 0.05);
    EXPECT_NEAR(mean_inside, 0.95 * repeats, rounding);
    // That of the deviation is one for many samples: with a hundred it may hold a little less.
    EXPECT_GE(deviation_inside, 0.92 * repeats - rounding);
}

TEST(Quantiles, OfMissingValuesAreThoseOfTheOthers) {
    results::SampledAnswer answer;
    answer.values = {3., std::nullopt, 1., 2.};
    analyses::describe_values({0.5}, answer);
    EXPECT_EQ(answer.present, 3);
    EXPECT_EQ(answer.quantiles.at(0).value, 2);
    EXPECT_DOUBLE_EQ(*answer.mean, 2);
    EXPECT_DOUBLE_EQ(*answer.deviation, 1);
    results::SampledAnswer none;
    none.values = {std::nullopt};
    analyses::describe_values({0.5}, none);
    EXPECT_TRUE(none.quantiles.empty());
    EXPECT_FALSE(none.mean);
}

} // namespace
