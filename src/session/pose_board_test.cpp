// SPDX-License-Identifier: Apache-2.0
#include "session/pose_board.h"

#include <gtest/gtest.h>

#include "wire/face_expression.h"
#include "wire/person_pose.h"

namespace theatron::session {
namespace {

constexpr ParticipantId alice{1}, bob{2};
bool everything(Right) {
    return true;
}
bool seeing(Right right) {
    return may(Role::observer, right);
}
using Answer = PoseBoard::Answer;

Bytes pose_at(TimePoint time, float x) {
    wire::PersonPose pose;
    pose.time = time;
    pose.head = wire::PartPose{{x, 1.7F, 0}, {1, 0, 0, 0}};
    return wire::encode_person_pose(pose);
}

struct Board {
    PoseBoard board;
    TimePoint now = from_us(10'000'000);

    Answer put(ParticipantId sender, float x, Duration age = {}) {
        const Bytes body = pose_at(now - age, x);
        return board.put(sender, {{wire::StateTopic::pose, std::uint32_t(sender)}, body},
                         everything, now);
    }
    // The places of the gathered poses, by owner.
    std::map<ParticipantId, float> gathered() { return places(board.gather(now)); }
    static std::map<ParticipantId, float> places(const std::vector<PoseBoard::Entry>& entries) {
        std::map<ParticipantId, float> result;
        for (const auto& entry : entries) {
            EXPECT_EQ(entry.state.key.id, std::uint32_t(entry.participant));
            const auto pose = wire::decode_person_pose(entry.state.body);
            EXPECT_TRUE(pose);
            result[entry.participant] = pose->head ? pose->head->position[0] : -1;
        }
        return result;
    }
};

TEST(PoseBoard, SendsTheNewestOfEverybodyTogetherNinetyTimesASecond) {
    Board b;
    int sent = 0;
    const TimePoint end = b.now + 1s;
    for (int i = 0; b.now < end; ++i, b.now += 1ms) {
        // 100 poses a second of each, not at the same time.
        if (i % 10 == 0) {
            EXPECT_EQ(b.put(alice, float(i)), Answer::kept);
        }
        if (i % 10 == 5) {
            EXPECT_EQ(b.put(bob, float(i)), Answer::kept);
        }
        if (const auto due = b.board.due(); due && *due <= b.now) {
            ++sent;
            const auto places = b.gathered();
            if (sent > 1) {
                ASSERT_EQ(places.size(), 2u);
                EXPECT_EQ(places.at(alice), float(i - i % 10));
            }
        }
    }
    EXPECT_GE(sent, 80);
    EXPECT_LE(sent, 91);
}

TEST(PoseBoard, IsDueAtOnceAfterAPauseAndNeverWhileNobodyMoves) {
    Board b;
    EXPECT_FALSE(b.board.due());
    b.put(alice, 1);
    EXPECT_EQ(b.board.due(), b.now);
    b.gathered();
    EXPECT_FALSE(b.board.due());
    b.now += 1ms;
    b.put(alice, 2);
    EXPECT_EQ(b.board.due(), b.now - 1ms + PoseBoard::period);
    b.now += 1s;
    b.gathered();
    b.now += 1s;
    b.put(bob, 3);
    EXPECT_EQ(b.board.due(), b.now);
    EXPECT_EQ(b.gathered(), (std::map<ParticipantId, float>{{bob, 3}})) << "only what is new";
    EXPECT_EQ(Board::places(b.board.all()), (std::map<ParticipantId, float>{{alice, 2}, {bob, 3}}));
}

TEST(PoseBoard, IgnoresPosesOfOthersOldOnesAndOnesOfTheFuture) {
    Board b;
    const Bytes body = pose_at(b.now, 1);
    EXPECT_EQ(
        b.board.put(alice, {{wire::StateTopic::pose, std::uint32_t(bob)}, body}, everything, b.now),
        Answer::ignored);
    EXPECT_EQ(
        b.board.put(alice, {{wire::StateTopic(9), std::uint32_t(alice)}, body}, everything, b.now),
        Answer::ignored);
    EXPECT_EQ(b.board.put(alice, {{wire::StateTopic::pose, std::uint32_t(alice)}, Bytes(5)},
                          everything, b.now),
              Answer::ignored);
    EXPECT_EQ(b.put(alice, 1, -2s), Answer::ignored);
    EXPECT_FALSE(b.board.due());
    EXPECT_EQ(b.put(alice, 1, 10ms), Answer::kept);
    EXPECT_EQ(b.put(alice, 2, 20ms), Answer::ignored);
    EXPECT_EQ(b.gathered().at(alice), 1);
}

TEST(PoseBoard, TheOthersAreToldOnceWhoHasLeft) {
    Board b;
    b.put(alice, 1);
    b.put(bob, 2);
    b.gathered();
    b.board.remove(alice, b.now);
    EXPECT_EQ(b.put(alice, 7), Answer::ignored);
    EXPECT_EQ(b.gathered(), (std::map<ParticipantId, float>{{alice, -1}}));
    EXPECT_EQ(Board::places(b.board.all()), (std::map<ParticipantId, float>{{bob, 2}}));
    b.board.remove(alice, b.now);
    b.board.remove(ParticipantId{9}, b.now);
    EXPECT_FALSE(b.board.due());
}

TEST(PoseBoard, FarTooManyPosesAreAFlood) {
    Board b;
    Answer answer{};
    int kept = 0;
    for (; kept < 10'000 && answer != Answer::flood; ++kept) {
        b.now += 100us;
        answer = b.put(alice, 1);
    }
    EXPECT_EQ(answer, Answer::flood);
    EXPECT_GT(kept, 500);
    EXPECT_EQ(b.put(bob, 1), Answer::kept);
}

wire::FaceExpression happy_at(TimePoint time) {
    wire::FaceExpression face;
    face.time = time;
    face.state = wire::FaceExpression::State::tracked;
    face.emotions[2] = 1;
    return face;
}

TEST(PoseBoard, SendsExpressionsBesidePosesAndTakesThemBackAtTheEnd) {
    Board b;
    b.put(alice, 1);
    const auto put = [&](ParticipantId sender, ParticipantId owner) {
        const Bytes body = wire::encode_face_expression(happy_at(b.now));
        return b.board.put(sender, {{wire::StateTopic::expression, std::uint32_t(owner)}, body},
                           everything, b.now);
    };
    EXPECT_EQ(put(bob, alice), Answer::ignored);
    EXPECT_EQ(put(alice, alice), Answer::kept);
    EXPECT_EQ(put(alice, alice), Answer::ignored) << "it is not newer";
    auto entries = b.board.gather(b.now);
    ASSERT_EQ(entries.size(), 2u);
    EXPECT_EQ(entries[0].state.key.topic, wire::StateTopic::pose);
    EXPECT_EQ(entries[1].state.key.topic, wire::StateTopic::expression);
    EXPECT_EQ(*wire::decode_face_expression(entries[1].state.body), happy_at(b.now));
    EXPECT_EQ(b.board.all().size(), 2u);
    b.board.remove(alice, b.now + 1s);
    entries = b.board.gather(b.now + 1s);
    ASSERT_EQ(entries.size(), 2u);
    EXPECT_EQ(wire::decode_face_expression(entries[1].state.body)->state,
              wire::FaceExpression::State::none);
    EXPECT_TRUE(b.board.all().empty());
}

TEST(PoseBoard, FarTooManyExpressionsAreAFlood) {
    Board b;
    int kept = 0;
    for (Answer answer{}; kept < 10'000 && answer != Answer::flood; ++kept) {
        b.now += 100us;
        const Bytes body = wire::encode_face_expression(happy_at(b.now));
        answer = b.board.put(alice, {{wire::StateTopic::expression, std::uint32_t(alice)}, body},
                             everything, b.now);
    }
    EXPECT_GE(kept, int(PoseBoard::expression_limit.at_once));
    EXPECT_LT(kept, 150);
    EXPECT_EQ(b.put(alice, 1), Answer::kept) << "poses have a limit of their own";
}

// For each topic of the board.
TEST(PoseBoard, WhatARoleMayNoLongerSendIsTakenBack) {
    Board b;
    wire::PersonPose pose;
    pose.time = b.now;
    pose.head = pose.left_hand = pose.right_hand = wire::PartPose{{1, 1.7F, 0}, {1, 0, 0, 0}};
    pose.calls = true;
    const auto key = [](wire::StateTopic topic) {
        return wire::StateKey{topic, std::uint32_t(alice)};
    };
    const Bytes body = wire::encode_person_pose(pose);
    const Bytes face = wire::encode_face_expression(happy_at(b.now));
    (void)b.board.put(alice, {key(wire::StateTopic::pose), body}, everything, b.now);
    (void)b.board.put(alice, {key(wire::StateTopic::expression), face}, everything, b.now);
    b.put(bob, 2);
    (void)b.board.gather(b.now);

    b.now += 1s;
    b.board.follow_rights(alice, everything, b.now);
    EXPECT_FALSE(b.board.due());
    b.board.follow_rights(alice, seeing, b.now);
    for (const auto& entries : {b.board.all(), b.board.gather(b.now), b.board.all()}) {
        int of_alice = 0;
        for (const auto& entry : entries) {
            if (entry.participant != alice)
                continue;
            ++of_alice;
            if (entry.state.key.topic == wire::StateTopic::expression) {
                const auto left = wire::decode_face_expression(entry.state.body);
                EXPECT_EQ(left->state, wire::FaceExpression::State::none);
                EXPECT_GT(left->time, happy_at(b.now - 1s).time);
            } else {
                const auto left = wire::decode_person_pose(entry.state.body);
                EXPECT_TRUE(left->head && !left->left_hand && !left->right_hand && !left->calls);
                EXPECT_GT(left->time, pose.time);
            }
        }
        EXPECT_EQ(of_alice, 2);
    }
    // The same holds for what comes from now on; the end of a face is never refused.
    b.now += 1s;
    pose.time = b.now;
    const Bytes later = wire::encode_person_pose(pose);
    EXPECT_EQ(b.board.put(alice, {key(wire::StateTopic::pose), later}, seeing, b.now),
              Answer::kept);
    EXPECT_FALSE(wire::decode_person_pose(b.board.gather(b.now).at(0).state.body)->left_hand);
    const Bytes again = wire::encode_face_expression(happy_at(b.now));
    EXPECT_EQ(b.board.put(alice, {key(wire::StateTopic::expression), again}, seeing, b.now),
              Answer::ignored);
    wire::FaceExpression none;
    none.time = b.now;
    const Bytes off = wire::encode_face_expression(none);
    EXPECT_EQ(b.board.put(alice, {key(wire::StateTopic::expression), off}, seeing, b.now),
              Answer::kept);
}

}  // namespace
}  // namespace theatron::session
