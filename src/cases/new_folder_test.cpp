// SPDX-License-Identifier: Apache-2.0
#include "cases/new_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <span>

#include "base/error.h"
#include "files/file_bytes.h"
#include "testing/temporary_folder.h"

namespace theatron::cases {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class Folders : public ::testing::Test {
protected:
    std::vector<std::string> names() const {
        std::vector<std::string> names;
        for (const auto& entry : fs::directory_iterator(root.path()))
            names.push_back(entry.path().filename().string());
        std::ranges::sort(names);
        return names;
    }
    static void put(const NewFolder& folder, const char* text) {
        files::write_file(folder.path() / "file", std::as_bytes(std::span(text, 1)));
    }
    testing::TemporaryFolder root;
};

TEST_F(Folders, ComeIntoBeingWholeOrNotAtAll) {
    {
        NewFolder left(root.path() / "left");
        put(left, "a");
    }
    EXPECT_THAT(names(), ElementsAre());
    NewFolder kept(root.path() / "deep" / "kept" / "");  // as a shell completes it
    put(kept, "b");
    kept.keep();
    EXPECT_TRUE(fs::is_regular_file(root.path() / "deep" / "kept" / "file"));
    EXPECT_THAT(names(), ElementsAre("deep"));
}

TEST_F(Folders, ChangeNothingThatWasThere) {
    fs::create_directories(root.path() / "case.making");
    fs::create_directories(root.path() / ".making");
    NewFolder made(root.path() / "case");
    made.keep();
    EXPECT_THAT(names(), ElementsAre(".making", "case", "case.making"));
    EXPECT_THROW(NewFolder(root.path() / "case"), Error);
    EXPECT_THROW(NewFolder(root.path() / "case" / ""), Error);
    fs::create_symlink("nowhere", root.path() / "link");
    EXPECT_THROW(NewFolder(root.path() / "link"), Error);
}

TEST_F(Folders, OfTwoAtOnceTheSecondIsRefusedWhole) {
    NewFolder first(root.path() / "case");
    put(first, "1");
    {
        NewFolder second(root.path() / "case");
        put(second, "2");
        first.keep();
        try {
            second.keep();
            ADD_FAILURE();
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), HasSubstr("is there already"));
        }
    }
    EXPECT_EQ(files::read_file(root.path() / "case" / "file", 10), Bytes(1, std::byte('1')));
    EXPECT_THAT(names(), ElementsAre("case"));
}

}  // namespace
}  // namespace theatron::cases
