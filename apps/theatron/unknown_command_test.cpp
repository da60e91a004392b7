// SPDX-License-Identifier: Apache-2.0
#include "unknown_command.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace theatron::app {
namespace {

const std::vector<std::string> commands{"host", "join", "record"};

TEST(UnknownCommand, NamesTheMostSimilarOne) {
    EXPECT_EQ(unknown_command("jion", commands),
              "There is no command 'jion'; did you mean 'theatron join'?");
    EXPECT_EQ(unknown_command("recrod", commands),
              "There is no command 'recrod'; did you mean 'theatron record'?");
}

TEST(UnknownCommand, ListsAllWhereNoneIsSimilar) {
    EXPECT_EQ(unknown_command("abracadabra", commands),
              "There is no command 'abracadabra'; the commands are host, join, record.");
}

TEST(UnknownCommand, LeavesCommandsAndOptionsAlone) {
    EXPECT_EQ(unknown_command("join", commands), "");
    EXPECT_EQ(unknown_command("--help", commands), "");
}

TEST(FileTakenForOption, IsNamedWithWhatToWrite) {
    EXPECT_EQ(file_taken_for_option({"record", "-dash.mkv"}),
              "'-dash.mkv' is taken for an option; if it is a file, write './-dash.mkv'.");
    EXPECT_EQ(file_taken_for_option({"record", "--seconds=1.5", "-h", "-1.5", "./-dash.mkv"}), "");
}

TEST(EmptyArgument, IsNamedByItsOption) {
    EXPECT_EQ(empty_argument({"theatron", "link", "--revoke", ""}),
              "The value of --revoke is empty; a variable of the shell may have none. Leave it "
              "out, or give it a value.");
    EXPECT_THAT(empty_argument({"theatron", "link", "--session=", "--revoke", "expert"}),
                ::testing::StartsWith("The value of --session is empty"));
    EXPECT_THAT(empty_argument({"theatron", "inspect", ""}),
                ::testing::StartsWith("An argument is empty"));
    EXPECT_EQ(empty_argument({"theatron", "host", "--camera", "folder:a,name=", "--json"}), "");
}

}  // namespace
}  // namespace theatron::app
