// SPDX-License-Identifier: Apache-2.0
#include "window/input_queue.h"

#include <gtest/gtest.h>

namespace theatron::window {
namespace {

TEST(InputQueue, TwoClicksBetweenPicturesAreBothSeenAtTheirPlaces) {
    InputQueue queue;
    for (const double x : {0.25, 0.75}) {
        queue.grab({x, 0.5}, true);
        queue.release();
    }
    for (const double x : {0.25, 0.75}) {
        const WindowInput press = queue.take();
        ASSERT_TRUE(press.grabbed);
        EXPECT_EQ(press.grabbed->x, x);
        EXPECT_TRUE(press.grabbed_left);
        EXPECT_FALSE(press.released) << "the press comes before";
        EXPECT_TRUE(queue.has_more());
        EXPECT_TRUE(queue.take().released);
    }
    EXPECT_FALSE(queue.has_more());
    EXPECT_FALSE(queue.take().grabbed);
}

TEST(InputQueue, AReleaseIsWhereThePointerWasThen) {
    InputQueue queue;
    for (const double x : {0.25, 0.75}) {
        queue.move({x, 0.5});
        queue.grab({x, 0.5}, true);
        queue.release();
    }
    queue.move({0.9, 0.9});
    for (const double x : {0.25, 0.75}) {
        WindowInput input = queue.take();
        while (!input.released)
            input = queue.take();
        ASSERT_TRUE(input.pointer);
        EXPECT_EQ(input.pointer->x, x);
    }
    EXPECT_EQ(queue.take().pointer->x, 0.9);
}

TEST(InputQueue, KeysAndButtonsComeInTheirOrder) {
    InputQueue queue;
    queue.press({Action::marks});
    queue.press({Action::help});
    queue.grab({0.5, 0.5}, false);
    queue.press({Action::leave});
    const WindowInput keys = queue.take();
    ASSERT_EQ(keys.keys.size(), 2u);
    EXPECT_EQ(keys.keys[1].action, Action::help);
    EXPECT_FALSE(keys.grabbed);
    const WindowInput press = queue.take();
    EXPECT_TRUE(press.grabbed);
    EXPECT_TRUE(press.keys.empty());
    EXPECT_EQ(queue.take().keys.at(0).action, Action::leave);
}

TEST(InputQueue, LettersComeWithTheInputInWhichTheyWereTypedAndOnce) {
    InputQueue queue;
    queue.type({FormKey::letters, false, false, "H"});
    queue.grab({0.5, 0.5}, true);
    queue.release();
    queue.type({FormKey::letters, false, false, "i"});
    EXPECT_TRUE(queue.has_more());
    const WindowInput first = queue.take(), second = queue.take();
    ASSERT_EQ(first.typed.size(), 1u);
    EXPECT_EQ(first.typed[0].text, "H");
    ASSERT_EQ(second.typed.size(), 1u);
    EXPECT_EQ(second.typed[0].text, "i");
    EXPECT_FALSE(queue.has_more());
    EXPECT_TRUE(queue.take().typed.empty());
}

TEST(InputQueue, TooManyLettersAreLeftOut) {
    InputQueue queue;
    for (std::size_t i = 0; i < 2 * InputQueue::max_waiting; ++i)
        queue.type({FormKey::letters, false, false, "a"});
    EXPECT_EQ(queue.take().typed.size(), InputQueue::max_waiting);
}

TEST(InputQueue, WhatIsHeldStaysAndMovementsCountOnce) {
    InputQueue queue;
    queue.newest().steering.fly = {1, 0, 0};
    queue.newest().points = true;
    queue.newest().steering.turn = {0.1, 0};
    queue.newest().redraw = true;
    queue.grab({0.5, 0.5}, true);
    queue.release();
    for (int i = 0; i < 3; ++i) {
        const WindowInput input = queue.take();
        EXPECT_EQ(input.steering.fly.x, 1) << i;
        EXPECT_TRUE(input.points) << i;
        EXPECT_EQ(input.steering.turn.x, i == 0 ? 0.1 : 0) << i;
        EXPECT_EQ(input.redraw, i == 0) << i;
    }
}

TEST(InputQueue, IsBoundedAndLosesNoRelease) {
    InputQueue queue;
    for (int i = 0; i < 1000; ++i) {
        queue.grab({0.5, 0.5}, true);
        queue.press({Action::help});
    }
    queue.release();
    std::size_t taken = 0;
    bool released = false;
    for (; queue.has_more(); ++taken) {
        const WindowInput input = queue.take();
        EXPECT_LE(input.keys.size(), InputQueue::max_waiting);
        released |= input.released;
    }
    EXPECT_LE(taken, InputQueue::max_waiting);
    EXPECT_TRUE(released);
}

}  // namespace
}  // namespace theatron::window
