// SPDX-License-Identifier: Apache-2.0
#include "session/direct_paths.h"

#include <gtest/gtest.h>

#include "session/host_session_testing.h"

namespace theatron::session {
namespace {

constexpr SettingId path_depth{7}, path_color{9};
constexpr ParticipantId path_sender{5};

class DirectPathsTest : public ::testing::Test {
protected:
    DirectPathsTest()
        : paths(
              [this] {
                  Bytes secret(wire::direct_secret_size);
                  secret[0] = std::byte(++secrets);
                  return secret;
              },
              actions) {
        paths.set_address(path_sender, "10.0.1.5");
        paths.join(path_sender);
        paths.offer(path_sender, {{"10.0.0.5"}, 4000, Bytes(wire::fingerprint_size)});
    }

    // Each of these gets depth and colour of the camera.
    std::vector<StreamUse> used_by(std::vector<ParticipantId> receivers,
                                   SettingId depth_setting = path_depth) {
        std::vector<StreamUse> uses{{path_sender, StreamId{0}, depth_setting, {}, false},
                                    {path_sender, StreamId{1}, path_color, {}, false}};
        for (StreamUse& use : uses)
            for (const ParticipantId receiver : receivers)
                use.receivers.push_back({receiver, true});
        return uses;
    }
    void come(ParticipantId id) {
        paths.set_address(id, "10.0.2." + std::to_string(std::uint32_t(id)));
        paths.join(id);
    }
    void report(ParticipantId id, std::vector<SettingId> direct) {
        std::vector<wire::StreamReport> streams;
        for (const SettingId setting : direct)
            streams.push_back({StreamId{0}, 0, 0, 0, {}, setting});
        paths.report(id, streams);
    }
    std::vector<Action> follow(const std::vector<StreamUse>& uses) {
        keys = paths.follow(uses);
        return std::exchange(actions, {});
    }
    bool is_relayed(ParticipantId id, bool key, SettingId setting = path_depth) {
        wire::MediaHeader header;
        header.setting = setting;
        header.key = key;
        return paths.is_relayed(id, header);
    }
    // Alice gets both streams directly.
    void go_direct() {
        come(alice);
        (void)follow(used_by({alice}));
        report(alice, {path_depth, path_color});
        last = follow(used_by({alice}));
    }

    std::vector<Action> actions, last;
    std::vector<KeyRequests::Key> keys;
    int secrets = 0;
    DirectPaths paths;
};

TEST_F(DirectPathsTest, BothSidesLearnOneSecret) {
    come(alice);
    const auto sent = follow(used_by({alice}));
    const auto grants = messages_to<wire::DirectGrants>(alice, sent);
    ASSERT_EQ(grants.size(), 1u);
    ASSERT_EQ(grants[0].grants.size(), 1u);
    const wire::DirectGrant& grant = grants[0].grants[0];
    EXPECT_EQ(grant.publisher, path_sender);
    EXPECT_EQ(grant.addresses, (std::vector<std::string>{"10.0.1.5", "10.0.0.5"}))
        << "the address at which the host sees it comes first";
    EXPECT_EQ(grant.port, 4000);
    const auto receivers = messages_to<wire::DirectReceivers>(path_sender, sent);
    ASSERT_EQ(receivers.size(), 1u);
    ASSERT_EQ(receivers[0].receivers.size(), 1u);
    EXPECT_EQ(receivers[0].receivers[0].secret, grant.secret);
    EXPECT_EQ(receivers[0].receivers[0].settings, (std::vector{path_depth, path_color}));
    EXPECT_TRUE(receivers[0].not_to_host.empty()) << "nothing has come directly";
    EXPECT_TRUE(follow(used_by({alice})).empty()) << "nothing is said twice";
    EXPECT_TRUE(is_relayed(alice, false));
}

TEST_F(DirectPathsTest, TheHostLetsGoOfWhatComesDirectlyToAll) {
    go_direct();
    const auto receivers = messages_to<wire::DirectReceivers>(path_sender, last);
    ASSERT_EQ(receivers.size(), 1u);
    EXPECT_EQ(receivers[0].not_to_host, (std::vector{path_depth, path_color}));
    EXPECT_FALSE(is_relayed(alice, true));
    EXPECT_TRUE(paths.is_direct(alice, path_depth));

    // A late joiner gets its frames from the host first, from the key frame that its coming asks
    // for.
    come(bob);
    const auto sent = follow(used_by({alice, bob}));
    ASSERT_EQ(messages_to<wire::DirectReceivers>(path_sender, sent).size(), 1u);
    EXPECT_TRUE(messages_to<wire::DirectReceivers>(path_sender, sent)[0].not_to_host.empty());
    EXPECT_EQ(messages_to<wire::DirectReceivers>(path_sender, sent)[0].receivers.size(), 2u);
    EXPECT_TRUE(is_relayed(bob, false));
    EXPECT_FALSE(is_relayed(alice, true)) << "she still gets hers directly";
}

TEST_F(DirectPathsTest, ALostPathIsReplacedFromAKeyFrameOn) {
    go_direct();
    report(alice, {path_color});
    const auto sent = follow(used_by({alice}));
    ASSERT_EQ(keys.size(), 1u);
    EXPECT_EQ(keys[0].stream, StreamId{0});
    EXPECT_EQ(keys[0].setting, path_depth);
    EXPECT_EQ(messages_to<wire::DirectReceivers>(path_sender, sent).at(0).not_to_host,
              std::vector{path_color});
    EXPECT_FALSE(is_relayed(alice, false)) << "it refers to frames that she may not have";
    EXPECT_TRUE(is_relayed(alice, true));
    EXPECT_TRUE(is_relayed(alice, false));
    EXPECT_FALSE(is_relayed(alice, true, path_color));
}

TEST_F(DirectPathsTest, WhoIsNoLongerAReceiverLosesItsPathAtOnce) {
    go_direct();
    const auto sent = follow(used_by({}));
    EXPECT_TRUE(messages_to<wire::DirectReceivers>(path_sender, sent).at(0).receivers.empty());
    EXPECT_TRUE(messages_to<wire::DirectReceivers>(path_sender, sent).at(0).not_to_host.empty());
    EXPECT_TRUE(messages_to<wire::DirectGrants>(alice, sent).at(0).grants.empty());
    EXPECT_FALSE(paths.is_direct(alice, path_depth));
    // Its secret is not used again.
    const auto again = follow(used_by({alice}));
    EXPECT_EQ(messages_to<wire::DirectGrants>(alice, again).at(0).grants.at(0).secret[0],
              std::byte{2});
}

TEST_F(DirectPathsTest, EitherSideMayLeave) {
    go_direct();
    paths.leave(alice);
    auto sent = follow(used_by({}));
    EXPECT_TRUE(messages_to<wire::DirectReceivers>(path_sender, sent).at(0).receivers.empty());
    EXPECT_TRUE(messages_to<wire::DirectGrants>(alice, sent).empty()) << "she is gone";

    go_direct();
    paths.leave(path_sender);
    EXPECT_TRUE(paths.is_used()) << "somebody has still to be told";
    sent = follow({});
    EXPECT_TRUE(messages_to<wire::DirectGrants>(alice, sent).at(0).grants.empty());
    EXPECT_TRUE(messages_to<wire::DirectReceivers>(path_sender, sent).empty());
    EXPECT_TRUE(follow({}).empty());
    EXPECT_FALSE(paths.is_used());
}

TEST_F(DirectPathsTest, AnotherCodecComesFromTheHostUntilItComesDirectly) {
    go_direct();
    const SettingId other{12};
    const auto sent = follow(used_by({alice}, other));
    const auto receivers = messages_to<wire::DirectReceivers>(path_sender, sent);
    ASSERT_EQ(receivers.size(), 1u);
    EXPECT_EQ(receivers[0].receivers.at(0).settings, (std::vector{path_color, other}));
    EXPECT_EQ(receivers[0].not_to_host, std::vector{path_color});
    EXPECT_TRUE(is_relayed(alice, true, other));
    report(alice, {other, path_color});
    EXPECT_EQ(messages_to<wire::DirectReceivers>(path_sender, follow(used_by({alice}, other)))
                  .at(0)
                  .not_to_host,
              (std::vector{other, path_color}));
}

TEST_F(DirectPathsTest, AReportOfWhatWasNotGrantedCountsForNothing) {
    come(alice);
    report(alice, {path_depth, SettingId{99}});
    std::vector<StreamUse> uses = used_by({alice});
    for (StreamUse& use : uses)
        use.receivers[0].may_be_direct = false;  // she records, or has a ceiling
    EXPECT_TRUE(follow(uses).empty());
    EXPECT_TRUE(is_relayed(alice, false));
    report(bob, {path_depth});  // an older program, or a stranger to this
    (void)follow(used_by({alice, bob}));
    EXPECT_TRUE(is_relayed(bob, false));
    EXPECT_FALSE(paths.is_direct(alice, SettingId{99}));
}

TEST_F(DirectPathsTest, TheHostKeepsWhatItNeedsItself) {
    come(alice);
    std::vector<StreamUse> uses = used_by({alice});
    uses[0].is_kept = true;
    (void)follow(uses);
    report(alice, {path_depth, path_color});
    EXPECT_EQ(messages_to<wire::DirectReceivers>(path_sender, follow(uses)).at(0).not_to_host,
              std::vector{path_color});
    EXPECT_FALSE(is_relayed(alice, true));
}

TEST_F(DirectPathsTest, AnOfferEndsOrIsMadeAnew) {
    go_direct();
    paths.offer(path_sender, {{}, 4001, Bytes(wire::fingerprint_size)});
    auto sent = follow(used_by({alice}));
    const auto grants = messages_to<wire::DirectGrants>(alice, sent);
    ASSERT_EQ(grants.size(), 1u);
    EXPECT_EQ(grants[0].grants.at(0).port, 4001);
    EXPECT_EQ(grants[0].grants.at(0).secret[0], std::byte{2}) << "the old one was for another";
    paths.offer(path_sender, {});
    sent = follow(used_by({alice}));
    EXPECT_TRUE(messages_to<wire::DirectGrants>(alice, sent).at(0).grants.empty());
    EXPECT_TRUE(messages_to<wire::DirectReceivers>(path_sender, sent).at(0).not_to_host.empty());
    EXPECT_FALSE(is_relayed(alice, false));
    EXPECT_TRUE(is_relayed(alice, true));
}

TEST_F(DirectPathsTest, OnlyAddressesAreHandedOn) {
    paths.offer(path_sender, {{"host.example", "10.0.0.5", "10.0.0.5", "fe80::1", "127.0.0.1",
                               "::1", "1.2.3.4 ", std::string(46, '1'), "beef"},
                              4000,
                              Bytes(wire::fingerprint_size)});
    come(alice);
    const auto addresses = [&](ParticipantId id) {
        return messages_to<wire::DirectGrants>(id, follow(used_by({id})))
            .at(0)
            .grants.at(0)
            .addresses;
    };
    EXPECT_EQ(addresses(alice), (std::vector<std::string>{"10.0.1.5", "10.0.0.5"}));
}

TEST_F(DirectPathsTest, AnOfferOfAPortOfServicesIsNone) {
    paths.offer(path_sender, {{"10.0.0.5"}, 443, Bytes(wire::fingerprint_size)});
    come(alice);
    EXPECT_TRUE(follow(used_by({alice})).empty());
}

TEST_F(DirectPathsTest, MoreReceiversThanAListHoldsStayWithTheHost) {
    std::vector<ParticipantId> all;
    for (std::uint32_t i = 0; i < wire::max_direct_receivers + 1; ++i)
        all.push_back(ParticipantId{100 + i});
    for (const ParticipantId id : all)
        come(id);
    const ParticipantId last_one = all.back();
    const auto sent = follow(used_by({all.begin() + 1, all.end()}));
    EXPECT_EQ(messages_to<wire::DirectReceivers>(path_sender, sent).at(0).receivers.size(),
              wire::max_direct_receivers);
    const auto later = follow(used_by(all));
    EXPECT_TRUE(messages_to<wire::DirectReceivers>(path_sender, later).empty())
        << "a newcomer with a lower number takes nobody's path away";
    EXPECT_TRUE(messages_to<wire::DirectGrants>(last_one, later).empty());
}

TEST_F(DirectPathsTest, LostMessagesAreSentAgain) {
    go_direct();
    paths.tell_again(alice);
    paths.tell_again(path_sender);
    EXPECT_EQ(messages_to<wire::DirectGrants>(alice, actions).at(0).grants.size(), 1u);
    EXPECT_EQ(messages_to<wire::DirectReceivers>(path_sender, actions).at(0).not_to_host.size(),
              2u);
}

TEST(DirectPaths, ThereAreNoneWhereTheHostWantsNone) {
    std::vector<Action> actions;
    DirectPaths paths({}, actions);
    paths.join(alice);
    paths.offer(alice, {{"10.0.0.5"}, 4000, Bytes(wire::fingerprint_size)});
    EXPECT_FALSE(paths.is_used());
}

// With the whole session around them.
class DirectSession : public ::testing::Test {
protected:
    struct Base : Host {
        static HostSession::Config config() {
            HostSession::Config config = Host::config();
            config.make_secret = [] { return Bytes(wire::direct_secret_size, std::byte{1}); };
            config.admission.tokens.push_back({"boss", Role::operator_, {}, ""});
            config.admission.tokens.push_back({"link", Role::expert, {}, "of a guest"});
            return config;
        }
    };
    DirectSession() : session(Base::config()) {
        come(alice, "publish");
        say(alice, wire::OfferDirect{{"10.0.0.5"}, 4000, Bytes(wire::fingerprint_size)});
        wire::Publish offer;
        offer.cameras.push_back({"own", false, 30, Base::config().cameras[0].calibration});
        say(alice, offer);
    }
    void say(ParticipantId id, const wire::ToHost& message) {
        session.on_control(id, wire::encode(message), now);
    }
    void come(ParticipantId id, const char* token, bool records = false) {
        session.on_connected(id, now, "192.0.2." + std::to_string(std::uint32_t(id)));
        wire::Join hello;
        hello.token = token;
        hello.depth_codec = "trvl";
        hello.color_codec = "jpeg";
        hello.records = records;
        hello.features = {wire::Feature::publish, wire::Feature::direct};
        say(id, hello);
    }
    SettingId given(ParticipantId id) {
        return session.streams().cameras().find(CameraId{1})->receivers.at(id).depth;
    }
    void report(ParticipantId id) {
        say(id, wire::Report{{{depth_stream(CameraId{1}), 0, 0, 0, {}, given(id)}}, ""});
    }
    wire::DirectReceivers told_alice() {
        const auto told = messages_to<wire::DirectReceivers>(alice, session.take_actions());
        return told.empty() ? wire::DirectReceivers{} : told.back();
    }
    std::vector<ParticipantId> receivers(SettingId setting, bool key = true) {
        wire::MediaHeader header;
        header.stream = depth_stream(CameraId{1});
        header.setting = setting;
        header.key = key;
        header.frame = ++frame;
        header.reference = key ? frame : frame - 1;
        header.captured = now;
        Bytes message(wire::media_header_size);
        wire::write_media_header(header, message.data());
        return session.on_media_from(alice, message, now);
    }

    TimePoint now = from_us(1'000'000);
    HostSession session;
    FrameNumber frame = 0;
};

TEST_F(DirectSession, ARemovedReceiverIsOutInTheSameStep) {
    come(bob, "secret");
    come(carol, "boss");
    EXPECT_EQ(told_alice().receivers.size(), 2u);
    report(bob);
    (void)session.take_actions();
    EXPECT_EQ(receivers(given(carol)), std::vector{carol}) << "bob has it directly";
    say(carol, wire::Manage{1, wire::ManageAction::remove, bob, {}});
    EXPECT_EQ(told_alice().receivers.size(), 1u);
}

TEST_F(DirectSession, ARevokedLinkEndsItsPaths) {
    come(bob, "link");
    EXPECT_EQ(told_alice().receivers.size(), 1u);
    auto tokens = Base::config().admission.tokens;
    tokens.pop_back();
    session.set_tokens(tokens);
    const auto told = messages_to<wire::DirectReceivers>(alice, session.take_actions());
    ASSERT_EQ(told.size(), 1u);
    EXPECT_TRUE(told[0].receivers.empty());
}

TEST_F(DirectSession, APublisherThatMayNoLongerPublishSendsNothingDirectly) {
    come(bob, "secret");
    come(carol, "boss");
    (void)session.take_actions();
    say(carol, wire::Manage{1, wire::ManageAction::set_role, alice, Role::observer});
    const auto actions = session.take_actions();
    const auto told = messages_to<wire::DirectReceivers>(alice, actions);
    ASSERT_FALSE(told.empty());
    EXPECT_TRUE(told.back().receivers.empty());
    EXPECT_TRUE(messages_to<wire::DirectGrants>(bob, actions).at(0).grants.empty());
}

TEST_F(DirectSession, ARecorderGetsAllFromTheHost) {
    say(alice, wire::Unpublish{{CameraId{1}}});
    wire::Publish offer;
    offer.cameras.push_back({"own", false, 30, Base::config().cameras[0].calibration, true});
    say(alice, offer);
    come(bob, "secret", true);
    EXPECT_EQ(told_alice(), wire::DirectReceivers{});
    say(bob, wire::Report{{{depth_stream(CameraId{2}), 0, 0, 0, {}, SettingId{1}}}, ""});
    EXPECT_EQ(told_alice(), wire::DirectReceivers{});
}

TEST_F(DirectSession, ALostPathAsksThePublisherForAKeyFrame) {
    come(bob, "secret");
    report(bob);
    const SettingId setting = given(bob);
    EXPECT_EQ(told_alice().not_to_host, std::vector{setting});
    EXPECT_TRUE(session.is_direct(bob, setting));
    now += std::chrono::seconds(1);
    session.on_tick(now);  // the key frame for his coming
    (void)session.take_actions();
    now += std::chrono::seconds(1);
    say(bob, wire::Report{});
    EXPECT_TRUE(told_alice().not_to_host.empty());
    session.on_tick(now);
    EXPECT_EQ(messages_to<wire::EncodeKey>(alice, session.take_actions()).size(), 1u);
    EXPECT_TRUE(receivers(setting, false).empty());
    EXPECT_EQ(receivers(setting, true), std::vector{bob});
}

TEST_F(DirectSession, WithACeilingEverythingComesFromTheHost) {
    come(bob, "secret");
    EXPECT_EQ(told_alice().receivers.size(), 1u);
    say(bob, wire::ChooseDelivery{150, 1000});
    EXPECT_TRUE(told_alice().receivers.empty());
    now += std::chrono::seconds(1);
    say(bob, wire::ChooseDelivery{150, 0});
    EXPECT_EQ(told_alice().receivers.size(), 1u);
}

}  // namespace
}  // namespace theatron::session
