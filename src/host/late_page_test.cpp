// SPDX-License-Identifier: Apache-2.0
#include "host/late_page.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "testing/temporary_folder.h"

namespace theatron::host {
namespace {

class LatePageTest : public ::testing::Test {
protected:
    void write(const std::string& name, const std::string& content) {
        std::ofstream(folder.path() / name, std::ios::binary) << content;
    }
    static std::string first_file(LatePage& page) {
        const auto answer = page.current()->answer({"/", "", ""});
        return answer ? *answer->file : "none";
    }

    testing::TemporaryFolder folder;
};

TEST_F(LatePageTest, IsServedOnceItIsBuilt) {
    LatePage page(folder.path());
    EXPECT_EQ(first_file(page), "none");
    write("index.html", "hello");
    EXPECT_EQ(first_file(page), "none") << "its list is missing";
    write("files.txt", "/ text/html index.html\n");
    EXPECT_EQ(first_file(page), "none") << "files of the list are missing";
    write("index.html.gz", "small");
    write("index.html.br", "smaller");
    EXPECT_EQ(first_file(page), "hello");
    write("index.html", "newer");
    EXPECT_EQ(first_file(page), "hello") << "a host serves one page";
}

TEST_F(LatePageTest, WithoutAFolderThereIsNone) {
    LatePage page({});
    EXPECT_TRUE(page.current()->empty());
}

}  // namespace
}  // namespace theatron::host
