// SPDX-License-Identifier: Apache-2.0
#include "host/cases_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "cases/manifest.h"
#include "testing/temporary_folder.h"

namespace theatron::host {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class CasesFolderTest : public ::testing::Test {
protected:
    void add(const std::filesystem::path& file) const {
        std::filesystem::create_directories((folder.path() / file).parent_path());
        std::ofstream(folder.path() / file) << "x";
    }
    std::string advice() const { return advice_on_cases_folder(folder.path()); }

    const testing::TemporaryFolder folder;
};

TEST_F(CasesFolderTest, IsFineEmptyAndWithACase) {
    EXPECT_EQ(advice(), "");
    add(".hidden");
    EXPECT_EQ(advice(), "") << "an import works in a hidden folder";
    add("notes.txt");
    add(std::filesystem::path("anna") / cases::manifest_name);
    EXPECT_EQ(advice(), "");
}

TEST_F(CasesFolderTest, FilesThatAreNoCaseAreToBeImported) {
    add("1.dcm");
    EXPECT_THAT(advice(), AllOf(HasSubstr("no case"), HasSubstr("theatron case import"),
                                HasSubstr(folder.path().string())));
}

TEST_F(CasesFolderTest, SoAreFilesInFolders) {
    add("series/1.dcm");
    EXPECT_THAT(advice(), HasSubstr("theatron case import"));
}

TEST_F(CasesFolderTest, ACaseItselfLiesInTheFolderToName) {
    add(cases::manifest_name);
    EXPECT_THAT(advice(), HasSubstr("name the one above it"));
}

}  // namespace
}  // namespace theatron::host
