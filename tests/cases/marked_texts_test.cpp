// The comparison of texts in two sets of units sees what it is for: each fault is planted.

#include "input/case_file.h"
#include "marked_texts.h"

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

namespace whirl::tests {

namespace {

MarkedTexts texts() {
    static const report::Units us =
        report::Units::of_readers(input::output_units({"units.preset=us"}));
    return {us, false, ""};
}

TEST(MarkedTexts, FollowNumbersIntoOtherUnits) {
    MarkedTexts all = texts();
    all.compare("from 100 to 200 §spe, 1F", "from 954.93 to 1909.86 rpm, 1F");
    all.compare("1, 2 and 2.5·10⁷ §sti", "0.00571, 0.01142 and 142754 lbf/in");
    all.compare("peak pk-pk 2000 §amp pk-pk, sag 25.4 §amp", "peak 39.3701 mil, sag 1 mil");
    all.compare_terminal("  z §len       peak pk-pk §amp\n  0.254   end             50.8\n",
                         "  z in       peak mil\n  10   end              1\n");
    all.compare_html("<p>at 10 §spe</p><table><tr><th>z (§len)</th><th>of</th></tr>"
                     "<tr><td>0.0254</td><td>1</td></tr></table>",
                     "<p>at 95.493 rpm</p><table><tr><th>z (in)</th><th>of</th></tr>"
                     "<tr><td>1</td><td>1</td></tr></table>");
    EXPECT_EQ(all.compared.numbers, 11);
    EXPECT_EQ(all.compared.converted, 11);
}

TEST(MarkedTexts, SeeNumbersAndUnitsThatDoNotFit) {
    const auto sentence = [](const char *marked, const char *other) {
        texts().compare(marked, other);
    };
    // The number is left, the unit is left, the factor is that of something else, a peak is halved.
    EXPECT_NONFATAL_FAILURE(sentence("at 100 §spe", "at 100 rpm"), "speed");
    EXPECT_NONFATAL_FAILURE(sentence("at 100 §spe", "at 954.93 rad/s"), "words");
    EXPECT_NONFATAL_FAILURE(sentence("at 100 §fre", "at 954.93 Hz"), "frequency");
    EXPECT_NONFATAL_FAILURE(sentence("peak 50.8 §amp pk-pk", "peak 2 mil"), "amplitude");
    EXPECT_NONFATAL_FAILURE(sentence("1, 2 and 3 §len", "39.37, 2 and 118.11 in"), "length");
    // A number in a unit that nobody asked for; one that is another without a unit.
    EXPECT_NONFATAL_FAILURE(sentence("at 100 rad/s", "at 100 rad/s"), "whatever is asked for");
    EXPECT_NONFATAL_FAILURE(sentence("z = 0.254", "z = 10"), "without a unit");
    EXPECT_NONFATAL_FAILURE(
        texts().compare_terminal("  z §len   of\n  0.254   1\n", "  z in   of\n  0.254   1\n"),
        "length");
    EXPECT_NONFATAL_FAILURE(
        texts().compare_html("<table><tr><th>z (§len)</th></tr><tr><td>0.254</td></tr></table>",
                             "<table><tr><th>z (in)</th></tr><tr><td>0.254</td></tr></table>"),
        "length");
}

} // namespace

} // namespace whirl::tests
