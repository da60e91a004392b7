// SPDX-License-Identifier: Apache-2.0
#include "session/look_backs.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "session/host_session_testing.h"

namespace theatron::session {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using wire::ManageRefusal;

// Alice watches, and Bob comes later.
class LookingBack : public Host {
protected:
    LookingBack() {
        HostSession::Config c = config();
        c.past.reach = seconds(60);
        session_.emplace(std::move(c));
        come(alice, true);
    }
    std::vector<Action> tell(ParticipantId id, const wire::ToHost& message) {
        session_->on_control(id, wire::encode(message), now);
        return session_->take_actions();
    }
    void come(ParticipantId id, bool can_look_back, bool records = false,
              const char* token = "secret", const Bytes& person = {}) {
        session_->on_connected(id, now);
        wire::Join hello;
        hello.person = person;
        hello.token = token;
        hello.depth_codec = "trvl";
        hello.color_codec = "jpeg";
        hello.records = records;
        hello.features = {wire::Feature::publish};
        if (can_look_back)
            hello.features.push_back(wire::Feature::look_back);
        last_ = tell(id, hello);
    }
    ManageRefusal look_back(ParticipantId id, Duration ago) {
        last_ = tell(id, wire::LookBack{5, ago});
        return messages_to<wire::Managed>(id, last_).at(0).refusal;
    }
    std::vector<wire::StreamSetting> told(ParticipantId id) {
        const auto messages = messages_to<wire::Settings>(id, last_);
        return messages.empty() ? std::vector<wire::StreamSetting>() : messages.back().settings;
    }
    Bytes picture(CameraId camera, bool is_depth, SettingId setting) {
        wire::MediaHeader h;
        h.stream = is_depth ? depth_stream(camera) : color_stream(camera);
        h.setting = setting;
        h.frame = frame_;
        h.reference = frame_;
        h.key = frame_ % 10 == 0 || !is_depth;
        if (!h.key)
            h.reference = frame_ - 1;
        h.captured = h.moment = now;
        h.payload_size = 4;
        Bytes bytes(wire::media_header_size + 4, std::byte(frame_));
        wire::write_media_header(h, bytes.data());
        return bytes;
    }
    // The host's camera for some time, 10 pictures a second. Returns who got the last depth.
    std::vector<ParticipantId> film(Duration time) {
        std::vector<ParticipantId> receivers;
        for (const TimePoint end = now + time; now < end; now += milliseconds(100)) {
            for (const bool is_depth : {true, false}) {
                const auto& settings =
                    is_depth ? session_->depth_settings({}) : session_->color_settings({});
                const Bytes bytes = picture({}, is_depth, settings.at(0).id);
                const auto header = wire::parse_media_header(bytes).value();
                const auto to = session_->on_media(header, bytes.size(), now).receivers;
                if (is_depth)
                    receivers = to;
                session_->keep(header, bytes, now);
            }
            ++frame_;
            session_->on_tick(now);
            for (LookBacks::Due& due : session_->take_past(now))
                got_.push_back(std::move(due));
        }
        last_ = session_->take_actions();
        return receivers;
    }

    FrameNumber frame_ = 0;
    std::vector<Action> last_;
    std::vector<LookBacks::Due> got_;
    std::optional<HostSession> session_;
};

TEST_F(LookingBack, ALatecomerSeesThePastAndTheOthersThePresent) {
    film(seconds(30));
    come(bob, true);
    EXPECT_EQ(film(seconds(1)), (std::vector{alice, bob}));
    EXPECT_TRUE(got_.empty());

    const TimePoint asked = now;
    EXPECT_EQ(look_back(bob, seconds(20)), ManageRefusal::none);
    const auto settings = told(bob);
    ASSERT_EQ(settings.size(), 2u);
    for (const wire::StreamSetting& s : settings)
        EXPECT_TRUE(s.past);
    EXPECT_NE(settings[0].setting, session_->depth_settings({}).at(0).id);
    EXPECT_EQ(settings[0].codec, "trvl");
    EXPECT_EQ(settings[1].codec, "jpeg");
    EXPECT_EQ(film(seconds(5)), std::vector{alice});

    // From the key frame before, at the pace at which they came.
    ASSERT_GE(got_.size(), 90u);
    EXPECT_TRUE(got_[0].header.key);
    FrameNumber expected = got_[0].header.frame;
    for (const LookBacks::Due& due : got_) {
        EXPECT_EQ(due.receiver, bob);
        if (!is_depth(due.header.stream))
            continue;
        EXPECT_EQ(due.header.setting, settings[0].setting);
        EXPECT_EQ(wire::parse_media_header(*due.message).value(), due.header);
        EXPECT_EQ(due.message->back(), std::byte(due.header.frame));
        EXPECT_EQ(due.header.frame, expected++);
    }
    const Duration behind = asked - got_[0].header.captured;
    EXPECT_GE(behind, seconds(20));
    EXPECT_LE(behind, seconds(22));
    EXPECT_NEAR(to_seconds(now - got_.back().header.captured), to_seconds(behind), 0.21);

    got_.clear();
    EXPECT_EQ(look_back(bob, {}), ManageRefusal::none);
    ASSERT_EQ(told(bob).size(), 2u);
    for (const wire::StreamSetting& s : told(bob))
        EXPECT_FALSE(s.past);
    EXPECT_EQ(told(bob)[0].setting, session_->depth_settings({}).at(0).id);
    EXPECT_EQ(film(seconds(1)), (std::vector{alice, bob}));
    EXPECT_TRUE(got_.empty());
}

TEST_F(LookingBack, DoesNotGoBehindTheMomentAtWhichAnOperatorLetsIn) {
    HostSession::Config c = config();
    c.past.reach = seconds(60);
    c.admission.asks = true;
    session_.emplace(std::move(c));
    come(alice, true, false, "publish");  // has not to ask
    film(seconds(20));
    const FrameNumber first_to_see = frame_;
    const auto come_again = [&] { come(bob, true, false, "secret", Bytes(16, std::byte(7))); };
    come_again();
    EXPECT_EQ(session_->manage({0, wire::ManageAction::admit, bob, {}}, now), ManageRefusal::none);
    EXPECT_EQ(look_back(bob, seconds(10)), ManageRefusal::nothing_kept);
    film(seconds(10));
    // Nor on a later connection, which sees what came since.
    session_->on_closed(bob);
    come_again();
    EXPECT_EQ(look_back(bob, seconds(60)), ManageRefusal::none);
    film(seconds(1));
    ASSERT_FALSE(got_.empty());
    EXPECT_GE(got_.at(0).header.frame, first_to_see);
    EXPECT_LE(got_.at(0).header.frame, first_to_see + 20);
    EXPECT_EQ(look_back(bob, Duration(0)), ManageRefusal::none) << "back to the present";
}

TEST_F(LookingBack, EveryLookHasNumbersOfItsOwn) {
    film(seconds(10));
    EXPECT_EQ(look_back(alice, seconds(2)), ManageRefusal::none);
    const auto first = told(alice);
    EXPECT_EQ(look_back(alice, seconds(5)), ManageRefusal::none);
    const auto second = told(alice);
    ASSERT_EQ(first.size(), 2u);
    ASSERT_EQ(second.size(), 2u);
    EXPECT_NE(first[0].setting, second[0].setting);
}

TEST_F(LookingBack, ReachesAsFarAsIsKept) {
    EXPECT_EQ(look_back(alice, seconds(10)), ManageRefusal::nothing_kept);
    film(seconds(5));
    EXPECT_EQ(look_back(alice, seconds(60)), ManageRefusal::none);
    film(milliseconds(100));
    EXPECT_EQ(got_.at(0).header.frame, 0u);
}

TEST_F(LookingBack, IsNotForRecordersNorWhereNothingIsKept) {
    film(seconds(5));
    come(carol, true, true);
    EXPECT_EQ(look_back(carol, seconds(3)), ManageRefusal::nothing_kept);
    come(dave, false);
    EXPECT_EQ(look_back(dave, seconds(3)), ManageRefusal::nothing_kept);
    session.on_connected(bob, now);  // a host without a past
    wire::Join hello;
    hello.token = "secret";
    hello.depth_codec = "trvl";
    hello.color_codec = "jpeg";
    hello.features = {wire::Feature::look_back};
    say(bob, hello);
    EXPECT_TRUE(sent<wire::Welcome>(bob, session.take_actions()).at(0).features.empty());
}

TEST_F(LookingBack, SettingsThatChangeMeanwhileAreToldWhenItIsOver) {
    film(seconds(10));
    come(bob, true);
    EXPECT_EQ(look_back(bob, seconds(5)), ManageRefusal::none);
    last_ = tell(bob, wire::ChooseCodecs{"rvl", "", {}});
    EXPECT_TRUE(told(bob).empty());
    EXPECT_EQ(look_back(bob, milliseconds(900)), ManageRefusal::none);
    ASSERT_EQ(told(bob).size(), 2u);
    EXPECT_EQ(told(bob)[0].codec, "rvl");
    EXPECT_FALSE(told(bob)[0].past);
}

TEST_F(LookingBack, EndsWhenTheStateIsSentAgain) {
    film(seconds(10));
    EXPECT_EQ(look_back(alice, seconds(5)), ManageRefusal::none);
    session_->resynchronise(alice);
    last_ = session_->take_actions();
    ASSERT_FALSE(told(alice).empty());
    EXPECT_FALSE(told(alice)[0].past);
    EXPECT_EQ(film(seconds(1)), std::vector{alice});
    EXPECT_TRUE(got_.empty());
}

TEST_F(LookingBack, IsNotBehindTheEndOfTheSession) {
    film(seconds(10));
    session_->end();
    EXPECT_EQ(session_->past_bytes(), 0u);
    EXPECT_FALSE(session_->past_due());
}

TEST_F(LookingBack, DoesNotGoBehindARegionThatAnOperatorHasDrawn) {
    film(seconds(10));
    EXPECT_GT(session_->past_bytes(), 0u);
    CameraAdjustment nudged;
    nudged.moved_m.x = 0.01;
    EXPECT_EQ(session_->adjust({}, nudged, "Ada", now), ManageRefusal::none);
    EXPECT_GT(session_->past_bytes(), 0u);
    CameraAdjustment region = nudged;
    region.region = PictureBox{8, 8, 16, 16};
    EXPECT_EQ(session_->adjust({}, region, "Ada", now), ManageRefusal::none);
    EXPECT_EQ(session_->past_bytes(), 0u);
    EXPECT_EQ(look_back(alice, seconds(5)), ManageRefusal::nothing_kept);
}

TEST_F(LookingBack, WaitsForNoAlarmWithoutAnybodyWhoLooks) {
    film(seconds(3));
    EXPECT_FALSE(session_->past_due());
    EXPECT_EQ(look_back(alice, seconds(2)), ManageRefusal::none);
    EXPECT_EQ(session_->past_due(), now);
    session_->on_closed(alice);
    EXPECT_FALSE(session_->past_due());
}

// Cameras of participants.
class LookingBackAtOthers : public LookingBack {
protected:
    // Bob publishes a camera, and its pictures come for five seconds.
    void publish(bool may_record, wire::CameraKind kind) {
        come(bob, true, false, "publish");
        wire::OfferedCamera offer;
        offer.name = "own";
        offer.calibration = config().cameras.at(0).calibration;
        offer.frames_per_second = 10;
        offer.may_record = may_record;
        offer.kind = kind;
        last_ = tell(bob, wire::Publish{{offer}});
        camera_ = messages_to<wire::Published>(bob, last_).at(0).cameras.at(0);
        const SettingId setting =
            messages_to<wire::Encode>(bob, last_).at(0).settings.at(0).setting;
        for (int i = 0; i < 50; ++i, ++frame_, now += milliseconds(100))
            EXPECT_EQ(session_->on_media_from(bob, picture(camera_, true, setting), now).receivers,
                      std::vector{alice});
        (void)session_->take_actions();
    }
    CameraId camera_{};
};

TEST_F(LookingBackAtOthers, ShowsACameraOfTheRoomThatMayBeRecordedButNotToItsPublisher) {
    publish(true, wire::CameraKind::room);
    EXPECT_EQ(look_back(alice, seconds(4)), ManageRefusal::none);
    ASSERT_EQ(told(alice).size(), 1u);
    EXPECT_EQ(told(alice)[0].stream, depth_stream(camera_));
    EXPECT_EQ(look_back(bob, seconds(4)), ManageRefusal::nothing_kept);
    // It is withdrawn.
    last_ = tell(bob, wire::Unpublish{{camera_}});
    EXPECT_EQ(session_->past_bytes(), 0u);
    EXPECT_TRUE(session_->take_past(now + seconds(2)).empty());
}

TEST_F(LookingBackAtOthers, KeepsNoCameraWhoseOwnerDoesNotAgree) {
    publish(false, wire::CameraKind::room);
    EXPECT_EQ(session_->past_bytes(), 0u);
}

TEST_F(LookingBackAtOthers, KeepsNobodysOwnCloud) {
    publish(true, wire::CameraKind::person);
    EXPECT_EQ(session_->past_bytes(), 0u);
}

}  // namespace
}  // namespace theatron::session
