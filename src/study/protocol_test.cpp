// SPDX-License-Identifier: Apache-2.0
#include "study/protocol.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study/built_in.h"

namespace theatron::study {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string head = "study = S\n";
const std::string consent = "phase = agree\nkind = consent\ntext = Do you agree?\n";

std::string mistakes_of(const std::string& text) {
    return mistakes_text("p", parse_protocol(text).mistakes);
}

TEST(Protocol, TheExampleIsWithoutMistakes) {
    const ReadProtocol read = parse_protocol(example_protocol());
    EXPECT_THAT(read.mistakes, IsEmpty());
    EXPECT_THAT(check_questionnaires(read.protocol, built_in_questionnaires()), IsEmpty());
    EXPECT_EQ(read.protocol.title, "Splats or mesh");
    EXPECT_EQ(read.protocol.order, Order::latin_square);
    ASSERT_EQ(read.protocol.conditions.size(), 2u);
    EXPECT_EQ(read.protocol.conditions[1].renderer, "mesh");
    EXPECT_EQ(read.protocol.phases.size(), 7u);
}

TEST(Protocol, MistakesHaveLineAndReason) {
    EXPECT_EQ(mistakes_of(head + consent), "");
    EXPECT_EQ(mistakes_of(consent), "p: there is no line 'study = NAME'.");
    EXPECT_THAT(mistakes_of(head + "order = any\n" + consent),
                HasSubstr("p:2: order: 'any' is neither as-written, random nor latin-square"));
    EXPECT_THAT(mistakes_of(head + "seed = -1\n" + consent), HasSubstr("p:2: seed: '-1' is no"));
    EXPECT_THAT(mistakes_of(head + "questionnaires = ../ipq.conf\n" + consent),
                HasSubstr("p:2: questionnaires: '../ipq.conf' is no name of a file beside"));
    EXPECT_THAT(mistakes_of(head + "condition = a\nrenderer = --x\n" + consent),
                HasSubstr("p:3: renderer: '--x' is no value"));
    EXPECT_THAT(mistakes_of(head + "condition = a\nlatency-ms = 9000\n" + consent),
                HasSubstr("p:3: latency-ms: '9000' is no whole number from 0 to 5000"));
    EXPECT_THAT(mistakes_of(head + "condition = a\ncondition = a\n" + consent),
                HasSubstr("p:3: condition: the condition in line 2 has the same name"));
    EXPECT_THAT(mistakes_of(head + "condition = a\n" + consent),
                HasSubstr("p:2: condition: no phase has the line 'each-condition = yes'"));
    EXPECT_THAT(mistakes_of(head + "condition = a\nroom = off\n" + consent),
                HasSubstr("p:3: room: no condition sets the room"));
    EXPECT_THAT(mistakes_of(head + "seed = 1\nseed = 2\n" + consent),
                HasSubstr("p:3: seed: line 2 says it already"));
    // The lines below a refused one belong to it and are no further mistakes.
    EXPECT_EQ(mistakes_of(head + consent +
                          "phase = say\nkind = instruction\ntext = a\n"
                          "phase = say\nkind = break\ntext = b\n"
                          "condition = late\nrenderer = mesh\n"),
              "p:8: phase: the phase in line 5 has the same name.\n"
              "p:11: condition: conditions stand before the first phase.");
    EXPECT_THAT(mistakes_of(head + "wish = 1\n" + consent), HasSubstr("p:2: wish: there is no"));
}

TEST(Protocol, ConsentComesFirstAndOnce) {
    EXPECT_THAT(mistakes_of(head + "phase = a\nkind = instruction\ntext = t\n"),
                HasSubstr("p:2: phase: 'a' is the first phase, which must be of the kind consent"));
    EXPECT_THAT(mistakes_of(head + consent + "phase = b\nkind = consent\ntext = t\n"),
                HasSubstr("p:5: phase: 'b' asks for consent, which must stand before"));
    EXPECT_THAT(mistakes_of(head + "condition = c\nphase = a\nkind = consent\ntext = t\n"
                                   "each-condition = yes\n"),
                HasSubstr("given once"));
    EXPECT_THAT(mistakes_of(head + "phase = a\nkind = consent\n"), HasSubstr("says nothing"));
}

TEST(Protocol, PhasesOfConditionsAreOneBlock) {
    const std::string each = "kind = instruction\ntext = t\neach-condition = yes\n";
    EXPECT_THAT(mistakes_of(head + "condition = c\n" + consent + "phase = x\n" + each +
                            "phase = y\nkind = instruction\ntext = t\nphase = z\n" + each),
                HasSubstr("p:13: phase: 'z' is for each condition"));
    EXPECT_THAT(mistakes_of(head + consent + "phase = x\n" + each),
                HasSubstr("there is no line 'condition = NAME'"));
}

TEST(Protocol, MissingTextsAreNamedWithTheirPublication) {
    const ReadProtocol read =
        parse_protocol(head + consent + "phase = q\nkind = questionnaire\nquestionnaire = ipq\n");
    ASSERT_THAT(read.mistakes, IsEmpty());
    const auto mistakes = check_questionnaires(read.protocol, built_in_questionnaires());
    ASSERT_EQ(mistakes.size(), 1u);
    EXPECT_EQ(mistakes[0].line, 5);
    for (const char* part : {"14 items", "G1 SP1", "igroup.org", "Schubert"})
        EXPECT_THAT(mistakes[0].text, HasSubstr(part));
    const ReadProtocol other = parse_protocol(
        head + consent + "phase = q\nkind = questionnaire\nquestionnaire = nothing\n");
    EXPECT_THAT(check_questionnaires(other.protocol, built_in_questionnaires())[0].text,
                HasSubstr("there is no questionnaire 'nothing'; there are ipq"));
}

TEST(Protocol, AChangedTextHasAnotherHash) {
    EXPECT_NE(parse_protocol(head + consent).protocol.hash,
              parse_protocol(head + consent + "#\n").protocol.hash);
}

}  // namespace
}  // namespace theatron::study
