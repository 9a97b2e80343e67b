// The boxes by which tests/cases/pictures_test.cpp judges the pictures.

#include "report/common/text_width.h"
#include "report/common/words.h"
#include "support/svg_texts.h"

#include <gtest/gtest.h>

namespace whirl::tests {

namespace {

std::string svg(const std::string &inside) {
    return "<svg viewBox=\"0 0 200 100\">" + inside + "</svg>";
}

} // namespace

// In DejaVu Sans "iii" is 3 x 0.278 and "MMM" 3 x 0.863 of the font's size wide.
TEST(SvgTexts, BoxesFollowAnchorLettersAndTurn) {
    const auto boxes = svg_texts(svg("<text x=\"50\" y=\"20\" font-size=\"10\">MMM</text>"
                                     "<text x=\"50\" y=\"40\" font-size=\"10\" "
                                     "text-anchor=\"end\">iii</text>"
                                     "<g transform=\"translate(10,90) rotate(-90)\" "
                                     "font-size=\"10\"><text><tspan> MMM</tspan></text></g>"));
    ASSERT_EQ(boxes.size(), 3U);
    EXPECT_NEAR(boxes[0].corners[0].x, 50, 1e-12);
    EXPECT_NEAR(boxes[0].corners[1].x, 50 + 25.89, 1e-9);
    EXPECT_NEAR(boxes[1].corners[0].x, 50 - 8.34, 1e-9);
    EXPECT_EQ(boxes[2].text, "MMM");
    EXPECT_NEAR(boxes[2].corners[1].y, 90 - 25.89, 1e-9) << "it reads upwards";
    EXPECT_NEAR(boxes[2].corners[2].x, 10, 1e-9) << "on its baseline";
    EXPECT_LT(boxes[2].corners[1].x, 10);
}

// Advance widths of DejaVu Sans in thousandths: u 634, e with any accent 615, an ideograph 1000
// (there in fonts that stand in), Cyrillic Sha 1077 as the widest of its script.
TEST(TextWidth, FollowsTheFontBeyondAscii) {
    EXPECT_NEAR(report::text_width("ü", 10), 6.34, 1e-9);
    EXPECT_NEAR(report::text_width("éèê", 10), 3 * 6.15, 1e-9);
    EXPECT_NEAR(report::text_width("e\u0301", 10), 6.15, 1e-9) << "the accent apart";
    EXPECT_NEAR(report::text_width("10 µm", 10), report::text_width("10 m", 10) + 6.36, 1e-9);
    EXPECT_NEAR(report::text_width("轴承", 10), 20, 1e-9);
    EXPECT_GT(report::text_width("Подшипник", 10), 50);
}

// Rings of polar plots at 500 and 1000 um, amplification factors of thousands.
TEST(Words, NumbersForReadersHaveNoPowerOfTenBelowAMillion) {
    EXPECT_EQ(report::readable(1000, 3), "1000");
    EXPECT_EQ(report::readable(123456, 3), "123000");
    EXPECT_EQ(report::readable(999999, 3), "1e+06");
    EXPECT_EQ(report::readable(2.5e7, 3), "2.5e+07");
    EXPECT_EQ(report::readable(0.012345, 3), "0.0123");
    EXPECT_EQ(report::readable(-4321, 2), "-4300");
}

TEST(SvgTexts, FaultsAreTextsOutsideAndOnEachOther) {
    const auto at = [](int x, int y) {
        return "<text font-size=\"10\" x=\"" + std::to_string(x) + "\" y=\"" + std::to_string(y) +
               "\">MMM</text>";
    };
    EXPECT_TRUE(layout_faults(svg(at(0, 10) + at(27, 10) + at(0, 20) + at(174, 99))).empty());
    EXPECT_EQ(layout_faults(svg(at(178, 50))).size(), 1U) << "leaves at the right";
    EXPECT_EQ(layout_faults(svg(at(50, 5))).size(), 1U) << "leaves at the top";
    EXPECT_EQ(layout_faults(svg(at(50, 50) + at(70, 53))).size(), 1U);
    EXPECT_EQ(layout_faults(svg(at(50, 50) + at(50, 50))).size(), 1U) << "drawn twice";
    const std::string aslant =
        "<g transform=\"translate(100,60) rotate(45)\" font-size=\"10\"><text>MMM</text></g>";
    EXPECT_TRUE(layout_faults(svg(aslant + at(100, 80))).size() == 1U) << "on the turned one";
    EXPECT_TRUE(layout_faults(svg(aslant + at(120, 65))).empty())
        << "inside its upright frame only";
}

TEST(SvgTexts, NumbersAsProgramsWriteThemAreFaults) {
    const auto faults = [](const std::string &text) {
        return layout_faults(svg("<text x=\"20\" y=\"50\" font-size=\"10\">" + text + "</text>"))
            .size();
    };
    EXPECT_EQ(faults("2e+07 N/m"), 1U);
    EXPECT_EQ(faults("1e-16"), 1U);
    EXPECT_EQ(faults("-0"), 1U);
    EXPECT_EQ(faults("2·10⁷ N/m"), 0U);
    EXPECT_EQ(faults("-0.5"), 0U);
    EXPECT_EQ(faults("stage-01"), 0U);
}

} // namespace whirl::tests
