#include "report/report.h"

#include "model/errors.h"
#include "sample_results.h"

#include <nlohmann/json.hpp>
#include <pugixml.hpp>

#include <cstdlib>

namespace whirl::report {

namespace fs = std::filesystem;

class ReportTest : public ScratchFolder {
  protected:
    /// Every file announced is there with content, and nothing else is.
    void expect_complete(const Files &files) const {
        for (const fs::path &path : files.paths)
            EXPECT_GT(fs::file_size(path), 50u) << path;
        EXPECT_EQ(static_cast<std::size_t>(
                      std::distance(fs::directory_iterator(folder), fs::directory_iterator())),
                  files.paths.size());
    }
};

TEST_F(ReportTest, CampbellWritesPicturesDataAndPage) {
    const Files files = write_report(sample_case(), sample_campbell(), folder);
    expect_complete(files);
    EXPECT_TRUE(nlohmann::json::accept(content_of(folder / "campbell.json")));
    EXPECT_TRUE(fs::exists(folder / "report.html"));
    if (!files.notes.empty())
        GTEST_SKIP() << files.notes[0];
    EXPECT_EQ(files.paths.at(0), folder / "campbell.svg");
    EXPECT_EQ(content_of(folder / "campbell.png").substr(1, 3), "PNG");
    pugi::xml_document svg;
    EXPECT_TRUE(svg.load_file((folder / "campbell.svg").c_str()));
}

TEST_F(ReportTest, EmptyResultsStillMakeAReport) {
    EXPECT_NO_THROW(write_report(model::Case{}, analyses::CampbellResult{}, folder / "a"));
    EXPECT_NO_THROW(write_report(model::Case{}, analyses::CriticalResult{}, folder / "b"));
    EXPECT_NO_THROW(write_report(model::Case{}, analyses::ResponseResult{}, folder / "c"));
    EXPECT_NO_THROW(write_report(model::Case{}, analyses::ModesResult{}, folder / "d"));
    EXPECT_NO_THROW(write_report(model::Case{}, analyses::ShowResult{}, folder / "e"));
    EXPECT_NO_THROW(write_report(model::Case{}, analyses::AccuracyResult{}, folder / "f"));
}

TEST_F(ReportTest, SingleSpeedStillMakesAReport) {
    analyses::CampbellResult result = sample_campbell();
    result.speeds.resize(1);
    EXPECT_NO_THROW(write_report(sample_case(), result, folder));
}

TEST_F(ReportTest, ModesHaveAFileForParaView) {
    expect_complete(write_report(sample_case(), sample_modes(), folder));
    EXPECT_TRUE(fs::exists(folder / "modes.vtp"));
}

TEST_F(ReportTest, WithoutGnuplotTheRestIsWrittenAndANoteSaysSo) {
    const char *found = std::getenv("PATH");
    const std::string path = found == nullptr ? "" : found;
    setenv("PATH", "/nonexistent", 1);
    const Files files = write_report(sample_case(), sample_campbell(), folder);
    setenv("PATH", path.c_str(), 1);
    expect_complete(files);
    ASSERT_EQ(files.notes.size(), 1u);
    EXPECT_NE(files.notes[0].find("gnuplot"), std::string::npos);
    EXPECT_FALSE(fs::exists(folder / "campbell.svg"));
    EXPECT_TRUE(fs::exists(folder / "campbell.json"));
}

} // namespace whirl::report
