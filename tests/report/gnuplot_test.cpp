#include "report/common/gnuplot.h"

#include "model/errors.h"
#include "report/common/drawing.h"
#include "sample_results.h"
#include "support/svg_texts.h"

#include <fmt/format.h>
#include <pugixml.hpp>

#include <cstdlib>

namespace whirl::report {

class GnuplotTest : public ScratchFolder {
  protected:
    static double height_of(const std::string &text, const std::string &svg) {
        for (const auto &box : whirl::tests::svg_texts(svg))
            if (box.text == text)
                return box.corners[2].y - box.corners[0].y;
        return 0;
    }
};

TEST_F(GnuplotTest, WickedTitleIsShownLetterByLetter) {
    Figure figure;
    figure.script = "set title " + plot_text(wicked_title) + "\nplot x\n";
    PlotJobs jobs;
    if (!jobs.start(figure, PictureFormat::svg, folder / "a.svg"))
        GTEST_SKIP() << "gnuplot is not installed";
    jobs.finish();
    pugi::xml_document svg;
    ASSERT_TRUE(svg.load_string(content_of(folder / "a.svg").c_str()));
    std::string all;
    for (const auto &text : svg.select_nodes("//text"))
        all += std::string(text.node().text().get()) + text.node().child_value("tspan") + "\n";
    std::string shown = wicked_title;
    shown[shown.find('\n')] = ' ';
    EXPECT_NE(all.find(shown), std::string::npos) << all;
}

// The sizes of letters that a figure gives are those of the letters it gives none for, in a PNG as
// in an SVG: 14 is the size of both. Equal pictures to the last byte.
TEST_F(GnuplotTest, SizesOfLettersAreTheSameInBothFormats) {
    for (const PictureFormat format : {PictureFormat::svg, PictureFormat::png}) {
        std::vector<std::string> pictures;
        for (const char *size : {"", "font ',14'", "font ',9'"}) {
            PlotJobs jobs;
            const Figure figure{fmt::format("set label 'amplitude' at 0,0 {}\nplot x\n", size)};
            if (!jobs.start(figure, format, folder / "picture"))
                GTEST_SKIP() << "gnuplot is not installed";
            jobs.finish();
            pictures.push_back(content_of(folder / "picture"));
        }
        // An SVG names every size that is given; its letters are compared, not its bytes.
        if (format == PictureFormat::svg)
            for (std::string &picture : pictures)
                picture = whirl::tests::svg_texts(picture).empty()
                              ? ""
                              : fmt::format("{:.3f}", height_of("amplitude", picture));
        EXPECT_EQ(pictures[0], pictures[1]);
        EXPECT_NE(pictures[0], pictures[2]);
    }
}

// A point of size 2 is 13 pixels wide in a PNG of gnuplot's cairo terminal; in the SVG, whose
// points are circles of radius 1 scaled, not much more.
TEST_F(GnuplotTest, PointsOfAnSvgAreAsLargeAsThoseOfAPng) {
    Figure figure;
    figure.script = "set label 'ps 7' at graph 0.5,0.5\nplot '-' with points pt 7 ps 2 notitle\n"
                    "1 0\n2 1\ne\n";
    PlotJobs jobs;
    if (!jobs.start(figure, PictureFormat::svg, folder / "a.svg"))
        GTEST_SKIP() << "gnuplot is not installed";
    jobs.finish();
    const std::string svg = content_of(folder / "a.svg");
    const std::size_t at = svg.find(" scale(");
    ASSERT_NE(at, std::string::npos);
    const double pixels = 2 * std::stod(svg.substr(at + 7));
    EXPECT_GE(pixels, 13);
    EXPECT_LE(pixels, 4.0 / 3 * 13);
    EXPECT_NE(svg.find("ps 7"), std::string::npos) << "a text is left as it is";
}

TEST_F(GnuplotTest, ScriptErrorIsAFailureInGnuplotsWords) {
    PlotJobs jobs;
    if (!jobs.start({"plot nonsense(\n"}, PictureFormat::svg, folder / "a.svg"))
        GTEST_SKIP() << "gnuplot is not installed";
    try {
        jobs.finish();
        FAIL() << "no failure";
    } catch (const model::AnalysisFailure &failure) {
        EXPECT_NE(std::string(failure.what()).find("nonsense"), std::string::npos)
            << failure.what();
    }
}

TEST_F(GnuplotTest, MissingProgramIsToldNotThrown) {
    const char *found = std::getenv("PATH");
    const std::string path = found == nullptr ? "" : found;
    setenv("PATH", folder.c_str(), 1);
    PlotJobs jobs;
    EXPECT_FALSE(jobs.start({"plot x\n"}, PictureFormat::svg, folder / "a.svg"));
    setenv("PATH", path.c_str(), 1);
    jobs.finish(); // nothing was started: there is nothing to wait for, and no picture
    EXPECT_EQ(content_of(folder / "a.svg"), "");
}

TEST(Drawing, SvgIsWellFormedWithAnyText) {
    Drawing drawing;
    drawing.texts.push_back({{1, 2}, wicked_title});
    drawing.shapes.push_back({{{0, 0}, {1, 1}}, "", "#000000"});
    pugi::xml_document svg;
    ASSERT_TRUE(svg.load_string(to_svg(drawing).c_str()));
    std::string shown = wicked_title;
    shown[shown.find('\n')] = ' ';
    EXPECT_EQ(svg.child("svg").child_value("text"), shown);
}

} // namespace whirl::report
