// SPDX-License-Identifier: Apache-2.0
#include "viewer/headset.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "render/offscreen_context_native.h"

namespace theatron::viewer {
namespace {

constexpr double nearly = 1e-5;  // poses are sent as floats
constexpr Vec3 upwards{0, 1, 0};

client::Participant::Options nobody_answers() {
    client::Participant::Options options;
    options.link = {"127.0.0.1", 1, "token", ""};
    return options;
}

// A right hand that points to +x, over the middle of the operating table.
xr::HandState hand_at(Vec3 place, double trigger = 0) {
    xr::HandState hand;
    hand.floor_from_aim = hand.floor_from_grip = {rotation_about(upwards, -radians_of(90)), place};
    hand.trigger = trigger;
    return hand;
}

class HeadsetTest : public ::testing::Test {
protected:
    // `before_from_now`: the tracking space has moved so since the head and hand were told.
    void show(const Pose& its_head, std::optional<xr::HandState> hand = {},
              const Pose& before_from_now = {}) {
        const Pose now_from_before = inverse(before_from_now);
        xr::HeadsetFrame frame;
        frame.floor_from_head = now_from_before * its_head;
        frame.eyes.resize(1);
        frame.eyes[0].floor_from_eye = frame.floor_from_head;
        if (hand) {
            hand->floor_from_aim = now_from_before * hand->floor_from_aim;
            hand->floor_from_grip = now_from_before * hand->floor_from_grip;
        }
        frame.hands[xr::right_side] = hand;
        now_ += 10ms;
        headset_->on_frame(frame, {}, tools_, scene_, participant_, now_);
    }
    void place_table() {
        show(head, hand_at(table));
        show(head, hand_at(table, 1));
        show(head, hand_at(table));
        ASSERT_FALSE(headset_->places_table());
        (void)headset_->take_note();
    }
    static Vec3 place_of(const wire::PartPose& part) {
        return {part.position[0], part.position[1], part.position[2]};
    }
    Vec3 head_place() const { return place_of(*headset_->pose(now_).head); }
    Vec3 hand_place() const { return place_of(*headset_->pose(now_).right_hand); }
    static void expect_near(Vec3 a, Vec3 b) {
        EXPECT_NEAR(length(a - b), 0, nearly)
            << a.x << " " << a.y << " " << a.z << ", wanted " << b.x << " " << b.y << " " << b.z;
    }

    // In the tracking space that was first.
    const Pose head{rotation_about(upwards, 0.3), {0.4, 1.6, 0.2}};
    const Vec3 table{0.3, 1.0, -1.2}, expert{0.1, 1.1, -1.0};
    // The new origin in it: a metre aside, turned by a quarter.
    const Pose moved{rotation_about(upwards, radians_of(90)), {1, 0, -0.5}};

    render::OffscreenContext context_;  // of the scene
    client::Participant participant_{nobody_answers()};
    LiveScene scene_{RoomChoice{}};
    Tools tools_;
    std::optional<Headset> headset_;
    TimePoint now_{1s};
};

TEST_F(HeadsetTest, AfterARecentreOneStandsWhereOneWasBroughtLast) {
    const Pose eye = look_at({2, 1.6, 1}, {0, 1.6, 1}, upwards);
    headset_.emplace(eye, false);
    show(head);
    expect_near(head_place(), {2, 1.6, 1});
    const Pose before = headset_->head().room_from_eye;
    // The first frame of the new origin has the head at another place.
    headset_->on_space_moved(std::nullopt);
    show(head, {}, moved);
    expect_near(head_place(), {2, 1.6, 1});
    expect_near(rotate(headset_->head().room_from_eye.rotation, {0, 0, 1}),
                rotate(before.rotation, {0, 0, 1}));
    show(head, {}, moved);
    expect_near(head_place(), {2, 1.6, 1});
}

TEST_F(HeadsetTest, InARealRoomTheTableKeepsItsPlaceWhereTheWayIsKnown) {
    headset_.emplace(Pose{}, true);
    place_table();
    show(head, hand_at(expert));
    const Vec3 hand = hand_place(), eyes = head_place();
    headset_->on_space_moved(moved);
    show(head, hand_at(expert), moved);
    expect_near(hand_place(), hand);
    expect_near(head_place(), eyes);
    EXPECT_FALSE(headset_->places_table());
    // Two moves between two frames are one.
    const Pose further{rotation_about(upwards, -0.4), {-0.2, 0, 0.7}};
    headset_->on_space_moved(further);
    headset_->on_space_moved(moved);
    show(head, hand_at(expert), moved * further * moved);
    expect_near(hand_place(), hand);
}

TEST_F(HeadsetTest, TheFloorIsWhereTheHeadsetSeesItNow) {
    headset_.emplace(Pose{}, true);
    place_table();
    Pose higher = moved;
    higher.translation.y = 0.1;
    headset_->on_space_moved(higher);
    show(head, hand_at(expert), higher);
    EXPECT_NEAR(head_place().y, head.translation.y - 0.1, nearly);
}

TEST_F(HeadsetTest, InARealRoomTheTableIsPlacedAgainWhereTheWayIsNotKnown) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const std::optional<Pose>& way :
         {std::optional<Pose>(), std::optional(Pose{rotation_about({1, 0, 0}, 0.5), {}}),
          std::optional(Pose{{}, {nan, 0, 0}})}) {
        headset_.emplace(Pose{}, true);
        place_table();
        headset_->on_space_moved(way);
        EXPECT_FALSE(headset_->places_table()) << "the newest frame is still of the old space";
        show(head, hand_at(expert), moved);
        EXPECT_TRUE(headset_->places_table());
        EXPECT_NE(headset_->take_note(), "");
        show(head, hand_at(table, 1), moved);
        EXPECT_FALSE(headset_->places_table());
        show(head, hand_at(table), moved);
        // Its middle is under the hand.
        EXPECT_NEAR(std::hypot(hand_place().x, hand_place().z), 0, nearly);
    }
}

TEST_F(HeadsetTest, ARayPressesTheButtonsOfThePanels) {
    headset_.emplace(look_at({0, 1.6, 2}, {0, 1.6, 0}, upwards), false);
    const Pose upright{{}, {0, 1.6, 0}};
    show(upright);
    headset_->show_panels({{"Marks", {{"", "", {{"Undo", 3}}}}}});
    // The plate is 0.3 m to the left and 0.7 m ahead; the button is in its second row.
    const Vec3 away = normalized(Vec3{-0.3, 0, -0.7});
    const Vec3 along{-away.z, 0, away.x};
    const Vec3 button = Vec3{-0.3, 1.65 - 1.5 * Plate::row_m, -0.7} + along * (0.03 - 0.25);
    xr::HandState hand;
    hand.floor_from_aim = {rotation_about(upwards, std::atan2(0.3, 0.7)), button - away * 0.3};
    show(upright, hand);
    EXPECT_FALSE(headset_->take_pressed());
    hand.trigger = 1;
    show(upright, hand);
    EXPECT_EQ(headset_->take_pressed(), 3);
    show(upright, hand);
    EXPECT_FALSE(headset_->take_pressed()) << "the trigger was not let go";
    headset_->show_panels({});
    hand.trigger = 0;
    show(upright, hand);
    hand.trigger = 1;
    show(upright, hand);
    EXPECT_FALSE(headset_->take_pressed()) << "there is no plate";
}

TEST_F(HeadsetTest, PosesHaveTheTimeAtWhichThePictureIsSeen) {
    headset_.emplace(look_at({0, 1.6, 2}, {0, 1.6, 0}, upwards), false);
    const auto told = [&](Duration until_shown) {
        xr::HeadsetFrame frame;
        frame.until_shown = until_shown;
        frame.floor_from_head = head;
        frame.eyes.resize(1);
        headset_->on_frame(frame, {}, tools_, scene_, participant_, now_);
        return headset_->pose(now_).time - now_;
    };
    EXPECT_EQ(told(0ms), 0ms);
    EXPECT_EQ(told(23ms), 23ms);
    EXPECT_EQ(told(-5ms), 0ms);
    EXPECT_EQ(told(10s), 100ms) << "no runtime sees that far ahead";
}

TEST_F(HeadsetTest, WalkingByStickDarkensTheSidesUntilOneStands) {
    headset_.emplace(look_at({0, 1.6, 2}, {0, 1.6, 0}, upwards), false);
    const auto walk = [&](double ahead, int frames) {
        for (int i = 0; i < frames; ++i) {
            xr::HeadsetFrame frame;
            frame.floor_from_head = head;
            frame.eyes.resize(1);
            frame.hands[xr::left_side] = frame.hands[xr::right_side] = hand_at({0, 1, 0});
            frame.hands[xr::left_side]->stick.y = ahead;
            now_ += 10ms;
            headset_->on_frame(frame, {}, tools_, scene_, participant_, now_);
        }
    };
    walk(0, 2);
    EXPECT_EQ(headset_->vignette(), 0);
    const Vec3 before = head_place();
    walk(1, 5);
    EXPECT_GT(headset_->vignette(), 0.2);
    EXPECT_LT(headset_->vignette(), 0.8) << "it comes gently";
    walk(1, 20);
    EXPECT_EQ(headset_->vignette(), 1);
    EXPECT_NEAR(length(head_place() - before), 1.4 * 0.25, 0.02);
    walk(0, 25);
    EXPECT_EQ(headset_->vignette(), 0);
}

}  // namespace
}  // namespace theatron::viewer
