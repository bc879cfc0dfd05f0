// A file that is being written does not lie in its folder, whole or in part, and what is no file is never replaced.
#include "base/replaced_file.h"

#include <gtest/gtest.h>

#include <sys/stat.h>

#include "base/error.h"
#include "base/interrupt.h"
#include "programs/command.h"

namespace lw {
namespace {

using Words = std::vector<std::string>;

std::string refusal_of(const std::string& path) {
    try {
        const ReplacedFile file(path);
    } catch (const Error& refusal) {
        return refusal.what();
    }
    return "";
}

TEST(ReplacedFile, HasNoNameUntilItIsWholeSoThatNoKillLeavesAPart) {
    const TempFolder folder;
    const int nameless = open(folder.path().c_str(), O_TMPFILE | O_WRONLY, 0600);
    if (nameless < 0) GTEST_SKIP() << "this file system has no files without names";
    close(nameless);
    write_text(folder / "map", "yesterday");
    {
        ReplacedFile file(folder / "map");
        file.stream() << "today" << std::flush;
        EXPECT_EQ(folder.names(), Words{"map"});
        EXPECT_EQ(read_text(folder / "map"), "yesterday");
        file.commit();
    }
    EXPECT_EQ(read_text(folder / "map"), "today");
    EXPECT_EQ(folder.names(), Words{"map"});
    const mode_t mask = umask(0);
    umask(mask);
    struct stat made {};
    ASSERT_EQ(stat((folder / "map").c_str(), &made), 0);
    EXPECT_EQ(made.st_mode & 0777u, 0666u & ~mask);
}

TEST(ReplacedFile, IsGoneWhenItIsNotCommitted) {
    const TempFolder folder;
    for (const bool nameless : {true, false}) {
        { ReplacedFile(folder / "map", nameless).stream() << "a part"; }
        EXPECT_EQ(folder.names(), Words{}) << nameless;
    }
}

TEST(ReplacedFile, IsWrittenBesideItsPlaceWhereAllFilesHaveNames) {
    const TempFolder folder;
    write_text(folder / "map", "yesterday");
    ReplacedFile file(folder / "map", false);
    file.stream() << "today" << std::flush;
    EXPECT_EQ(folder.names().size(), 2u);
    EXPECT_EQ(read_text(folder / "map"), "yesterday");
    file.commit();
    EXPECT_EQ(folder.names(), Words{"map"});
    EXPECT_EQ(read_text(folder / "map"), "today");
}

/// Where all files have names, they go by the signal's own hand.
TEST(ReplacedFile, GoesWithTheProcessThatIsInterrupted) {
    const TempFolder folder;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        const auto write_and_end = [&] {
            watch_for_interrupt();
            ReplacedFile file(folder / "map", false);
            file.stream() << "a part" << std::flush;
            std::raise(signal);
        };
        EXPECT_EXIT(write_and_end(), testing::KilledBySignal(signal), "interrupted");
        EXPECT_EQ(folder.names(), Words{}) << signal;
    }
}

TEST(ReplacedFile, IsNeverADeviceAPipeOrAFolder) {
    const TempFolder folder;
    ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
    std::filesystem::create_symlink("/dev/null", folder / "nothing");
    EXPECT_EQ(refusal_of(folder / "pipe"), folder / "pipe" + std::string(": is a device or a pipe, not a file"));
    EXPECT_EQ(refusal_of(folder / "nothing"), folder / "nothing" + std::string(": is a device or a pipe, not a file"));
    EXPECT_EQ(refusal_of(folder.path()), folder.path().string() + ": is a folder, not a file");
    EXPECT_TRUE(std::filesystem::is_fifo(folder / "pipe"));
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "nothing"));
}

TEST(ReplacedFile, OfAFolderThatIsNotThereIsRefusedByName) {
    const TempFolder folder;
    const std::string lost = folder / "lost/map";
    EXPECT_EQ(refusal_of(lost), lost + ": cannot be created here; choose another place with -o");
    EXPECT_NE(refusal_of(""), "");
    EXPECT_EQ(folder.names(), Words{});
}

}  // namespace
}  // namespace lw
