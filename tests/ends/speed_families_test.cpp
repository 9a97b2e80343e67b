#include "ends/speed_families.h"

#include <gtest/gtest.h>

namespace whirl::ends {
namespace {

using Intervals = std::vector<results::Interval>;

TEST(SpeedFamilies, ListsOfOneLengthGoTogetherInOrder) {
    EXPECT_EQ(intervals_of({{1, 5, 9}, {1.5, 4, 9}, {0.5, 6, 9}}),
              (Intervals{{0.5, 1.5}, {4, 6}, {9, 9}}));
    EXPECT_EQ(intervals_of({}), Intervals{});
    EXPECT_EQ(intervals_of({{}, {}}), Intervals{});
}

// Of two speeds that nearly coincide one arrangement has one: the others keep their partners.
TEST(SpeedFamilies, AListThatLacksASpeedIsLaidWhereItFits) {
    EXPECT_EQ(intervals_of({{144.8368, 144.8369, 224.68, 224.70}, {144.8367, 224.69, 224.71}}),
              (Intervals{
                  {144.8367, 144.8368}, {144.8369, 144.8369}, {224.68, 224.69}, {224.70, 224.71}}));
    // A speed that leaves the range, at either end.
    EXPECT_EQ(intervals_of({{10, 20, 30}, {11, 21}, {19, 29}}),
              (Intervals{{10, 11}, {19, 21}, {29, 30}}));
    EXPECT_EQ(intervals_of({{21}, {10, 20}}), (Intervals{{10, 10}, {20, 21}}));
}

} // namespace
} // namespace whirl::ends
