// SPDX-License-Identifier: Apache-2.0
#include "wire/text.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <string>

#include "testing/speaking.h"
#include "wire/control.h"
#include "wire/sentence.h"

namespace theatron::wire {
namespace {

TEST(Text, ArgumentsStandInTheSentence) {
    EXPECT_EQ(english({TextCode::all_encodings_taken, {"3", "zstd:level=3"}}),
              "The host already encodes in 3 ways; instead of zstd:level=3 you get the nearest of "
              "them.");
    EXPECT_EQ(english({TextCode::camera_time_jump}),
              "Its pictures come late, or their times are wrong.");
    EXPECT_EQ(english(as_written("The cable is {0} out.")), "The cable is {0} out.");
}

TEST(Text, WhoIsNoOperatorIsNotToldWhatOperatorsCanDo) {
    const Text moved{TextCode::camera_moved, {"8.0", "0.10"}};
    EXPECT_EQ(english_without_advice(moved), "The camera was moved by 8.0 mm and 0.10 degrees.");
    EXPECT_EQ(english(moved).rfind(english_without_advice(moved) + " Put it back, ", 0), 0u);
    const Text far{TextCode::camera_moved_far, {"30", "left"}};
    EXPECT_EQ(english_without_advice(far).find("nudge"), std::string::npos);
    EXPECT_NE(english(far).find("'nudge left none'"), std::string::npos);
    const Text gone{TextCode::camera_gone};
    EXPECT_EQ(english_without_advice(gone), english(gone));
}

// The host sees when pictures are taken, not why they are not: the viewer may decode slowly.
TEST(Text, ASlowComputerIsNotBlamedOnTheLink) {
    for (const TextCode code :
         {TextCode::link_has_room, TextCode::link_is_tried, TextCode::trial_failed}) {
        const std::string text = english({code});
        EXPECT_TRUE(text.find("link") == std::string::npos ||
                    text.find("computer") != std::string::npos)
            << text;
    }
}

TEST(Text, WithoutACodeThereIsNone) {
    EXPECT_EQ(english({}), "");
    EXPECT_EQ(english_without_advice({}), "");
    EXPECT_TRUE(as_written("").empty());
}

TEST(Text, AnUnknownCodeStillNamesItsSubjectAndItsArguments) {
    EXPECT_FALSE(is_known(TextCode{199}));
    EXPECT_EQ(english({TextCode{199}, {"room 3", "8"}}),
              "The host ends the connection for a reason that this version of Theatron does not "
              "know (number 199, room 3, 8); a newer version can show it.");
    EXPECT_EQ(english({TextCode{60'000}}),
              "The other program says something that this version of Theatron does not know "
              "(number 60000); a newer version can show it.");
}

TEST(Text, MissingAndSurplusArgumentsDoNoHarm) {
    EXPECT_EQ(english({TextCode::ceiling}), "your ceiling is ? Mbit/s");
    EXPECT_EQ(english({TextCode::wrong_token, {"a", "b"}}),
              "The access code of this link is wrong; ask for the host's current link.");
}

TEST(Text, EveryoneIsToldInTheirOwnLanguageAndLogsAreEnglish) {
    const testing::Speaking german(Language::german);
    const Text late{TextCode::all_places_taken, {"8"}};
    EXPECT_EQ(sentence(late).rfind("Alle 8 Plätze dieser Sitzung sind belegt; ", 0), 0u);
    EXPECT_EQ(english(late).rfind("All 8 places of this session are taken; ", 0), 0u);
    EXPECT_EQ(
        sentence({TextCode{199}, {"room 3"}}),
        "Der Gastgeber beendet die Verbindung aus einem Grund, den diese Version von Theatron "
        "nicht kennt (Nummer 199, room 3); eine neuere Version kann ihn zeigen.");
    EXPECT_EQ(sentence({}), "");
    const Text moved{TextCode::camera_moved, {"8.0", "0.10"}};
    EXPECT_EQ(sentence_without_advice(moved), "Die Kamera wurde um 8.0 mm und 0.10 Grad bewegt.");
    EXPECT_NE(sentence(moved).find("Stellen Sie sie zurück"), std::string::npos);
    EXPECT_EQ(spoken(Role::operator_), "Sitzungsleitung");
    const testing::Speaking french(Language::french);
    EXPECT_EQ(sentence(late).rfind("Les 8 places de cette séance sont prises\u00a0; ", 0), 0u);
    EXPECT_EQ(sentence_without_advice(moved), "La caméra a été déplacée de 8.0 mm et 0.10 degrés.");
    EXPECT_NE(sentence(moved).find("Remettez-la en place"), std::string::npos);
    EXPECT_EQ(spoken(Role::operator_), "responsable");
}

// The arguments that a sentence shows.
std::set<char> shown_arguments(const std::string& sentence) {
    std::set<char> shown;
    for (std::size_t at = sentence.find('<'); at != sentence.npos; at = sentence.find('<', at + 1))
        shown.insert(sentence[at + 1]);
    return shown;
}

TEST(Text, TellsTheSameArgumentsInEveryLanguage) {
    for (std::uint16_t code = 0; code < 1000; ++code)
        for (std::size_t i = 0; i < language_count; ++i) {
            const Text text{TextCode{code}, {"<0>", "<1>", "<2>", "<3>"}};
            EXPECT_EQ(shown_arguments(sentence(text, Language(i))), shown_arguments(english(text)))
                << code << " in " << languages[i].name;
        }
}

TEST(Text, APartOfTheFramesIsNamedInEveryLanguage) {
    Delivery delivery;
    delivery.one_frame_of = 8;
    delivery.lossy_outside_region = true;
    EXPECT_EQ(sent_part(delivery), "one frame of 8, bounded loss outside the region");
    EXPECT_EQ(sent_part(delivery, Language::german),
              "eines von 8 Bildern, begrenzter Verlust außerhalb des wichtigen Bereichs");
    EXPECT_EQ(sent_part(delivery, Language::french),
              "une image sur 8, perte limitée hors de la zone d'intérêt");
}

}  // namespace
}  // namespace theatron::wire
