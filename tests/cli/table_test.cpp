#include "cli/table.h"

#include <gtest/gtest.h>

namespace {

using whirl::cli::Table;

TEST(Table, AlignsTheFirstColumnLeftAndTheOthersRight) {
    Table table({"mode", "Hz"});
    EXPECT_TRUE(table.empty());
    table.add({"1F", "13.5"});
    table.add({"10B", "7"});
    EXPECT_FALSE(table.empty());
    EXPECT_EQ(table.text(), "  mode     Hz\n"
                            "  1F     13.5\n"
                            "  10B       7\n");
}

} // namespace
