// SPDX-License-Identifier: Apache-2.0
#include "session/voice_floor.h"

#include <gtest/gtest.h>

#include "session/host_session_testing.h"

namespace theatron::session {
namespace {

class Voices : public Host {
protected:
    static HostSession::Config people() {
        HostSession::Config c = config();
        c.admission.tokens = {{"or", Role::operator_, {}, "operator"},
                              {"see", Role::observer, {}, "observer"},
                              {"secret", Role::expert, {}, "a1"}};
        return c;
    }
    void come(ParticipantId id, const char* token, std::vector<wire::Feature> features = {}) {
        all_.on_connected(id, now);
        wire::Join hello;
        hello.token = token;
        hello.depth_codec = "trvl";
        hello.color_codec = "jpeg";
        hello.features = std::move(features);
        all_.on_control(id, wire::encode(hello), now);
    }
    std::vector<ParticipantId> heard_by(ParticipantId speaker) {
        return floor_.on_voice(speaker, all_, now).receivers;
    }
    using People = std::vector<ParticipantId>;

    HostSession all_{people()};
    VoiceFloor floor_;
};

TEST_F(Voices, EverybodyElseHearsASpeakerAndObserversDoNotSpeak) {
    come(alice, "or");
    come(bob, "secret");
    come(carol, "see");
    come(dave, "secret", {wire::Feature::sends_only});
    EXPECT_EQ(heard_by(alice), (People{bob, carol}));
    EXPECT_EQ(heard_by(bob), (People{alice, carol}));
    EXPECT_EQ(heard_by(carol), People{});
    EXPECT_EQ(all_.participants().at(carol).denied, 1u);
}

TEST_F(Voices, AMutedSpeakerIsHeardByNobodyFromTheNextPacketOn) {
    come(alice, "or");
    come(bob, "secret");
    EXPECT_EQ(heard_by(bob), People{alice});
    using Action = wire::ManageAction;
    all_.on_control(alice, wire::encode(wire::Manage{1, Action::mute, bob, {}}), now);
    EXPECT_EQ(heard_by(bob), People{});
    all_.on_control(alice, wire::encode(wire::Manage{2, Action::unmute, bob, {}}), now);
    EXPECT_EQ(heard_by(bob), People{alice});
}

TEST_F(Voices, ARecorderHearsOnlyThoseWhoAgreeAndOnlyWhileTheyDo) {
    come(alice, "secret", {wire::Feature::voice_consent, wire::Feature::room});
    all_.on_connected(bob, now);
    wire::Join recorder;
    recorder.token = "secret";
    recorder.depth_codec = "trvl";
    recorder.color_codec = "jpeg";
    recorder.records = true;
    all_.on_control(bob, wire::encode(recorder), now);
    come(carol, "secret");
    EXPECT_EQ(heard_by(alice), People{carol});
    all_.on_control(alice, wire::encode(wire::VoiceConsent{true}), now);
    EXPECT_EQ(heard_by(alice), (People{bob, carol}));
    // Nothing is recorded of a program that does not know of this, whatever it says.
    all_.on_control(carol, wire::encode(wire::VoiceConsent{true}), now);
    EXPECT_EQ(heard_by(carol), People{alice});
    all_.on_control(alice, wire::encode(wire::VoiceConsent{false}), now);
    EXPECT_EQ(heard_by(alice), People{carol});
    EXPECT_EQ(VoiceFloor::listeners_of_replay(all_), (People{alice, carol}));
}

TEST_F(Voices, AConnectionThatHasNotJoinedOrIsUnknownIsHeardByNobody) {
    come(alice, "or");
    all_.on_connected(bob, now);
    EXPECT_EQ(heard_by(bob), People{});
    EXPECT_EQ(heard_by(carol), People{});
}

TEST_F(Voices, PacketsBeyondTheLimitAreDroppedAndAFloodEndsTheConnection) {
    come(alice, "or");
    come(bob, "secret");
    int heard = 0, sent = 0;
    for (bool is_flood = false; !is_flood; ++sent) {
        ASSERT_LT(sent, 10'000);
        const VoiceFloor::Forward forward = floor_.on_voice(bob, all_, now);
        heard += int(forward.receivers.size());
        is_flood = forward.is_flood;
    }
    EXPECT_EQ(heard, int(VoiceFloor::limit.at_once));
    EXPECT_EQ(sent, int(VoiceFloor::limit.at_once + VoiceFloor::patience_limit.at_once) + 1);
    // Ten seconds of frames of 10 ms are fine.
    for (int i = 0; i < 1000; ++i) {
        EXPECT_EQ(heard_by(alice), People{bob}) << i;
        now += 10ms;
    }
}

}  // namespace
}  // namespace theatron::session
