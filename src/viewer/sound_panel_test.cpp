// SPDX-License-Identifier: Apache-2.0
#include "viewer/sound_panel.h"

#include <gtest/gtest.h>

namespace theatron::viewer {
namespace {

TEST(SoundPanel, HasAButtonForEachDeviceThatIsNotInUse) {
    RoomPanel panel;
    add_sound_panel({{"default", "Headset"}, {"default", "Monitor"}, "default", "Monitor"}, panel);
    ASSERT_EQ(panel.panels.size(), 1u);
    const auto& rows = panel.panels[0].rows;
    ASSERT_EQ(rows.size(), 4u);
    EXPECT_EQ(rows[0], (window::PanelRow{"Microphone", "The usual one", {}}));
    EXPECT_EQ(rows[1].text, "Headset");
    EXPECT_EQ(rows[2], (window::PanelRow{"Loudspeaker", "Monitor", {}}));
    EXPECT_EQ(rows[3].text, "The usual one");
    const auto& headset =
        std::get<UseSound>(panel.commands.at(std::size_t(rows[1].buttons.at(0).command)));
    EXPECT_EQ(headset.kind, UseSound::Kind::microphone);
    EXPECT_EQ(headset.device, "Headset");
    const auto& usual =
        std::get<UseSound>(panel.commands.at(std::size_t(rows[3].buttons.at(0).command)));
    EXPECT_EQ(usual.kind, UseSound::Kind::loudspeaker);
    EXPECT_EQ(usual.device, "default");
}

TEST(SoundPanel, IsLeftOutWhereThereIsNoSound) {
    RoomPanel panel;
    add_sound_panel({}, panel);
    EXPECT_TRUE(panel.panels.empty());
}

TEST(SoundPanel, ShowsADeviceThatIsWaitedForAndLongNamesShortened) {
    RoomPanel panel;
    add_sound_panel({{std::string(500, 'a')}, {}, "Headset", ""}, panel);
    const auto& rows = panel.panels.at(0).rows;
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[0].detail, "Headset");
    EXPECT_LE(rows[1].text.size(), 44u);
    EXPECT_EQ(std::get<UseSound>(panel.commands.at(0)).device.size(), 500u);
}

}  // namespace
}  // namespace theatron::viewer
