// SPDX-License-Identifier: Apache-2.0
#include "entry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace theatron::app {
namespace {

using ::testing::ElementsAre;

nlohmann::json lobby(const char* role) {
    return {
        {"role", role},
        {"sessions",
         {{{"name", "Ward 3"},
           {"asks", false},
           {"ended", false},
           {"people", {{{"name", "Anna"}, {"role", "operator"}}}},
           {"cameras",
            {{{"name", "table"}, {"state", "live"}}, {{"name", "lamp"}, {"state", "stalled"}}}}}}}};
}

TEST(EntryFacts, NameTheSessionItsPeopleAndItsCameras) {
    const window::EntryFacts facts = entry_facts(lobby("expert"));
    EXPECT_EQ(facts.title, "Ward 3");
    EXPECT_THAT(facts.lines, ElementsAre("You come as an expert.", "1 person: Anna (operator)",
                                         "2 cameras: table (live), lamp (stalled)"));
    EXPECT_EQ(facts.hint, "The session is open.");
    EXPECT_TRUE(facts.can_enter);
    EXPECT_FALSE(facts.is_problem);
}

TEST(EntryFacts, NameTheOtherSessionsThatTheLinkShows) {
    nlohmann::json several = lobby("operator");
    several["sessions"].push_back({{"name", "Ward 4"}, {"people_count", 0}});
    several["sessions"].push_back({{"name", "Ward 5"}, {"people_count", 1}});
    several["sessions"].push_back({{"name", "Ward 6"}, {"people_count", "many"}});
    several["sessions"].push_back(
        {{"name", "Ward 7"}, {"closed", true}, {"problem", "No camera."}});
    const window::EntryFacts facts = entry_facts(several);
    EXPECT_EQ(facts.title, "Ward 3");
    EXPECT_EQ(facts.lines.back(),
              "Also here: Ward 4 (nobody), Ward 5 (1 person), Ward 6 (nobody), Ward 7 (not open)");
}

TEST(EntryFacts, AnObserverLearnsThatNobodyHearsThem) {
    EXPECT_EQ(entry_facts(lobby("observer")).lines[0],
              "You come as an observer: you see and hear, and are not heard.");
}

TEST(EntryFacts, APersonWhoMustKnockSeesTheNameAlone) {
    const window::EntryFacts facts =
        entry_facts({{"role", "expert"},
                     {"sessions", {{{"name", "Ward 3"}, {"asks", true}, {"people_count", 4}}}}});
    EXPECT_THAT(facts.lines, ElementsAre("You come as an expert."));
    EXPECT_EQ(facts.hint, "An operator lets you in after you have knocked.");
    EXPECT_TRUE(facts.can_enter);
}

TEST(EntryFacts, OfALinkThatIsHeldBackSayWhyNobodyIsNamed) {
    const window::EntryFacts facts =
        entry_facts({{"role", "expert"},
                     {"sessions", {{{"name", "Ward 3"}, {"asks", false}, {"held_back", true}}}}});
    EXPECT_EQ(facts.lines.back(),
              "Somebody who came by this link was removed, so it does not show who is there.");
    EXPECT_TRUE(facts.can_enter);
}

TEST(EntryFacts, OfAnEndedSessionSayWhatToDo) {
    nlohmann::json ended = lobby("expert");
    ended["sessions"][0]["ended"] = true;
    const window::EntryFacts facts = entry_facts(ended);
    EXPECT_EQ(facts.hint, "This session has ended. Ask for a new link.");
    EXPECT_TRUE(facts.is_problem);
    EXPECT_FALSE(facts.can_enter);
}

TEST(EntryFacts, ALongListIsCut) {
    nlohmann::json many = lobby("expert");
    for (int i = 0; i < 8; ++i)
        many["sessions"][0]["people"].push_back(
            {{"name", "P" + std::to_string(i)}, {"role", "expert"}});
    EXPECT_EQ(entry_facts(many).lines[1],
              "9 people: Anna (operator), P0 (expert), P1 (expert), P2 (expert), P3 (expert), P4 "
              "(expert), and 3 more");
}

TEST(EntryFacts, OfAnythingElseNobodyCanEnter) {
    for (const char* text : {"null", "[]", "{}", R"({"sessions":[]})", R"({"sessions":7})"}) {
        const window::EntryFacts facts = entry_facts(nlohmann::json::parse(text));
        EXPECT_FALSE(facts.can_enter) << text;
        EXPECT_TRUE(facts.is_problem) << text;
    }
    const window::EntryFacts odd =
        entry_facts(nlohmann::json::parse(R"({"sessions":[{"people":[1,null],"cameras":["x"]}]})"));
    EXPECT_EQ(odd.title, "");
}

}  // namespace
}  // namespace theatron::app
