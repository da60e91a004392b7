// SPDX-License-Identifier: Apache-2.0
#include "window/keyboard_focus.h"

#include <gtest/gtest.h>

namespace theatron::window {
namespace {

TEST(Focus, TabGoesRoundAndArrowsStayAtTheEnds) {
    EXPECT_EQ(moved_focus({}, FocusStep::next, 3), 0u);
    EXPECT_EQ(moved_focus({}, FocusStep::next, 3, 1), 1u);
    EXPECT_EQ(moved_focus({}, FocusStep::next, 3, 7), 2u) << "controls have gone";
    EXPECT_EQ(moved_focus(2, FocusStep::next, 3, 1), 0u);
    EXPECT_EQ(moved_focus({}, FocusStep::previous, 3), 2u);
    EXPECT_EQ(moved_focus(2, FocusStep::next, 3), 0u);
    EXPECT_EQ(moved_focus(0, FocusStep::previous, 3), 2u);
    EXPECT_EQ(moved_focus(1, FocusStep::right, 3), 2u);
    EXPECT_EQ(moved_focus(2, FocusStep::right, 3), 2u);
    EXPECT_EQ(moved_focus(0, FocusStep::left, 3), 0u);
    EXPECT_EQ(moved_focus({}, FocusStep::right, 3), std::nullopt) << "the arrows are the room's";
    EXPECT_EQ(moved_focus(9, FocusStep::next, 3), 0u) << "a panel has closed";
    EXPECT_EQ(moved_focus(1, FocusStep::none, 3), std::nullopt);
    EXPECT_EQ(moved_focus(1, FocusStep::next, 0), std::nullopt);
}

TEST(Focus, KeysAreTheRoomsUntilAButtonHasTheKeyboard) {
    std::optional<std::size_t> focus;
    WindowInput input;
    input.talks = true;
    input.keys = {{Action::nudge, 0, Nudge::left}, {Action::press_control}, {Action::leave}};
    EXPECT_EQ(take_focus_keys(input, 3, 0, focus), std::nullopt);
    EXPECT_EQ(input.keys.size(), 3u);
    EXPECT_TRUE(input.talks);
    EXPECT_EQ(focus, std::nullopt);
}

TEST(Focus, TheKeyboardGoesThroughTheButtonsPressesOneAndLeavesThem) {
    std::optional<std::size_t> focus;
    WindowInput input;
    input.talks = true;
    input.keys = {{Action::next_control},
                  {Action::nudge, 0, Nudge::right},
                  {Action::help},
                  {Action::press_control}};
    EXPECT_EQ(take_focus_keys(input, 3, 1, focus), 2u);
    EXPECT_EQ(focus, 2u);
    ASSERT_EQ(input.keys.size(), 1u);
    EXPECT_EQ(input.keys[0].action, Action::help);
    EXPECT_FALSE(input.talks) << "Return pressed a button";

    input.keys = {{Action::freeze}};
    EXPECT_EQ(take_focus_keys(input, 2, 1, focus), std::nullopt) << "the button has gone";
    EXPECT_TRUE(input.keys.empty());
    input.keys = {{Action::leave}, {Action::leave}};
    EXPECT_EQ(take_focus_keys(input, 2, 1, focus), std::nullopt);
    EXPECT_EQ(focus, std::nullopt);
    EXPECT_EQ(input.keys.size(), 1u) << "the first Esc leaves the buttons alone";
}

}  // namespace
}  // namespace theatron::window
