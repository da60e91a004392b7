// SPDX-License-Identifier: Apache-2.0
#include "session/studies.h"

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
    void come(ParticipantId id, const std::string& token, bool knows_studies = true) {
        session.on_connected(id, now);
        wire::Join hello;
        hello.token = token;
        hello.name = "person " + std::to_string(std::uint32_t(id));
        hello.depth_codec = "trvl";
        hello.color_codec = "jpeg";
        hello.features = {wire::Feature::room};
        if (knows_studies)
            hello.features.push_back(wire::Feature::study);
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

    static constexpr ParticipantId lead = alice, taker = bob;
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
    EXPECT_EQ(sent<wire::SetRenderer>(taker, taken), std::vector{(wire::SetRenderer{"", false})});
    EXPECT_EQ(actions_of<action::Delay>(taken).at(0).by, 0ms);
    tell(taker, wire::ChooseCodecs{"zstd", "", {}});
    EXPECT_TRUE(std::any_of(session.depth_settings().begin(), session.depth_settings().end(),
                            [](const ActiveSetting& one) { return one.codec == "zstd"; }));
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

}  // namespace
}  // namespace theatron::session
