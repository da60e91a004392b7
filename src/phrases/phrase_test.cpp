// SPDX-License-Identifier: Apache-2.0
#include "phrases/phrase.h"

#include <gtest/gtest.h>

#include <set>
#include <string_view>
#include <utility>

#include "testing/speaking.h"

namespace theatron {
namespace {

TEST(Language, ReadsTheNamesOfBrowsersAndOfSystems) {
    for (const char* german : {"de", "de-AT", "de_DE.UTF-8", "de_CH@euro"})
        EXPECT_EQ(parse_language(german), Language::german) << german;
    for (const char* french : {"fr", "fr-CA", "fr_FR.UTF-8"})
        EXPECT_EQ(parse_language(french), Language::french) << french;
    EXPECT_EQ(parse_language("en-GB"), Language::english);
    for (const char* other : {"", "C", "C.UTF-8", "nl", "den", "fro"})
        EXPECT_FALSE(parse_language(other)) << other;
}

TEST(Phrases, AreEnglishUntilAnotherLanguageIsChosen) {
    EXPECT_EQ(say(Phrase::given_to, "Ben"), "Given to Ben");
    const testing::Speaking german(Language::german);
    EXPECT_EQ(say(Phrase::given_to, "Ben"), "An Ben gegeben");
    const testing::Speaking french(Language::french);
    EXPECT_EQ(say(Phrase::given_to, "Ben"), "Donné à Ben");
}

TEST(Language, WritesDecimalNumbersAsItsReadersDo) {
    EXPECT_EQ(decimal("0.8"), "0.8");
    EXPECT_EQ(decimal("0.8", Language::german), "0,8");
    EXPECT_EQ(decimal("0.8", Language::french), "0,8");
}

// The arguments' places in a text, each once.
std::set<char> places_in(std::string_view text) {
    std::set<char> places;
    for (std::size_t at = text.find('{'); at != text.npos; at = text.find('{', at + 1))
        places.insert(text[at + 1]);
    return places;
}

TEST(Phrases, HaveTheSameArgumentsInEveryLanguage) {
    const std::pair<Phrase, const char*> all[] = {
#define PHRASE(key, ...) {Phrase::key, #key},
#include "phrases/bar.inc"
#include "phrases/connection.inc"
#include "phrases/face.inc"
#include "phrases/form.inc"
#include "phrases/meeting.inc"
#include "phrases/pictures.inc"
#include "phrases/study.inc"
#include "phrases/window.inc"
#undef PHRASE
    };
    for (const bool by_touch : {false, true}) {
        set_by_touch(by_touch);
        for (const auto& [phrase, key] : all)
            for (std::size_t i = 0; i < language_count; ++i)
                EXPECT_EQ(places_in(sentence_of(phrase).in(Language(i))),
                          places_in(sentence_of(phrase).in(Language::english)))
                    << key << " in " << languages[i].name;
    }
    set_by_touch(false);
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
