// SPDX-License-Identifier: Apache-2.0
#include "session/camera_adjustment.h"

#include <gtest/gtest.h>

#include "session/host_session_testing.h"
#include "session/viewer_session.h"

namespace theatron::session {
namespace {

using wire::ManageRefusal;

TEST(CameraAdjustment, BytesAreAsSpecified) {
    const CameraAdjustment adjustment{{0.1, -0.02, 0}, {0, 1.5, 0}, PictureBox{8, 4, 32, 24}};
    const std::uint8_t expected[] = {1, 0xa0, 0x86, 1, 0, 0xe0, 0xb1, 0xff, 0xff, 0,  0,
                                     0, 0,    0,    0, 0, 0,    0x60, 0xe3, 0x16, 0,  0,
                                     0, 0,    0,    8, 0, 4,    0,    32,   0,    24, 0};
    const Bytes bytes = encode_adjustment(adjustment);
    ASSERT_EQ(bytes.size(), std::size(expected));
    EXPECT_EQ(std::memcmp(bytes.data(), expected, bytes.size()), 0);
    EXPECT_EQ(decode_adjustment(bytes).value(), adjustment);
    EXPECT_TRUE(encode_adjustment({}).empty());
    EXPECT_EQ(decode_adjustment({}).value(), CameraAdjustment{});
    for (std::size_t size = 1; size < bytes.size(); ++size)
        EXPECT_EQ(decode_adjustment(ByteView(bytes).first(size)).error(), Status::truncated);
    Bytes longer = bytes;
    longer.push_back({});
    EXPECT_EQ(decode_adjustment(longer).error(), Status::trailing_bytes);
    Bytes newer = bytes;
    newer[0] = std::byte{2};
    EXPECT_EQ(decode_adjustment(newer).error(), Status::unsupported);
}

TEST(CameraAdjustment, TurnsAboutTheCameraAndMovesAlongTheRoom) {
    const Pose registered = look_at({1, 2, 3}, {0, 1, 0}, {0, 1, 0});
    const CameraAdjustment adjustment{{0.1, 0, 0}, {0, 10, 0}, {}};
    const Pose now = nudged(registered, adjustment);
    EXPECT_NEAR(length(now.translation - Vec3{1.1, 2, 3}), 0, 1e-12);
    const Vec3 before = rotate(registered.rotation, {0, 0, 1}),
               after = rotate(now.rotation, {0, 0, 1});
    EXPECT_NEAR(after.y, before.y, 1e-12);
    const double turned = std::atan2(after.x, after.z) - std::atan2(before.x, before.z);
    EXPECT_NEAR(turned, radians_of(10), 1e-9);
    const Pose back = without_nudge(now, adjustment);
    EXPECT_NEAR(length(back.translation - registered.translation), 0, 1e-12);
}

TEST(CameraAdjustment, HasLimits) {
    const Size depth{64, 48};
    const auto is_allowed = [&](const CameraAdjustment& a) { return is_within_limits(a, depth); };
    EXPECT_TRUE(is_allowed({{0.3, 0, 0}, {0, 0, -15}, PictureBox{0, 0, 64, 48}}));
    EXPECT_FALSE(is_allowed({{0.3, 0.01, 0}, {}, {}}));
    EXPECT_FALSE(is_allowed({{}, {11, 11, 0}, {}}));
    EXPECT_FALSE(is_allowed({{}, {}, PictureBox{1, 0, 64, 48}}));
    EXPECT_FALSE(is_allowed({{}, {}, PictureBox{0, 0, 0, 48}}));
}

class Adjusting : public Host {
protected:
    Adjusting() { session_.emplace(with_operator()); }
    static HostSession::Config with_operator() {
        HostSession::Config c = config();
        c.cameras[0].name = "left";
        c.admission.tokens = {{"or", Role::operator_, {}, "operator"},
                              {"secret", Role::expert, {}, "expert"}};
        return c;
    }
    void come(ParticipantId id, const char* token) {
        session_->on_connected(id, now);
        wire::Join hello;
        hello.token = token;
        hello.name = token;
        hello.depth_codec = "trvl";
        hello.color_codec = "jpeg";
        hello.features = {wire::Feature::adjusting, wire::Feature::playback};
        tell(id, hello);
    }
    void tell(ParticipantId id, const wire::ToHost& message) {
        session_->on_control(id, wire::encode(message), now);
        taken = session_->take_actions();
    }
    ManageRefusal adjust(ParticipantId id, const CameraAdjustment& adjustment,
                         CameraId camera = {}) {
        tell(id, wire::AdjustCamera{7, camera, encode_adjustment(adjustment)});
        return messages_to<wire::Managed>(id, taken).at(0).refusal;
    }
    static Pose pose_of(const wire::Camera& camera) {
        return decode_calibration(camera.calibration).value().room_from_camera;
    }

    static inline const CameraAdjustment nudge{{0.05, 0, 0}, {0, 2, 0}, {}};
    std::optional<HostSession> session_;
    std::vector<Action> taken;
};

TEST_F(Adjusting, ByAnOperatorIsToldToAllAndToThoseWhoComeLater) {
    come(alice, "or");
    come(bob, "secret");
    const Pose registered = pose_of(session_->streams().cameras().descriptions().at(0));
    EXPECT_EQ(adjust(alice, nudge), ManageRefusal::none);
    for (const ParticipantId id : {alice, bob}) {
        const auto changes = messages_to<wire::CameraChanged>(id, taken);
        ASSERT_EQ(changes.size(), 1u);
        EXPECT_EQ(pose_of(changes[0].camera), nudged(registered, nudge));
        EXPECT_EQ(changes[0].camera.adjustment, encode_adjustment(nudge));
    }
    EXPECT_EQ(actions_of<action::Adjusted>(taken).size(), 1u);
    come(carol, "secret");
    const auto welcome = messages_to<wire::Welcome>(carol, taken).at(0);
    EXPECT_EQ(pose_of(welcome.cameras.at(0)), nudged(registered, nudge));
    // Adjustments do not add up: each is relative to the registered pose.
    EXPECT_EQ(adjust(alice, {}), ManageRefusal::none);
    EXPECT_EQ(pose_of(session_->streams().cameras().descriptions().at(0)), registered);
    EXPECT_TRUE(session_->streams().cameras().adjustments().empty());
}

TEST_F(Adjusting, IsRefusedWithAReason) {
    come(alice, "or");
    come(bob, "secret");
    EXPECT_EQ(adjust(bob, nudge), ManageRefusal::adjusting_role);
    EXPECT_EQ(adjust(alice, nudge, CameraId{9}), ManageRefusal::no_such_camera);
    EXPECT_EQ(adjust(alice, {{1, 0, 0}, {}, {}}), ManageRefusal::beyond_limits);
    tell(alice, wire::AdjustCamera{8, {}, Bytes(3)});
    EXPECT_EQ(messages_to<wire::Managed>(alice, taken).at(0).refusal, ManageRefusal::beyond_limits);
    EXPECT_TRUE(messages_to<wire::CameraChanged>(bob, taken).empty());
    EXPECT_TRUE(session_->streams().cameras().adjustments().empty());
}

TEST_F(Adjusting, OutlivesTheHostUntilTheCameraIsRegisteredAnew) {
    come(alice, "or");
    EXPECT_EQ(adjust(alice, nudge), ManageRefusal::none);
    const auto kept = session_->streams().cameras().adjustments();
    ASSERT_EQ(kept.size(), 1u);

    HostSession::Config again = with_operator();
    again.streams.adjustments = kept;
    const Pose registered = pose_of(again.cameras[0]);
    HostSession second(again);
    EXPECT_EQ(pose_of(second.streams().cameras().descriptions().at(0)), nudged(registered, nudge));

    auto calibration = decode_calibration(again.cameras[0].calibration).value();
    calibration.room_from_camera.translation.x += 0.001;
    again.cameras[0].calibration = encode_calibration(calibration);
    HostSession third(again);
    EXPECT_EQ(pose_of(third.streams().cameras().descriptions().at(0)),
              calibration.room_from_camera);
}

TEST_F(Adjusting, KeepsGainsThatWereEstimated) {
    come(alice, "or");
    const auto calibration = [&] {
        return decode_calibration(session_->streams().cameras().descriptions().at(0).calibration)
            .value();
    };
    const Calibration registered = calibration();
    session_->set_estimated_gain({}, {1.25, 1, 0.5});
    taken = session_->take_actions();
    ASSERT_EQ(messages_to<wire::CameraChanged>(alice, taken).size(), 1u);
    EXPECT_EQ(calibration().color_gain, (Vec3{1.25, 1, 0.5}));

    EXPECT_EQ(adjust(alice, nudge), ManageRefusal::none);
    EXPECT_EQ(calibration().color_gain, (Vec3{1.25, 1, 0.5}));
    session_->set_estimated_gain({}, {1.5, 1, 0.5});
    EXPECT_EQ(calibration().color_gain, (Vec3{1.5, 1, 0.5}));
    EXPECT_EQ(calibration().room_from_camera, nudged(registered.room_from_camera, nudge));
    EXPECT_EQ(session_->streams().cameras().adjustments().at(0).registered,
              registered.room_from_camera);

    // A recording that is played knows its own from some time on.
    Calibration known = registered;
    known.color_gain = {1, 1, 0.75};
    session_->set_calibration({}, encode_calibration(known));
    EXPECT_EQ(calibration().color_gain, known.color_gain);
    (void)session_->take_actions();
    session_->set_estimated_gain({}, {2, 2, 2});
    EXPECT_EQ(calibration().color_gain, known.color_gain);
    EXPECT_TRUE(session_->take_actions().empty());
    session_->set_calibration({}, encode_calibration(registered));
    EXPECT_EQ(calibration().color_gain, (Vec3{2, 2, 2}));
}

TEST_F(Adjusting, IsInTheAuditLogOnceItStays) {
    come(alice, "or");
    for (int i = 1; i <= 5; ++i) {
        EXPECT_EQ(adjust(alice, {{0.01 * i, 0, 0}, {}, {}}), ManageRefusal::none);
        now += 500ms;
        session_->on_tick(now);
        EXPECT_TRUE(actions_of<action::Audit>(session_->take_actions()).empty());
    }
    now += 2s;
    session_->on_tick(now);
    const auto audited = actions_of<action::Audit>(session_->take_actions());
    ASSERT_EQ(audited.size(), 1u);
    EXPECT_EQ(audited[0].event.detail, "left: moved by 50.0, 0.0, 0.0 mm");
    EXPECT_EQ(audited[0].event.by, "or");
}

TEST_F(Adjusting, ChangesTheViewersCamera) {
    come(alice, "or");
    ViewerSession viewer({});
    (void)viewer.on_control(wire::encode(messages_to<wire::Welcome>(alice, taken).at(0)));
    EXPECT_EQ(adjust(alice, nudge), ManageRefusal::none);
    const auto change = messages_to<wire::CameraChanged>(alice, taken).at(0);
    EXPECT_EQ(viewer.on_control(wire::encode(change)), ViewerSession::Change::cameras);
    EXPECT_EQ(viewer.cameras().at(0).calibration, change.camera.calibration);
    // Nothing that concerns the streams changes so.
    wire::CameraChanged foreign = change;
    auto calibration = decode_calibration(change.camera.calibration).value();
    calibration.depth.size.width *= 2;
    foreign.camera.calibration = encode_calibration(calibration);
    EXPECT_EQ(viewer.on_control(wire::encode(foreign)), ViewerSession::Change::nothing);
    EXPECT_EQ(viewer.cameras().at(0).calibration, change.camera.calibration);
}

TEST_F(Adjusting, PlayingNeedsARecording) {
    come(bob, "secret");
    const wire::Play seek{3, wire::PlayAction::seek, 90s};
    tell(bob, seek);
    EXPECT_EQ(messages_to<wire::Managed>(bob, taken).at(0).refusal, ManageRefusal::nothing_to_play);
    session_->set_playback({1s, now, 60s, false, ""});
    EXPECT_EQ(messages_to<wire::Playback>(bob, session_->take_actions()).size(), 1u);
    tell(bob, seek);
    EXPECT_EQ(messages_to<wire::Managed>(bob, taken).at(0).refusal, ManageRefusal::none);
    const auto plays = actions_of<action::Play>(taken);
    ASSERT_EQ(plays.size(), 1u);
    EXPECT_EQ(plays[0].position, 60s) << "not behind the end";
    come(carol, "secret");
    EXPECT_EQ(messages_to<wire::Playback>(carol, taken).size(), 1u);
}

}  // namespace
}  // namespace theatron::session
