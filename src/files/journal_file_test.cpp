// SPDX-License-Identifier: Apache-2.0
#include "files/journal_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error.h"

namespace theatron::files {
namespace {

class JournalFileTest : public ::testing::Test {
protected:
    void SetUp() override {
        char name[] = "/tmp/theatron_journal_XXXXXX";
        ASSERT_TRUE(mkdtemp(name));
        folder_ = name;
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    std::filesystem::path folder_;
};

TEST_F(JournalFileTest, GoesOnBehindWholeLines) {
    const auto path = folder_ / "a";
    {
        JournalFile file(path);
        EXPECT_EQ(file.text(100), "");
        file.append("one\n");
        file.append("tw");
    }
    JournalFile file(path);
    EXPECT_EQ(file.text(100), "one\ntw");
    file.keep(4);
    file.append("two\n");
    EXPECT_EQ(file.text(100), "one\ntwo\n");
    struct stat info {};
    ASSERT_EQ(stat(path.c_str(), &info), 0);
    EXPECT_EQ(info.st_mode & 0777, mode_t(0600));
    EXPECT_THROW((void)file.text(3), Error);
}

TEST_F(JournalFileTest, HasOneWriter) {
    JournalFile file(folder_ / "a");
    EXPECT_THROW(JournalFile(folder_ / "a"), Error);
    EXPECT_THROW(JournalFile(folder_ / "none" / "a"), Error);
}

TEST_F(JournalFileTest, TellsThatItsFileWasDeleted) {
    JournalFile file(folder_ / "a");
    file.append("one\n");
    std::filesystem::remove(folder_ / "a");
    EXPECT_THROW(file.append("two\n"), Error);
}

TEST_F(JournalFileTest, DoesNotFollowALink) {
    std::filesystem::create_symlink(folder_ / "other", folder_ / "a");
    EXPECT_THROW(JournalFile(folder_ / "a"), Error);
}

}  // namespace
}  // namespace theatron::files
