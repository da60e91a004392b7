// SPDX-License-Identifier: Apache-2.0
// Publishers, cameras and participants that come and go while a session runs.
#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/calibration.h"
#include "session/camera_offer.h"
#include "session/host_session.h"
#include "session/host_session_testing.h"

namespace theatron::session {
namespace {

constexpr ParticipantId alice{1}, bob{2}, carol{3}, dave{4};

class SessionOfMany : public ::testing::Test {
protected:
    SessionOfMany() : session(config()) {}

    static Bytes calibration(Size depth = {64, 48}, Size color = {128, 96}) {
        Calibration c;
        c.depth.size = depth;
        c.color.size = color;
        c.depth.fx = c.depth.fy = c.color.fx = c.color.fy = 60;
        return encode_calibration(c);
    }
    static HostSession::Config config() {
        HostSession::Config config;
        config.admission.tokens = {{"watch", Role::expert, {}},
                                   {"publish", Role::publisher, {}},
                                   {"short", Role::publisher, from_us(5'000'000)}};
        config.admission.equal_secrets = [](std::string_view a, std::string_view b) {
            return a == b;
        };
        config.session = wire::SessionId{5};
        wire::Camera camera;
        camera.name = "OR lamp";
        camera.has_color = true;
        camera.frames_per_second = 30;
        camera.calibration = calibration();
        config.cameras = {camera};
        config.check_depth = config.check_color = [](const std::string& text) {
            return text == "bad" ? HostSession::CheckedCodec{"", "There is no codec bad."}
                                 : HostSession::CheckedCodec{text, ""};
        };
        return config;
    }

    void say(ParticipantId id, const wire::ToHost& message) {
        session.on_control(id, wire::encode(message), now);
    }
    void join(ParticipantId id, const char* token = "watch", const char* depth = "strata") {
        session.on_connected(id, now);
        wire::Join hello;
        hello.token = token;
        hello.depth_codec = depth;
        hello.color_codec = "jpeg";
        hello.features = {wire::Feature{77}, wire::Feature::publish};
        say(id, hello);
    }
    // Offers this many cameras; their numbers.
    std::vector<CameraId> publish(ParticipantId id, std::size_t cameras, bool may_record = false) {
        say(id, wire::Publish{std::vector<wire::OfferedCamera>(
                    cameras, {"face", true, 30, calibration(), may_record})});
        actions = session.take_actions();
        const auto answers = sent<wire::Published>(id);
        return answers.empty() ? std::vector<CameraId>() : answers.back().cameras;
    }
    template <class T>
    std::vector<T> all() const {
        return actions_of<T>(actions);
    }
    // In the actions taken last.
    template <class T>
    std::vector<T> sent(ParticipantId id) const {
        return messages_to<T>(id, actions);
    }
    // The codec of a stream for a participant, from the actions that were taken last.
    std::string codec_of(ParticipantId id, StreamId stream) const {
        std::string codec;
        for (const auto& message : sent<wire::Settings>(id))
            for (const auto& setting : message.settings)
                if (setting.stream == stream)
                    codec = setting.codec;
        return codec;
    }
    Bytes picture(CameraId camera, SettingId setting, FrameNumber frame = 0) const {
        wire::MediaHeader h;
        h.stream = depth_stream(camera);
        h.setting = setting;
        h.frame = h.reference = frame;
        h.key = true;
        h.captured = now;
        Bytes message(wire::media_header_size);
        wire::write_media_header(h, message.data());
        return message;
    }

    TimePoint now = from_us(1'000'000);
    HostSession session;
    std::vector<Action> actions;
};

TEST_F(SessionOfMany, ACameraOfAParticipantReachesTheOthers) {
    join(alice, "publish");
    join(bob);
    (void)session.take_actions();
    const auto cameras = publish(alice, 1);
    ASSERT_EQ(cameras, std::vector{CameraId{1}}) << "the host's own is 0";
    ASSERT_EQ(sent<wire::CamerasAdded>(bob).size(), 1u);
    const wire::Camera added = sent<wire::CamerasAdded>(bob)[0].cameras.at(0);
    EXPECT_EQ(added.publisher, alice);
    EXPECT_EQ(added.session, wire::SessionId{5});
    EXPECT_EQ(added.depth_stream, depth_stream(CameraId{1}));
    EXPECT_TRUE(sent<wire::CamerasAdded>(alice).empty()) << "it knows its own";
    ASSERT_EQ(all<action::TakeMedia>().size(), 1u);
    EXPECT_GT(all<action::TakeMedia>()[0].max_message, 4u * 128 * 96);

    // The publisher gets an Encode message with the settings for bob.
    ASSERT_EQ(sent<wire::Encode>(alice).size(), 1u);
    const auto encode = sent<wire::Encode>(alice)[0].settings;
    ASSERT_EQ(encode.size(), 2u);
    EXPECT_EQ(encode[0].codec, "strata");
    EXPECT_EQ(codec_of(bob, added.depth_stream), "strata");
    session.on_tick(now);
    actions = session.take_actions();
    EXPECT_EQ(sent<wire::EncodeKey>(alice).size(), 2u);

    EXPECT_EQ(session.on_media_from(alice, picture(cameras[0], encode[0].setting), now).receivers,
              std::vector{bob});
    join(carol);
    EXPECT_EQ(session.on_media_from(alice, picture(cameras[0], encode[0].setting), now).receivers,
              (std::vector{bob, carol}))
        << "that come later, too";
    actions = session.take_actions();
    EXPECT_EQ(sent<wire::Welcome>(carol).at(0).cameras.size(), 2u);
    EXPECT_TRUE(all<action::Close>().empty());
}

TEST_F(SessionOfMany, ARecorderGetsTheCamerasOfTheHostAndOfThoseWhoAgree) {
    join(alice, "publish");
    const auto join_recorder = [&](ParticipantId id, const char* codec) {
        session.on_connected(id, now);
        wire::Join hello;
        hello.token = "watch";
        hello.depth_codec = codec;
        hello.color_codec = "jpeg";
        hello.records = true;
        say(id, hello);
    };
    // One that is there before the cameras, one that comes later, with a codec of its own.
    join_recorder(bob, "strata");
    actions = session.take_actions();
    EXPECT_EQ(codec_of(bob, depth_stream(CameraId{0})), "strata") << "the host's own";
    const auto refused = publish(alice, 1), agreed = publish(alice, 1, true);
    EXPECT_EQ(codec_of(bob, depth_stream(agreed.at(0))), "strata");
    EXPECT_TRUE(sent<wire::CamerasAdded>(bob).at(0).cameras.at(0).may_record);
    join_recorder(carol, "zstd");
    session.on_link(carol, {1e6, Duration(1000), Duration(1000), 0}, now);
    session.resynchronise(carol);
    say(carol, wire::ChooseCodecs{"lz4", "", {}});
    actions = session.take_actions();
    EXPECT_EQ(codec_of(carol, depth_stream(refused.at(0))), "");
    EXPECT_NE(codec_of(carol, depth_stream(agreed.at(0))), "");
    EXPECT_FALSE(sent<wire::Welcome>(carol).at(0).cameras.at(1).may_record);
    for (const bool may : {false, true}) {
        const CameraId camera = may ? agreed.at(0) : refused.at(0);
        std::size_t receivers = 0;
        for (const auto& setting : session.depth_settings(camera))
            receivers +=
                session.on_media_from(alice, picture(camera, setting.id), now).receivers.size();
        EXPECT_EQ(receivers, may ? 2u : 0u);
    }
    // A viewer gets both.
    join(ParticipantId{77});
    actions = session.take_actions();
    EXPECT_EQ(codec_of(ParticipantId{77}, depth_stream(refused.at(0))), "strata");
}

// Settings of single cameras use up numbers faster than settings of all.
TEST_F(SessionOfMany, APictureUnderAnOldNumberGoesToNobodyThoughAnotherCameraHasTheNumberNow) {
    join(alice, "publish");
    join(bob);
    const auto cameras = publish(alice, 2);
    const SettingId old = session.depth_settings(cameras[0]).at(0).id;
    say(bob, wire::ChooseCodecs{"other", "", {cameras[0]}});
    ASSERT_NE(session.depth_settings(cameras[0]).at(0).id, old);
    SettingId reused{};
    for (std::size_t i = 0; i < SettingNumbers::how_many && reused != old; ++i) {
        now += std::chrono::milliseconds(500);
        const std::string codec = i % 2 == 0 ? "even" : "odd";
        say(bob, wire::ChooseCodecs{codec, codec, {cameras[1]}});
        (void)session.take_actions();
        reused = session.depth_settings(cameras[1]).at(0).id;
        if (session.color_settings(cameras[1]).at(0).id == old)
            reused = old;
    }
    ASSERT_EQ(reused, old);
    EXPECT_TRUE(session.on_media_from(alice, picture(cameras[0], old), now).receivers.empty());
    const SettingId present = session.depth_settings(cameras[0]).at(0).id;
    EXPECT_EQ(session.on_media_from(alice, picture(cameras[0], present), now).receivers,
              std::vector{bob});
}

TEST_F(SessionOfMany, OnlyALinkForPublishersLetsCamerasIn) {
    join(alice);
    actions = session.take_actions();
    EXPECT_TRUE(sent<wire::Welcome>(alice).at(0).features.empty());
    EXPECT_TRUE(publish(alice, 1).empty());
    EXPECT_EQ(sent<wire::Published>(alice).at(0).problem.code,
              wire::TextCode::link_without_cameras);
    EXPECT_EQ(session.streams().cameras().size(), 1u);
    EXPECT_TRUE(
        session.on_media_from(alice, picture(CameraId{1}, SettingId{1}), now).receivers.empty());
    actions = session.take_actions();
    EXPECT_EQ(all<action::Close>().size(), 1u);
}

// A machine with cameras and without a viewer.
TEST_F(SessionOfMany, OneThatOnlySendsIsToldOfNoCameraAndSentNone) {
    session.on_connected(alice, now);
    wire::Join hello;
    hello.token = "publish";
    hello.depth_codec = "strata";
    hello.color_codec = "jpeg";
    hello.features = {wire::Feature::publish, wire::Feature::sends_only};
    say(alice, hello);
    join(bob, "publish");
    actions = session.take_actions();
    ASSERT_EQ(sent<wire::Welcome>(alice).size(), 1u);
    EXPECT_TRUE(sent<wire::Welcome>(alice)[0].cameras.empty());
    EXPECT_EQ(sent<wire::Welcome>(alice)[0].features.size(), 2u);
    EXPECT_TRUE(sent<wire::Settings>(alice).empty());
    const auto of_bob = publish(bob, 1);
    EXPECT_TRUE(sent<wire::CamerasAdded>(alice).empty());
    EXPECT_EQ(of_bob.size(), 1u);
    EXPECT_TRUE(sent<wire::Encode>(bob).empty()) << "nobody receives it";

    const auto own = publish(alice, 1);
    ASSERT_EQ(own.size(), 1u);
    ASSERT_FALSE(sent<wire::Encode>(alice).empty());
    EXPECT_EQ(sent<wire::Encode>(alice).back().settings.size(), 2u) << "bob receives it";
    // Lost messages are sent again.
    session.resynchronise(alice);
    actions = session.take_actions();
    EXPECT_TRUE(sent<wire::Welcome>(alice).at(0).cameras.empty());
    EXPECT_EQ(sent<wire::Encode>(alice).size(), 1u);
    EXPECT_TRUE(sent<wire::CameraState>(alice).empty());
}

TEST_F(SessionOfMany, CamerasWithoutAPlaceStandBesideEachOther) {
    join(alice, "publish");
    join(bob, "publish");
    const auto first = publish(alice, 1);
    const auto second = publish(bob, 1);
    session.on_closed(alice);
    const auto third = publish(bob, 1);
    const auto x_of = [&](CameraId id) {
        const auto& calibration = session.streams().cameras().find(id)->description().calibration;
        return decode_calibration(calibration)->room_from_camera.translation.x;
    };
    constexpr double apart = SessionCameras::unregistered_distance_m;
    EXPECT_EQ(x_of(CameraId{0}), 0);
    EXPECT_EQ(x_of(second[0]), 2 * apart);
    EXPECT_EQ(x_of(third[0]), apart) << "where the one that left stood";
}

TEST_F(SessionOfMany, NobodySendsPicturesOfAnothersCamera) {
    join(alice, "publish");
    join(bob, "publish");
    join(carol);
    const auto own = publish(alice, 1);
    const SettingId setting = sent<wire::Encode>(alice).at(0).settings.at(0).setting;
    EXPECT_TRUE(session.on_media_from(bob, picture(own.at(0), setting), now).receivers.empty());
    actions = session.take_actions();
    ASSERT_EQ(sent<wire::Refused>(bob).size(), 1u);
    ASSERT_EQ(all<action::Close>().size(), 1u);
    EXPECT_EQ(all<action::Close>()[0].participant, bob);
    EXPECT_FALSE(session.on_media_from(alice, picture(own.at(0), setting), now).receivers.empty());
    // Nor of the host's.
    EXPECT_TRUE(session.on_media_from(alice, picture(CameraId{0}, setting), now).receivers.empty());
    actions = session.take_actions();
    EXPECT_EQ(all<action::Close>().size(), 1u);
}

TEST_F(SessionOfMany, DamagedPicturesEndTheConnectionOfTheirPublisherOnly) {
    join(alice, "publish");
    join(bob);
    (void)publish(alice, 1);
    EXPECT_TRUE(session.on_media_from(alice, Bytes(70, std::byte{0xff}), now).receivers.empty());
    actions = session.take_actions();
    ASSERT_EQ(all<action::Close>().size(), 1u);
    EXPECT_EQ(all<action::Close>()[0].participant, alice);
}

TEST_F(SessionOfMany, CamerasLeaveWithTheirPublisherAndNumbersNeverComeAgain) {
    join(alice, "publish");
    join(bob);
    const auto first = publish(alice, 2);
    session.on_closed(alice);
    actions = session.take_actions();
    ASSERT_EQ(sent<wire::CamerasRemoved>(bob).size(), 1u);
    EXPECT_EQ(sent<wire::CamerasRemoved>(bob)[0].cameras, first);
    EXPECT_EQ(session.streams().cameras().size(), 1u);

    join(carol, "publish");
    const auto second = publish(carol, 2);
    EXPECT_EQ(second, (std::vector{CameraId{3}, CameraId{4}}));
    const SettingId setting = sent<wire::Encode>(carol).at(0).settings.at(0).setting;
    say(carol, wire::Unpublish{{second[0], first[0], CameraId{0}}});
    actions = session.take_actions();
    EXPECT_EQ(sent<wire::CamerasRemoved>(bob).at(0).cameras, std::vector{second[0]})
        << "others' cameras stay";
    // A picture that was in flight when the camera left is no fault.
    EXPECT_TRUE(session.on_media_from(carol, picture(second[0], setting), now).receivers.empty());
    actions = session.take_actions();
    EXPECT_TRUE(all<action::Close>().empty());
}

TEST_F(SessionOfMany, ACameraThatComesOrLeavesChangesNothingOfTheOthers) {
    join(alice, "publish");
    join(bob, "watch", "zstd");
    join(carol, "publish");
    const auto stays = publish(alice, 1);
    session.on_tick(now);
    (void)session.take_actions();
    for (int i = 0; i < 5; ++i) {
        now += 1s;
        const auto comes = publish(carol, 1);
        ASSERT_EQ(comes.size(), 1u);
        for (const bool leaves : {false, true}) {
            if (leaves) {
                say(carol, wire::Unpublish{comes});
                actions = session.take_actions();
            }
            EXPECT_TRUE(all<action::ChangeSettings>().empty()) << "the host's own camera";
            EXPECT_TRUE(sent<wire::Encode>(alice).empty());
            EXPECT_EQ(codec_of(bob, depth_stream(stays[0])), "");
            EXPECT_EQ(codec_of(bob, depth_stream(CameraId{0})), "");
            session.on_tick(now);
            actions = session.take_actions();
            EXPECT_TRUE(sent<wire::EncodeKey>(alice).empty());
            EXPECT_TRUE(all<action::RequestKey>().empty());
        }
    }
}

TEST_F(SessionOfMany, CodecsAreChosenForEachCamera) {
    join(alice, "publish");
    join(bob);
    const CameraId face = publish(alice, 1).at(0);
    say(bob, wire::ChooseCodecs{"rvl", "", {face}});
    actions = session.take_actions();
    EXPECT_EQ(codec_of(bob, depth_stream(face)), "rvl");
    EXPECT_EQ(codec_of(bob, depth_stream(CameraId{0})), "") << "stays";
    EXPECT_EQ(session.depth_settings(CameraId{0})[0].codec, "strata");
    EXPECT_EQ(session.depth_settings(face)[0].codec, "rvl");

    say(bob, wire::ChooseCodecs{"zstd", "", {}});
    actions = session.take_actions();
    EXPECT_EQ(codec_of(bob, depth_stream(face)), "zstd") << "a choice for all is for all";
    EXPECT_EQ(codec_of(bob, depth_stream(CameraId{0})), "zstd");
    const CameraId other = publish(alice, 1).at(0);
    EXPECT_EQ(codec_of(bob, depth_stream(other)), "zstd") << "also for those that come";
    say(bob, wire::ChooseCodecs{"rvl", "", {CameraId{999}}});
    actions = session.take_actions();
    EXPECT_TRUE(sent<wire::Settings>(bob).empty());
}

TEST_F(SessionOfMany, EachCameraHasPlacesOfItsOwn) {
    join(alice, "watch", "trvl");
    join(bob, "watch", "rvl");
    join(carol, "watch", "zstd");
    join(dave, "publish", "ans");
    actions = session.take_actions();
    EXPECT_NE(codec_of(dave, depth_stream(CameraId{0})), "ans") << "three are in use";
    // A camera that only two of them get in codecs of their own has room.
    const CameraId face = publish(dave, 1).at(0);
    say(alice, wire::ChooseCodecs{"rvl", "", {face}});
    say(bob, wire::ChooseCodecs{"ans", "", {face}});
    actions = session.take_actions();
    EXPECT_EQ(codec_of(bob, depth_stream(face)), "ans");
    EXPECT_EQ(session.depth_settings(face).size(), 3u);
}

TEST_F(SessionOfMany, RequestsForKeyFramesReachThePublisher) {
    join(alice, "publish");
    join(bob);
    const CameraId face = publish(alice, 1).at(0);
    const SettingId setting = sent<wire::Encode>(alice).at(0).settings.at(0).setting;
    session.on_tick(now);
    (void)session.take_actions();
    now += 1s;
    say(bob, wire::RequestKey{depth_stream(face), setting});
    say(alice, wire::RequestKey{depth_stream(face), setting});  // it does not get it
    session.on_tick(now);
    actions = session.take_actions();
    ASSERT_EQ(sent<wire::EncodeKey>(alice).size(), 1u);
    EXPECT_EQ(sent<wire::EncodeKey>(alice)[0].setting, setting);
    EXPECT_TRUE(all<action::RequestKey>().empty()) << "the host encodes nothing of it";
}

TEST_F(SessionOfMany, StatesAreBelievedOfOnesOwnCamerasOnly) {
    join(alice, "publish");
    join(bob, "publish");
    const CameraId face = publish(alice, 1).at(0);
    say(bob, wire::CameraState{face, wire::CameraCondition::failed, wire::as_written("a lie"), ""});
    say(bob, wire::CameraState{CameraId{0}, wire::CameraCondition::failed,
                               wire::as_written("a lie"), ""});
    actions = session.take_actions();
    EXPECT_TRUE(sent<wire::CameraState>(bob).empty());
    EXPECT_TRUE(sent<wire::CameraState>(alice).empty());
    say(alice,
        wire::CameraState{face, wire::CameraCondition::stale, wire::as_written("covered"), ""});
    actions = session.take_actions();
    ASSERT_EQ(sent<wire::CameraState>(bob).size(), 1u);
    join(carol);
    actions = session.take_actions();
    EXPECT_EQ(sent<wire::CameraState>(carol).at(0).problem, wire::as_written("covered"));
}

TEST_F(SessionOfMany, CamerasAreBoundedInNumberAndInPixels) {
    join(alice, "publish");
    (void)session.take_actions();
    EXPECT_TRUE(publish(alice, max_published + 1).empty());
    EXPECT_EQ(publish(alice, max_published).size(), max_published);
    EXPECT_TRUE(publish(alice, 1).empty());
    EXPECT_FALSE(sent<wire::Published>(alice).at(0).problem.empty());
    join(bob, "publish");
    say(bob, wire::Publish{{{"too large", true, 30, calibration({2048, 2049})}}});
    say(bob, wire::Publish{{{"no calibration", true, 30, {}}}});
    say(bob, wire::Publish{{{"no rate", true, -1, calibration()}}});
    say(bob, wire::Publish{std::vector<wire::OfferedCamera>(
                 5, {"too many pixels", true, 30, calibration({2048, 2048}, {4096, 3072})})});
    actions = session.take_actions();
    ASSERT_EQ(sent<wire::Published>(bob).size(), 4u);
    for (const wire::Published& answer : sent<wire::Published>(bob)) {
        EXPECT_TRUE(answer.cameras.empty());
        EXPECT_FALSE(answer.problem.empty());
    }
    EXPECT_EQ(session.streams().cameras().size(), 1 + max_published);
    for (int i = 3; session.streams().cameras().size() < wire::max_cameras && i < 60; ++i) {
        join(ParticipantId(i), "publish");
        (void)publish(ParticipantId(i), 2);
    }
    EXPECT_EQ(session.streams().cameras().size(), wire::max_cameras);
    EXPECT_TRUE(publish(bob, 1).empty());
}

TEST_F(SessionOfMany, OfferingTooOftenIsAnsweredNotQueued) {
    join(alice, "publish");
    (void)session.take_actions();
    const auto limit = RequestBudget::limits[std::size_t(RequestBudget::Kind::publish)];
    int taken = 0;
    for (int i = 0; i < 2 * limit.at_once; ++i) {
        const auto cameras = publish(alice, 1);
        taken += !cameras.empty();
        ASSERT_EQ(sent<wire::Published>(alice).size(), 1u);
        say(alice, wire::Unpublish{cameras});
    }
    EXPECT_LE(taken, limit.at_once);
    EXPECT_EQ(session.streams().cameras().size(), 1u) << "taking back is never refused";
}

TEST_F(SessionOfMany, ALinkThatHasExpiredLetsNobodyInAndPutsNobodyOut) {
    join(alice, "short");
    actions = session.take_actions();
    EXPECT_EQ(sent<wire::Welcome>(alice).size(), 1u);
    now = from_us(5'000'000);
    join(bob, "short");
    session.on_tick(now);
    actions = session.take_actions();
    EXPECT_EQ(sent<wire::Refused>(bob).at(0).reason.code, wire::TextCode::link_expired);
    EXPECT_TRUE(session.participants().at(alice).takes_part());
    EXPECT_EQ(publish(alice, 1).size(), 1u);
}

}  // namespace
}  // namespace theatron::session
