// SPDX-License-Identifier: Apache-2.0
#include "session/studies.h"

#include <set>

#include "session/host_session_testing.h"

namespace theatron::session {
namespace {

using wire::ManageRefusal;
using wire::StudyKind;

class StudiesOfAHost : public Host {
protected:
    StudiesOfAHost() {
        session.set_tokens({{"operate", Role::operator_, {}, "operator"},
                            {"secret", Role::expert, {}, "expert"},
                            {"watch", Role::observer, {}, "observer"}});
        come(lead, "operate");
        come(taker, "secret");
    }
    void come(ParticipantId id, const std::string& token, bool knows_studies = true,
              bool draws_flat = false) {
        session.on_connected(id, now);
        wire::Join hello;
        hello.token = token;
        hello.name = "person " + std::to_string(std::uint32_t(id));
        hello.depth_codec = "trvl";
        hello.color_codec = "jpeg";
        hello.features = {wire::Feature::room};
        if (knows_studies)
            hello.features.push_back(wire::Feature::study);
        if (draws_flat)
            hello.features.push_back(wire::Feature::draws_flat);
        say(id, hello);
        taken = session.take_actions();
    }
    void tell(ParticipantId id, const wire::ToHost& message) {
        now += 1s;  // within every budget
        say(id, message);
        taken = session.take_actions();
    }
    static wire::StudyStep step(std::uint32_t number) {
        wire::StudyStep step;
        step.step = number;
        step.steps = 9;
        step.kind = StudyKind::rating;
        step.texts = {{"How was it?"}};
        step.highest = 6;
        return step;
    }
    ManageRefusal show(ParticipantId by, ParticipantId to, const wire::StudyStep& step) {
        tell(by, wire::ShowStudy{5, to, step});
        return answer(by);
    }
    ManageRefusal answer(ParticipantId by) {
        const auto answers = sent<wire::Managed>(by, taken);
        return answers.empty() ? ManageRefusal{255} : answers[0].refusal;
    }
    std::vector<wire::StudyReplied> replied(ParticipantId from, std::uint32_t number) {
        tell(from, wire::StudyReply{number, wire::StudyAction::answer, 3});
        return sent<wire::StudyReplied>(lead, taken);
    }

    void set(const std::string& renderer, const std::string& depth, Duration latency = {}) {
        const bool locked = !renderer.empty() || !depth.empty() || latency > Duration(0);
        tell(lead, wire::SetCondition{7, taker, renderer, depth, "", latency, locked});
        EXPECT_EQ(answer(lead), ManageRefusal::none);
    }
    // The depth codecs that the host's camera is encoded in.
    std::set<std::string> depth_codecs() {
        session.on_tick(now += 1s);
        std::set<std::string> codecs;
        for (const ActiveSetting& setting : session.depth_settings())
            codecs.insert(setting.codec);
        return codecs;
    }
    // All that the participant had before a condition holds again.
    void expect_freed() {
        EXPECT_EQ(sent<wire::SetRenderer>(taker, taken), std::vector{own});
        const auto delays = actions_of<action::Delay>(taken);
        ASSERT_EQ(delays.size(), 1u);
        EXPECT_EQ(delays[0].participant, taker);
        EXPECT_EQ(delays[0].by, 0ms);
        EXPECT_EQ(depth_codecs(), std::set<std::string>{"trvl"});
        tell(taker, wire::ChooseCodecs{"zstd", "", {}});
        EXPECT_TRUE(depth_codecs().contains("zstd"));
    }

    static constexpr ParticipantId lead = alice, taker = bob;
    const wire::SetRenderer own{own_renderer, false};
    std::vector<Action> taken;
};

TEST_F(StudiesOfAHost, StepsGoToTheParticipantAndRepliesBackToTheLeaderAlone) {
    come(carol, "secret");
    EXPECT_EQ(show(lead, taker, step(4)), ManageRefusal::none);
    EXPECT_EQ(sent<wire::StudyStep>(taker, taken), std::vector{step(4)});
    EXPECT_TRUE(sent<wire::StudyStep>(carol, taken).empty());
    EXPECT_EQ(replied(taker, 4),
              (std::vector{wire::StudyReplied{taker, {4, wire::StudyAction::answer, 3}}}));
    EXPECT_TRUE(sent<wire::StudyReplied>(carol, taken).empty());
    EXPECT_TRUE(sent<wire::StudyReplied>(taker, taken).empty());
}

TEST_F(StudiesOfAHost, RepliesToOtherStepsAndOfOthersGoNowhere) {
    come(carol, "secret");
    EXPECT_TRUE(replied(taker, 1).empty()) << "before there is a study";
    EXPECT_EQ(show(lead, taker, step(4)), ManageRefusal::none);
    EXPECT_TRUE(replied(taker, 3).empty());
    EXPECT_TRUE(replied(taker, 5).empty());
    EXPECT_TRUE(replied(carol, 4).empty());
    wire::StudyStep end = step(5);
    end.kind = StudyKind::over;
    EXPECT_EQ(show(lead, taker, end), ManageRefusal::none);
    EXPECT_TRUE(replied(taker, 5).empty()) << "after its end";
}

TEST_F(StudiesOfAHost, OnlyOperatorsLeadAndOneAtATime) {
    come(carol, "operate");
    come(dave, "watch");
    EXPECT_EQ(show(taker, dave, step(1)), ManageRefusal::role);
    EXPECT_EQ(show(dave, taker, step(1)), ManageRefusal::role);
    EXPECT_EQ(show(lead, lead, step(1)), ManageRefusal::yourself);
    EXPECT_EQ(show(lead, ParticipantId{77}, step(1)), ManageRefusal::no_such_participant);
    EXPECT_EQ(show(lead, dave, step(1)), ManageRefusal::none) << "an observer may take part";
    EXPECT_FALSE(replied(dave, 1).empty());
    EXPECT_EQ(show(carol, dave, step(2)), ManageRefusal::other_study);
    session.on_closed(lead);
    taken = session.take_actions();
    EXPECT_EQ(show(carol, dave, step(2)), ManageRefusal::none) << "nobody leads it any more";
}

TEST_F(StudiesOfAHost, AParticipantWhoseProgramIsTooOldIsNamed) {
    come(carol, "secret", false);
    EXPECT_EQ(show(lead, carol, step(1)), ManageRefusal::shows_no_study);
    EXPECT_TRUE(sent<wire::StudyStep>(carol, taken).empty());
}

TEST_F(StudiesOfAHost, AStepThatFitsIntoNoMessageIsRefused) {
    wire::StudyStep large = step(1);
    large.texts.assign(wire::max_study_texts, {std::string(wire::max_study_text, 'a')});
    EXPECT_EQ(show(lead, taker, large), ManageRefusal::none) << "as much as a protocol may have";
    for (wire::StudyText& text : large.texts)
        for (text.text.clear(); text.text.size() < 4 * wire::max_study_text;)
            text.text += "\xf0\x9f\x98\x80";
    EXPECT_EQ(show(lead, taker, large), ManageRefusal::large_step);
    EXPECT_TRUE(sent<wire::StudyStep>(taker, taken).empty());
}

TEST_F(StudiesOfAHost, TheParticipantIsToldThatItsLeaderHasGone) {
    EXPECT_EQ(show(lead, taker, step(4)), ManageRefusal::none);
    session.on_closed(lead);
    taken = session.take_actions();
    const auto told = sent<wire::StudyStep>(taker, taken);
    ASSERT_EQ(told.size(), 1u);
    EXPECT_EQ(told[0].kind, StudyKind::interrupted);
    EXPECT_TRUE(replied(taker, 4).empty());
}

TEST_F(StudiesOfAHost, ALeaderWhoIsNoOperatorAnyMoreLeadsNoStudy) {
    come(carol, "operate");
    EXPECT_EQ(show(lead, taker, step(4)), ManageRefusal::none);
    tell(carol, wire::Manage{6, wire::ManageAction::set_role, lead, Role::expert});
    EXPECT_EQ(sent<wire::StudyStep>(taker, taken).at(0).kind, StudyKind::interrupted);
    EXPECT_TRUE(replied(taker, 4).empty());
}

TEST_F(StudiesOfAHost, WhoMissedMessagesIsShownTheStepAgain) {
    EXPECT_EQ(show(lead, taker, step(4)), ManageRefusal::none);
    session.resynchronise(taker);
    EXPECT_EQ(sent<wire::StudyStep>(taker, session.take_actions()), std::vector{step(4)});
    session.on_closed(taker);
    come(taker, "secret");
    session.resynchronise(taker);
    EXPECT_TRUE(sent<wire::StudyStep>(taker, session.take_actions()).empty())
        << "a number is of one connection";
}

TEST_F(StudiesOfAHost, ConditionsAreSetAndLocked) {
    wire::SetCondition mesh{7, taker, "mesh", "rvl", "", 80ms, true};
    tell(taker, mesh);
    EXPECT_EQ(answer(taker), ManageRefusal::role);
    tell(lead, mesh);
    EXPECT_EQ(answer(lead), ManageRefusal::none);
    EXPECT_EQ(sent<wire::SetRenderer>(taker, taken),
              std::vector{(wire::SetRenderer{"mesh", true})});
    const auto delays = actions_of<action::Delay>(taken);
    ASSERT_EQ(delays.size(), 1u);
    EXPECT_EQ(delays[0].participant, taker);
    EXPECT_EQ(delays[0].by, 80ms);
    EXPECT_EQ(session.depth_settings().size(), 2u) << "trvl of the leader, rvl of the participant";

    tell(taker, wire::ChooseCodecs{"zstd", "", {}});
    const auto notes = sent<wire::Settings>(taker, taken);
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_EQ(notes[0].note.code, wire::TextCode::codecs_are_set);
    for (const ActiveSetting& setting : session.depth_settings())
        EXPECT_NE(setting.codec, "zstd");

    tell(lead, wire::SetCondition{8, taker, "", "", "", 0ms, false});
    EXPECT_EQ(sent<wire::SetRenderer>(taker, taken), std::vector{own});
    EXPECT_EQ(actions_of<action::Delay>(taken).at(0).by, 0ms);
    tell(taker, wire::ChooseCodecs{"zstd", "", {}});
    EXPECT_TRUE(std::any_of(session.depth_settings().begin(), session.depth_settings().end(),
                            [](const ActiveSetting& one) { return one.codec == "zstd"; }));
}

TEST_F(StudiesOfAHost, WhatAConditionLeavesOpenIsAsTheParticipantHasChosenIt) {
    tell(taker, wire::ChooseCodecs{"zstd", "", {CameraId{0}}});
    EXPECT_EQ(depth_codecs(), (std::set<std::string>{"trvl", "zstd"}));
    set("mesh", "rvl", 80ms);
    EXPECT_EQ(depth_codecs(), (std::set<std::string>{"trvl", "rvl"}));
    set("", "", 40ms);
    EXPECT_EQ(sent<wire::SetRenderer>(taker, taken), std::vector{own});
    EXPECT_EQ(depth_codecs(), (std::set<std::string>{"trvl", "zstd"}))
        << "the wish for this camera alone";
    set("splat", "");
    EXPECT_EQ(depth_codecs(), (std::set<std::string>{"trvl", "zstd"}));
    tell(taker, wire::ChooseCodecs{"delta", "", {}});
    EXPECT_TRUE(depth_codecs().contains("delta")) << "codecs are free";
    set("", "");
    EXPECT_EQ(sent<wire::SetRenderer>(taker, taken), std::vector{own});
    EXPECT_TRUE(depth_codecs().contains("delta"));
    set("", "");
    EXPECT_TRUE(sent<wire::SetRenderer>(taker, taken).empty()) << "it has its own one";
}

TEST_F(StudiesOfAHost, TheHostsOwnLockHoldsAgainAfterAConditionAndReachesThoseWhoHadOne) {
    session.set_renderer({"blend", true});
    set("mesh", "");
    taken = session.take_actions();
    set("", "");
    EXPECT_EQ(sent<wire::SetRenderer>(taker, taken),
              std::vector{(wire::SetRenderer{"blend", true})});
    set("mesh", "");
    session.set_renderer({"splat", false});
    taken = session.take_actions();
    EXPECT_EQ(sent<wire::SetRenderer>(taker, taken), std::vector{(wire::SetRenderer{"mesh", true})})
        << "the condition goes first";
    set("", "");
    EXPECT_EQ(sent<wire::SetRenderer>(taker, taken),
              std::vector{(wire::SetRenderer{"splat", false})});
}

TEST_F(StudiesOfAHost, WhoeverIsFreedHasNoConditionLeft) {
    set("mesh", "rvl", 80ms);  // without any step
    session.on_closed(lead);
    taken = session.take_actions();
    EXPECT_TRUE(sent<wire::StudyStep>(taker, taken).empty()) << "it has seen nothing of a study";
    expect_freed();
}

TEST_F(StudiesOfAHost, AConditionEndsWithTheRightToManage) {
    come(carol, "operate");
    set("mesh", "rvl", 80ms);
    tell(carol, wire::Manage{6, wire::ManageAction::set_role, lead, Role::expert});
    expect_freed();
}

TEST_F(StudiesOfAHost, AConditionEndsWithTheStudy) {
    EXPECT_EQ(show(lead, taker, step(1)), ManageRefusal::none);
    set("mesh", "rvl", 80ms);
    wire::StudyStep end = step(2);
    end.kind = StudyKind::over;
    EXPECT_EQ(show(lead, taker, end), ManageRefusal::none);
    expect_freed();
}

TEST_F(StudiesOfAHost, AProgramThatIsKnownLeadsOnePersonWhoeverElseComes) {
    const auto come_as = [&](ParticipantId id, const char* token, int person, int run) {
        session.on_connected(id, now += 1s);
        wire::Join hello;
        hello.token = token;
        hello.name = person == 9 ? "study" : "Anna";
        hello.depth_codec = "trvl";
        hello.color_codec = "jpeg";
        hello.features = {wire::Feature::room, wire::Feature::study};
        hello.person = Bytes(wire::person_id_size, std::byte(person));
        hello.run = std::uint64_t(run);
        say(id, hello);
        taken = session.take_actions();
    };
    const ParticipantId program{11}, again{12}, anna{13}, stranger{14}, anna_again{15};
    come_as(program, "operate", 9, 1);
    come_as(anna, "secret", 1, 2);
    EXPECT_EQ(show(program, anna, step(1)), ManageRefusal::none);
    session.on_closed(anna);
    come_as(stranger, "secret", 2, 3);
    EXPECT_EQ(show(program, stranger, step(1)), ManageRefusal::no_such_participant);
    tell(program, wire::SetCondition{9, stranger, "splat", "", "", 0ms, true});
    EXPECT_EQ(answer(program), ManageRefusal::no_such_participant);
    come_as(anna_again, "secret", 1, 4);
    EXPECT_EQ(show(program, anna_again, step(1)), ManageRefusal::none);
    // Its own new connection, while the host has not noticed the end of the one before.
    come_as(again, "operate", 9, 1);
    EXPECT_EQ(show(again, anna_again, step(1)), ManageRefusal::none);
    EXPECT_EQ(show(again, stranger, step(1)), ManageRefusal::no_such_participant);
}

TEST_F(StudiesOfAHost, WhoeverSetsAConditionLeads) {
    come(carol, "operate");
    set("mesh", "");
    tell(carol, wire::SetCondition{9, taker, "splat", "", "", 0ms, true});
    EXPECT_EQ(answer(carol), ManageRefusal::other_study);
    EXPECT_EQ(show(carol, taker, step(1)), ManageRefusal::other_study);
    set("", "");
    EXPECT_EQ(show(carol, taker, step(1)), ManageRefusal::none) << "nothing is left of it";
}

TEST_F(StudiesOfAHost, WhileItsCodecsAreSetAParticipantChangesNothingThatIsSent) {
    tell(taker, wire::ChooseDelivery{0, 900});
    ASSERT_EQ(actions_of<action::SetCeiling>(taken).size(), 1u);
    set("", "rvl");
    tell(taker, wire::ChooseDelivery{100, 200});
    EXPECT_TRUE(actions_of<action::SetCeiling>(taken).empty());
    EXPECT_EQ(sent<wire::Settings>(taker, taken).at(0).note.code, wire::TextCode::codecs_are_set);
    set("mesh", "");
    tell(taker, wire::ChooseDelivery{0, 300});
    EXPECT_EQ(actions_of<action::SetCeiling>(taken).size(), 1u);
}

TEST_F(StudiesOfAHost, AStepThatIsToldAgainHasWhatIsLeftOfItsTimes) {
    wire::StudyStep watched = step(4);
    watched.watch = 30s;
    watched.limit = 20s;
    EXPECT_EQ(show(lead, taker, watched), ManageRefusal::none);
    session.on_tick(now + 12s);
    session.resynchronise(taker);
    wire::StudyStep again = sent<wire::StudyStep>(taker, session.take_actions()).at(0);
    EXPECT_EQ(again.watch, 18s);
    EXPECT_EQ(again.limit, 8s);
    session.on_tick(now + 60s);
    session.resynchronise(taker);
    again = sent<wire::StudyStep>(taker, session.take_actions()).at(0);
    EXPECT_EQ(again.watch, 1us) << "0 would be none";
    EXPECT_EQ(again.limit, 1us);
}

TEST_F(StudiesOfAHost, NobodyWithoutTheRightToManageSeesTheRoomUnseen) {
    const auto hello = [&](const std::string& token) {
        wire::Join hello;
        hello.token = token;
        hello.depth_codec = "trvl";
        hello.color_codec = "jpeg";
        hello.features = {wire::Feature::sends_only, wire::Feature::room, wire::Feature::study};
        return hello;
    };
    const auto brick = [&] {
        tell(taker,
             wire::RoomRequest{1, encode_request(request::Create{ObjectKind::brick, {}, 1, {}})});
    };
    for (const char* token : {"watch", "secret"}) {
        session.on_connected(carol, now);
        tell(carol, hello(token));
        EXPECT_EQ(sent<wire::Welcome>(carol, taken).size(), 1u) << token;
        EXPECT_TRUE(sent<wire::RoomSnapshot>(carol, taken).empty()) << token;
        brick();
        EXPECT_TRUE(sent<wire::RoomChange>(carol, taken).empty()) << token;
        session.on_closed(carol);
    }
    session.on_connected(dave, now);
    tell(dave, hello("operate"));
    brick();
    EXPECT_EQ(sent<wire::RoomChange>(dave, taken).size(), 1u);
    tell(lead, wire::Manage{6, wire::ManageAction::set_role, dave, Role::publisher});
    brick();
    EXPECT_TRUE(sent<wire::RoomChange>(dave, taken).empty());
    session.resynchronise(dave);
    EXPECT_TRUE(sent<wire::RoomSnapshot>(dave, session.take_actions()).empty());
}

TEST_F(StudiesOfAHost, AConditionWithAnUnknownCodecChangesNothing) {
    tell(lead, wire::SetCondition{7, taker, "mesh", "bad", "", 80ms, true});
    EXPECT_EQ(answer(lead), ManageRefusal::no_such_codec);
    EXPECT_TRUE(sent<wire::SetRenderer>(taker, taken).empty());
    EXPECT_TRUE(actions_of<action::Delay>(taken).empty());
}

TEST_F(StudiesOfAHost, AProgramThatOnlyWatchesIsNobodyInTheRoomAndChangesNothing) {
    session.on_connected(carol, now);
    wire::Join hello;
    hello.token = "operate";
    hello.depth_codec = "trvl";
    hello.color_codec = "jpeg";
    hello.features = {wire::Feature::sends_only, wire::Feature::room, wire::Feature::study};
    say(carol, hello);
    taken = session.take_actions();
    EXPECT_EQ(sent<wire::RoomSnapshot>(carol, taken).size(), 1u);
    EXPECT_TRUE(sent<wire::RoomChange>(taker, taken).empty()) << "no person has come";
    const Bytes brick = encode_request(request::Create{ObjectKind::brick, {}, 1, {}});
    tell(carol, wire::RoomRequest{1, brick});
    EXPECT_EQ(sent<wire::RoomDecision>(carol, taken).at(0).refusal, std::uint8_t(Refusal::role));
    tell(taker, wire::RoomRequest{1, brick});
    EXPECT_EQ(sent<wire::RoomChange>(carol, taken).size(), 1u);
    EXPECT_EQ(show(carol, taker, step(1)), ManageRefusal::none);
    session.on_closed(carol);
    EXPECT_TRUE(sent<wire::RoomChange>(taker, session.take_actions()).empty());
}

TEST_F(StudiesOfAHost, AReplyThatIsOneTooManyIsAskedForAgain) {
    EXPECT_EQ(show(lead, taker, step(1)), ManageRefusal::none);
    const auto limit = RequestBudget::limits[std::size_t(RequestBudget::Kind::room)];
    std::size_t kept = 0, again = 0;
    for (int i = 0; i <= int(limit.at_once); ++i) {  // at one moment
        say(taker, wire::StudyReply{1, wire::StudyAction::answer, 3});
        taken = session.take_actions();
        kept += sent<wire::StudyReplied>(lead, taken).size();
        again += sent<wire::StudyStep>(taker, taken).size();
    }
    EXPECT_EQ(kept, std::size_t(limit.at_once));
    EXPECT_EQ(again, 1u);
}

TEST_F(StudiesOfAHost, TheFlatViewHasNoConditionOfRendererOrDepth) {
    come(carol, "secret", true, true);
    const auto set_for_carol = [&](const std::string& renderer, const std::string& depth,
                                   Duration latency) {
        tell(lead, wire::SetCondition{8, carol, renderer, depth, "", latency, true});
        return answer(lead);
    };
    EXPECT_EQ(set_for_carol("mesh", "", 0ms), ManageRefusal::draws_flat);
    EXPECT_EQ(set_for_carol("", "rvl", 0ms), ManageRefusal::draws_flat);
    EXPECT_TRUE(sent<wire::SetRenderer>(carol, taken).empty());
    EXPECT_EQ(set_for_carol("", "", 80ms), ManageRefusal::none);
    EXPECT_EQ(show(lead, carol, step(1)), ManageRefusal::none);
}

}  // namespace
}  // namespace theatron::session
