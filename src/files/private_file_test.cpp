// SPDX-License-Identifier: Apache-2.0
#include "files/private_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

#include "base/error.h"
#include "testing/temporary_folder.h"

namespace theatron::files {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

unsigned mode_of(const fs::path& path) {
    struct stat info {};
    EXPECT_EQ(stat(path.c_str(), &info), 0) << path;
    return info.st_mode & 07777;
}

std::string problem_with_reading(const fs::path& path, Privacy privacy) {
    try {
        (void)read_private_file(path, privacy);
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

std::string problem_with_folder(const fs::path& folder) {
    try {
        open_private_folder(folder);
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

TEST(PrivateFile, FoldersAndFilesAreTheOwnersWhateverTheUmask) {
    const theatron::testing::TemporaryFolder folder;
    const mode_t before = umask(0);
    open_private_folder(folder.path() / "a" / "b");
    write_private_file(folder.path() / "a" / "b" / "key", "secret");
    umask(before);
    EXPECT_EQ(mode_of(folder.path() / "a"), 0700u);
    EXPECT_EQ(mode_of(folder.path() / "a" / "b"), 0700u);
    EXPECT_EQ(mode_of(folder.path() / "a" / "b" / "key"), 0600u);
    EXPECT_EQ(read_private_file(folder.path() / "a" / "b" / "key", Privacy::secret), "secret");
}

TEST(PrivateFile, WhatACrashLeftBesideItIsReplaced) {
    const theatron::testing::TemporaryFolder folder;
    const fs::path key = folder.path() / "key";
    std::ofstream(folder.path() / "key.part") << "half a k";
    EXPECT_EQ(read_private_file(key, Privacy::secret), std::nullopt);
    write_private_file(key, "whole");
    EXPECT_EQ(read_private_file(key, Privacy::secret), "whole");
    EXPECT_FALSE(fs::exists(folder.path() / "key.part"));
}

TEST(PrivateFile, NeverWritesThroughALinkThatSomebodyPutThere) {
    const theatron::testing::TemporaryFolder folder;
    std::ofstream(folder.path() / "other") << "untouched";
    fs::create_symlink(folder.path() / "other", folder.path() / "key.part");
    write_private_file(folder.path() / "key", "secret");
    std::string other;
    std::ifstream(folder.path() / "other") >> other;
    EXPECT_EQ(other, "untouched");
}

TEST(PrivateFile, ASecretThatOthersMayReadOrWriteIsRefused) {
    const theatron::testing::TemporaryFolder folder;
    const fs::path key = folder.path() / "key";
    write_private_file(key, "secret");
    for (const mode_t mode : {0640, 0604}) {
        ASSERT_EQ(chmod(key.c_str(), mode), 0);
        EXPECT_THAT(problem_with_reading(key, Privacy::secret),
                    HasSubstr("chmod 600 '" + key.string() + "'"));
        EXPECT_EQ(problem_with_reading(key, Privacy::readable), "");
    }
    for (const mode_t mode : {0620, 0602}) {
        ASSERT_EQ(chmod(key.c_str(), mode), 0);
        EXPECT_THAT(problem_with_reading(key, Privacy::secret), HasSubstr("chmod go-w"));
        EXPECT_THAT(problem_with_reading(key, Privacy::readable), HasSubstr("chmod go-w"));
    }
}

TEST(PrivateFile, AFolderThatOthersMayWriteIntoIsRefused) {
    const theatron::testing::TemporaryFolder folder;
    for (const mode_t mode : {0770, 0707, 01777}) {
        ASSERT_EQ(chmod(folder.path().c_str(), mode), 0);
        EXPECT_THAT(problem_with_folder(folder.path()), HasSubstr("chmod go-w"));
    }
    ASSERT_EQ(chmod(folder.path().c_str(), 0755), 0);
    EXPECT_EQ(problem_with_folder(folder.path()), "");
}

TEST(PrivateFile, WhatBelongsToAnotherUserIsRefused) {
    if (geteuid() != 0)
        GTEST_SKIP() << "only root can give a file away";
    const theatron::testing::TemporaryFolder folder;
    const fs::path key = folder.path() / "key";
    write_private_file(key, "secret");
    ASSERT_EQ(chown(key.c_str(), 4242, 4242), 0);
    EXPECT_THAT(problem_with_reading(key, Privacy::secret), HasSubstr("another user, number 4242"));
    ASSERT_EQ(chown(folder.path().c_str(), 4242, 4242), 0);
    EXPECT_THAT(problem_with_folder(folder.path()), HasSubstr("another user, number 4242"));
}

TEST(PrivateFile, SaysWhatIsInTheWay) {
    const theatron::testing::TemporaryFolder folder;
    const fs::path file = folder.path() / "file";
    write_private_file(file, std::string(max_private_file_bytes + 1, 'x'));
    EXPECT_THAT(problem_with_reading(file, Privacy::secret), HasSubstr("too long"));
    EXPECT_THAT(problem_with_folder(file), HasSubstr("is not a folder"));
    EXPECT_THAT(problem_with_folder(file / "below"), HasSubstr("Cannot make the folder"));
    EXPECT_THROW(write_private_file(folder.path() / "none" / "key", "secret"), Error);
}

// A test that waits for the pipe never ends.
TEST(PrivateFile, APipeOrADeviceIsRefusedUnlessTheUserNamedIt) {
    const theatron::testing::TemporaryFolder folder;
    const fs::path pipe = folder.path() / "pipe";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    for (const fs::path& path : {pipe, fs::path("/dev/null"), fs::path("/dev/zero"), folder.path()})
        for (const Privacy privacy : {Privacy::secret, Privacy::readable})
            EXPECT_THAT(problem_with_reading(path, privacy), HasSubstr("is no file")) << path;
    EXPECT_EQ(read_named_file("/dev/null", Privacy::secret), "");
}

}  // namespace
}  // namespace theatron::files
