// SPDX-License-Identifier: Apache-2.0
// Screens that a browser shows (wire::CameraKind::screen): who may, how others are told of them,
// and their limits.
#include <gtest/gtest.h>

#include "session/offering_testing.h"
#include "session/own_pictures.h"

namespace theatron::session {
namespace {

using wire::CameraKind;
using wire::Feature;
using wire::TextCode;

class ShownScreens : public Offering {
protected:
    ShownScreens() : Offering({Feature::shows_screen, Feature::screens, Feature::room}) {
        between = 1s;
    }
    static wire::OfferedCamera screen(Size size = {1280, 720}, double fps = 8) {
        return {"Screen of Ada",
                true,
                fps,
                encode_calibration(screen_calibration(size, 1.2, {})),
                false,
                CameraKind::screen};
    }
    // The number of receivers of a picture of this many bytes, behind its plane.
    std::size_t receivers_of(ParticipantId id, const std::vector<wire::StreamSetting>& both,
                             std::size_t bytes) {
        (void)send(id, both[0], 600);
        return send(id, both[1], bytes).size();
    }
};

TEST_F(ShownScreens, AnExpertShowsOneAndItIsAScreenOfTheRoomForEverybody) {
    come(alice);
    come(bob, "see", {});
    const wire::Published answer = offer(alice, {screen()});
    EXPECT_TRUE(answer.problem.empty()) << wire::english(answer.problem);
    ASSERT_EQ(answer.cameras.size(), 1u);
    const auto told = to<wire::CamerasAdded>(bob);
    ASSERT_EQ(told.size(), 1u) << "an old program, too";
    EXPECT_EQ(told[0].cameras[0].kind, CameraKind::room);
    EXPECT_EQ(told[0].cameras[0].name, "Screen of Ada");
    EXPECT_FALSE(told[0].cameras[0].may_record);
    const auto calibration = decode_calibration(told[0].cameras[0].calibration);
    ASSERT_TRUE(calibration);
    EXPECT_TRUE(is_screen(*calibration));
    EXPECT_TRUE(calibration->registered) << "it has a place";
    come(carol);
    EXPECT_EQ(to<wire::Welcome>(carol).at(0).cameras.back().kind, CameraKind::room);
}

TEST_F(ShownScreens, ComeAsJpegWhateverTheirReceiversWish) {
    come(alice);
    come(bob);
    offer(alice, {screen()});
    ASSERT_EQ(settings(alice).size(), 2u);
    EXPECT_EQ(settings(alice)[0].codec, screen_limits.depth_codec);
    EXPECT_EQ(settings(alice)[1].codec, screen_limits.color_codec);
    const auto told = to<wire::Settings>(bob);
    ASSERT_EQ(told.size(), 1u);
    EXPECT_TRUE(told[0].note.empty()) << wire::english(told[0].note);
    tell(bob, wire::ChooseCodecs{"rvl", "raw", {}});
    EXPECT_TRUE(settings(alice).empty()) << "nothing has changed for the publisher";
}

TEST_F(ShownScreens, AreNotSentToAPersonWhoWishesForNoPictures) {
    come(alice);
    come(bob);
    tell(bob, wire::ChooseCodecs{"none", "none", {}});
    const wire::Published answer = offer(alice, {screen()});
    ASSERT_EQ(answer.cameras.size(), 1u);
    EXPECT_TRUE(settings(alice).empty()) << "nobody gets it";
    tell(bob, wire::ChooseCodecs{"", "jpeg:quality=60", {answer.cameras[0]}});
    const auto asked = settings(alice);
    ASSERT_EQ(asked.size(), 1u) << "its colour alone";
    EXPECT_EQ(asked[0].codec, screen_limits.color_codec);
    tell(bob, wire::ChooseCodecs{"none", "none", {answer.cameras[0]}});
    EXPECT_TRUE(settings(alice).empty());
}

TEST_F(ShownScreens, AreNotRecorded) {
    come(alice);
    come(bob, "secret", {}, true);
    offer(alice, {screen()});
    EXPECT_TRUE(settings(alice).empty()) << "nobody gets it";
}

TEST_F(ShownScreens, AnObserverShowsNone) {
    come(alice, "see");
    EXPECT_EQ(problem_with(alice, {screen()}), TextCode::screen_forbidden);
    EXPECT_EQ(session_->participants().at(alice).denied, 1u);
}

TEST_F(ShownScreens, AnExpertSendsNoCameraBesideIt) {
    come(alice);
    wire::OfferedCamera camera = screen();
    camera.kind = CameraKind::room;
    EXPECT_EQ(problem_with(alice, {screen(), camera}), TextCode::link_without_cameras);
    camera.kind = CameraKind::person;
    EXPECT_EQ(problem_with(alice, {camera, screen()}), TextCode::link_without_cameras);
    EXPECT_TRUE(session_->streams().cameras().of(alice).empty());
}

TEST_F(ShownScreens, BeyondTheLimitsAreRefused) {
    come(alice);
    EXPECT_EQ(problem_with(alice, {screen({1921, 1200})}), TextCode::screen_beyond_limits);
    EXPECT_EQ(problem_with(alice, {screen({1280, 720}, 30)}), TextCode::screen_beyond_limits);
    EXPECT_EQ(problem_with(alice, {screen({1280, 720}, 0)}), TextCode::screen_beyond_limits);
    wire::OfferedCamera deep = screen();
    Calibration calibration = screen_calibration({1280, 720}, 1.2, {});
    calibration.depth.size = {640, 576};
    deep.calibration = encode_calibration(calibration);
    EXPECT_EQ(problem_with(alice, {deep}), TextCode::screen_beyond_limits)
        << "no way for an expert to send a camera of the room";
    deep.calibration = Bytes(7);
    EXPECT_EQ(problem_with(alice, {deep}), TextCode::screen_beyond_limits);
    EXPECT_EQ(problem_with(alice, {screen(), screen()}), TextCode::one_screen);
    EXPECT_EQ(problem_with(alice, {screen()}), TextCode::none);
    EXPECT_EQ(problem_with(alice, {screen()}), TextCode::one_screen);
}

TEST_F(ShownScreens, TooManyAndTooLargePicturesAreLeftOutAndCounted) {
    come(alice);
    come(bob);
    offer(alice, {screen()});
    const auto both = settings(alice);
    ASSERT_EQ(both.size(), 2u);
    const auto refused = [&] { return session_->participants().at(alice).refused_pictures; };
    // Ten seconds at the offered rate, 300 kB each.
    for (int i = 0; i < 80; ++i) {
        now += 125ms;
        ASSERT_EQ(receivers_of(alice, both, 300'000), 1u) << i;
    }
    EXPECT_EQ(refused(), 0u);
    EXPECT_EQ(receivers_of(alice, both, max_screen_message + 1), 0u);
    EXPECT_EQ(refused(), 1u);
    // Ten seconds with ten times as many bytes as are let through.
    now += 1s;
    std::size_t bytes = 0;
    for (int i = 0; i < 300; ++i) {
        now += 33'333us;
        bytes += 1'000'000 * receivers_of(alice, both, 1'000'000);
    }
    EXPECT_LE(double(bytes), 11 * max_screen_bytes_per_s);
    EXPECT_GE(double(bytes), 9 * max_screen_bytes_per_s);
    EXPECT_TRUE(session_->participants().at(alice).takes_part()) << "it only costs pictures";
}

TEST_F(ShownScreens, ANewRoleWithoutTheRightTakesTheScreenAway) {
    come(carol, "or");
    come(alice);
    come(bob);
    offer(alice, {screen()});
    tell(carol, wire::Manage{1, wire::ManageAction::set_role, alice, Role::observer});
    EXPECT_TRUE(session_->streams().cameras().of(alice).empty());
    EXPECT_EQ(to<wire::CamerasRemoved>(bob).size(), 1u);
    tell(carol, wire::Manage{2, wire::ManageAction::set_role, alice, Role::expert});
    EXPECT_EQ(problem_with(alice, {screen()}), TextCode::none);
}

}  // namespace
}  // namespace theatron::session
