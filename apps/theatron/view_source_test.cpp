// SPDX-License-Identifier: Apache-2.0
#include "view_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "files/file_bytes.h"
#include "testing/temporary_folder.h"

namespace theatron::app {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class ViewSourceTest : public ::testing::Test {
protected:
    std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
    static std::string problem_of(const std::string& text) {
        try {
            view_source(text);
        } catch (const Error& error) {
            return error.what();
        }
        return {};
    }

    testing::TemporaryFolder folder_;
};

TEST_F(ViewSourceTest, ACameraIsOneAsItIsWritten) {
    const ViewSource source = view_source("synthetic:room,quality=quick");
    EXPECT_THAT(source.cameras, ElementsAre("synthetic:room,quality=quick"));
    EXPECT_EQ(source.name, "synthetic:room");
}

TEST_F(ViewSourceTest, APathIsWhatLiesThere) {
    fs::create_directories(path("pictures/depth"));
    fs::create_directories(path("liver"));
    files::write_file(path("liver/case.json"), {});
    files::write_file(path("a.MKV"), {});
    files::write_file(path("a.mp4"), {});
    EXPECT_THAT(view_source(path("pictures")).cameras,
                ElementsAre("folder:" + path("pictures") + ",loop=1"));
    EXPECT_EQ(view_source(path("pictures/")).name, "pictures");
    const ViewSource liver = view_source(path("liver"));
    EXPECT_THAT(liver.cameras, IsEmpty());
    EXPECT_EQ(liver.case_folder, path("liver"));
    EXPECT_THAT(view_source(path("a.MKV")).cameras,
                ElementsAre("mkv:" + path("a.MKV") + ",loop=1"));
    EXPECT_THAT(view_source(path("a.mp4")).cameras,
                ElementsAre("video:" + path("a.mp4") + ",loop=1"));
}

TEST_F(ViewSourceTest, WhatCannotBeShownIsNamed) {
    fs::create_directories(path("empty"));
    fs::create_directories(path("a,b"));
    EXPECT_THAT(problem_of(path("empty")), HasSubstr("is neither a case nor pictures"));
    EXPECT_THAT(problem_of(path("a,b")), HasSubstr("has a comma"));
    EXPECT_THAT(problem_of("nothing"), HasSubstr("There is no file or folder 'nothing'"));
    EXPECT_THAT(problem_of("a\nb"), ::testing::Not(HasSubstr("\n")));
}

}  // namespace
}  // namespace theatron::app
