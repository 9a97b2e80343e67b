// Roots that cannot be told apart, by the polynomial with just these roots.

#include "modes/roots/clusters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <vector>

using namespace whirl;

namespace {

/// The roots -1 +- sqrt(q) at t = 0 and t = 1, q = 4 height t (1 - t) - depth: a pair that meets on
/// the real axis and parts again for height > depth, where one of them reaches sqrt(height - depth)
/// - 1 in the middle.
std::vector<modes::Root> roots_at(double t, double height, double depth) {
    const std::complex<double> root = std::sqrt(std::complex<double>(-depth));
    const double slope = 4 * height * (1 - 2 * t);
    std::vector<modes::Root> out(2);
    for (const int k : {0, 1}) {
        const double sign = k == 0 ? 1 : -1;
        modes::Root &one = out[static_cast<std::size_t>(k)];
        one.value = -1.0 + sign * root;
        one.rate = sign * slope / (2.0 * root);
        one.noise = 1e-12;
    }
    return out;
}

bool off_the_axis(double height, double depth) {
    const auto a = roots_at(0, height, depth);
    const auto b = roots_at(1, height, depth);
    return modes::off_the_axis({&a[0], &a[1]}, {&b[0], &b[1]}, {0, 1, false});
}

// Values and rates at both ends are those of one pair that dies out; whether one of it grows in
// between only their product tells.
TEST(Clusters, APairThatMeetsInAStepIsKnownToGrowOrNot) {
    EXPECT_TRUE(off_the_axis(0.5, 0.1));  // meets, and comes to -1 + sqrt(0.4)
    EXPECT_FALSE(off_the_axis(1.2, 0.1)); // comes to -1 + sqrt(1.1)
    EXPECT_FALSE(off_the_axis(4, 0.1));
}

} // namespace
