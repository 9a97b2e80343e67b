#include "report/common/gnuplot.h"

#include "model/errors.h"
#include "report/common/drawing.h"
#include "sample_results.h"

#include <pugixml.hpp>

#include <cstdlib>

namespace whirl::report {

class GnuplotTest : public ScratchFolder {};

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
