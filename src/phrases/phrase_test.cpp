// SPDX-License-Identifier: Apache-2.0
#include "phrases/phrase.h"

#include <gtest/gtest.h>

#include "testing/speaking.h"

namespace theatron {
namespace {

TEST(Language, ReadsTheNamesOfBrowsersAndOfSystems) {
    for (const char* german : {"de", "de-AT", "de_DE.UTF-8", "de_CH@euro"})
        EXPECT_EQ(parse_language(german), Language::german) << german;
    EXPECT_EQ(parse_language("en-GB"), Language::english);
    for (const char* other : {"", "C", "C.UTF-8", "fr", "den"})
        EXPECT_FALSE(parse_language(other)) << other;
}

TEST(Phrases, AreEnglishUntilAnotherLanguageIsChosen) {
    EXPECT_EQ(say(Phrase::given_to, "Ben"), "Given to Ben");
    const testing::Speaking german(Language::german);
    EXPECT_EQ(say(Phrase::given_to, "Ben"), "An Ben gegeben");
}

TEST(Phrases, ArgumentsStandWhereEachLanguageWantsThem) {
    EXPECT_EQ(filled_in("{1} and {0}, {1} again", {"a", "b"}), "b and a, b again");
    EXPECT_EQ(filled_in("{0} of {1}", {"1"}), "1 of ?");
    EXPECT_EQ(say(Phrase::asks_to_come_in, "Ada", "an expert"),
              "Ada asks to come in as an expert. Say 'admit Ada' or 'refuse Ada'; in the window "
              "press Y or U.");
    // Braces in an argument are no place of another one.
    EXPECT_EQ(say(Phrase::given_to, "{0}"), "Given to {0}");
}

TEST(Phrases, NameNoKeysToAPersonWithoutAKeyboard) {
    EXPECT_EQ(say(Phrase::press_esc, "The session is over."),
              "The session is over. Press Esc to leave.");
    set_by_touch(true);
    EXPECT_EQ(say(Phrase::press_esc, "The session is over."), "The session is over.");
    EXPECT_EQ(say(Phrase::given_to, "Ben"), "Given to Ben");
    set_by_touch(false);
}

}  // namespace
}  // namespace theatron
