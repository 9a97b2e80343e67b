#include "report/common/files.h"

#include "model/errors.h"
#include "sample_results.h"

namespace whirl::report {

namespace fs = std::filesystem;

class FilesTest : public ScratchFolder {
  protected:
    [[nodiscard]] std::ptrdiff_t entries() const {
        return std::distance(fs::directory_iterator(folder), fs::directory_iterator());
    }
};

TEST_F(FilesTest, WritesIntoNewFoldersAndLeavesNoTemporaryName) {
    write_file_atomically(folder / "a" / "b" / "x.txt", "new");
    EXPECT_EQ(content_of(folder / "a" / "b" / "x.txt"), "new");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder / "a" / "b"), fs::directory_iterator()),
              1);
}

TEST_F(FilesTest, OldContentStaysUntilCommit) {
    write_file_atomically(folder / "x.txt", "old");
    OutputFiles files(folder);
    files.add("x.txt", "new");
    EXPECT_EQ(content_of(folder / "x.txt"), "old");
    EXPECT_EQ(files.commit().at(0), folder / "x.txt");
    EXPECT_EQ(content_of(folder / "x.txt"), "new");
}

TEST_F(FilesTest, WithoutCommitNothingIsLeftNotEvenFolders) {
    {
        OutputFiles files(folder / "a" / "b");
        files.add("x.txt", "text");
        files.reserve("y.txt");
        ASSERT_TRUE(fs::exists(folder / "a" / "b"));
    }
    EXPECT_EQ(entries(), 0);
}

TEST_F(FilesTest, FileInTheWayOfAFolderIsAFailureThatLeavesItAlone) {
    write_file_atomically(folder / "taken", "text");
    EXPECT_THROW(write_file_atomically(folder / "taken" / "x.txt", "y"), model::AnalysisFailure);
    EXPECT_EQ(content_of(folder / "taken"), "text");
    EXPECT_EQ(entries(), 1);
}

TEST_F(FilesTest, FolderInTheWayOfAFileIsAFailureThatLeavesNoTemporaryFile) {
    fs::create_directories(folder / "x.txt" / "inside");
    EXPECT_THROW(write_file_atomically(folder / "x.txt", "y"), model::AnalysisFailure);
    EXPECT_EQ(entries(), 1);
}

} // namespace whirl::report
