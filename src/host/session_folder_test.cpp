// SPDX-License-Identifier: Apache-2.0
#include "host/session_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "base/error.h"
#include "host/host_identity.h"
#include "host/link_book.h"
#include "testing/temporary_folder.h"

namespace theatron::host {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

class SessionFolder : public ::testing::Test {
protected:
    testing::TemporaryFolder folder;
    const std::filesystem::path& state = folder.path();
};

TEST_F(SessionFolder, ANameAndItsFolderSayTheSame) {
    EXPECT_EQ(folder_name("OR-4_b"), "OR-4_b");
    EXPECT_EQ(folder_name("OR 4"), "OR%204");
    EXPECT_EQ(folder_name("../x"), "%2E%2E%2Fx");
    for (const char* name : {"OR 4", "../../etc", ".", "Säle/2", "%41", "a"})
        EXPECT_EQ(session_of_folder(folder_name(name)), name) << name;
}

TEST_F(SessionFolder, OtherFoldersAreNoSessions) {
    // The last ones have another spelling than folder_name() gives.
    for (const char* other : {"", "OR 4", "%", "%2", "%2G", "a.b", "%0A", "%20a", "%41", "%2e"})
        EXPECT_FALSE(session_of_folder(other)) << other;
}

TEST_F(SessionFolder, ANameIsTextOnOneLine) {
    EXPECT_NO_THROW(check_session_name(std::string(max_session_name, 'x')));
    for (const std::string& name :
         {std::string(), std::string(max_session_name + 1, 'x'), std::string("a\nb"),
          std::string(" a"), std::string("a "), std::string("\xff"), std::string("a\u200b")})
        EXPECT_THROW(check_session_name(name), Error) << name;
    EXPECT_THROW((void)session_folder(state, ""), Error);
}

// Another thread may just be making them.
TEST_F(SessionFolder, LinksAreReadButNotMade) {
    keep_session(state, "OR 4", {});
    EXPECT_THAT(valid_tokens(state, "OR 4"), IsEmpty());
    EXPECT_THAT(valid_tokens(state, "OR 5"), IsEmpty());
    EXPECT_FALSE(has_links(session_folder(state, "OR 4")));
    const KnownLinks made = load_links(session_folder(state, "OR 4"));
    EXPECT_TRUE(has_links(session_folder(state, "OR 4")));
    const auto tokens = valid_tokens(state, "OR 4");
    ASSERT_THAT(tokens, SizeIs(made.links.size()));
    EXPECT_EQ(tokens.front(), made.links.front().token);
}

TEST_F(SessionFolder, AKeptSessionHasItsWordsUntilItIsForgotten) {
    EXPECT_THAT(kept_sessions(state), IsEmpty());
    keep_session(state, "OR 5", {"--camera", "folder:/a b,loop=1"});
    keep_session(state, "OR 4", {});
    std::filesystem::create_directory(state / "sessions" / "no session");
    auto kept = kept_sessions(state);
    ASSERT_THAT(kept, SizeIs(2));
    EXPECT_EQ(kept[0].name, "OR 4");
    EXPECT_THAT(*kept[0].words, IsEmpty());
    EXPECT_EQ(kept[1].folder, session_folder(state, "OR 5"));
    EXPECT_THAT(*kept[1].words, ElementsAre("--camera", "folder:/a b,loop=1"));
    EXPECT_FALSE(kept[1].ends);

    ask_for_end(state, "OR 5");
    EXPECT_TRUE(kept_sessions(state)[1].ends);
    forget_session(state, "OR 5");
    EXPECT_THAT(kept_sessions(state), SizeIs(1));
    EXPECT_FALSE(std::filesystem::exists(session_folder(state, "OR 5")));
}

TEST_F(SessionFolder, ADamagedFileIsAProblemOfItsSessionAlone) {
    keep_session(state, "OR 4", {"--admit", "ask"});
    for (const char* text : {"", "{", "[]", "{\"words\":1}", "{\"words\":[1]}", "{\"other\":[]}"}) {
        keep_session(state, "OR 5", {});
        std::ofstream(session_folder(state, "OR 5") / "session.json") << text;
        const auto kept = kept_sessions(state);
        ASSERT_THAT(kept, SizeIs(2));
        EXPECT_THAT(kept[0].problem, IsEmpty());
        EXPECT_FALSE(kept[1].words) << text;
        EXPECT_THAT(kept[1].problem, HasSubstr("create it again")) << text;
    }
}

TEST_F(SessionFolder, AFolderOfACommandLineHasNoWords) {
    std::filesystem::create_directories(session_folder(state, "OR 4"));
    const auto kept = kept_sessions(state);
    ASSERT_THAT(kept, SizeIs(1));
    EXPECT_FALSE(kept[0].words);
    EXPECT_THAT(kept[0].problem, IsEmpty());
}

TEST_F(SessionFolder, TheSessionsOfARunningHostAreToldUntilItEnds) {
    const std::vector<ToldSession> sessions{
        {"OR 3", ToldSession::State::open, ""},
        {"OR \"4\"", ToldSession::State::failed, "There is no camera."}};
    {
        const StateLock host(state);
        tell_sessions(state, sessions);
        EXPECT_EQ(told_sessions(state), sessions);
    }
    EXPECT_THAT(told_sessions(state), IsEmpty()) << "the host has died";
    const StateLock host(state);
    for (const char* damaged : {"", "{", "[]", "{\"sessions\":1}"}) {
        std::ofstream(state / "sessions.json") << damaged;
        EXPECT_THAT(told_sessions(state), IsEmpty()) << damaged;
    }
    std::ofstream(state / "sessions.json") << "{\"sessions\":[1,{\"name\":2}]}";
    EXPECT_THAT(told_sessions(state), SizeIs(2));
    tell_no_sessions(state);
    EXPECT_THAT(told_sessions(state), IsEmpty());
}

TEST_F(SessionFolder, TheFirstSessionOfAHostUsesItsOwnFolder) {
    const StateLock host(state);
    tell_sessions(state, {{"OR 3", ToldSession::State::open, ""}});
    keep_session(state, "OR 4", {});
    EXPECT_EQ(find_session_folder(state, "OR 3"), state);
    EXPECT_EQ(find_session_folder(state, "OR 4"), session_folder(state, "OR 4"));
    try {
        (void)find_session_folder(state, "OR 5");
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("there are 'OR 3', 'OR 4'"));
    }
}

}  // namespace
}  // namespace theatron::host
