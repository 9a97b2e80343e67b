#pragma once

#include "model/rotor.h"
#include "results/response.h"
#include "support/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

namespace whirl::tests {

/// Local maxima of a curve (place, value) by looking at very many places, then by thirds: the place
/// to the root of rounding.
template <class Curve>
std::vector<std::pair<double, double>> looked_for(Curve &&curve, double from, double to,
                                                  int count) {
    std::vector<double> values;
    const double step = (to - from) / count;
    for (int i = 0; i <= count; ++i)
        values.push_back(curve(from + i * step));
    std::vector<std::pair<double, double>> out;
    for (std::size_t i = 1; i + 1 < values.size(); ++i) {
        if (values[i] < values[i - 1] || values[i] <= values[i + 1])
            continue;
        double a = from + static_cast<double>(i - 1) * step;
        double b = from + static_cast<double>(i + 1) * step;
        while (b - a > 1e-7 * b) {
            const double left = a + (b - a) / 3;
            const double right = b - (b - a) / 3;
            if (curve(left) < curve(right))
                a = left;
            else
                b = right;
        }
        out.emplace_back((a + b) / 2, curve((a + b) / 2));
    }
    return out;
}

inline void expect_same_peaks(const std::vector<results::ResponsePeak> &some,
                              const std::vector<results::ResponsePeak> &others) {
    ASSERT_EQ(some.size(), others.size());
    for (std::size_t i = 0; i < some.size(); ++i) {
        EXPECT_NEAR(some[i].speed / others[i].speed, 1, 1e-8);
        EXPECT_NEAR(some[i].value / others[i].value, 1, 1e-8);
    }
}

/// Deviations of values (and of speeds where they have an error) within twice the stated errors.
/// @returns of how many both were compared; none where so coarse that a peak is beyond an end
inline int expect_within_errors(const std::vector<results::ResponsePeak> &coarse,
                                const std::vector<results::ResponsePeak> &fine) {
    if (coarse.size() != fine.size())
        return 0;
    int compared = 0;
    for (std::size_t i = 0; i < fine.size(); ++i) {
        if (std::isnan(coarse[i].error))
            continue;
        const double value = std::abs(coarse[i].value / fine[i].value - 1);
        EXPECT_LE(value, 2 * coarse[i].error + 3e-9) << "peak " << i;
        if (std::isnan(coarse[i].speed_error))
            continue; // a shallow maximum, or the row of a bearing table
        const double speed = std::abs(coarse[i].speed / fine[i].speed - 1);
        EXPECT_LE(speed, 2 * coarse[i].speed_error + 1e-9) << "peak " << i;
        ++compared;
    }
    return compared;
}

/// With some luck a table of speeds and a pedestal.
/// @param tables     share of bearings that get a table
/// @param exponent   of ten, of the least damping of a pedestal (N s/m)
inline void attach_at_random(model::Bearing &bearing, Random &random, double tables,
                             double exponent) {
    if (random(0, 1) < tables) {
        model::BearingCoefficients faster = bearing.rows[0];
        faster.k *= random(1, 3);
        faster.c *= random(0.3, 1);
        bearing.rows.push_back(faster);
        bearing.speeds = {random(100, 400), random(600, 1500)};
    }
    if (random.coin())
        bearing.pedestal = model::Pedestal{random(2, 20), std::pow(10, random(7, 8.5)),
                                           std::pow(10, random(exponent, 4))};
}

} // namespace whirl::tests
