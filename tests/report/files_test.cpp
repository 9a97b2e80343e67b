#include "report/common/files.h"

#include "model/errors.h"
#include "sample_results.h"

#include <fmt/format.h>

#include <csignal>
#include <cstdlib>
#include <sys/resource.h>
#include <unistd.h>

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
        files.announce("y.txt");
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

/// One target cannot be replaced, the last of three: those before it are as they were.
TEST_F(FilesTest, AFolderInTheWayOfOneFileLeavesAllOthersAsTheyWere) {
    write_file_atomically(folder / "a", "old");
    fs::create_directories(folder / "z" / "inside");
    OutputFiles files(folder);
    files.add("a", "new");
    files.add("b", "new");
    files.add("z", "new");
    EXPECT_THROW(files.commit(), model::AnalysisFailure);
    EXPECT_EQ(content_of(folder / "a"), "old");
    EXPECT_FALSE(fs::exists(folder / "b"));
    EXPECT_EQ(entries(), 2);
}

/// The same where only the exchange itself is refused: a file that may not be changed is said after
/// others have been replaced.
TEST_F(FilesTest, AFileThatMayNotBeReplacedLeavesAllOthersAsTheyWere) {
    write_file_atomically(folder / "a", "old");
    write_file_atomically(folder / "gone", "old");
    write_file_atomically(folder / "z", "old");
    const std::string attribute = "chattr %ci '" + (folder / "z").string() + "' 2> /dev/null";
    const auto change = [&](char sign) {
        std::string command = attribute;
        command.replace(command.find("%c"), 2, {sign});
        return std::system(command.c_str()) == 0;
    };
    if (!change('+'))
        GTEST_SKIP() << "no file can be made immutable here";
    OutputFiles files(folder);
    files.add("a", "new");
    files.add("b", "new");
    files.announce("gone");
    files.add("z", "new");
    EXPECT_THROW(files.commit(), model::AnalysisFailure);
    EXPECT_TRUE(change('-'));
    for (const char *name : {"a", "gone", "z"})
        EXPECT_EQ(content_of(folder / name), "old") << name;
    EXPECT_EQ(entries(), 3);
}

/// A picture that was not drawn this time, of a run before.
TEST_F(FilesTest, AnAnnouncedFileWithoutContentIsGoneAfterwards) {
    write_file_atomically(folder / "a.png", "of an earlier run");
    write_file_atomically(folder / "other.png", "of somebody else");
    OutputFiles files(folder);
    files.announce("a.png");
    files.announce("b.png");
    files.add("a.json", "{}");
    EXPECT_EQ(files.commit(), std::vector<fs::path>{folder / "a.json"});
    EXPECT_FALSE(fs::exists(folder / "a.png"));
    EXPECT_EQ(content_of(folder / "other.png"), "of somebody else");
    EXPECT_EQ(entries(), 2);
}

/// Whoever may write in the folder can put links there: none of them is followed. The name is that
/// which temporary files of this process once had, and the target itself.
TEST_F(FilesTest, LinksAreNotFollowed) {
    write_file_atomically(folder / "mine", "mine");
    fs::create_symlink(folder / "mine", folder / fmt::format(".x.txt.{}.part", getpid()));
    fs::create_symlink(folder / "mine", folder / "x.txt");
    write_file_atomically(folder / "x.txt", "new");
    EXPECT_EQ(content_of(folder / "mine"), "mine");
    EXPECT_FALSE(fs::is_symlink(folder / "x.txt"));
    EXPECT_EQ(content_of(folder / "x.txt"), "new");
}

/// A limit on the size of files: the write fails, and the program is not ended.
TEST_F(FilesTest, AFileThatIsCutShortByALimitIsAFailure) {
    write_file_atomically(folder / "a", "old");
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit small{1000, before.rlim_max};
    const auto handler = std::signal(SIGXFSZ, SIG_IGN); // as process::end_in_order_on_signals
    setrlimit(RLIMIT_FSIZE, &small);
    OutputFiles files(folder);
    files.add("a", "new");
    files.add("b", std::string(2000, 'x'));
    EXPECT_THROW(files.commit(), model::AnalysisFailure);
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    EXPECT_EQ(content_of(folder / "a"), "old");
    EXPECT_EQ(entries(), 1);
}

} // namespace whirl::report
