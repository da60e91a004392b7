// SPDX-License-Identifier: Apache-2.0
// Requests that come too often, encoders and receivers that are too slow.
#include <set>

#include "session/host_session_testing.h"

namespace theatron::session {
namespace {

TEST_F(Host, RefusesMoreRecordersThanItKeepsPicturesFor) {
    for (int i = 0; i < Admission::max_recorders; ++i)
        join_to_record(ParticipantId(10 + i), "trvl");
    session.take_actions();
    join_to_record(alice, "trvl");
    EXPECT_EQ(sent<wire::Refused>(alice, session.take_actions()).size(), 1u);
    join(bob);
    EXPECT_EQ(sent<wire::Welcome>(bob, session.take_actions()).size(), 1u)
        << "a viewer is no recorder";
    session.on_closed(ParticipantId(10));
    join_to_record(carol, "trvl");
    EXPECT_EQ(sent<wire::Welcome>(carol, session.take_actions()).size(), 1u);
}

TEST_F(Host, ANameHasNoMarkOfAReplayAndNoSpacesAroundIt) {
    const auto shown = [&](ParticipantId id, const std::string& name) {
        session.on_connected(id, now);
        wire::Join hello;
        hello.token = "secret";
        hello.name = name;
        hello.depth_codec = "trvl";
        hello.color_codec = "jpeg";
        say(id, hello);
        return session.participants().at(id).name;
    };
    for (const char* name : {"  Ben (recorded) ", "Ben (operator)", "Ben [Beobachter]", "Ben,"}) {
        session.on_closed(alice);
        EXPECT_EQ(shown(alice, name), "Ben") << name;
    }
    EXPECT_EQ(shown(bob, "(recorded)(recorded)"), "guest");
    EXPECT_EQ(shown(carol, "Dr. Ada  Bee"), "Dr. Ada  Bee");
    EXPECT_EQ(shown(dave, "   "), "guest (2)");
}

TEST_F(Host, OneLinkShutsOutNobodyWithAnotherOne) {
    HostSession::Config of_three = config();
    of_three.admission.tokens = {{"watch", Role::observer, {}, "observer"},
                                 {"secret", Role::expert, {}, "expert"},
                                 {"third", Role::expert, {}, "third"},
                                 {"operate", Role::operator_, {}, "operator"}};
    HostSession session(std::move(of_three));
    std::uint32_t next = 100;
    const auto refusal = [&](const std::string& token, Bytes person = {}) {
        const ParticipantId id{next++};
        session.on_connected(id, now);
        wire::Join hello;
        hello.token = token;
        hello.depth_codec = "trvl";
        hello.color_codec = "jpeg";
        hello.person = std::move(person);
        session.on_control(id, wire::encode(hello), now);
        const auto refused = messages_to<wire::Refused>(id, session.take_actions());
        return refused.empty() ? wire::TextCode::none : refused.front().reason.code;
    };
    using enum wire::TextCode;
    const Bytes ann(16, std::byte{7});
    EXPECT_EQ(refusal("watch", ann), none);
    for (int i = 1; i < Admission::max_by_one_link; ++i)
        ASSERT_EQ(refusal("watch"), none) << i;
    EXPECT_EQ(refusal("watch"), link_full);
    EXPECT_EQ(refusal("watch", ann), link_full) << "she is in already";
    const int others =
        Admission::max_participants - Admission::kept_for_operators - Admission::max_by_one_link;
    for (int i = 0; i < others; ++i)
        ASSERT_EQ(refusal("secret"), none) << i;
    EXPECT_EQ(refusal("third"), all_places_taken);
    for (int i = 0; i < Admission::kept_for_operators; ++i)
        EXPECT_EQ(refusal("operate"), none) << i;
    EXPECT_EQ(refusal("operate"), all_places_taken);
    session.on_closed(ParticipantId(101));
    EXPECT_EQ(refusal("operate"), none) << "somebody has left";
}

TEST_F(Host, FramesWaitOnlyWhileAllAreBehindWhoDoNotAdapt) {
    std::set<ParticipantId> behind;
    const auto all_wait = [&] {
        return session.all_wait(CameraId{0}, [&](ParticipantId id) { return behind.contains(id); });
    };
    EXPECT_FALSE(all_wait()) << "nobody is there";
    session.on_connected(dave, now);
    behind.insert(dave);
    EXPECT_FALSE(all_wait()) << "who has not joined does not count";
    join(alice);
    join(bob);
    EXPECT_FALSE(all_wait());
    behind.insert(alice);
    EXPECT_FALSE(all_wait()) << "bob can take it";
    behind.insert(bob);
    EXPECT_TRUE(all_wait());
    wire::ChooseDelivery goal;
    goal.target_latency_ms = 150;
    say(bob, goal);
    EXPECT_FALSE(all_wait()) << "bob is sent less instead";
    session.on_closed(bob);
    EXPECT_TRUE(all_wait());
}

TEST_F(Host, OfTooManyCodecChangesTheLastWishWins) {
    join(alice);
    session.take_actions();
    const auto limit = RequestBudget::limits[std::size_t(RequestBudget::Kind::codecs)];
    for (int i = 0; i < 3 * limit.at_once; ++i)
        say(alice, wire::ChooseCodecs{i % 2 ? "rvl" : "lz4", ""});
    say(alice, wire::ChooseCodecs{"ans", ""});
    say(alice, wire::ChooseCodecs{"", "raw"});
    auto actions = session.take_actions();
    EXPECT_EQ(count<action::ChangeSettings>(actions), limit.at_once);
    EXPECT_EQ(count<action::Close>(actions), 0);
    session.on_tick(now);
    EXPECT_EQ(count<action::ChangeSettings>(session.take_actions()), 0) << "it is not yet time";
    now += 2s;
    session.on_tick(now);
    EXPECT_EQ(session.depth_settings()[0].codec, "ans");
    EXPECT_EQ(session.color_settings()[0].codec, "raw");
    EXPECT_EQ(sent<wire::Settings>(alice, session.take_actions()).size(), 1u) << "none was queued";
    now += 60s;
    session.on_tick(now);
    EXPECT_EQ(count<action::ChangeSettings>(session.take_actions()), 0);
}

TEST_F(Host, AFloodOfRequestsEndsTheConnectionWithAReason) {
    join(alice);
    join(bob);
    session.take_actions();
    int said = 0;
    while (session.participants().at(alice).takes_part() && said < 70'000) {
        say(alice, wire::ChooseCodecs{said % 2 ? "rvl" : "lz4", ""});
        ++said;
    }
    EXPECT_LE(said, RequestBudget::patience.at_once + 10);
    const auto actions = session.take_actions();
    ASSERT_EQ(sent<wire::Refused>(alice, actions).size(), 1u);
    EXPECT_NE(sent<wire::Refused>(alice, actions)[0].in_english.find("requests"),
              std::string::npos);
    EXPECT_EQ(count<action::Close>(actions), 1);
    EXPECT_TRUE(session.participants().at(bob).takes_part());
    EXPECT_EQ(session.participants().at(alice).budget.refused(),
              std::uint64_t(RequestBudget::patience.at_once) + 1);
}

TEST_F(Host, PingsKeysReportsAndGoalsBeyondTheirLimitsAreNotAnswered) {
    join(alice);
    session.take_actions();
    using Asked = RequestBudget::Kind;
    const auto at_once = [](Asked kind) {
        return int(RequestBudget::limits[std::size_t(kind)].at_once);
    };
    for (int i = 0; i < 300; ++i)
        say(alice, wire::Ping{from_us(i)});
    EXPECT_EQ(int(sent<wire::Pong>(alice, session.take_actions()).size()), at_once(Asked::ping));
    for (int i = 0; i < 100; ++i)
        say(alice, wire::ChooseDelivery{0, std::uint32_t(1000 + i)});
    EXPECT_EQ(count<action::SetCeiling>(session.take_actions()), at_once(Asked::delivery));
    now += 1s;
    session.on_tick(now);
    const auto actions = session.take_actions();
    ASSERT_EQ(count<action::SetCeiling>(actions), 1);
    EXPECT_EQ(all<action::SetCeiling>(actions)[0].bytes_per_second, 1099u * 125)
        << "the last one counts";
}

TEST_F(Host, ASettingThatCannotKeepUpIsToldToThoseWhoGetIt) {
    join(alice, "trvl");
    join(bob, "zstd:level=19");
    session.take_actions();
    const SettingId slow = session.depth_settings()[1].id;
    session.on_encoding(CameraId{0}, slow, false, 151.6);
    auto actions = session.take_actions();
    EXPECT_TRUE(sent<wire::Settings>(alice, actions).empty());
    ASSERT_EQ(sent<wire::Settings>(bob, actions).size(), 1u);
    const auto announced = sent<wire::Settings>(bob, actions)[0];
    EXPECT_TRUE(announced.settings.empty());
    EXPECT_EQ(announced.note,
              (wire::Text{wire::TextCode::encoding_is_slow, {"zstd:level=19", "152"}}));
    session.on_encoding(CameraId{0}, slow, false, 160);
    EXPECT_TRUE(session.take_actions().empty()) << "once is enough";
    session.on_encoding(CameraId{0}, SettingId{999}, false, 160);
    EXPECT_TRUE(session.take_actions().empty()) << "it is of the past";
}

TEST_F(Host, ASlowSettingMakesNobodyElsesFramesLate) {
    join(alice, "trvl");
    join(bob, "zstd:level=19");
    for (const ParticipantId id : {alice, bob})
        say(id, wire::ChooseDelivery{60, 0});
    session.take_actions();
    for (int i = 0; i < 300; ++i, now += 33ms) {
        wire::MediaHeader h;
        h.frame = FrameNumber(i);
        h.setting = session.depth_settings()[0].id;
        h.captured = now - 5ms;
        (void)session.on_media(h, 1000, now);
        h.setting = session.depth_settings()[1].id;
        h.captured = now - 200ms;
        (void)session.on_media(h, 1000, now);
        for (const ParticipantId id : {alice, bob})
            session.on_link(id, {1e7, 2ms, 20ms, 0}, now);
    }
    int alice_stepped = 0;
    for (const auto& a : all<action::Stepped>(session.take_actions()))
        alice_stepped += a.participant == alice;
    EXPECT_EQ(alice_stepped, 0);
}

}  // namespace
}  // namespace theatron::session
