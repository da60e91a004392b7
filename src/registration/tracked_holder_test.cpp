// SPDX-License-Identifier: Apache-2.0
#include "registration/tracked_holder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace theatron::registration {
namespace {

using ::testing::HasSubstr;

const Pose room_from_rig{rotation_about({0.1, 1, 0.2}, 1.1), {0.5, 1.5, -2}};
const Pose offset{rotation_about({1, 0.2, 0}, 0.4), {0.02, 0.35, -0.05}};

// The board at three places, seen by the cameras; rig frame.
std::vector<Pose> boards() {
    return {{rotation_about({0, 1, 0}, 0.2), {0, 0, 2}},
            {rotation_about({1, 0, 0}, -0.5), {0.4, 0.1, 1.6}},
            {rotation_about({0.3, 0.2, 1}, 0.9), {-0.5, -0.2, 2.4}}};
}

HolderPose at(int place) {
    return {place, room_from_rig * boards()[std::size_t(place)] * inverse(offset)};
}

double error_m(const HolderFit& fit) {
    const Vec3 point{0.7, -0.4, 2};
    return length(fit.room_from_reference * point - room_from_rig * point);
}

TEST(TrackedHolder, OnePlaceGivesTheRoomAndMoreAverageTheirErrors) {
    const auto seen = boards();
    HolderPose one[] = {at(1)};
    EXPECT_EQ(fit_holder(large_target(), seen, offset, one).problem, "");
    EXPECT_LT(error_m(fit_holder(large_target(), seen, offset, one)), 1e-9);

    HolderPose three[] = {at(0), at(1), at(2)};
    three[0].room_from_controller.translation.x += 0.006;
    three[2].room_from_controller.translation.x -= 0.006;
    one[0] = three[0];
    const HolderFit averaged = fit_holder(large_target(), seen, offset, three);
    EXPECT_EQ(averaged.problem, "");
    EXPECT_GT(averaged.rms_m, 0.001);
    EXPECT_LT(error_m(averaged), 0.8 * error_m(fit_holder(large_target(), seen, offset, one)));
}

TEST(TrackedHolder, AnOffsetOrPlaceThatIsWrongEndsInASentence) {
    const auto seen = boards();
    const HolderPose poses[] = {at(0), at(1), at(2)};
    Pose wrong = offset;
    wrong.translation.y += 0.1;
    EXPECT_THAT(fit_holder(large_target(), seen, wrong, poses).problem,
                HasSubstr("--holder-offset"));
    HolderPose swapped[] = {at(0), at(1)};
    std::swap(swapped[0].place, swapped[1].place);
    EXPECT_THAT(fit_holder(large_target(), seen, offset, swapped).problem, HasSubstr("places"));
    const HolderPose unknown[] = {{3, {}}};
    EXPECT_THAT(fit_holder(large_target(), seen, offset, unknown).problem,
                HasSubstr("place 4, and the cameras saw the board at 3"));
    EXPECT_THAT(fit_holder(large_target(), seen, offset, {}).problem, HasSubstr("no pose"));
}

TEST(TrackedHolder, LinesAreReadAndALineThatIsNoneIsNamed) {
    const ParsedHolder parsed = parse_holder("# place, pose\n\n2 1 2 3 0 0 1 0\r\n");
    EXPECT_EQ(parsed.problem, "");
    ASSERT_EQ(parsed.poses.size(), 1u);
    EXPECT_EQ(parsed.poses[0].place, 1);
    EXPECT_EQ(parsed.poses[0].room_from_controller.translation, (Vec3{1, 2, 3}));
    for (const char* line : {"1 1 2 3", "0 1 2 3 1 0 0 0", "x 1 2 3 1 0 0 0", "1 1 2 3 1 1 0 0",
                             "1 1 2 3 1 0 0 0 5", "1 nan 2 3 1 0 0 0", "1"})
        EXPECT_THAT(parse_holder(std::string("1 1 2 3 1 0 0 0\n") + line).problem,
                    HasSubstr("Line 2 of the holder's poses is not"))
            << line;
}

}  // namespace
}  // namespace theatron::registration
