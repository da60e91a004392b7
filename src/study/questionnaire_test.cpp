// SPDX-License-Identifier: Apache-2.0
#include "study/questionnaire.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study/built_in.h"

namespace theatron::study {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const Questionnaire& built_in(const char* id) {
    static const Questionnaires all = built_in_questionnaires();
    const Questionnaire* one = all.find(id);
    EXPECT_TRUE(one) << id;
    return *one;
}

// The same reply to every item.
Replies all_at(const Questionnaire& questionnaire, int point) {
    Replies replies;
    for (const Item& item : questionnaire.items)
        replies[item.id] = point;
    return replies;
}

double value(const Questionnaire& questionnaire, const char* scale, const Replies& replies) {
    const auto values = scores(questionnaire, replies);
    for (std::size_t s = 0; s < questionnaire.scales.size(); ++s)
        if (questionnaire.scales[s].id == scale)
            return values[s].value_or(-1000);
    return -2000;
}

std::string first_mistake(std::string_view text) {
    Questionnaires known;
    const auto mistakes = add_questionnaires(text, known);
    return mistakes.empty() ? "" : mistakes_text("q", mistakes);
}

TEST(Questionnaire, BuiltInOnesAreWithoutMistakes) {
    Questionnaires known;
    EXPECT_THAT(add_questionnaires(built_in_text(), known), IsEmpty());
    EXPECT_EQ(known.all.size(), 10u);
}

TEST(Questionnaire, PublishedOnesHaveTheirNumbersOfItemsAndNoTexts) {
    const std::pair<const char*, std::size_t> counts[] = {{"ipq", 14},     {"networked-minds", 36},
                                                          {"ssq", 16},     {"vrsq", 9},
                                                          {"nasa-tlx", 6}, {"sus", 10}};
    for (const auto& [id, count] : counts) {
        EXPECT_EQ(built_in(id).items.size(), count) << id;
        EXPECT_EQ(built_in(id).items_without_text().size(), count) << id;
        EXPECT_FALSE(built_in(id).source.empty()) << id;
        EXPECT_FALSE(built_in(id).texts_at.empty()) << id;
    }
}

TEST(Questionnaire, OwnOnesHaveAllTheirTexts) {
    for (const char* id : {"about-you", "own-presence", "own-benefit", "own-preference"})
        EXPECT_TRUE(built_in(id).has_texts()) << id;
}

TEST(Questionnaire, IpqTurnsThreeItems) {
    const Questionnaire& ipq = built_in("ipq");
    const Replies sixes = all_at(ipq, 6);
    EXPECT_DOUBLE_EQ(value(ipq, "general", sixes), 6);
    EXPECT_DOUBLE_EQ(value(ipq, "spatial", sixes), 24.0 / 5);
    EXPECT_DOUBLE_EQ(value(ipq, "involvement", sixes), 18.0 / 4);
    EXPECT_DOUBLE_EQ(value(ipq, "realism", sixes), 18.0 / 4);
}

TEST(Questionnaire, SsqHasThePublishedHighestValues) {
    // Kennedy and others (1993): 7 items of 3 points a scale, and 21 in the total.
    const Questionnaire& ssq = built_in("ssq");
    const Replies worst = all_at(ssq, 3);
    EXPECT_NEAR(value(ssq, "nausea", worst), 200.34, 1e-9);
    EXPECT_NEAR(value(ssq, "oculomotor", worst), 159.18, 1e-9);
    EXPECT_NEAR(value(ssq, "disorientation", worst), 292.32, 1e-9);
    EXPECT_NEAR(value(ssq, "total", worst), 235.62, 1e-9);
    // Nausea is an item of two scales.
    Replies nausea = all_at(ssq, 0);
    nausea["S8"] = 1;
    EXPECT_NEAR(value(ssq, "nausea", nausea), 9.54, 1e-9);
    EXPECT_NEAR(value(ssq, "disorientation", nausea), 13.92, 1e-9);
    EXPECT_NEAR(value(ssq, "oculomotor", nausea), 0, 1e-9);
    EXPECT_NEAR(value(ssq, "total", nausea), 7.48, 1e-9);
}

TEST(Questionnaire, VrsqTotalIsTheMeanOfItsScales) {
    const Questionnaire& vrsq = built_in("vrsq");
    Replies replies = all_at(vrsq, 0);
    replies["V1"] = 3;
    EXPECT_NEAR(value(vrsq, "oculomotor", replies), 25, 1e-9);
    EXPECT_NEAR(value(vrsq, "disorientation", replies), 0, 1e-9);
    EXPECT_NEAR(value(vrsq, "total", replies), 12.5, 1e-9);
}

TEST(Questionnaire, SusTurnsEachSecondItem) {
    const Questionnaire& sus = built_in("sus");
    EXPECT_DOUBLE_EQ(value(sus, "usability", all_at(sus, 3)), 50);
    Replies best;
    for (int i = 1; i <= 10; ++i)
        best["U" + std::to_string(i)] = i % 2 ? 5 : 1;
    EXPECT_DOUBLE_EQ(value(sus, "usability", best), 100);
}

TEST(Questionnaire, NetworkedMindsTurnsEightItems) {
    const Questionnaire& minds = built_in("networked-minds");
    int reversed = 0;
    for (const Item& item : minds.items)
        reversed += item.reversed;
    EXPECT_EQ(reversed, 8);
    EXPECT_DOUBLE_EQ(value(minds, "copresence", all_at(minds, 7)), 7);
    EXPECT_DOUBLE_EQ(value(minds, "attention", all_at(minds, 7)), 3);
    EXPECT_DOUBLE_EQ(value(minds, "message", all_at(minds, 7)), 5);
    EXPECT_DOUBLE_EQ(value(minds, "affect", all_at(minds, 7)), 5);
}

TEST(Questionnaire, TaskLoadIsTheMeanOfSix) {
    const Questionnaire& tlx = built_in("nasa-tlx");
    Replies replies = all_at(tlx, 40);
    replies["effort"] = 100;
    EXPECT_DOUBLE_EQ(value(tlx, "load", replies), 50);
    EXPECT_DOUBLE_EQ(value(tlx, "effort", replies), 100);
}

TEST(Questionnaire, AScaleWithoutAReplyHasNoValueAndOthersHave) {
    const Questionnaire& ipq = built_in("ipq");
    Replies replies = all_at(ipq, 2);
    replies.erase("SP3");
    const auto values = scores(ipq, replies);
    EXPECT_TRUE(values[0]);
    EXPECT_FALSE(values[1]);
    EXPECT_TRUE(values[2]);
    EXPECT_TRUE(values[3]);
}

TEST(Questionnaire, BoundsAreThoseOfTheScale) {
    EXPECT_EQ(bounds(built_in("ipq"), 1), std::pair(0.0, 6.0));
    EXPECT_EQ(bounds(built_in("sus"), 0), std::pair(0.0, 100.0));
    EXPECT_NEAR(bounds(built_in("vrsq"), 2).second, 100, 1e-9);
}

TEST(Questionnaire, AFileGivesTextsToAKnownOne) {
    Questionnaires known = built_in_questionnaires();
    std::string text = "questionnaire = sus\nanchors = no | yes\n";
    for (int i = 1; i <= 10; ++i)
        text += "item = U" + std::to_string(i) + "\ntext = sentence " + std::to_string(i) + "\n";
    EXPECT_THAT(add_questionnaires(text, known), IsEmpty());
    EXPECT_TRUE(known.find("sus")->has_texts());
    EXPECT_EQ(known.find("sus")->items[9].text, "sentence 10");
    EXPECT_EQ(known.find("sus")->items[9].right, "yes");
    EXPECT_TRUE(known.find("sus")->items[9].reversed);
    const auto mistakes = add_questionnaires("questionnaire = sus\nitem = U11\nhighest = 9", known);
    ASSERT_EQ(mistakes.size(), 2u);
    EXPECT_EQ(mistakes[0].line, 2);
    EXPECT_THAT(mistakes[0].text, HasSubstr("has no item 'U11'"));
    EXPECT_THAT(mistakes[1].text, HasSubstr("is known already"));
}

TEST(Questionnaire, MistakesHaveLineAndReason) {
    const std::string begin = "questionnaire = a\n";
    EXPECT_EQ(first_mistake("title = b"),
              "q:1: title: a line 'questionnaire = NAME' must stand before it.");
    EXPECT_EQ(first_mistake(begin), "q: the questionnaire 'a' has no item.");
    EXPECT_THAT(first_mistake(begin + "item = x y"), HasSubstr("q:2: item: there is no scale 'y'"));
    EXPECT_THAT(first_mistake(begin + "scale = s\nitem = x s\nitem = x"),
                HasSubstr("q:4: item: the item 'x' is there already"));
    EXPECT_THAT(first_mistake(begin + "lowest = 9\nitem = x"), HasSubstr("q:3: item: from 9 to 6"));
    EXPECT_THAT(first_mistake(begin + "scale = s\nfactor = 0"), HasSubstr("q:3: factor: '0'"));
    EXPECT_THAT(first_mistake(begin + "scale = s\nfrom = mean of s"),
                HasSubstr("q:3: from: there is no scale 's' before this one"));
    EXPECT_THAT(first_mistake(begin + "item = x\nchoices = one"), HasSubstr("2 to 20 choices"));
    EXPECT_THAT(first_mistake(begin + "scale = s\nitem = x"),
                HasSubstr("the scale 's' of 'a' has no item"));
    EXPECT_THAT(first_mistake(begin + "anchors = a | b | c"), HasSubstr("two words"));
}

TEST(Questionnaire, WithAMistakeNothingIsTaken) {
    Questionnaires known;
    EXPECT_FALSE(
        add_questionnaires("questionnaire = a\nitem = x\ntext = t\nbad = 1", known).empty());
    EXPECT_TRUE(known.all.empty());
}

TEST(Questionnaire, ListsArePartsBetweenBars) {
    EXPECT_THAT(listed(" a b |c "), ElementsAre("a b", "c"));
    EXPECT_THAT(listed("a||b"), ElementsAre(""));
}

}  // namespace
}  // namespace theatron::study
