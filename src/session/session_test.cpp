// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <set>

#include "geometry/calibration.h"
#include "session/host_session.h"
#include "session/renderer_choice.h"
#include "session/viewer_session.h"

namespace theatron::session {
namespace {

constexpr ParticipantId alice{1}, bob{2}, carol{3}, dave{4};

TEST(SettingTable, OneSettingPerDistinctWish) {
    SettingNumbers numbers;
    SettingTable table(numbers);
    table.wish(alice, "trvl");
    table.wish(bob, "trvl");
    EXPECT_EQ(table.active().size(), 1u);
    EXPECT_EQ(table.given(alice), table.given(bob));
    table.wish(bob, "rvl");
    EXPECT_EQ(table.active().size(), 2u);
    EXPECT_EQ(table.given(bob).codec, "rvl");
}

TEST(SettingTable, BeyondThreeTheNearestIsGivenUntilAPlaceIsFree) {
    SettingNumbers numbers;
    SettingTable table(numbers);
    table.wish(alice, "trvl");
    table.wish(bob, "zstd");
    table.wish(carol, "raw");
    table.wish(dave, "zstd:delta=1");
    EXPECT_EQ(table.active().size(), SettingTable::max_active);
    EXPECT_EQ(table.given(dave).codec, "zstd");
    table.wish(dave, "lz4");
    EXPECT_EQ(table.given(dave).codec, "trvl");
    table.leave(carol);
    EXPECT_EQ(table.given(dave).codec, "lz4");
}

TEST(SettingTable, NobodyTakesThePlaceOfTheUsualSetting) {
    SettingNumbers numbers;
    SettingTable table(numbers, "strata");
    table.wish(alice, "zstd:level=19");
    table.wish(bob, "ans");
    table.wish(carol, "raw");
    EXPECT_EQ(table.active().size(), SettingTable::max_active) << "nobody gets the usual one yet";
    table.wish(dave, "strata");
    EXPECT_EQ(table.given(dave).codec, "strata");
    EXPECT_EQ(table.active().size(), SettingTable::max_active + 1);
    table.wish(dave, "lz4");
    EXPECT_EQ(table.given(dave).codec, "strata") << "nothing is nearer";
    table.wish(dave, "zstd:level=1");
    EXPECT_EQ(table.given(dave).codec, "zstd:level=19") << "the same codec is nearer";
    table.set_slow(table.given(alice).id, true);
    EXPECT_EQ(table.given(dave).codec, "strata") << "but not if it is slow";
    EXPECT_EQ(table.given(alice).codec, "zstd:level=19") << "who wants it gets it";
    table.leave(dave);
    EXPECT_EQ(table.active().size(), SettingTable::max_active);
}

// Numbers are 16 bits wide in the media header and in recordings.
TEST(SettingTable, NumbersInUseAreGivenToNothingElseHoweverManyThereWere) {
    SettingNumbers numbers;
    SettingTable depth(numbers, "strata"), color(numbers, "jpeg");
    depth.wish(alice, "strata");
    color.wish(alice, "jpeg");
    const ActiveSetting usual_depth = depth.given(alice), usual_color = color.given(alice);
    SettingId before{};
    for (int i = 0; i < 200'000; ++i) {
        depth.wish(bob, i % 2 ? "rvl" : "lz4");
        if (i % 3 == 0)
            color.wish(bob, i % 2 ? "raw" : "h264");
        const std::set<SettingId> given{depth.given(alice).id, color.given(alice).id,
                                        depth.given(bob).id, color.given(bob).id};
        ASSERT_EQ(given.size(), 4u) << i;
        ASSERT_FALSE(given.contains(SettingId{0})) << i;
        ASSERT_NE(depth.given(bob).id, before) << i;
        before = depth.given(bob).id;
    }
    EXPECT_EQ(depth.given(alice), usual_depth);
    EXPECT_EQ(color.given(alice), usual_color);
}

TEST(SettingNumbers, ANumberComesAgainOnlyAfterAllOthers) {
    SettingNumbers numbers;
    const SettingId first = numbers.take();
    numbers.give_back(first);
    std::size_t others = 0;
    for (SettingId next = numbers.take(); next != first; next = numbers.take(), ++others)
        numbers.give_back(next);
    EXPECT_EQ(others, SettingNumbers::how_many - 1);
}

TEST(KeyRequests, AreCoalescedAndNeverLost) {
    KeyRequests requests;
    const KeyRequests::Key key{StreamId{2}, SettingId{1}};
    requests.request(key);
    requests.request(key);
    EXPECT_EQ(requests.take(from_us(0)).size(), 1u);
    requests.request(key);
    EXPECT_TRUE(requests.take(from_us(499'999)).empty());
    EXPECT_EQ(requests.take(from_us(500'000)).size(), 1u);
    EXPECT_TRUE(requests.take(from_us(9'000'000)).empty());
}

class Host : public ::testing::Test {
protected:
    Host() : session(config()) {}

    static HostSession::CheckedCodec check(const std::string& text) {
        return text == "bad" ? HostSession::CheckedCodec{"", "There is no codec bad."}
                             : HostSession::CheckedCodec{text, ""};
    }
    static HostSession::Config config() {
        Calibration calibration;
        calibration.depth.size = calibration.color.size = {64, 48};
        calibration.depth.fx = calibration.depth.fy = 60;
        calibration.color.fx = calibration.color.fy = 60;
        wire::Camera camera;
        camera.calibration = encode_calibration(calibration);
        camera.depth_stream = depth_stream(CameraId{0});
        camera.color_stream = color_stream(CameraId{0});
        camera.has_color = true;
        HostSession::Config config;
        config.admission.tokens = {{"secret", Role::viewer, {}},
                                   {"publish", Role::publisher, {}},
                                   {"short", Role::viewer, from_us(5'000'000)}};
        config.admission.equal_secrets = [](std::string_view a, std::string_view b) {
            return a == b;
        };
        config.name = "OR";
        config.cameras = {camera};
        config.check_depth = config.check_color = check;
        return config;
    }

    void join(ParticipantId id, const std::string& depth = "trvl",
              const std::string& token = "secret", bool records = false) {
        session.on_connected(id, now);
        wire::Join hello;
        hello.token = token;
        hello.depth_codec = depth;
        hello.color_codec = "jpeg";
        hello.records = records;
        say(id, hello);
    }
    void join_to_record(ParticipantId id, const std::string& depth) {
        join(id, depth, "secret", true);
    }
    void say(ParticipantId id, const wire::ToHost& message) {
        session.on_control(id, wire::encode(message), now);
    }
    // Everything of one type that is sent to a participant.
    template <class T>
    std::vector<T> sent(ParticipantId id, const std::vector<Action>& actions) {
        std::vector<T> result;
        for (const auto& a : all<action::Send>(actions))
            if (a.participant == id)
                if (const auto* m = std::get_if<T>(&a.message))
                    result.push_back(*m);
        return result;
    }
    // Everything of one type that is to be done.
    template <class T>
    static std::vector<T> all(const std::vector<Action>& actions) {
        std::vector<T> result;
        for (const Action& a : actions)
            if (const auto* wanted = std::get_if<T>(&a))
                result.push_back(*wanted);
        return result;
    }
    template <class T>
    static int count(const std::vector<Action>& actions) {
        return int(all<T>(actions).size());
    }

    TimePoint now = from_us(1'000'000);
    HostSession session;
};

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
    EXPECT_NE(sent<wire::Refused>(alice, actions)[0].reason.find("token"), std::string::npos);
    EXPECT_TRUE(sent<wire::Welcome>(alice, actions).empty());
    EXPECT_EQ(count<action::Close>(actions), 1);
    // Nothing that follows counts any more.
    join(alice);
    say(alice, wire::Ping{});
    EXPECT_TRUE(sent<wire::Pong>(alice, session.take_actions()).empty());
}

TEST_F(Host, RefusesAnUnknownCodecAndANewerProtocol) {
    join(alice, "bad");
    EXPECT_EQ(sent<wire::Refused>(alice, session.take_actions())[0].reason,
              "There is no codec bad.");
    session.on_connected(bob, now);
    wire::Join newer;
    newer.protocol_min = newer.protocol_max = wire::protocol_max + 1;
    newer.token = "secret";
    say(bob, newer);
    EXPECT_NE(sent<wire::Refused>(bob, session.take_actions())[0].reason.find("older"),
              std::string::npos);
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

TEST_F(Host, ABadWishKeepsTheOldCodecAndSaysSo) {
    join(alice);
    session.take_actions();
    say(alice, wire::ChooseCodecs{"bad", ""});
    const auto settings = sent<wire::Settings>(alice, session.take_actions());
    ASSERT_EQ(settings.size(), 1u);
    EXPECT_EQ(settings[0].note, "There is no codec bad.");
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
    EXPECT_NE(settings[0].note.find("zstd:level=3"), std::string::npos);
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
    session.on_camera({CameraId{0}, wire::CameraCondition::failed, "unplugged"});
    join(alice);
    const auto states = sent<wire::CameraState>(alice, session.take_actions());
    ASSERT_EQ(states.size(), 1u);
    EXPECT_EQ(states[0].problem, "unplugged");
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
    EXPECT_NE(given[0].note.find("strata"), std::string::npos) << "it is told";

    // A place becomes free; who asked for what it gets goes; others want other things.
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

TEST_F(Host, SetsTheRendererOfOneOfANameOrOfAll) {
    const auto heard = [&](ParticipantId id, const auto& actions) {
        std::string text;
        for (const auto& word : sent<wire::SetRenderer>(id, actions))
            text += word.renderer + (word.locked ? "!" : "") + ";";
        return text;
    };
    join(alice);
    EXPECT_EQ(heard(alice, session.take_actions()), "") << "nothing was said yet";
    session.set_renderer({"mesh", true});
    session.set_renderer(dave, {"splat", false});  // who is not in
    auto actions = session.take_actions();
    EXPECT_EQ(heard(alice, actions), "mesh!;");
    EXPECT_EQ(heard(dave, actions), "");

    join(bob);
    EXPECT_EQ(heard(bob, session.take_actions()), "mesh!;") << "who comes later is told, too";
    session.set_renderer(bob, {"blend", false});
    actions = session.take_actions();
    EXPECT_EQ(heard(alice, actions), "");
    EXPECT_EQ(heard(bob, actions), "blend;");
    session.on_closed(bob);
    join(bob);
    EXPECT_EQ(heard(bob, session.take_actions()), "mesh!;") << "a number is of one connection";

    session.set_renderer("guest", {"disc", true});  // as both are called
    actions = session.take_actions();
    EXPECT_EQ(heard(alice, actions) + heard(bob, actions), "disc!;disc!;");
    session.on_closed(bob);
    join(bob);
    EXPECT_EQ(heard(bob, session.take_actions()), "disc!;") << "a name is found again";
    session.set_renderer({"", false});
    join(carol);
    EXPECT_EQ(heard(carol, session.take_actions()), ";") << "names are forgotten";
}

TEST_F(Host, LogsHowSomebodyDrawsWhenThatChanges) {
    join(alice);
    session.take_actions();
    for (const char* renderer : {"mesh", "mesh", "ble\nnd", ""}) {
        now += 1s;
        say(alice, wire::Report{{}, renderer});
    }
    // A change so soon is believed when it is said again.
    say(alice, wire::Report{{}, "disc"});
    now += 1s;
    say(alice, wire::Report{{}, "splat"});
    std::vector<std::string> noted;
    for (const auto& a : all<action::Drawing>(session.take_actions()))
        noted.push_back(a.renderer);
    EXPECT_EQ(noted, (std::vector<std::string>{"mesh", "ble nd", "", "splat"}));
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
    EXPECT_NE(sent<wire::Refused>(alice, actions)[0].reason.find("requests"), std::string::npos);
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

TEST_F(Host, WhoLostMessagesIsToldEverythingAgain) {
    join(alice);
    join(bob);
    session.on_camera({CameraId{0}, wire::CameraCondition::stale, "It is dark.", ""});
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

TEST_F(Host, ASettingThatCannotKeepUpIsToldToThoseWhoGetIt) {
    join(alice, "trvl");
    join(bob, "zstd:level=19");
    session.take_actions();
    const SettingId slow = session.depth_settings()[1].id;
    session.on_encoding(CameraId{0}, slow, false, 151.6);
    auto actions = session.take_actions();
    EXPECT_TRUE(sent<wire::Settings>(alice, actions).empty());
    ASSERT_EQ(sent<wire::Settings>(bob, actions).size(), 1u);
    const auto told = sent<wire::Settings>(bob, actions)[0];
    EXPECT_TRUE(told.settings.empty());
    EXPECT_EQ(told.note.find("Encoding zstd:level=19 takes 152 ms"), 0u) << told.note;
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

TEST(RendererChoice, TheLastWordHoldsUnlessTheHostLocksIt) {
    RendererChoice choice("auto");
    choice.follow({"mesh", false});
    EXPECT_EQ(choice.renderer(), "mesh");
    EXPECT_TRUE(choice.choose("splat"));
    EXPECT_EQ(choice.renderer(), "splat");
    choice.follow({"blend", true});
    EXPECT_FALSE(choice.choose("splat"));
    EXPECT_EQ(choice.renderer(), "blend");
    choice.follow({"", false});
    EXPECT_EQ(choice.renderer(), "blend") << "given back as it is";
    EXPECT_TRUE(choice.choose("splat"));
}

// Host and viewer, each fed with what the other says.
TEST_F(Host, AViewerJoinsAndChangesItsCodec) {
    ViewerSession viewer({"secret", "Dr. A", "trvl", "jpeg"});
    session.on_connected(alice, now);
    session.on_control(alice, viewer.begin(), now);
    std::vector<ViewerSession::Change> changes;
    const auto deliver = [&] {
        changes.clear();
        for (const auto& a : all<action::Send>(session.take_actions()))
            changes.push_back(viewer.on_control(wire::encode(a.message)));
    };
    deliver();
    using Change = ViewerSession::Change;
    EXPECT_EQ(changes, (std::vector{Change::welcomed, Change::settings}));
    EXPECT_EQ(viewer.cameras().size(), 1u);
    EXPECT_EQ(viewer.settings().size(), 2u);

    session.on_control(alice, viewer.choose("rvl", ""), now);
    deliver();
    EXPECT_EQ(changes, std::vector{Change::settings});
    EXPECT_EQ(viewer.settings()[0].codec, "rvl");
    EXPECT_EQ(viewer.wishes().depth_codec, "rvl");

    session.on_control(alice, viewer.choose("bad", ""), now);
    deliver();
    EXPECT_EQ(viewer.note(), "There is no codec bad.");
    EXPECT_EQ(viewer.settings()[0].codec, "rvl");

    session.set_renderer({"mesh", true});
    deliver();
    EXPECT_EQ(changes, std::vector{Change::renderer});
    EXPECT_EQ(viewer.renderer_word(), (wire::SetRenderer{"mesh", true}));
    (void)viewer.begin();
    EXPECT_EQ(viewer.renderer_word(), wire::SetRenderer{}) << "another host may think otherwise";
}

TEST_F(Host, EverybodyIsToldOnceThatTheSessionIsOver) {
    join(alice);
    session.on_connected(bob, now);  // has not joined
    session.take_actions();
    session.end();
    session.end();
    const auto actions = session.take_actions();
    ASSERT_EQ(actions.size(), 1u);
    const auto* end = std::get_if<action::End>(&actions[0]);
    ASSERT_TRUE(end);
    EXPECT_EQ(end->participant, alice);

    ViewerSession viewer({});
    EXPECT_EQ(viewer.on_control(wire::encode(end->message)), ViewerSession::Change::goodbye);
    EXPECT_EQ(viewer.goodbye(), "The host has ended the session.");
    (void)viewer.begin();
    EXPECT_EQ(viewer.goodbye(), "");
}

TEST(ViewerSession, IgnoresWhatItDoesNotUnderstand) {
    ViewerSession viewer({});
    EXPECT_EQ(viewer.on_control(Bytes(7)), ViewerSession::Change::nothing);
    EXPECT_EQ(viewer.on_control(wire::encode(wire::Refused{""})), ViewerSession::Change::refused);
    EXPECT_FALSE(viewer.refusal().empty());
}

}  // namespace
}  // namespace theatron::session
