// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "synthetic/person.h"

namespace theatron::synthetic {
namespace {

constexpr double loop_seconds = 20;

F3 hand_at(double phase, int person, PersonBone hand) {
    const auto bones = pose_bones(phase, loop_seconds, 1);
    return bones[std::size_t(first_person + person * person_bone_count + hand)].origin;
}

TEST(RoomMotion, HandsMoveSmoothlyAndAtAHumanSpeed) {
    constexpr int frames = 600;
    for (int person = 0; person < 2; ++person)
        for (const PersonBone hand : {hand_left, hand_right}) {
            float fastest = 0, travelled = 0, jolt = 0;
            F3 before_velocity{};
            F3 before = hand_at(0, person, hand);
            for (int i = 1; i <= frames; ++i) {
                const F3 now = hand_at(double(i % frames) / frames, person, hand);
                const F3 velocity = (now - before) * float(frames / loop_seconds);
                fastest = std::max(fastest, length(velocity));
                if (i > 1)
                    jolt = std::max(jolt, length(velocity - before_velocity));
                travelled += length(now - before);
                before = now;
                before_velocity = velocity;
            }
            EXPECT_LT(fastest, 0.45f) << person << " " << hand;
            EXPECT_GT(travelled / float(loop_seconds), 0.003f) << person << " " << hand;
            EXPECT_LT(jolt, 0.08f) << "a jerk: " << person << " " << hand;
        }
}

TEST(RoomMotion, ToolsNeverJump) {
    constexpr int frames = 600;
    for (const Tool tool : {scissors_a, hemostat, forceps, retractor}) {
        const auto at = [&](int i) {
            return pose_bones(double(i % frames) / frames, loop_seconds,
                              1)[std::size_t(first_tool) + std::size_t(tool)]
                .origin;
        };
        for (int i = 0; i < frames; ++i)
            EXPECT_LT(length(at(i + 1) - at(i)), 0.03f) << "tool " << tool << " frame " << i;
    }
}

}  // namespace
}  // namespace theatron::synthetic
