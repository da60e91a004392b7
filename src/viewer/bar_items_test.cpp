// SPDX-License-Identifier: Apache-2.0
#include "viewer/bar_items.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "testing/speaking.h"

namespace theatron::viewer {
namespace {

using ::testing::ElementsAre;
using window::ToolIcon;

std::vector<ToolIcon> bar_order(const BarFacts& facts) {
    std::vector<ToolIcon> order;
    for (const BarItem& item : bar_items(facts))
        order.push_back(item.id);
    return order;
}

BarItem bar_item(const BarFacts& facts, ToolIcon id) {
    for (const BarItem& item : bar_items(facts))
        if (item.id == id)
            return item;
    return {};
}

BarFacts bar_speaking() {
    BarFacts facts;
    facts.microphone = Microphone::open;
    facts.own_face = OwnFace::off;
    return facts;
}

TEST(BarItems, StandInOneOrder) {
    EXPECT_THAT(
        bar_order(bar_speaking()),
        ElementsAre(ToolIcon::microphone, ToolIcon::webcam, ToolIcon::point, ToolIcon::draw,
                    ToolIcon::patient_case, ToolIcon::people, ToolIcon::leave, ToolIcon::more));
}

TEST(BarItems, AnObserverIsOfferedNeitherMicrophoneNorWebcam) {
    BarFacts facts = bar_speaking();
    facts.role = wire::Role::observer;
    EXPECT_THAT(bar_order(facts), ElementsAre(ToolIcon::patient_case, ToolIcon::people,
                                              ToolIcon::leave, ToolIcon::more));
}

TEST(BarItems, AtTheDoorOneCanOnlyLeave) {
    BarFacts facts = bar_speaking();
    facts.joined = false;
    EXPECT_THAT(bar_order(facts), ElementsAre(ToolIcon::leave));
}

TEST(BarItems, NothingIsPointedAtOrDrawnInThePast) {
    BarFacts facts = bar_speaking();
    facts.is_past = true;
    EXPECT_THAT(bar_order(facts),
                ElementsAre(ToolIcon::microphone, ToolIcon::webcam, ToolIcon::patient_case,
                            ToolIcon::people, ToolIcon::leave, ToolIcon::more));
}

TEST(BarItems, AProgramWithoutAWebcamOffersNone) {
    BarFacts facts = bar_speaking();
    facts.own_face = OwnFace::none;
    EXPECT_EQ(bar_item(facts, ToolIcon::webcam).label, Phrase{});
}

TEST(BarItems, TheMicrophoneIsOnOrUnmistakablyOff) {
    BarFacts facts = bar_speaking();
    EXPECT_TRUE(bar_item(facts, ToolIcon::microphone).pressed);
    EXPECT_FALSE(bar_item(facts, ToolIcon::microphone).off);
    for (const auto off : {Microphone::closed, Microphone::none, Microphone::missing}) {
        facts.microphone = off;
        const BarItem item = bar_item(facts, ToolIcon::microphone);
        EXPECT_FALSE(item.pressed);
        EXPECT_TRUE(item.off && item.alarm);
        EXPECT_NE(item.label, Phrase::microphone);
    }
    facts.microphone = Microphone::waits;
    EXPECT_FALSE(bar_item(facts, ToolIcon::microphone).off);
    facts.microphone = Microphone::open;
    facts.muted = true;
    EXPECT_TRUE(bar_item(facts, ToolIcon::microphone).off) << "an operator has closed it";
    EXPECT_FALSE(bar_item(facts, ToolIcon::microphone).pressed);
}

TEST(BarItems, AreNamedApartInEveryLanguage) {
    std::vector<BarFacts> all(5, bar_speaking());
    all[1].muted = true;
    all[2].asks_leave = true;
    all[3].microphone = Microphone::waits;
    all[4].microphone = Microphone::missing;
    for (std::size_t i = 0; i < language_count; ++i) {
        const testing::Speaking spoken{Language(i)};
        for (const BarFacts& facts : all) {
            std::set<std::string> labels, hints;
            for (const BarItem& item : bar_items(facts)) {
                EXPECT_TRUE(labels.insert(say(item.label)).second) << say(item.label);
                EXPECT_TRUE(hints.insert(say(item.hint)).second) << say(item.hint);
            }
        }
    }
}

TEST(BarItems, ThoseThatAreOnArePressed) {
    BarFacts facts = bar_speaking();
    for (const ToolIcon id : {ToolIcon::webcam, ToolIcon::point, ToolIcon::draw,
                              ToolIcon::patient_case, ToolIcon::people, ToolIcon::more})
        EXPECT_FALSE(bar_item(facts, id).pressed);
    facts.own_face = OwnFace::seen;
    facts.points = facts.draws = facts.shows_case = facts.shows_people = facts.shows_more = true;
    for (const ToolIcon id : {ToolIcon::webcam, ToolIcon::point, ToolIcon::draw,
                              ToolIcon::patient_case, ToolIcon::people, ToolIcon::more})
        EXPECT_TRUE(bar_item(facts, id).pressed);
}

TEST(BarItems, OnlyOperatorsSeeHowManyWaitAtTheDoor) {
    BarFacts facts = bar_speaking();
    facts.visitors = 2;
    EXPECT_EQ(bar_item(facts, ToolIcon::people).badge, 0u);
    facts.role = wire::Role::operator_;
    EXPECT_EQ(bar_item(facts, ToolIcon::people).badge, 2u);
}

TEST(BarItems, LeavingAsksOnce) {
    BarFacts facts = bar_speaking();
    const BarItem before = bar_item(facts, ToolIcon::leave);
    facts.asks_leave = true;
    const BarItem asked = bar_item(facts, ToolIcon::leave);
    EXPECT_FALSE(before.alarm);
    EXPECT_TRUE(asked.alarm);
    EXPECT_NE(asked.label, before.label);
}

}  // namespace
}  // namespace theatron::viewer
