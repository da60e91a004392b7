// SPDX-License-Identifier: Apache-2.0
#include "session/relay_paths.h"

#include <gtest/gtest.h>

#include "session/host_session_testing.h"

namespace theatron::session {
namespace {

using namespace std::chrono_literals;

constexpr SettingId path_depth{7}, path_color{9};
constexpr ParticipantId relay_one{50}, relay_two{51};

class RelayPathsTest : public ::testing::Test {
protected:
    RelayPathsTest()
        : paths(
              [this] {
                  Bytes secret(wire::relay_secret_size);
                  secret[0] = std::byte(++secrets);
                  return secret;
              },
              actions) {}

    void offer(ParticipantId relay, std::vector<std::string> networks = {},
               std::uint16_t port = 4000) {
        paths.offer(relay, {{"relay.example"}, port, Bytes(wire::fingerprint_size), networks});
    }
    // Each of these gets depth and colour of a camera.
    std::vector<StreamUse> used_by(std::vector<ParticipantId> receivers,
                                   SettingId depth_setting = path_depth) {
        std::vector<StreamUse> uses{{StreamId{0}, depth_setting, {}},
                                    {StreamId{1}, path_color, {}}};
        for (StreamUse& use : uses)
            for (const ParticipantId receiver : receivers)
                use.receivers.push_back({receiver, 2, 0});
        return uses;
    }
    void come(ParticipantId id, const std::string& address = "10.2.0.9") {
        paths.set_address(id, address);
        paths.join(id, now);
    }
    void report(ParticipantId id, std::vector<SettingId> relayed) {
        std::vector<wire::StreamReport> streams;
        for (const SettingId setting : relayed)
            streams.push_back({StreamId{0}, 0, 0, 0, {}, setting});
        paths.report(id, streams, now);
    }
    std::vector<Action> follow(const std::vector<StreamUse>& uses) {
        keys = paths.follow(uses, now);
        return std::exchange(actions, {});
    }
    bool by_host(ParticipantId id, bool key, SettingId setting = path_depth) {
        return paths.goes_by_host(id, frame(setting, key));
    }
    static wire::MediaHeader frame(SettingId setting, bool key = false) {
        wire::MediaHeader header;
        header.setting = setting;
        header.key = key;
        return header;
    }
    // Time goes on in steps of a host, while frames come of the camera.
    void pass(Duration time, const std::vector<StreamUse>& uses) {
        for (const TimePoint end = now + time; now < end;) {
            now += 100ms;
            for (const StreamUse& use : uses)
                (void)paths.relays_of(frame(use.setting), 0, now);
            paths.on_tick(now);
            if (paths.take_change())
                for (Action& action : follow(uses))
                    passed.push_back(std::move(action));
        }
    }
    // Alice gets both streams from the first relay.
    void go_by_relay() {
        offer(relay_one);
        come(alice);
        last = follow(used_by({alice}));
        report(alice, {path_depth, path_color});
        (void)follow(used_by({alice}));
    }

    TimePoint now = from_us(1'000'000);
    std::vector<Action> actions, last, passed;
    std::vector<KeyRequests::Key> keys;
    int secrets = 0;
    RelayPaths paths;
};

TEST_F(RelayPathsTest, BothSidesLearnOneSecretAndTheReceiverTheKey) {
    go_by_relay();
    const auto grants = messages_to<wire::RelayGrants>(alice, last);
    ASSERT_EQ(grants.size(), 1u);
    const wire::RelayGrant& grant = grants[0].grants.at(0);
    EXPECT_EQ(grant.relay, relay_one);
    EXPECT_EQ(grant.addresses, std::vector<std::string>{"relay.example"});
    EXPECT_EQ(grant.port, 4000);
    EXPECT_EQ(grant.key, paths.key(now).bytes);
    EXPECT_EQ(grant.key_number, paths.key(now).number);
    const auto receivers = messages_to<wire::RelayReceivers>(relay_one, last);
    ASSERT_EQ(receivers.size(), 1u);
    const wire::RelayReceiver& receiver = receivers[0].receivers.at(0);
    EXPECT_EQ(receiver.secret, grant.secret);
    EXPECT_NE(receiver.secret, grant.key) << "a relay does not know the key";
    EXPECT_EQ(receiver.participant, alice);
    EXPECT_EQ(receiver.settings, (std::vector{path_depth, path_color}));
    EXPECT_EQ(receiver.layers, Bytes(2, std::byte{2}));
    EXPECT_TRUE(follow(used_by({alice})).empty()) << "nothing is said twice";
}

TEST_F(RelayPathsTest, ANewcomerIsWaitedForASecondAndThenServedByTheHost) {
    offer(relay_one);
    come(alice);
    EXPECT_TRUE(paths.is_reached(alice));
    (void)follow(used_by({alice}));
    EXPECT_FALSE(by_host(alice, true)) << "the relay has the newest key frame";
    pass(900ms, used_by({alice}));
    EXPECT_FALSE(by_host(alice, true));
    pass(200ms, used_by({alice}));
    EXPECT_FALSE(paths.is_reached(alice));
    EXPECT_FALSE(by_host(alice, false)) << "it refers to frames that she may not have";
    EXPECT_TRUE(by_host(alice, true));
    EXPECT_TRUE(by_host(alice, false));
}

TEST_F(RelayPathsTest, WhoIsServedAlreadyDoesNotWaitForARelayThatComesLater) {
    come(alice);
    offer(relay_one);
    (void)follow(used_by({alice}));
    EXPECT_TRUE(by_host(alice, false));
    report(alice, {path_depth});
    (void)follow(used_by({alice}));
    EXPECT_FALSE(by_host(alice, true)) << "now it comes from the relay";
    EXPECT_TRUE(by_host(alice, false, path_color));
}

TEST_F(RelayPathsTest, ALostWayIsReplacedFromAKeyFrameOn) {
    go_by_relay();
    pass(2s, used_by({alice}));
    report(alice, {path_color});
    (void)follow(used_by({alice}));
    ASSERT_EQ(keys.size(), 1u);
    EXPECT_EQ(keys[0].stream, StreamId{0});
    EXPECT_EQ(keys[0].setting, path_depth);
    EXPECT_FALSE(by_host(alice, false));
    EXPECT_TRUE(by_host(alice, true));
    EXPECT_TRUE(by_host(alice, false));
    EXPECT_FALSE(by_host(alice, true, path_color));
}

TEST_F(RelayPathsTest, ARelayIsSentWhatItsReceiversUseUpToTheirHighestLayer) {
    go_by_relay();
    come(bob);
    std::vector<StreamUse> uses = used_by({alice, bob});
    uses[0].receivers[0].highest_layer = 0;
    uses[0].receivers[1].highest_layer = 1;
    (void)follow(uses);
    const auto relays = [&](SettingId setting, int layer) {
        return paths.relays_of(frame(setting), layer, now);
    };
    EXPECT_EQ(relays(path_depth, 0), std::vector{relay_one});
    EXPECT_EQ(relays(path_depth, 1), std::vector{relay_one});
    EXPECT_TRUE(relays(path_depth, 2).empty());
    EXPECT_TRUE(relays(SettingId{30}, 0).empty());
    (void)follow(used_by({}));
    EXPECT_TRUE(relays(path_depth, 0).empty()) << "nobody sees it any more";
}

TEST_F(RelayPathsTest, TheRelayOfTheOwnNetworkComesFirstThenTheLeastLoaded) {
    offer(relay_one);
    offer(relay_two, {"10.3.0.0/16", "192.168.4.0/24"});
    come(alice, "10.3.7.1");
    come(bob, "192.168.5.1");
    come(carol, "2001:db8::1");
    EXPECT_EQ(paths.relay_of(alice), relay_two);
    EXPECT_EQ(paths.relay_of(bob), relay_one);
    EXPECT_EQ(paths.relay_of(carol), relay_one);
    offer(relay_two);
    (void)follow(used_by({}));
    come(dave);
    EXPECT_EQ(paths.relay_of(dave), relay_two) << "it has the fewest";
}

TEST_F(RelayPathsTest, ARelayForNetworksThatNobodyCanReadIsForNobody) {
    offer(relay_one, {"10.3.0.0/16", "fe80::/10"});
    come(alice, "10.3.7.1");
    EXPECT_EQ(paths.relay_of(alice), std::nullopt);
    EXPECT_FALSE(paths.is_relay(relay_one));
}

TEST_F(RelayPathsTest, WhoseRelayEndsGetsTheNextOneAndMeanwhileTheHost) {
    offer(relay_two);
    go_by_relay();
    const ParticipantId first = *paths.relay_of(alice);
    const ParticipantId other = first == relay_one ? relay_two : relay_one;
    paths.leave(first);
    const auto sent = follow(used_by({alice}));
    EXPECT_EQ(paths.relay_of(alice), other);
    EXPECT_EQ(messages_to<wire::RelayGrants>(alice, sent).at(0).grants.at(0).relay, other);
    EXPECT_EQ(keys.size(), 2u);
    EXPECT_TRUE(by_host(alice, true)) << "at once, until she reports frames of the other";
    report(alice, {path_depth, path_color});
    (void)follow(used_by({alice}));
    EXPECT_FALSE(by_host(alice, true));
}

TEST_F(RelayPathsTest, ARelayThatCannotBeReachedIsLeftForAMinute) {
    offer(relay_one);
    come(alice);
    (void)follow(used_by({alice}));
    pass(6s, used_by({alice}));
    EXPECT_EQ(paths.relay_of(alice), std::nullopt);
    EXPECT_TRUE(messages_to<wire::RelayGrants>(alice, passed).back().grants.empty());
    pass(50s, used_by({alice}));
    EXPECT_EQ(paths.relay_of(alice), std::nullopt);
    pass(10s, used_by({alice}));
    EXPECT_EQ(paths.relay_of(alice), relay_one);
}

TEST_F(RelayPathsTest, ARelayWithoutPicturesIsNotBlamed) {
    go_by_relay();
    report(alice, {});
    // The camera stands still: no frame goes to the relay.
    for (int i = 0; i < 100; ++i) {
        now += 100ms;
        paths.on_tick(now);
    }
    EXPECT_EQ(paths.relay_of(alice), relay_one);
}

TEST_F(RelayPathsTest, AReportOfWhatIsNotOnTheWayCountsForNothing) {
    report(bob, {path_depth});  // an older program, or a stranger to this
    (void)follow(used_by({bob}));
    EXPECT_TRUE(by_host(bob, false));
    go_by_relay();
    report(alice, {path_depth, SettingId{99}});
    (void)follow(used_by({alice}));
    EXPECT_FALSE(paths.is_by_relay(alice, SettingId{99}));
    EXPECT_TRUE(paths.is_by_relay(alice, path_depth));
}

TEST_F(RelayPathsTest, AnOfferEndsOrIsMadeAnew) {
    go_by_relay();
    const Bytes before = messages_to<wire::RelayGrants>(alice, last).at(0).grants.at(0).secret;
    offer(relay_one, {}, 4001);
    auto sent = follow(used_by({alice}));
    const auto grants = messages_to<wire::RelayGrants>(alice, sent);
    ASSERT_EQ(grants.size(), 1u);
    EXPECT_EQ(grants[0].grants.at(0).port, 4001);
    EXPECT_NE(grants[0].grants.at(0).secret, before) << "the old one was for another";
    offer(relay_one, {}, 0);
    sent = follow(used_by({alice}));
    EXPECT_TRUE(messages_to<wire::RelayGrants>(alice, sent).at(0).grants.empty());
    EXPECT_TRUE(by_host(alice, true));
}

TEST_F(RelayPathsTest, ANewKeyIsToldASecondBeforeItIsUsed) {
    go_by_relay();
    const RelayPaths::Key first = paths.key(now);
    paths.renew_key();
    const auto sent = follow(used_by({alice}));
    const wire::RelayGrant told = messages_to<wire::RelayGrants>(alice, sent).at(0).grants.at(0);
    EXPECT_EQ(told.key_number, first.number + 1);
    EXPECT_NE(told.key, first.bytes);
    EXPECT_EQ(paths.key(now).number, first.number);
    // Many who are removed at once are one change.
    paths.renew_key();
    paths.renew_key();
    EXPECT_TRUE(follow(used_by({alice})).empty());
    now += RelayPaths::key_told_before;
    EXPECT_EQ(paths.key(now).bytes, told.key);
    paths.on_tick(now);
    EXPECT_TRUE(paths.take_change());
    (void)follow(used_by({alice}));
    EXPECT_EQ(paths.key(now).number, told.key_number);
    now += RelayPaths::key_told_before;
    EXPECT_EQ(paths.key(now).number, told.key_number + 1);
}

TEST_F(RelayPathsTest, WhoIsHeldBackGetsNothingFromARelay) {
    go_by_relay();
    paths.allow(alice, false);
    const auto sent = follow(used_by({alice}));
    EXPECT_TRUE(messages_to<wire::RelayGrants>(alice, sent).at(0).grants.empty());
    EXPECT_TRUE(by_host(alice, true));
    paths.allow(alice, true);
    (void)follow(used_by({alice}));
    EXPECT_EQ(paths.relay_of(alice), relay_one);
}

TEST_F(RelayPathsTest, MoreReceiversThanARelayHoldsStayWithTheHost) {
    offer(relay_one);
    for (std::uint32_t i = 0; i <= wire::max_relay_receivers; ++i)
        come(ParticipantId{100 + i});
    EXPECT_EQ(paths.relay_of(ParticipantId{100}), relay_one);
    EXPECT_EQ(paths.relay_of(ParticipantId{100 + wire::max_relay_receivers}), std::nullopt);
}

TEST_F(RelayPathsTest, KeyFramesOfAStreamAreFarApart) {
    EXPECT_TRUE(paths.may_request_key(StreamId{0}, path_depth, now));
    EXPECT_FALSE(paths.may_request_key(StreamId{0}, path_depth, now + 1900ms));
    EXPECT_TRUE(paths.may_request_key(StreamId{1}, path_color, now + 1900ms));
    EXPECT_TRUE(paths.may_request_key(StreamId{0}, path_depth, now + 2s));
}

TEST_F(RelayPathsTest, LostMessagesAreSentAgain) {
    go_by_relay();
    paths.tell_again(alice);
    paths.tell_again(relay_one);
    EXPECT_EQ(messages_to<wire::RelayGrants>(alice, actions).at(0).grants.size(), 1u);
    EXPECT_EQ(messages_to<wire::RelayReceivers>(relay_one, actions).at(0).receivers.size(), 1u);
}

TEST(RelayPaths, ThereAreNoneWhereTheHostWantsNone) {
    std::vector<Action> actions;
    RelayPaths paths({}, actions);
    paths.join(alice, {});
    paths.offer(bob, {{"10.0.0.5"}, 4000, Bytes(wire::fingerprint_size), {}});
    EXPECT_FALSE(paths.is_used());
}

// With the whole session around them: Alice is a relay, Bob and Carol are people.
class RelayedSession : public ::testing::Test {
protected:
    struct Base : Host {
        static HostSession::Config config() {
            HostSession::Config config = Host::config();
            config.make_secret = [] { return Bytes(wire::relay_secret_size, std::byte{1}); };
            config.streams.codecs.layered = [](const std::string& depth) {
                return CodecSteps::Layered{depth, true, false};
            };
            config.admission.tokens.push_back({"boss", Role::operator_, {}, ""});
            config.admission.tokens.push_back({"relay", Role::relay, {}, ""});
            config.admission.tokens.push_back({"link", Role::expert, {}, "of a guest"});
            return config;
        }
    };
    RelayedSession() : session(Base::config()) {
        come(alice, "relay", {wire::Feature::relays});
        joined = session.take_actions();
        say(alice, wire::OfferRelay{{"10.0.0.5"}, 4000, Bytes(wire::fingerprint_size), {}});
    }
    void say(ParticipantId id, const wire::ToHost& message) {
        session.on_control(id, wire::encode(message), now);
    }
    void come(ParticipantId id, const char* token,
              std::vector<wire::Feature> features = {wire::Feature::relay, wire::Feature::room},
              bool records = false) {
        session.on_connected(id, now, "192.0.2." + std::to_string(std::uint32_t(id)));
        wire::Join hello;
        hello.token = token;
        hello.depth_codec = "trvl";
        hello.color_codec = "jpeg";
        hello.records = records;
        hello.features = std::move(features);
        say(id, hello);
    }
    SettingId given(ParticipantId id) {
        return session.streams().cameras().find(CameraId{0})->receivers.at(id).depth;
    }
    void report(ParticipantId id, bool relayed = true) {
        const auto& told = session.streams().cameras().find(CameraId{0})->receivers.at(id);
        say(id, wire::Report{
                    {{depth_stream(CameraId{0}), 0, 0, 0, {}, relayed ? told.depth : SettingId{}},
                     {color_stream(CameraId{0}), 0, 0, 0, {}, relayed ? told.color : SettingId{}}},
                    ""});
    }
    std::size_t named() {
        const auto told = messages_to<wire::RelayReceivers>(alice, session.take_actions());
        if (!told.empty())
            last_named = told.back().receivers.size();
        return last_named;
    }
    HostSession::Recipients film(ParticipantId of, bool key = true) {
        wire::MediaHeader header;
        header.stream = depth_stream(CameraId{0});
        header.setting = given(of);
        header.key = key;
        header.frame = frame += 4;  // of layer 0
        header.reference = key ? frame : frame - 4;
        header.captured = now;
        return session.on_media(header, 100, now);
    }

    TimePoint now = from_us(1'000'000);
    HostSession session;
    std::vector<Action> joined;
    FrameNumber frame = 0;
    std::size_t last_named = 0;
};

TEST_F(RelayedSession, ARelaySeesNothingOfTheSession) {
    const auto welcome = messages_to<wire::Welcome>(alice, joined);
    ASSERT_EQ(welcome.size(), 1u);
    EXPECT_TRUE(welcome[0].cameras.empty());
    EXPECT_EQ(welcome[0].features, (std::vector{wire::Feature::sends_only, wire::Feature::relays}));
    come(bob, "secret");
    say(alice, wire::ChooseCodecs{"trvl", "jpeg", {}});
    say(alice, wire::RoomRequest{});
    say(alice, wire::WriteChat{1, "hello"});
    say(alice, wire::RaiseHand{true});
    say(alice, wire::Publish{{{"own", false, 30, Base::config().cameras[0].calibration}}});
    for (const auto& sent : actions_of<action::Send>(session.take_actions()))
        if (sent.participant == alice)
            EXPECT_TRUE(std::holds_alternative<wire::RelayReceivers>(sent.message) ||
                        std::holds_alternative<wire::Published>(sent.message) ||
                        std::holds_alternative<wire::RoomDecision>(sent.message))
                << sent.message.index();
    for (const auto& [id, object] : session.room().snapshot().objects)
        EXPECT_NE(object.creator, alice) << "it is nobody in the room";
    EXPECT_GT(session.participants().at(alice).denied, 0u);
    EXPECT_EQ(session.streams().cameras().descriptions().size(), 1u);
    say(alice, wire::Ping{now});
    EXPECT_EQ(messages_to<wire::Pong>(alice, session.take_actions()).size(), 1u);
}

TEST_F(RelayedSession, APersonCannotComeByARelaysLinkNorARelayByAPersons) {
    come(bob, "relay");
    come(carol, "secret", {wire::Feature::relays});
    const auto sent = session.take_actions();
    EXPECT_EQ(messages_to<wire::Refused>(bob, sent).size(), 1u);
    EXPECT_EQ(messages_to<wire::Refused>(carol, sent).size(), 1u);
    come(dave, "boss");
    say(dave, wire::Manage{1, wire::ManageAction::set_role, alice, Role::expert});
    EXPECT_EQ(messages_to<wire::Managed>(dave, session.take_actions()).at(0).refusal,
              wire::ManageRefusal::no_such_participant);
    EXPECT_EQ(session.participants().at(alice).role, Role::relay);
}

TEST_F(RelayedSession, AFrameGoesToTheRelayAndNotToItsReceiver) {
    come(bob, "secret");
    EXPECT_EQ(named(), 1u);
    auto to = film(bob);
    EXPECT_TRUE(to.receivers.empty()) << "his first frame comes from the relay";
    EXPECT_EQ(to.relays, std::vector{alice});
    report(bob);
    (void)session.take_actions();
    to = film(bob, false);
    EXPECT_TRUE(to.receivers.empty());
    EXPECT_EQ(to.relays, std::vector{alice});
    come(carol, "boss", {wire::Feature::room});
    (void)session.take_actions();
    to = film(bob, true);
    EXPECT_EQ(to.receivers, std::vector{carol}) << "her program knows no relays";
    EXPECT_EQ(to.relays, std::vector{alice});
}

TEST_F(RelayedSession, ANewcomerOfARelayAsksTheHostForNoKeyFrame) {
    come(bob, "secret");
    report(bob);
    now += 1s;
    session.on_tick(now);
    (void)session.take_actions();
    come(carol, "boss");
    now += 1s;
    session.on_tick(now);
    EXPECT_TRUE(actions_of<action::RequestKey>(session.take_actions()).empty());
    // The stream is asked for once in two seconds, although a receiver asks, too.
    say(alice, wire::RelayReport{{}, {{depth_stream(CameraId{0}), given(bob)}}});
    report(bob);
    say(bob, wire::RequestKey{depth_stream(CameraId{0}), given(bob)});
    session.on_tick(now);
    EXPECT_EQ(actions_of<action::RequestKey>(session.take_actions()).size(), 1u);
    now += 1s;
    say(alice, wire::RelayReport{{}, {{depth_stream(CameraId{0}), given(bob)}}});
    session.on_tick(now);
    EXPECT_TRUE(actions_of<action::RequestKey>(session.take_actions()).empty());
}

TEST_F(RelayedSession, ALostRelayAsksForAKeyFrameAndTheHostSendsFromIt) {
    come(bob, "secret");
    report(bob);
    now += 2s;
    session.on_tick(now);
    (void)session.take_actions();
    session.on_closed(alice);
    EXPECT_TRUE(messages_to<wire::RelayGrants>(bob, session.take_actions()).back().grants.empty());
    session.on_tick(now);
    EXPECT_EQ(actions_of<action::RequestKey>(session.take_actions()).size(), 2u);
    EXPECT_TRUE(film(bob, false).receivers.empty());
    const auto to = film(bob, true);
    EXPECT_EQ(to.receivers, std::vector{bob});
    EXPECT_TRUE(to.relays.empty());
}

TEST_F(RelayedSession, ARemovedReceiverIsOutInTheSameStepAndTheKeyIsAnother) {
    come(bob, "secret");
    come(carol, "boss");
    EXPECT_EQ(named(), 2u);
    const std::uint32_t key = session.relay_key(now).number;
    say(carol, wire::Manage{1, wire::ManageAction::remove, bob, {}});
    const auto actions = session.take_actions();
    EXPECT_EQ(messages_to<wire::RelayReceivers>(alice, actions).back().receivers.size(), 1u);
    EXPECT_EQ(messages_to<wire::RelayGrants>(carol, actions).back().grants.at(0).key_number,
              key + 1);
    EXPECT_TRUE(messages_to<wire::RelayGrants>(bob, actions).empty());
    now += RelayPaths::key_told_before;
    EXPECT_EQ(session.relay_key(now).number, key + 1);
}

TEST_F(RelayedSession, ARevokedLinkEndsItsPaths) {
    come(bob, "link");
    EXPECT_EQ(named(), 1u);
    auto tokens = Base::config().admission.tokens;
    tokens.pop_back();
    session.set_tokens(tokens);
    EXPECT_EQ(named(), 0u);
}

TEST_F(RelayedSession, ARecorderAndWhoLooksBackGetAllFromTheHost) {
    come(bob, "secret", {wire::Feature::relay}, true);
    EXPECT_EQ(named(), 0u);
    report(bob);
    EXPECT_EQ(film(bob).receivers, std::vector{bob});
}

TEST_F(RelayedSession, ACeilingIsTheRelays) {
    come(bob, "secret");
    say(bob, wire::ChooseDelivery{150, 1000});
    const auto told = messages_to<wire::RelayReceivers>(alice, session.take_actions());
    EXPECT_EQ(told.back().receivers.at(0).max_kbit_per_s, 1000u);
}

TEST_F(RelayedSession, TheLinkOfAReceiverIsMeasuredByItsOwnRelayAlone) {
    come(bob, "secret");
    report(bob);
    (void)session.take_actions();
    const auto step = [&] { return session.step_of(bob); };
    ASSERT_EQ(step(), "everything");
    say(bob, wire::ChooseDelivery{100, 0});
    const auto measure = [&](ParticipantId from) {
        for (int i = 0; i < 60; ++i) {
            now += 100ms;
            (void)film(bob);
            say(from, wire::RelayReport{{{bob, 1000, 1ms, 900ms, 2, false}}, {}});
            report(bob);
            session.on_tick(now);
            (void)session.take_actions();
        }
    };
    come(carol, "boss");
    measure(carol);
    EXPECT_EQ(step(), "everything") << "she is no relay";
    measure(alice);
    EXPECT_NE(step(), "everything");
}

}  // namespace
}  // namespace theatron::session
