// SPDX-License-Identifier: Apache-2.0
// Pictures of participants' faces: who may send them, who is told of them, and their limits.
#include <gtest/gtest.h>

#include <algorithm>

#include "session/offering_testing.h"
#include "session/own_pictures.h"

namespace theatron::session {
namespace {

using wire::CameraKind;
using wire::Feature;
using wire::TextCode;

class Faces : public Offering {
protected:
    Faces() : Offering({Feature::webcam}) {}
    static wire::OfferedCamera face(Size size = {320, 240}, double fps = 15,
                                    bool may_record = false) {
        return {"face",     true,
                fps,        encode_calibration(screen_calibration(size, 0.3, {})),
                may_record, CameraKind::face};
    }
};

TEST_F(Faces, AnExpertShowsOneToThoseWhoseProgramsKnowFaces) {
    come(alice);
    come(bob);
    come(carol, "secret", {});
    const wire::Published answer = offer(alice, {face()});
    EXPECT_TRUE(answer.problem.empty()) << wire::english(answer.problem);
    ASSERT_EQ(answer.cameras.size(), 1u);
    ASSERT_EQ(to<wire::CamerasAdded>(bob).size(), 1u);
    EXPECT_EQ(to<wire::CamerasAdded>(bob)[0].cameras[0].kind, CameraKind::face);
    EXPECT_EQ(to<wire::CamerasAdded>(bob)[0].cameras[0].publisher, alice);
    EXPECT_TRUE(to<wire::CamerasAdded>(carol).empty()) << "she could not read the message";
    come(dave);
    EXPECT_EQ(to<wire::Welcome>(dave).at(0).cameras.size(), 2u) << "the host's and the face";
    come(ParticipantId{9}, "see", {Feature::webcam});
    EXPECT_EQ(to<wire::Welcome>(ParticipantId{9}).at(0).cameras.size(), 2u) << "observers see";
    come(ParticipantId{10}, "secret", {});
    EXPECT_EQ(to<wire::Welcome>(ParticipantId{10}).at(0).cameras.size(), 1u);
    tell(alice, wire::Unpublish{answer.cameras});
    EXPECT_EQ(to<wire::CamerasRemoved>(bob).size(), 1u);
    EXPECT_TRUE(to<wire::CamerasRemoved>(carol).empty());
}

TEST_F(Faces, AreSentAsJpegWhateverTheirReceiversWish) {
    come(alice);
    come(bob);
    offer(alice, {face()});
    ASSERT_EQ(settings(alice).size(), 2u);
    EXPECT_EQ(settings(alice)[0].codec, face_limits.depth_codec);
    EXPECT_EQ(settings(alice)[1].codec, face_limits.color_codec);
    const auto told = to<wire::Settings>(bob);
    ASSERT_EQ(told.size(), 1u);
    EXPECT_TRUE(told[0].note.empty()) << wire::english(told[0].note);
    tell(bob, wire::ChooseCodecs{"rvl", "raw", {}});
    EXPECT_TRUE(settings(alice).empty()) << "nothing has changed for the publisher";
}

TEST_F(Faces, AnObserverSendsNone) {
    come(alice, "see");
    EXPECT_EQ(problem_with(alice, {face()}), TextCode::face_forbidden);
    EXPECT_EQ(session_->participants().at(alice).denied, 1u);
}

TEST_F(Faces, AnExpertSendsNoOtherCamera) {
    come(alice);
    wire::OfferedCamera camera = face();
    camera.kind = CameraKind::room;
    EXPECT_EQ(problem_with(alice, {camera}), TextCode::link_without_cameras);
    EXPECT_EQ(problem_with(alice, {face(), camera}), TextCode::link_without_cameras);
    EXPECT_TRUE(session_->streams().cameras().of(alice).empty());
}

TEST_F(Faces, BeyondTheLimitsAreRefused) {
    come(alice);
    EXPECT_EQ(problem_with(alice, {face({322, 240})}), TextCode::face_beyond_limits);
    now += 1s;
    EXPECT_EQ(problem_with(alice, {face({4096, 3072})}), TextCode::face_beyond_limits);
    now += 1s;
    EXPECT_EQ(problem_with(alice, {face({320, 240}, 30)}), TextCode::face_beyond_limits);
    now += 1s;
    EXPECT_EQ(problem_with(alice, {face({320, 240}, 0)}), TextCode::face_beyond_limits);
    now += 1s;
    wire::OfferedCamera deep = face();
    Calibration calibration = screen_calibration({320, 240}, 0.3, {});
    calibration.depth.size = {640, 576};
    deep.calibration = encode_calibration(calibration);
    EXPECT_EQ(problem_with(alice, {deep}), TextCode::face_beyond_limits);
    now += 1s;
    deep.calibration = Bytes(7);
    EXPECT_EQ(problem_with(alice, {deep}), TextCode::face_beyond_limits);
    now += 1s;
    EXPECT_EQ(problem_with(alice, {face(), face()}), TextCode::one_face);
    now += 1s;
    EXPECT_EQ(problem_with(alice, {face()}), TextCode::none);
    now += 1s;
    EXPECT_EQ(problem_with(alice, {face()}), TextCode::one_face);
}

TEST_F(Faces, LeavePlacesForCamerasOfTheRoom) {
    for (std::uint32_t i = 0; i < max_faces; ++i) {
        come(ParticipantId{100 + i});
        ASSERT_EQ(problem_with(ParticipantId{100 + i}, {face()}), TextCode::none) << i;
    }
    come(alice);
    EXPECT_EQ(problem_with(alice, {face()}), TextCode::too_many_faces);
}

TEST_F(Faces, TooManyAndTooLargePicturesAreLeftOutAndCounted) {
    come(alice);
    come(bob);
    offer(alice, {face()});
    const auto both = settings(alice);
    ASSERT_EQ(both.size(), 2u);
    const std::vector<ParticipantId> to_bob{bob};
    const auto refused = [&] { return session_->participants().at(alice).refused_pictures; };
    // Ten seconds at the allowed rate.
    for (int i = 0; i < 150; ++i) {
        now += 66'667us;
        ASSERT_EQ(send(alice, both[0], 600), to_bob) << i;
        ASSERT_EQ(send(alice, both[1], 12'000), to_bob) << i;
    }
    EXPECT_EQ(refused(), 0u);
    EXPECT_TRUE(send(alice, both[1], max_face_message + 1).empty());
    EXPECT_EQ(refused(), 1u);
    // A second at 100 pictures a second.
    now += 1s;
    std::size_t passed = 0;
    for (int i = 0; i < 100; ++i) {
        now += 10ms;
        passed += send(alice, both[0], 600).size();
    }
    EXPECT_LE(passed, 26u);
    EXPECT_GE(passed, 20u);
    EXPECT_EQ(refused(), 101 - passed);
    EXPECT_TRUE(session_->participants().at(alice).takes_part()) << "it only costs pictures";
}

TEST_F(Faces, ANewRoleWithoutTheRightTakesTheFaceAway) {
    come(carol, "or");
    come(alice);
    come(bob);
    offer(alice, {face()});
    tell(carol, wire::Manage{1, wire::ManageAction::set_role, alice, Role::observer});
    EXPECT_TRUE(session_->streams().cameras().of(alice).empty());
    EXPECT_EQ(to<wire::CamerasRemoved>(bob).size(), 1u);
    tell(carol, wire::Manage{2, wire::ManageAction::set_role, alice, Role::expert});
    EXPECT_EQ(problem_with(alice, {face()}), TextCode::none);
    tell(carol, wire::Manage{3, wire::ManageAction::set_role, alice, Role::operator_});
    EXPECT_EQ(session_->streams().cameras().of(alice).size(), 1u) << "it stays";
}

TEST_F(Faces, DoNotMoveCamerasWithoutAPlace) {
    come(carol, "or", {Feature::publish, Feature::webcam});
    offer(carol, {face()});
    Calibration calibration;
    calibration.depth.size = {64, 48};
    calibration.depth.fx = calibration.depth.fy = 60;
    now += 1s;
    offer(carol, {{"cart", false, 30, encode_calibration(calibration), true}});
    const CameraId cart = session_->streams().cameras().of(carol).back();
    const auto placed =
        decode_calibration(session_->streams().cameras().find(cart)->description().calibration);
    ASSERT_TRUE(placed);
    EXPECT_EQ(placed->room_from_camera.translation.x, SessionCameras::unregistered_distance_m)
        << "beside the host's camera";
}

TEST_F(Faces, ARecorderGetsThemOnlyWhereTheyMayBeRecorded) {
    come(alice);
    come(bob, "secret", {Feature::webcam}, true);
    offer(alice, {face()});
    EXPECT_TRUE(settings(alice).empty()) << "nobody gets it";
    tell(alice, wire::Unpublish{session_->streams().cameras().of(alice)});
    now += 1s;
    offer(alice, {face({320, 240}, 15, true)});
    EXPECT_EQ(settings(alice).size(), 2u);
}

}  // namespace
}  // namespace theatron::session
