// SPDX-License-Identifier: Apache-2.0
#include "viewer/adjust_panel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "viewer/playing.h"

namespace theatron::viewer {
namespace {

using session::CameraAdjustment;

std::vector<client::Participant::Camera> cameras(const CameraAdjustment& left = {}) {
    std::vector<client::Participant::Camera> all(3);
    for (std::size_t i = 0; i < all.size(); ++i) {
        all[i].description.id = CameraId(i);
        all[i].calibration.depth.size = {64, 48};
    }
    all[0].description.name = "left";
    all[0].description.adjustment = encode_adjustment(left);
    all[1].description.name = "right";
    all[2].description.kind = wire::CameraKind::person;
    return all;
}

// The panel's rows as texts.
std::vector<std::string> rows_of(const AdjustPanel& adjusting) {
    RoomPanel panel;
    adjusting.add_panel(panel);
    std::vector<std::string> rows;
    for (const window::PanelRow& row : panel.panels.at(0).rows)
        rows.push_back(row.text);
    return rows;
}
bool has_row(const AdjustPanel& adjusting, const std::string& text) {
    const auto rows = rows_of(adjusting);
    return std::find(rows.begin(), rows.end(), text) != rows.end();
}

TEST(AdjustPanel, ShowsTheRoomsCamerasAndTheSlidersOfOne) {
    AdjustPanel adjusting;
    adjusting.take(cameras({{0.012, 0, 0}, {}, {}}));
    const auto rows = rows_of(adjusting);
    EXPECT_EQ(rows.front(), "left");
    EXPECT_EQ(rows.back(), "right") << "no camera of a person";
    EXPECT_TRUE(has_row(adjusting, "Right x +12 mm"));
    EXPECT_TRUE(has_row(adjusting, "Turn y +0.0°"));
}

TEST(AdjustPanel, StepsKeepWithinLimitsAndAreUndone) {
    using What = AdjustStep::What;
    AdjustPanel adjusting;
    adjusting.take(cameras());
    adjusting.carry_out({What::step, {}, 0, 0.25});
    adjusting.carry_out({What::step, {}, 0, 0.25});
    EXPECT_TRUE(has_row(adjusting, "Right x +300 mm"));
    adjusting.carry_out({What::slide, {}, 4, 0});
    adjusting.slide(-3);
    adjusting.slide(-7.5);
    EXPECT_TRUE(has_row(adjusting, "Turn y -7.5°"));
    adjusting.carry_out({What::undo, {}, 0, 0});
    EXPECT_TRUE(has_row(adjusting, "Turn y +0.0°")) << "the slider's whole way is one step";
    adjusting.carry_out({What::undo, {}, 0, 0});
    EXPECT_TRUE(has_row(adjusting, "Right x +250 mm"));
    adjusting.carry_out({What::reset, {}, 0, 0});
    EXPECT_TRUE(has_row(adjusting, "Right x +0 mm"));
    adjusting.give_up();
    EXPECT_TRUE(has_row(adjusting, "Right x +0 mm")) << "as the host has it";
}

TEST(AdjustPanel, ArrowKeysMoveAsThePersonLooks) {
    AdjustPanel adjusting;
    adjusting.take(cameras());
    // An eye that looks along -x has -z at its right.
    adjusting.nudge(window::Nudge::right, std::numbers::pi / 2);
    EXPECT_TRUE(has_row(adjusting, "Back z -5 mm"));
    adjusting.nudge(window::Nudge::farther, 0);
    EXPECT_TRUE(has_row(adjusting, "Back z -10 mm"));
    adjusting.nudge(window::Nudge::up, 1);
    EXPECT_TRUE(has_row(adjusting, "Up y +5 mm"));
}

TEST(Playing, TellsTheRecordingsPosition) {
    wire::Playback playback{2s, TimePoint(10s), 60s, false, ""};
    EXPECT_EQ(position_at(playback, TimePoint(13s)), 5s);
    EXPECT_EQ(position_at(playback, TimePoint(9s)), 2s) << "the clock may be a little behind";
    EXPECT_EQ(position_at(playback, TimePoint(99s)), 60s);
    playback.paused = true;
    EXPECT_EQ(position_at(playback, TimePoint(13s)), 2s);
    EXPECT_EQ(clock_text(62s), "1:02");
    EXPECT_EQ(clock_text(3602s), "1:00:02");
}

}  // namespace
}  // namespace theatron::viewer
