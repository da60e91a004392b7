// SPDX-License-Identifier: Apache-2.0
#include "saved_view.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "files/file_bytes.h"
#include "testing/temporary_folder.h"

namespace theatron::app {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(SaveView, EveryPictureGetsAFileOfItsOwnAndThePersonIsToldWhich) {
    const testing::TemporaryFolder folder;
    constexpr std::string_view saved = "Saved: ";
    std::vector<std::filesystem::path> files;
    for (const std::string content : {"first", "second", "third"}) {
        const std::string told = save_view(folder.path(), ".png", as_bytes(content));
        ASSERT_THAT(told, StartsWith(std::string(saved)));
        files.emplace_back(told.substr(saved.size()));
    }
    EXPECT_EQ(files::read_file(files[0]).size(), std::string_view("first").size());
    EXPECT_NE(files[0], files[1]);
    EXPECT_NE(files[1], files[2]);
    EXPECT_EQ(files[2].extension(), ".png");
}

TEST(SaveView, AFolderThatCannotBeWrittenIsNamed) {
    EXPECT_THAT(save_view("/no/such/folder", ".ply", ByteView{}), HasSubstr("/no/such/folder"));
}

}  // namespace
}  // namespace theatron::app
