#include "report/common/plot_jobs.h"

#include "model/errors.h"
#include "report/common/drawing.h"
#include "sample_results.h"
#include "support/svg_texts.h"

#include <fmt/format.h>
#include <pugixml.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <utility>
#include <vector>

namespace whirl::report {

namespace fs = std::filesystem;

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
    if (!jobs.start(figure, PictureFormat::svg, "a.svg"))
        GTEST_SKIP() << "gnuplot is not installed";
    const std::string picture = jobs.finish().at("a.svg");
    pugi::xml_document svg;
    ASSERT_TRUE(svg.load_string(picture.c_str()));
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
            if (!jobs.start(figure, format, "picture"))
                GTEST_SKIP() << "gnuplot is not installed";
            pictures.push_back(jobs.finish().at("picture"));
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
    if (!jobs.start(figure, PictureFormat::svg, "a.svg"))
        GTEST_SKIP() << "gnuplot is not installed";
    const std::string picture = jobs.finish().at("a.svg");
    const std::string &svg = picture;
    const std::size_t at = svg.find(" scale(");
    ASSERT_NE(at, std::string::npos);
    const double pixels = 2 * std::stod(svg.substr(at + 7));
    EXPECT_GE(pixels, 13);
    EXPECT_LE(pixels, 4.0 / 3 * 13);
    EXPECT_NE(svg.find("ps 7"), std::string::npos) << "a text is left as it is";
}

TEST_F(GnuplotTest, ScriptErrorIsAFailureInGnuplotsWords) {
    PlotJobs jobs;
    if (!jobs.start({"plot nonsense(\n"}, PictureFormat::svg, "a.svg"))
        GTEST_SKIP() << "gnuplot is not installed";
    try {
        (void)jobs.finish();
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
    EXPECT_FALSE(jobs.start({"plot x\n"}, PictureFormat::svg, "a.svg"));
    setenv("PATH", path.c_str(), 1);
    // Nothing was started: there is nothing to wait for, and no picture.
    EXPECT_TRUE(jobs.finish().empty());
}

/// A picture that gnuplot really draws is whole; no beginning of it is, and none of another size.
TEST_F(GnuplotTest, OnlyWholePicturesAreTaken) {
    for (const PictureFormat format : {PictureFormat::svg, PictureFormat::png}) {
        PlotJobs jobs;
        const Figure figure{"plot x\n", 300, 200};
        if (!jobs.start(figure, format, "picture"))
            GTEST_SKIP() << "gnuplot is not installed";
        const std::string picture = jobs.finish().at("picture");
        EXPECT_EQ(picture_fault(picture, format, 300, 200), "");
        const bool svg = format == PictureFormat::svg;
        EXPECT_EQ(picture_fault(picture, format, 301, 200).empty(), svg) << "pixels of a PNG";
        const std::size_t whole = svg ? picture.rfind("</svg>") + 6 : picture.size();
        for (std::size_t length = 0; length < whole; length += length < 100 ? 1 : 97)
            EXPECT_NE(picture_fault(picture.substr(0, length), format, 300, 200), "") << length;
        EXPECT_NE(picture_fault(picture.substr(0, whole - 1), format, 300, 200), "");
        EXPECT_NE(picture_fault("gnuplot> ", format, 300, 200), "");
    }
    EXPECT_NE(picture_fault("<html></html>", PictureFormat::svg, 300, 200), "");
}

/// Programs of that name that are none: none of what they write is taken for a picture, and none is
/// waited for without end.
TEST_F(GnuplotTest, WhatIsNoPictureIsAFailureInTime) {
    const std::string path = std::getenv("PATH");
    setenv("PATH", (folder.string() + ":" + path).c_str(), 1);
    struct Program {
        std::string script, words;
        double patience = 60; ///< s: more than a shell ever takes
    };
    const std::vector<Program> programs{{"exit 3", "exit status 3"},
                                        {"echo no terminal >&2; exit 1", "no terminal"},
                                        {"kill -SEGV $$", "ended by signal 11"},
                                        {"exit 0", "it is empty"},
                                        {"echo garbage", "it is no PNG"},
                                        {"printf '\\211PNG\\r\\n\\032\\n'", "its end is missing"},
                                        {"sleep 1000 & exit 0", "it is empty"},
                                        {"sleep 1000", "within 0.2 s", 0.2},
                                        {"while :; do :; done", "within 0.2 s", 0.2}};
    for (const auto &[script, words, patience] : programs) {
        std::ofstream(folder / "gnuplot") << "#!/bin/sh\n" << script << "\n";
        fs::permissions(folder / "gnuplot", fs::perms::owner_all);
        PlotJobs jobs(patience);
        ASSERT_TRUE(jobs.start({"plot x\n"}, PictureFormat::png, "a.png"));
        try {
            (void)jobs.finish();
            FAIL() << script;
        } catch (const model::AnalysisFailure &failure) {
            const std::string what = failure.what();
            EXPECT_NE(what.find("a.png"), std::string::npos) << what;
            EXPECT_NE(what.find(words), std::string::npos) << what;
        }
    }
    setenv("PATH", path.c_str(), 1);
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
