// SPDX-License-Identifier: Apache-2.0
// The ways out of a session: whichever a participant takes, nothing of it stays.
#include <gtest/gtest.h>

#include <algorithm>

#include "session/host_session_testing.h"

namespace theatron::session {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

enum class Way : std::uint8_t { closed, removed, ended };

// Bob shares a camera, looks back, gets depth in a codec of his own, stands in the room, and gets
// the camera of Carol from a relay, Dave.
class Leaving : public Host, public ::testing::WithParamInterface<Way> {
protected:
    Leaving() {
        HostSession::Config c = config();
        c.admission.tokens.push_back({"boss", Role::operator_, {}});
        c.admission.tokens.push_back({"relay", Role::relay, {}});
        c.past.reach = seconds(60);
        c.make_secret = [] { return Bytes(wire::relay_secret_size, std::byte{7}); };
        session_.emplace(std::move(c));
        come(alice, "boss", "trvl");
        come(carol, "publish", "trvl");
        come(dave, "relay", "trvl");
        tell(dave, wire::OfferRelay{{"10.0.0.5"}, 4000, Bytes(wire::fingerprint_size)});
        publish(carol);
        come(bob, "publish", "rvl");
        publish(bob);
        film();
        tell(bob, wire::LookBack{1, seconds(2)});
        const auto setting = session_->streams().cameras().find(of_carol)->receivers.at(bob).depth;
        tell(bob, wire::Report{{{depth_stream(of_carol), 0, 0, 0, {}, setting}}, ""});
        relayed_ = setting;
        (void)session_->take_actions();
    }

    void come(ParticipantId id, const std::string& token, const std::string& depth) {
        session_->on_connected(id, now, "192.0.2." + std::to_string(std::uint32_t(id)));
        wire::Join hello;
        hello.token = token;
        hello.depth_codec = depth;
        hello.color_codec = "jpeg";
        hello.features = {wire::Feature::publish, wire::Feature::room, wire::Feature::look_back,
                          token == "relay" ? wire::Feature::relays : wire::Feature::relay};
        tell(id, hello);
    }
    void tell(ParticipantId id, const wire::ToHost& message) {
        session_->on_control(id, wire::encode(message), now);
    }
    void publish(ParticipantId id) {
        wire::Publish offer;
        offer.cameras.push_back({"own", false, 30, config().cameras[0].calibration});
        tell(id, offer);
    }
    // The host's camera for some seconds, which are kept.
    void film() {
        for (FrameNumber n = 0; n < 50; ++n, now += milliseconds(100)) {
            wire::MediaHeader header;
            header.setting = session_->depth_settings().at(0).id;
            header.frame = header.reference = n;
            header.key = true;
            header.captured = header.moment = now;
            Bytes message(wire::media_header_size);
            wire::write_media_header(header, message.data());
            session_->keep(header, message, now);
            session_->on_tick(now);
        }
    }
    void leave() {
        switch (GetParam()) {
            case Way::closed:
                session_->on_closed(bob);
                break;
            case Way::removed:
                tell(alice, wire::Manage{1, wire::ManageAction::remove, bob, {}});
                break;
            case Way::ended:
                session_->end();
                break;
        }
        left_ = session_->take_actions();
    }
    bool is_in_room() const {
        const RoomObjects objects = session_->room().snapshot().objects;
        return std::any_of(objects.begin(), objects.end(), [](const auto& entry) {
            return entry.second.kind == ObjectKind::person && entry.second.creator == bob;
        });
    }
    bool is_encoded(const std::string& codec) const {
        const auto& settings = session_->depth_settings();
        return std::any_of(settings.begin(), settings.end(),
                           [&](const ActiveSetting& setting) { return setting.codec == codec; });
    }
    std::size_t pictures_of_the_past() {
        std::size_t count = 0;
        for (const LookBacks::Due& due : session_->take_past(now + seconds(1)))
            count += due.receiver == bob;
        return count;
    }

    static constexpr CameraId of_carol{1}, of_bob{2};
    std::optional<HostSession> session_;
    SettingId relayed_{};
    std::vector<Action> left_;
};

TEST_P(Leaving, ItsCamerasLeave) {
    ASSERT_EQ(session_->streams().cameras().of(bob), std::vector{of_bob});
    leave();
    EXPECT_TRUE(session_->streams().cameras().of(bob).empty());
}

TEST_P(Leaving, ItsCamerasAreInterruptedOnlyWhereNobodyDecidedIt) {
    leave();
    const auto told = messages_to<wire::CamerasRemoved>(carol, left_);
    ASSERT_EQ(told.size(), GetParam() == Way::ended ? 0u : 1u);
    if (told.empty())
        return;  // the session has ended for all
    EXPECT_EQ(told[0].cameras, std::vector{of_bob});
    EXPECT_EQ(told[0].interrupted, GetParam() == Way::closed);
}

TEST_P(Leaving, CamerasThatItTookBackBeforeAreNotInterrupted) {
    tell(bob, wire::Unpublish{{of_bob}});
    const auto told = messages_to<wire::CamerasRemoved>(carol, session_->take_actions());
    ASSERT_EQ(told.size(), 1u);
    EXPECT_FALSE(told[0].interrupted);
    leave();
    EXPECT_TRUE(messages_to<wire::CamerasRemoved>(carol, left_).empty());
}

TEST_P(Leaving, ItIsNotInTheRoom) {
    ASSERT_TRUE(is_in_room());
    leave();
    EXPECT_FALSE(is_in_room());
}

TEST_P(Leaving, NothingIsEncodedForItAlone) {
    ASSERT_TRUE(is_encoded("rvl"));
    leave();
    EXPECT_FALSE(is_encoded("rvl"));
    EXPECT_GT(actions_of<action::ChangeSettings>(left_).size(), 0u) << "the encoders are told";
}

TEST_P(Leaving, ItIsShownNoPast) {
    ASSERT_GT(pictures_of_the_past(), 0u);
    leave();
    now += seconds(2);
    EXPECT_EQ(pictures_of_the_past(), 0u);
    EXPECT_FALSE(session_->past_due());
}

TEST_P(Leaving, NothingGoesToItFromARelay) {
    ASSERT_TRUE(session_->relays().is_by_relay(bob, relayed_));
    leave();
    EXPECT_FALSE(session_->relays().is_by_relay(bob, relayed_));
    const auto told = messages_to<wire::RelayReceivers>(dave, left_);
    const bool is_named = std::any_of(told.begin(), told.end(), [](const auto& list) {
        return std::any_of(list.receivers.begin(), list.receivers.end(),
                           [](const auto& receiver) { return receiver.participant == bob; });
    });
    EXPECT_FALSE(is_named);
    if (GetParam() != Way::ended)
        EXPECT_FALSE(told.empty()) << "the relay ends its connection";
}

TEST_P(Leaving, NothingOfItCountsAnyMore) {
    leave();
    tell(bob, wire::Ping{});
    publish(bob);
    const auto answered = session_->take_actions();
    EXPECT_TRUE(messages_to<wire::Pong>(bob, answered).empty());
    EXPECT_TRUE(messages_to<wire::Published>(bob, answered).empty());
}

INSTANTIATE_TEST_SUITE_P(EachWay, Leaving,
                         ::testing::Values(Way::closed, Way::removed, Way::ended));

}  // namespace
}  // namespace theatron::session
