// SPDX-License-Identifier: Apache-2.0
#include "link_argument.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "base/error.h"
#include "testing/temporary_folder.h"

namespace theatron::app {
namespace {

using ::testing::ElementsAre;

const std::string link_text = "https://or3:4400/#join=secret&cert=" + std::string(64, 'a');

TEST(LinkArgument, IsALinkOrAFileThatHoldsOne) {
    const theatron::testing::TemporaryFolder folder;
    const std::string path = folder.path() / "link";
    std::ofstream(path) << "\n  " << link_text << "\n";
    EXPECT_EQ(parse_link_argument(link_text).token, "secret");
    EXPECT_EQ(parse_link_argument("@" + path).token, "secret");
    EXPECT_THROW(parse_link_argument("@" + path + "x"), Error);
    EXPECT_THROW(parse_link_argument("@"), Error);
    EXPECT_THROW(parse_link_argument("@/dev/null"), Error);
    EXPECT_THROW(parse_link_argument("@/dev/zero"), Error);
}

TEST(Arguments, AreKeptAndTheirSecretsCovered) {
    std::vector<std::string> given = {"theatron", "join",       link_text, "--token",
                                      "mine",     "--token=me", "--name",  "token"};
    const std::vector<std::string> before = given;
    std::vector<char*> argv;
    argv.reserve(given.size());
    for (std::string& argument : given)
        argv.push_back(argument.data());
    EXPECT_EQ(take_arguments(int(argv.size()), argv.data()), before);
    EXPECT_THAT(given, ElementsAre("theatron", "join",
                                   "https://or3:4400/#join=******&cert=" + std::string(64, 'a'),
                                   "--token", "****", "--token=**", "--name", "token"));
}

}  // namespace
}  // namespace theatron::app
