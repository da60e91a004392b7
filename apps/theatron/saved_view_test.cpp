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
        const std::string told = save_view(folder.path(), "", ".png", as_bytes(content));
        ASSERT_THAT(told, StartsWith(std::string(saved)));
        files.emplace_back(told.substr(saved.size()));
    }
    EXPECT_EQ(files::read_file(files[0]).size(), std::string_view("first").size());
    EXPECT_NE(files[0], files[1]);
    EXPECT_NE(files[1], files[2]);
    EXPECT_EQ(files[2].extension(), ".png");
}

TEST(SaveView, ThePastIsNotSavedAsThePresent) {
    viewer::ShownMoment moment;
    moment.age_ms = 80;
    const UtcTime now{std::chrono::seconds(1'795'444'800)};
    EXPECT_EQ(name_part(moment), "");
    EXPECT_THAT(moment_text(moment, now), HasSubstr("920Z, live"));
    moment.is_live = false;
    moment.age_ms = 31'400;
    EXPECT_EQ(name_part(moment), "-31s-ago");
    EXPECT_EQ(moment_text(moment, now), "captured " +
                                            utc_text(now - std::chrono::milliseconds(31'400)) +
                                            ", 31 s before it was saved, not live");
    moment = {};
    moment.is_recording = true;
    EXPECT_EQ(name_part(moment), "-recording");
    EXPECT_THAT(moment_text(moment, now), HasSubstr("not live"));
    const testing::TemporaryFolder folder;
    EXPECT_THAT(save_view(folder.path(), "-31s-ago", ".png", ByteView{}),
                HasSubstr("-31s-ago.png"));
}

TEST(SaveView, AFolderThatCannotBeWrittenIsNamed) {
    EXPECT_THAT(save_view("/no/such/folder", "", ".ply", ByteView{}), HasSubstr("/no/such/folder"));
}

}  // namespace
}  // namespace theatron::app
