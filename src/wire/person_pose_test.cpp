// SPDX-License-Identifier: Apache-2.0
#include "wire/person_pose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace theatron::wire {
namespace {

PersonPose sample() {
    PersonPose pose;
    pose.time = from_us(0x0102030405);
    pose.head = PartPose{{1, -0.5F, 2}, {1, 0, 0, 0}};
    pose.right_hand = PartPose{{0, 0, 0}, {0, 0.6F, 0, -0.8F}};
    return pose;
}

// The test vector of docs/formats/person_pose.md.
TEST(PersonPose, BytesAreAsSpecified) {
    const int expected[] = {5,    4,    3,    2,    1, 0, 0,    0,      // time
                            5,                                          // head and right hand
                            0,    0,    0x80, 0x3f,                     // 1
                            0,    0,    0,    0xbf,                     // -0.5
                            0,    0,    0,    0x40,                     // 2
                            0xff, 0x7f, 0,    0,    0, 0, 0,    0,      // no rotation
                            0,    0,    0,    0,    0, 0, 0,    0,      // 0, 0
                            0,    0,    0,    0,                        // 0
                            0,    0,    0xcc, 0x4c, 0, 0, 0x9a, 0x99};  // about x and z
    const Bytes bytes = encode_person_pose(sample());
    ASSERT_EQ(bytes.size(), std::size(expected));
    for (std::size_t i = 0; i < bytes.size(); ++i)
        EXPECT_EQ(std::to_integer<int>(bytes[i]), expected[i]) << "byte " << i;
}

TEST(PersonPose, ComesBackNearly) {
    const PersonPose pose = sample();
    const auto back = decode_person_pose(encode_person_pose(pose));
    ASSERT_TRUE(back);
    EXPECT_EQ(back->time, pose.time);
    EXPECT_EQ(back->head, pose.head);
    EXPECT_FALSE(back->left_hand);
    ASSERT_TRUE(back->right_hand);
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_NEAR(back->right_hand->rotation[i], pose.right_hand->rotation[i], 3e-5);
    EXPECT_TRUE(decode_person_pose(encode_person_pose(PersonPose{}))) << "nothing is tracked";
}

TEST(PersonPose, TellsWhetherThePersonCalls) {
    PersonPose pose = sample();
    EXPECT_FALSE(decode_person_pose(encode_person_pose(pose))->calls);
    pose.calls = true;
    const auto back = decode_person_pose(encode_person_pose(pose));
    ASSERT_TRUE(back);
    EXPECT_TRUE(back->calls);
    EXPECT_EQ(back->head.has_value(), pose.head.has_value());
}

TEST(PersonPose, TellsWhetherTheRightHandPoints) {
    PersonPose pose = sample();
    EXPECT_FALSE(decode_person_pose(encode_person_pose(pose))->points);
    pose.points = true;
    const auto back = decode_person_pose(encode_person_pose(pose));
    ASSERT_TRUE(back);
    EXPECT_TRUE(back->points);
    EXPECT_FALSE(back->calls);
}

TEST(PersonPose, RefusesWhatIsNoPose) {
    const Bytes whole = encode_person_pose(sample());
    for (std::size_t n = 0; n < whole.size(); ++n)
        EXPECT_EQ(decode_person_pose(ByteView(whole).first(n)).error(), Status::truncated) << n;
    Bytes longer = whole;
    longer.push_back({});
    EXPECT_EQ(decode_person_pose(longer).error(), Status::trailing_bytes);
    const auto with = [&](std::size_t at, std::uint32_t value) {
        Bytes bytes = whole;
        store_le(bytes.data() + at, value);
        return decode_person_pose(bytes).error();
    };
    EXPECT_EQ(with(9, 0x7fc00000), Status::malformed) << "not a number";
    EXPECT_EQ(with(9, 0x7f800000), Status::malformed) << "infinite";
    EXPECT_EQ(with(9, 0x4480'0000), Status::malformed) << "1024 m away";
    EXPECT_EQ(with(21, 0), Status::malformed) << "a rotation of no length";
    EXPECT_EQ(with(21, 0x2000'7fff), Status::malformed) << "one that is too long";
    EXPECT_EQ(with(4, 0x7000'0000), Status::malformed) << "a time beyond all sense";
    Bytes other_part = whole;
    other_part[8] = std::byte{32};
    EXPECT_EQ(decode_person_pose(other_part).error(), Status::malformed);
}

}  // namespace
}  // namespace theatron::wire
