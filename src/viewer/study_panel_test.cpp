// SPDX-License-Identifier: Apache-2.0
#include "viewer/study_panel.h"

#include <gmock/gmock.h>

#include <algorithm>

namespace theatron::viewer {
namespace {

using ::testing::ElementsAre;
using wire::StudyAction;
using wire::StudyKind;
using Key = StudyKey::What;

class StudyPanelOfAPerson : public ::testing::Test {
protected:
    wire::StudyStep step(StudyKind kind) {
        wire::StudyStep step;
        step.step = ++number_;
        step.steps = 31;
        step.kind = kind;
        step.texts = {{"How was it?"}};
        step.highest = 6;
        return step;
    }
    bool show(const wire::StudyStep& step) {
        return panel.take(client::Participant::Study{step, ++version_}, now);
    }
    window::Panel shown() {
        RoomPanel made;
        panel.add_panel(made, now);
        commands_ = made.commands;
        return made.panels.empty() ? window::Panel{} : made.panels.at(0);
    }
    std::vector<std::string> labels() {
        std::vector<std::string> all;
        for (const window::PanelRow& row : shown().rows)
            for (const window::PanelButton& button : row.buttons)
                all.push_back(button.label);
        return all;
    }
    bool has(const std::string& label) {
        const auto all = labels();
        return std::find(all.begin(), all.end(), label) != all.end();
    }
    bool says(const std::string& text) {
        const window::Panel rows = shown();
        return std::any_of(rows.rows.begin(), rows.rows.end(),
                           [&](const window::PanelRow& row) { return row.text == text; });
    }
    // As a person does, who can press only what is there.
    std::optional<wire::StudyReply> press(const std::string& label) {
        for (const window::PanelRow& row : shown().rows)
            for (const window::PanelButton& button : row.buttons)
                if (button.label == label)
                    return panel.carry_out(
                        std::get<StudyPress>(commands_.at(std::size_t(button.command))), now);
        ADD_FAILURE() << "there is no button " << label;
        return std::nullopt;
    }

    bool takes(Key what) { return panel.press_of({what, 0}, now).has_value(); }
    std::optional<wire::StudyReply> key(Key what, int digit = 0) {
        const auto press = panel.press_of({what, digit}, now);
        return press ? panel.carry_out(*press, now) : std::nullopt;
    }

    TimePoint now = from_us(1'000'000);
    StudyPanel panel;

private:
    std::uint32_t number_ = 0;
    std::uint64_t version_ = 0;
    std::vector<RoomCommand> commands_;
};

TEST_F(StudyPanelOfAPerson, ShowsNothingWithoutAStudy) {
    EXPECT_FALSE(panel.take(std::nullopt, now));
    EXPECT_FALSE(panel.is_on());
    EXPECT_TRUE(shown().rows.empty());
}

TEST_F(StudyPanelOfAPerson, ARatingIsChosenAndThenSent) {
    wire::StudyStep rating = step(StudyKind::rating);
    rating.left = "not at all";
    rating.right = "very much";
    EXPECT_TRUE(show(rating));
    EXPECT_THAT(labels(), ElementsAre("0", "1", "2", "3", "4", "5", "6", "Leave this out",
                                      "Put aside", "End the study"));
    EXPECT_TRUE(says("How was it?") && says("0: not at all") && says("6: very much"));
    EXPECT_TRUE(says("Step 1 of 31"));
    EXPECT_EQ(press("2"), std::nullopt);
    EXPECT_EQ(press("5"), std::nullopt);
    EXPECT_TRUE(has("[5]") && has("2"));
    EXPECT_EQ(press("Go on"), (wire::StudyReply{1, StudyAction::answer, 5}));
}

TEST_F(StudyPanelOfAPerson, PointsStandInRowsAndManyOfThemAreTyped) {
    wire::StudyStep load = step(StudyKind::rating);
    load.highest = 100;
    load.step_size = 5;
    show(load);
    EXPECT_TRUE(has("0") && has("95") && has("100"));
    for (const window::PanelRow& row : shown().rows)
        EXPECT_LE(row.buttons.size(), std::size_t(StudyPanel::points_in_row));
    load.step_size = 1;
    load.step = 2;
    show(load);
    for (const char* digit : {"1", "0", "7"})
        EXPECT_EQ(press(digit), std::nullopt);
    EXPECT_TRUE(says("Your reply: 107"));
    EXPECT_FALSE(has("Go on")) << "it is more than the highest point";
    press("Erase");
    EXPECT_EQ(press("Go on"), (wire::StudyReply{2, StudyAction::answer, 10}));
}

TEST_F(StudyPanelOfAPerson, ConsentIsGivenOrNotAndCannotBeLeftOut) {
    show(step(StudyKind::consent));
    EXPECT_THAT(labels(), ElementsAre("Yes", "No", "Put aside", "End the study"));
    press("Yes");
    EXPECT_EQ(press("Go on"), (wire::StudyReply{1, StudyAction::answer, 1}));
    wire::StudyStep question = step(StudyKind::yes_no);
    show(question);
    press("No");
    EXPECT_EQ(press("Go on"), (wire::StudyReply{2, StudyAction::answer, 0}));
}

TEST_F(StudyPanelOfAPerson, AChoiceHasItsTextBesideItsButton) {
    wire::StudyStep choice = step(StudyKind::choice);
    choice.choices = {{"never"}, {"sometimes"}, {"often"}};
    show(choice);
    EXPECT_TRUE(says("sometimes"));
    press("2");
    EXPECT_EQ(press("Go on"), (wire::StudyReply{1, StudyAction::answer, 2}));
}

TEST_F(StudyPanelOfAPerson, WatchingGoesOnWhenItsTimeIsOver) {
    wire::StudyStep watch = step(StudyKind::watch);
    watch.watch = 3s;
    show(watch);
    EXPECT_FALSE(has("Go on"));
    EXPECT_TRUE(says("Please watch for another 3 s."));
    now += 2500ms;
    EXPECT_TRUE(says("Please watch for another 1 s."));
    EXPECT_EQ(panel.carry_out({StudyPress::What::go_on}, now), std::nullopt);
    now += 500ms;
    EXPECT_EQ(press("Go on"), (wire::StudyReply{1, StudyAction::answer, 0}));
}

TEST_F(StudyPanelOfAPerson, TheTimeToReplyIsShown) {
    wire::StudyStep number = step(StudyKind::number);
    number.limit = 10s;
    show(number);
    now += 3s;
    EXPECT_TRUE(says("7 s are left to reply."));
    now += 8s;
    EXPECT_TRUE(says("The time to reply is over; please reply all the same."));
    press("4");
    EXPECT_TRUE(has("Go on"));
}

TEST_F(StudyPanelOfAPerson, ASentReplyIsOnItsWayUntilTheProgramAsksAgain) {
    const wire::StudyStep read = step(StudyKind::read);
    show(read);
    EXPECT_TRUE(press("Go on"));
    EXPECT_TRUE(says("Sent; waiting for the study's program."));
    EXPECT_THAT(labels(), ElementsAre("Put aside"));
    now += 1h;  // however long the way is
    EXPECT_THAT(labels(), ElementsAre("Put aside"));
    EXPECT_EQ(key(Key::go_on), std::nullopt);
    EXPECT_TRUE(takes(Key::digit)) << "it would show another camera";
    EXPECT_EQ(panel.carry_out({StudyPress::What::go_on}, now), std::nullopt);
    show(read);  // asked again
    EXPECT_TRUE(press("Go on"));
}

TEST_F(StudyPanelOfAPerson, ASentReplyCanBeGivenAgainAfterALostConnection) {
    const wire::StudyStep rating = step(StudyKind::rating);
    show(rating);
    press("4");
    EXPECT_TRUE(press("Go on"));
    EXPECT_FALSE(panel.take(std::nullopt, now));
    show(rating);
    EXPECT_EQ(press("Go on"), (wire::StudyReply{1, StudyAction::answer, 4}));
}

TEST_F(StudyPanelOfAPerson, DigitsChooseAPointAndReturnGoesOn) {
    show(step(StudyKind::rating));
    EXPECT_EQ(key(Key::go_on), std::nullopt) << "nothing is chosen";
    EXPECT_EQ(key(Key::digit, 9), std::nullopt);
    EXPECT_FALSE(has("Go on")) << "9 is no point";
    EXPECT_EQ(key(Key::digit, 5), std::nullopt);
    key(Key::digit, 9);
    EXPECT_TRUE(has("[5]"));
    EXPECT_FALSE(takes(Key::erase) || takes(Key::minus));
    EXPECT_EQ(key(Key::go_on), (wire::StudyReply{1, StudyAction::answer, 5}));
}

TEST_F(StudyPanelOfAPerson, KeysThatAStepDoesNotTakeMeanWhatTheyMeanElsewhere) {
    EXPECT_FALSE(takes(Key::digit)) << "there is no study";
    show(step(StudyKind::consent));
    EXPECT_FALSE(takes(Key::digit) || takes(Key::minus) || takes(Key::erase));
    show(step(StudyKind::rating));
    press("Put aside");
    EXPECT_FALSE(takes(Key::digit) || takes(Key::go_on));
    show(step(StudyKind::interrupted));
    EXPECT_FALSE(takes(Key::digit) || takes(Key::go_on));
}

TEST_F(StudyPanelOfAPerson, NegativeNumbersAreTypedWhereTheyAreAllowed) {
    wire::StudyStep number = step(StudyKind::rating);
    number.lowest = -50;
    number.highest = 50;
    show(number);
    press("-");
    EXPECT_TRUE(says("Your reply: -"));
    press("1");
    press("2");
    EXPECT_TRUE(says("Your reply: -12"));
    press("-");
    EXPECT_TRUE(says("Your reply: 12"));
    key(Key::minus);
    press("Erase");
    EXPECT_TRUE(says("Your reply: -1"));
    EXPECT_EQ(press("Go on"), (wire::StudyReply{1, StudyAction::answer, -1}));
    show(step(StudyKind::number));
    EXPECT_FALSE(has("-") || takes(Key::minus)) << "0 is its lowest number";
    wire::StudyStep scale = step(StudyKind::rating);
    scale.lowest = -3;
    scale.highest = 3;
    show(scale);
    key(Key::digit, 2);
    key(Key::minus);
    EXPECT_TRUE(has("[-2]"));
    key(Key::digit, 3);
    EXPECT_TRUE(has("[3]")) << "a reply of one digit begins anew";
    key(Key::erase);
    key(Key::minus);
    EXPECT_TRUE(says("Your reply: -"));
    key(Key::digit, 1);
    EXPECT_TRUE(has("[-1]"));
}

TEST_F(StudyPanelOfAPerson, RepliesOfMoreThanOneDigitAreTyped) {
    wire::StudyStep load = step(StudyKind::rating);
    load.highest = 100;
    load.step_size = 5;
    show(load);
    key(Key::digit, 1);
    EXPECT_TRUE(says("Your reply: 1"));
    EXPECT_EQ(key(Key::go_on), std::nullopt) << "1 is no point";
    key(Key::digit, 5);
    EXPECT_TRUE(has("[15]"));
    key(Key::erase);
    EXPECT_FALSE(has("[15]") || has("Go on"));
    press("35");
    key(Key::digit, 5);
    EXPECT_TRUE(has("[5]")) << "a pressed point is replaced and not continued";
    key(Key::digit, 0);
    EXPECT_EQ(key(Key::go_on), (wire::StudyReply{1, StudyAction::answer, 50}));

    wire::StudyStep choice = step(StudyKind::choice);
    choice.choices.resize(20, {"one of them"});
    show(choice);
    key(Key::digit, 1);
    key(Key::digit, 5);
    EXPECT_EQ(key(Key::go_on), (wire::StudyReply{2, StudyAction::answer, 15}));
}

TEST_F(StudyPanelOfAPerson, TheKeyboardFindsItsButtonAnewWithEachStep) {
    EXPECT_EQ(shown().keyboard, 0u);
    show(step(StudyKind::rating));
    const std::uint64_t first = shown().keyboard;
    EXPECT_NE(first, 0u);
    press("3");
    EXPECT_EQ(shown().keyboard, first) << "the button that has the keyboard stays";
    press("Go on");
    EXPECT_NE(shown().keyboard, first);
    show(step(StudyKind::rating));
    EXPECT_NE(shown().keyboard, first);
    EXPECT_TRUE(shown().large);
}

TEST_F(StudyPanelOfAPerson, PutAsideItComesBackWithTheNextStep) {
    const wire::StudyStep first = step(StudyKind::read);
    show(first);
    press("Put aside");
    EXPECT_TRUE(panel.is_aside());
    EXPECT_THAT(labels(), ElementsAre("Show"));
    EXPECT_FALSE(show(first)) << "the same step, told again after a lost connection";
    EXPECT_TRUE(panel.is_aside());
    EXPECT_TRUE(show(step(StudyKind::read)));
    EXPECT_FALSE(panel.is_aside());
}

TEST_F(StudyPanelOfAPerson, WhatWasChosenStaysOverALostConnection) {
    const wire::StudyStep rating = step(StudyKind::rating);
    show(rating);
    press("4");
    EXPECT_FALSE(panel.take(std::nullopt, now));
    wire::StudyStep interrupted = rating;
    interrupted.kind = StudyKind::interrupted;
    EXPECT_FALSE(show(interrupted));
    EXPECT_FALSE(show(rating));
    EXPECT_TRUE(has("[4]"));
}

TEST_F(StudyPanelOfAPerson, TheEndIsAskedForTwice) {
    show(step(StudyKind::rating));
    EXPECT_EQ(press("End the study"), std::nullopt);
    EXPECT_EQ(press("No, go on"), std::nullopt);
    EXPECT_EQ(press("End the study"), std::nullopt);
    EXPECT_EQ(press("Yes, end it"), (wire::StudyReply{1, StudyAction::stop, 0}));
    wire::StudyStep end = step(StudyKind::over);
    end.texts = {{"Take the headset off."}};
    show(end);
    EXPECT_TRUE(says("Take the headset off.") && says("The study is over."));
    press("Close");
    EXPECT_FALSE(panel.is_on());
}

TEST_F(StudyPanelOfAPerson, AProblemIsShownAndTheQuestionStays) {
    wire::StudyStep number = step(StudyKind::number);
    show(number);
    press("5");
    press("Go on");
    number.problem = "Write a whole number from 0 to 6.";
    show(number);
    EXPECT_TRUE(says(number.problem));
    EXPECT_TRUE(has("7") && !has("Go on"));
}

TEST_F(StudyPanelOfAPerson, AnInterruptedStudyTakesNoReply) {
    show(step(StudyKind::interrupted));
    EXPECT_TRUE(says("The study is interrupted. It goes on here by itself."));
    EXPECT_THAT(labels(), ElementsAre("Put aside"));
}

}  // namespace
}  // namespace theatron::viewer
