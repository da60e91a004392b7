// SPDX-License-Identifier: Apache-2.0
#include "session/host_session.h"

#include "session/host_session_testing.h"

namespace theatron::session {
namespace {

TEST_F(Host, WelcomesAndStartsWithKeyFrames) {
    join(alice);
    const auto actions = session.take_actions();
    EXPECT_EQ(sent<wire::Welcome>(alice, actions).size(), 1u);
    const auto settings = sent<wire::Settings>(alice, actions);
    ASSERT_EQ(settings.size(), 1u);
    ASSERT_EQ(settings[0].settings.size(), 2u);
    EXPECT_EQ(settings[0].settings[0].codec, "trvl");
    EXPECT_EQ(count<action::ChangeSettings>(actions), 1);
    session.on_tick(now);
    EXPECT_EQ(count<action::RequestKey>(session.take_actions()), 2);
    EXPECT_EQ(session.receivers(StreamId{0}, settings[0].settings[0].setting), std::vector{alice});
}

TEST_F(Host, RefusesAWrongTokenWithASentence) {
    join(alice, "trvl", "guess");
    const auto actions = session.take_actions();
    ASSERT_EQ(sent<wire::Refused>(alice, actions).size(), 1u);
    EXPECT_NE(sent<wire::Refused>(alice, actions)[0].in_english.find("access code"),
              std::string::npos);
    EXPECT_TRUE(sent<wire::Welcome>(alice, actions).empty());
    EXPECT_EQ(count<action::Close>(actions), 1);
    // Nothing that follows counts any more.
    join(alice);
    say(alice, wire::Ping{});
    EXPECT_TRUE(sent<wire::Pong>(alice, session.take_actions()).empty());
}

TEST_F(Host, RefusesAnUnknownCodec) {
    join(alice, "bad");
    EXPECT_EQ(sent<wire::Refused>(alice, session.take_actions())[0].reason,
              wire::as_written("There is no codec bad."));
}

// Publishers, recorders, viewers and pages say the same Join; the kind makes no difference.
TEST_F(Host, RefusesOtherProtocolsWithBothNumbersAndWhatToUpdate) {
    std::uint32_t next = 40;
    const auto answer = [&](int lowest, int highest, bool records, wire::Feature feature) {
        const ParticipantId id{next++};
        session.on_connected(id, now);
        wire::Join join;
        join.protocol_min = std::uint16_t(lowest);
        join.protocol_max = std::uint16_t(highest);
        join.token = "secret";
        join.depth_codec = "trvl";
        join.color_codec = "jpeg";
        join.records = records;
        join.features = {feature};
        say(id, join);
        return session.take_actions();
    };
    const auto refusal = [&](const auto& actions) {
        for (const auto& a : all<action::Send>(actions))
            if (const auto* refused = std::get_if<wire::Refused>(&a.message))
                return refused->in_english;
        return std::string();
    };
    const int oldest = wire::protocol_min, newest = wire::protocol_max;
    const auto text = [](int number) { return std::to_string(number); };
    for (const bool records : {false, true})
        for (const auto feature : {wire::Feature::room, wire::Feature::sends_only}) {
            EXPECT_EQ(refusal(answer(newest + 1, newest + 2, records, feature)),
                      "This host is older than your Theatron (protocol " + text(newest) +
                          ", you need " + text(newest + 1) + "); update the host.");
            EXPECT_EQ(refusal(answer(oldest - 2, oldest - 1, records, feature)),
                      "Your Theatron is too old for this host (protocol " + text(oldest - 1) +
                          ", it needs " + text(oldest) + "); update it.");
            // A newer program that still speaks this protocol, and an older one that knew more.
            const ParticipantId id{next};
            const auto welcomes =
                sent<wire::Welcome>(id, answer(oldest - 1, newest + 1, records, feature));
            ASSERT_EQ(welcomes.size(), 1u);
            EXPECT_EQ(welcomes[0].protocol, newest);
        }
}

TEST_F(Host, NothingIsDoneForWhoHasNotJoined) {
    session.on_connected(alice, now);
    say(alice, wire::ChooseCodecs{"rvl", ""});
    EXPECT_EQ(count<action::Close>(session.take_actions()), 1);
    session.on_connected(bob, now);
    now += Admission::join_deadline + 1s;
    session.on_tick(now);
    EXPECT_EQ(count<action::Close>(session.take_actions()), 1);
}

TEST_F(Host, ParticipantsShareAnEncoderAndChangeItAlone) {
    join(alice);
    join(bob);
    session.take_actions();
    EXPECT_EQ(session.depth_settings().size(), 1u);
    say(bob, wire::ChooseCodecs{"rvl", ""});
    const auto actions = session.take_actions();
    EXPECT_EQ(session.depth_settings().size(), 2u);
    EXPECT_TRUE(sent<wire::Settings>(alice, actions).empty());
    ASSERT_EQ(sent<wire::Settings>(bob, actions).size(), 1u);
    EXPECT_EQ(session.receivers(StreamId{0}, session.depth_settings()[0].id), std::vector{alice});
    EXPECT_EQ(session.receivers(StreamId{1}, session.color_settings()[0].id),
              (std::vector{alice, bob}));
    session.on_closed(alice);
    EXPECT_EQ(session.depth_settings().size(), 1u);
    EXPECT_EQ(session.depth_settings()[0].codec, "rvl");
}

TEST_F(Host, AParticipantThatAsksForNoDepthGetsColorAlone) {
    join(alice);
    session.take_actions();
    say(alice, wire::ChooseCodecs{"none", "", {CameraId{0}}});
    auto actions = session.take_actions();
    const auto settings = sent<wire::Settings>(alice, actions);
    ASSERT_EQ(settings.size(), 1u);
    EXPECT_EQ(settings[0].settings[0].codec, "none");
    EXPECT_TRUE(settings[0].note.empty());
    EXPECT_TRUE(session.depth_settings().empty()) << "it is not even encoded";
    ASSERT_EQ(session.color_settings().size(), 1u);
    now += 1s;
    session.on_tick(now);
    actions = session.take_actions();
    for (const action::RequestKey& wanted : all<action::RequestKey>(actions))
        EXPECT_EQ(wanted.key.stream, StreamId{1});

    join(bob);
    wire::MediaHeader color;
    color.stream = StreamId{1};
    color.setting = session.color_settings()[0].id;
    EXPECT_EQ(session.on_media(color, 100, now).receivers, (std::vector{alice, bob}));
    wire::MediaHeader depth;
    depth.setting = session.depth_settings()[0].id;
    EXPECT_EQ(session.on_media(depth, 100, now).receivers, std::vector{bob});
}

TEST_F(Host, ABadWishKeepsTheOldCodecAndSaysSo) {
    join(alice);
    session.take_actions();
    say(alice, wire::ChooseCodecs{"bad", ""});
    const auto settings = sent<wire::Settings>(alice, session.take_actions());
    ASSERT_EQ(settings.size(), 1u);
    EXPECT_EQ(settings[0].note, wire::as_written("There is no codec bad."));
    EXPECT_EQ(session.depth_settings()[0].codec, "trvl");
}

TEST_F(Host, AFourthCodecIsServedTheNearestWithANote) {
    join(alice, "trvl");
    join(bob, "rvl");
    join(carol, "zstd");
    session.take_actions();
    join(dave, "zstd:level=3");
    const auto settings = sent<wire::Settings>(dave, session.take_actions());
    ASSERT_EQ(settings.size(), 1u);
    EXPECT_EQ(settings[0].settings[0].codec, "zstd");
    EXPECT_NE(wire::english(settings[0].note).find("zstd:level=3"), std::string::npos);
}

TEST_F(Host, OnlyOwnStreamsMayBeAskedForKeyFrames) {
    join(alice);
    session.on_tick(now);
    session.take_actions();
    now += 1s;
    say(alice, wire::RequestKey{StreamId{0}, SettingId{999}});
    say(alice, wire::RequestKey{StreamId{50}, session.depth_settings()[0].id});
    session.on_tick(now);
    EXPECT_EQ(count<action::RequestKey>(session.take_actions()), 0);
    say(alice, wire::RequestKey{StreamId{0}, session.depth_settings()[0].id});
    session.on_tick(now);
    EXPECT_EQ(count<action::RequestKey>(session.take_actions()), 1);
}

TEST_F(Host, TellsJoinersAboutCameras) {
    session.on_camera({CameraId{0}, wire::CameraCondition::failed, wire::as_written("unplugged")});
    join(alice);
    const auto states = sent<wire::CameraState>(alice, session.take_actions());
    ASSERT_EQ(states.size(), 1u);
    EXPECT_EQ(states[0].problem, wire::as_written("unplugged"));
}

TEST_F(Host, DamagedMessagesEndTheConnection) {
    join(alice);
    session.take_actions();
    session.on_control(alice, Bytes(20, std::byte{0xff}), now);
    EXPECT_EQ(count<action::Close>(session.take_actions()), 1);
}

TEST_F(Host, ARecordersEncodingStaysWhateverOthersDo) {
    join(alice, "trvl");
    join(bob, "rvl");
    join(carol, "zstd");
    session.take_actions();
    join_to_record(dave, "strata");
    auto actions = session.take_actions();
    EXPECT_EQ(count<action::KeepEverything>(actions), 1);
    const auto given = sent<wire::Settings>(dave, actions);
    ASSERT_EQ(given.size(), 1u);
    EXPECT_EQ(given[0].settings[0].codec, "trvl");
    EXPECT_NE(wire::english(given[0].note).find("strata"), std::string::npos)
        << "the reason is reported";

    // A place becomes free, the participant whose setting it shares leaves, others choose again.
    session.on_closed(bob);
    session.on_closed(alice);
    say(carol, wire::ChooseCodecs{"raw", ""});
    join(alice, "lz4");
    join(bob, "ans");
    session.on_region(true);
    EXPECT_TRUE(sent<wire::Settings>(dave, session.take_actions()).empty());
    EXPECT_EQ(session.receivers(StreamId{0}, given[0].settings[0].setting),
              (std::vector{bob, dave}));

    // It may change its mind itself.
    session.on_closed(bob);
    session.take_actions();
    say(dave, wire::ChooseCodecs{"strata", ""});
    const auto wished = sent<wire::Settings>(dave, session.take_actions());
    ASSERT_EQ(wished.size(), 1u);
    EXPECT_EQ(wished[0].settings[0].codec, "strata");
}

TEST_F(Host, WhoLostMessagesIsToldEverythingAgain) {
    join(alice);
    join(bob);
    session.on_camera(
        {CameraId{0}, wire::CameraCondition::stale, wire::as_written("It is dark."), ""});
    session.set_renderer(wire::SetRenderer{"mesh", true});
    session.take_actions();
    session.resynchronise(alice);
    const auto actions = session.take_actions();
    EXPECT_EQ(sent<wire::Welcome>(alice, actions).size(), 1u);
    EXPECT_EQ(sent<wire::CameraState>(alice, actions).size(), 1u);
    EXPECT_EQ(sent<wire::Settings>(alice, actions).size(), 1u);
    EXPECT_EQ(sent<wire::Delivery>(alice, actions).size(), 1u);
    EXPECT_EQ(sent<wire::SetRenderer>(alice, actions).size(), 1u);
    EXPECT_TRUE(sent<wire::Settings>(bob, actions).empty());
    EXPECT_EQ(count<action::ChangeSettings>(actions), 0) << "nothing is encoded in another way";

    session.resynchronise(ParticipantId{77});
    EXPECT_TRUE(session.take_actions().empty());
}

}  // namespace
}  // namespace theatron::session
