// SPDX-License-Identifier: Apache-2.0
#include "session_flags.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "base/error.h"
#include "testing/temporary_folder.h"

namespace theatron::app {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string refusal_of_words(const std::vector<std::string>& words) {
    try {
        (void)parse_session(words);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(PartedSessions, WordsBeforeTheSecondSessionAreOfTheHost) {
    const PartedWords one = part_sessions({"theatron", "host", "--camera", "a"});
    EXPECT_THAT(one.first, ElementsAre("theatron", "host", "--camera", "a"));
    EXPECT_THAT(one.further, IsEmpty());

    const PartedWords three =
        part_sessions({"theatron", "host", "--listen", ":0", "--session", "OR 3", "--camera", "a",
                       "--session=OR 4", "--camera", "b", "--session", "OR 5"});
    EXPECT_THAT(three.first, ElementsAre("theatron", "host", "--listen", ":0", "--session", "OR 3",
                                         "--camera", "a"));
    EXPECT_THAT(three.further, ElementsAre(ElementsAre("--session=OR 4", "--camera", "b"),
                                           ElementsAre("--session", "OR 5")));
}

TEST(PartedSessions, ANameBeginsASessionToo) {
    const PartedWords two = part_sessions({"theatron", "host", "--name", "OR 3", "--name=OR 4"});
    EXPECT_THAT(two.first, ElementsAre("theatron", "host", "--name", "OR 3"));
    EXPECT_THAT(two.further, ElementsAre(ElementsAre("--name=OR 4")));
    EXPECT_EQ(parse_session(two.further[0]).options.name, "OR 4");
}

TEST(PartedSessions, ACameraBeforeEachNameIsNotShownToAnotherRoom) {
    for (const std::string camera : {"--camera", "--camera=a"})
        EXPECT_THROW(part_sessions({"theatron", "host", camera, "a", "--session", "OR 3",
                                    "--camera", "b", "--session", "OR 4"}),
                     Error);
    EXPECT_NO_THROW(part_sessions({"theatron", "host", "--camera", "a", "--session", "OR 3"}));
}

TEST(SessionWords, AreReadWithTheOptionsOfASession) {
    const SessionFlags flags =
        parse_session({"--session", "OR 4", "--camera", "synthetic", "--admit", "ask", "--camera",
                       "k4a:1", "--look-back", "0"});
    EXPECT_EQ(flags.options.name, "OR 4");
    EXPECT_THAT(flags.options.cameras, ElementsAre("synthetic", "k4a:1"));
    const host::SessionOptions options = session_options(flags);
    EXPECT_TRUE(options.asks);
    EXPECT_EQ(options.look_back, Duration(0));
    EXPECT_THAT(options.patient_for, ElementsAre(wire::Role::operator_));
}

TEST(SessionWords, NameAnOptionThatOnlyAHostHas) {
    EXPECT_THAT(refusal_of_words({"--session", "OR 4", "--listen", ":0"}),
                HasSubstr("before its second --session"));
    EXPECT_THAT(refusal_of_words({"--session", "OR 4", "--admit", "none"}), HasSubstr("OR 4"));
    EXPECT_THAT(refusal_of_words({"--session", ""}), HasSubstr("name"));
    EXPECT_NE(refusal_of_words({"--camera", "synthetic"}), "");
}

TEST(SessionWords, GiveTheSameFlagsAgain) {
    const SessionFlags flags =
        parse_session({"--session", "OR 4", "--camera", "synthetic:surgeon,seed=3", "--region",
                       "0=1:2:3:4", "--filter", "0=paper", "--identifiers-for", "nobody", "--admit",
                       "ask", "--link-hours", "0.1", "--look-back", "12.5"});
    std::vector<std::string> words = words_of(flags, "/nowhere");
    words.insert(words.begin(), {"--session", "OR 4"});
    const SessionFlags again = parse_session(words);
    EXPECT_EQ(again.options.cameras, flags.options.cameras);
    EXPECT_EQ(again.regions, flags.regions);
    EXPECT_EQ(again.options.filters, flags.options.filters);
    EXPECT_EQ(again.identifiers_for, "nobody");
    EXPECT_EQ(again.admit, "ask");
    EXPECT_EQ(again.link_hours, flags.link_hours);
    EXPECT_EQ(again.look_back_s, flags.look_back_s);
}

TEST(SessionWords, NameFilesFromAnyFolder) {
    const theatron::testing::TemporaryFolder folder;
    std::filesystem::create_directory(folder.path() / "table");
    std::ofstream(folder.path() / "filter.json") << "{}";
    const SessionFlags flags =
        parse_session({"--session", "OR 4", "--camera", "folder:table,loop=1", "--camera",
                       "synthetic:surgeon", "--filter", "filter.json", "--filter", "1=filter.json",
                       "--filter", "paper", "--places", "places.json", "--cases", "/cases"});
    const std::string in = folder.path().string() + "/";
    const std::vector<std::string> words = words_of(flags, folder.path());
    const auto has = [&](const std::string& word) {
        return std::find(words.begin(), words.end(), word) != words.end();
    };
    EXPECT_TRUE(has("folder:" + in + "table,loop=1"));
    EXPECT_TRUE(has("synthetic:surgeon"));
    EXPECT_TRUE(has(in + "filter.json"));
    EXPECT_TRUE(has("1=" + in + "filter.json"));
    EXPECT_TRUE(has("paper"));
    EXPECT_TRUE(has(in + "places.json"));
    EXPECT_TRUE(has("/cases"));
}

}  // namespace
}  // namespace theatron::app
