#include "balancing/split.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

namespace whirl::tests {

namespace {

using balancing::Piece;
using balancing::Places;
using balancing::Split;
using Complex = std::complex<double>;
constexpr double pi = std::numbers::pi;

Complex sum_of_pieces(const Split &split) {
    Complex sum;
    for (const Piece &piece : split.pieces)
        sum += std::polar(piece.mr, piece.angle);
    return sum;
}

TEST(Split, BetweenTwoHolesIsExact) {
    for (const double degrees : {0.0, 10.0, 45.0, 50.0, 133.0, 359.0, -90.0}) {
        const Complex weight = std::polar(2.5e-4, degrees * pi / 180);
        const Split split = balancing::split(weight, {8, 0.1, 0.2, {}});
        EXPECT_LE(split.pieces.size(), 2U);
        EXPECT_NEAR(std::abs(sum_of_pieces(split) - weight), 0, 1e-15);
        EXPECT_NEAR(std::abs(split.sum - weight), 0, 1e-15);
        for (const Piece &piece : split.pieces)
            EXPECT_GE(piece.mr, 0);
    }
}

/// On a hole all of it is there; of two holes at right angles each has a leg.
TEST(Split, OfKnownAngles) {
    const Split on_hole = balancing::split(std::polar(3.0, 0.1 + pi / 4), {8, 0.1, 1, {}});
    ASSERT_EQ(on_hole.pieces.size(), 1U);
    EXPECT_EQ(*on_hole.pieces[0].hole, 1U);
    const Split legs = balancing::split({3, 4}, {4, 0, 1, {}});
    ASSERT_EQ(legs.pieces.size(), 2U);
    EXPECT_NEAR(legs.pieces[0].mr, 3, 1e-12);
    EXPECT_NEAR(legs.pieces[1].mr, 4, 1e-12);
}

TEST(Split, AtTwoAnglesIsExactWhereTheStockSuffices) {
    const Complex weight = std::polar(0.8, 2.0);
    const Split split = balancing::split(weight, {0, 0, 0.1, {3, 5, 20}});
    ASSERT_EQ(split.pieces.size(), 2U);
    EXPECT_EQ(*split.pieces[0].mass, 5) << "the smallest of which two are enough";
    EXPECT_NEAR(std::abs(sum_of_pieces(split) - weight), 0, 1e-14);
    EXPECT_TRUE(split.complete);
    const Split short_of = balancing::split(weight, {0, 0, 0.1, {1, 2}});
    EXPECT_FALSE(short_of.complete);
    EXPECT_NEAR(std::abs(sum_of_pieces(short_of)), 0.4, 1e-14);
}

/// Against all ways to fill six holes from a stock of three, gone through one by one.
TEST(Split, OfHolesAndStockIsTheNearestOfAll) {
    const Places places{6, 0.3, 0.5, {1, 2.5, 4}};
    for (int draw = 0; draw < 12; ++draw) {
        const Complex weight = std::polar(0.7 + 0.45 * draw, 0.77 * draw);
        double least = std::numeric_limits<double>::infinity();
        for (int code = 0; code < 4096; ++code) {
            Complex sum;
            for (int hole = 0, rest = code; hole < 6; ++hole, rest /= 4)
                if (rest % 4 > 0)
                    sum += std::polar(places.stock[static_cast<std::size_t>(rest % 4 - 1)] * 0.5,
                                      0.3 + pi / 3 * hole);
            least = std::min(least, std::abs(sum - weight));
        }
        const Split split = balancing::split(weight, places);
        EXPECT_TRUE(split.complete);
        EXPECT_NEAR(std::abs(split.sum - weight), least, 1e-9 * std::abs(weight));
        EXPECT_NEAR(std::abs(split.sum - sum_of_pieces(split)), 0, 1e-14);
    }
}

/// Of 72 holes and a stock of four two pieces are tried: the nearest of all pairs.
TEST(Split, OfManyHolesSaysThatNotAllWaysWereTried) {
    const Complex weight(0.9, 0.2);
    const std::vector<double> stock{0.5, 1, 2, 3};
    const Split split = balancing::split(weight, {72, 0, 0.3, stock});
    EXPECT_FALSE(split.complete);
    double least = std::abs(weight);
    for (int a = 0; a < 72; ++a)
        for (const double first : stock)
            for (int b = a; b < 72; ++b)
                for (const double second : stock) {
                    const Complex one = std::polar(0.3 * first, a * pi / 36);
                    const Complex other = std::polar(0.3 * second, b * pi / 36);
                    least = std::min(least, std::abs(weight - one - (a == b ? 0.0 : other)));
                }
    EXPECT_NEAR(std::abs(split.sum - weight), least, 1e-9);
}

TEST(Split, OfNothingIsNothing) {
    EXPECT_TRUE(balancing::split(0.0, {8, 0, 1, {1}}).pieces.empty());
}

} // namespace

} // namespace whirl::tests
