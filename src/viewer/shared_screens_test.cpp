// SPDX-License-Identifier: Apache-2.0
#include "viewer/shared_screens.h"

#include <gtest/gtest.h>

namespace theatron::viewer {
namespace {

using wire::CameraCondition;

wire::CameraState in(CameraCondition condition) {
    wire::CameraState state;
    state.condition = condition;
    return state;
}

TEST(ScreenCaptionTest, AScreenShowsItsNameAndAge) {
    EXPECT_EQ(screen_caption("endoscope", in(CameraCondition::live), 85),
              (ScreenCaption{"endoscope  85 ms", false}));
}

TEST(ScreenCaptionTest, AScreenWithoutPicturesOrWithOldOnesSaysSo) {
    EXPECT_EQ(screen_caption("e", in(CameraCondition::live), std::nullopt),
              (ScreenCaption{"e: no picture yet", true}));
    EXPECT_EQ(screen_caption("e", in(CameraCondition::live), 3000),
              (ScreenCaption{"e: stands still for 3 s", true}));
    EXPECT_EQ(screen_caption("e", in(CameraCondition::live), 3000, true),
              (ScreenCaption{"e  NOT LIVE: 3 s old", true}));
    EXPECT_EQ(screen_caption("e", in(CameraCondition::ended), 85),
              (ScreenCaption{"e: has ended, this is its last picture", true}));
    EXPECT_EQ(screen_caption("e", in(CameraCondition::failed), std::nullopt),
              (ScreenCaption{"e: has failed", true}));
}

// Only add_to() needs a GL context.
TEST(SharedScreensTest, FollowTheirObjectsAndShowAnEmptyOneForAnOwnShare) {
    constexpr ParticipantId self{1}, ben{2};
    constexpr CameraId scope{3}, own{4};
    SharedScreens screens;
    screens.set_camera(scope, "scope", screen_calibration({640, 480}, 1, {}));
    EXPECT_FALSE(screens.follow({}, self)) << "a host without such objects";
    session::RoomObjects objects;
    const auto add = [&](std::uint32_t id, ParticipantId by, CameraId camera) {
        session::RoomObject object;
        object.kind = session::ObjectKind::screen;
        object.creator = by;
        object.properties = session::encode_shared_screen({camera, false, {640, 480}, "", "x"});
        objects[session::ObjectId(id)] = object;
    };
    add(8, ben, scope);
    EXPECT_TRUE(screens.follow(objects, self));
    EXPECT_FALSE(screens.follow(objects, self));
    objects.begin()->second.scale = 2;
    EXPECT_TRUE(screens.follow(objects, self));
    screens.remove_camera(scope);
    (void)screens.follow(objects, self);
    EXPECT_TRUE(screens.empty()) << "of Ben's screen no picture comes";
    add(9, self, own);
    EXPECT_TRUE(screens.follow(objects, self));
    EXPECT_FALSE(screens.empty());
    objects.clear();
    EXPECT_TRUE(screens.follow(objects, self));
    EXPECT_TRUE(screens.empty());
}

TEST(SharedScreensTest, APictureOfThePastIsMarkedAsOne) {
    constexpr CameraId scope{3};
    SharedScreens screens;
    screens.set_camera(scope, "scope", screen_calibration({4, 2}, 1, {}));
    client::CameraFigures figures;
    figures.camera.description.id = scope;
    figures.camera.state = in(CameraCondition::live);
    receive::CameraFrame frame;
    frame.camera = scope;
    const auto now = frame.times.captured + std::chrono::milliseconds(85);
    const auto take = [&](bool past) {
        auto color = std::make_shared<ColorImage>();
        color->size = {4, 2};
        frame.color = color;
        frame.past = past;
        screens.take(frame);
        return screens.note({figures}, now);
    };
    EXPECT_TRUE(take(false));
    EXPECT_FALSE(take(false)) << "nothing has changed but the pixels";
    EXPECT_TRUE(take(true)) << "its caption says that it is not live";
    EXPECT_FALSE(take(true));
    EXPECT_TRUE(take(false));
}

}  // namespace
}  // namespace theatron::viewer
