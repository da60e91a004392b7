// SPDX-License-Identifier: Apache-2.0
#include "registration/touched_corners.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>

namespace theatron::registration {
namespace {

using ::testing::HasSubstr;

const Pose board{rotation_about({0.2, 1, 0.1}, 0.7), {0.4, 1.2, -0.3}};

std::vector<Touch> touches_of(const std::vector<int>& corners, double error_m = 0) {
    std::vector<Touch> touches;
    for (const int corner : corners) {
        const double sign = touches.size() % 2 ? 1 : -1;
        touches.push_back({corner, board * board_corners(large_target())[std::size_t(corner)] +
                                       Vec3{sign * error_m, 0, 0}});
    }
    return touches;
}

TEST(TouchedCorners, ThreeCornersGiveTheBoardsPlaceInTheRoom) {
    const TouchFit fit = fit_touches(large_target(), touches_of({0, 1, 3}));
    EXPECT_EQ(fit.problem, "");
    EXPECT_LT(length(fit.room_from_board * Vec3{1, 1, 1} - board * Vec3{1, 1, 1}), 1e-9);
    EXPECT_LT(fit.rms_m, 1e-9);
}

TEST(TouchedCorners, RepeatedTouchesAreAveraged) {
    const TouchFit fit = fit_touches(large_target(), touches_of({0, 0, 1, 1, 2, 2, 3, 3}, 0.004));
    EXPECT_EQ(fit.problem, "");
    EXPECT_LT(length(fit.room_from_board.translation - board.translation), 1e-4);
    EXPECT_NEAR(fit.rms_m, 0.004, 1e-4);
}

TEST(TouchedCorners, TooFewAndMistakenCornersEndInASentence) {
    EXPECT_THAT(fit_touches(large_target(), touches_of({0, 0, 2})).problem,
                HasSubstr("at least three corners of the board; there are 2"));
    std::vector<Touch> anticlockwise = touches_of({0, 1, 2, 3});
    std::swap(anticlockwise[1].corner, anticlockwise[3].corner);
    EXPECT_THAT(fit_touches(large_target(), anticlockwise).problem, HasSubstr("mm off"));
    EXPECT_THAT(fit_touches(a2_target(), touches_of({0, 1, 2, 3})).problem, HasSubstr("--board"));
}

TEST(TouchedCorners, LinesAreReadWithTheTipsOffset) {
    const auto parsed = parse_touches("# corner, position\n\nA 1 2 3\nb, 1.5, 2, 3\r\n", {});
    EXPECT_EQ(parsed.problem, "");
    ASSERT_EQ(parsed.touches.size(), 2u);
    EXPECT_EQ(parsed.touches[1].corner, 1);
    EXPECT_EQ(parsed.touches[1].room, (Vec3{1.5, 2, 3}));
    // Turned half around y, the tip lies on the other side.
    const auto turned = parse_touches("C 1 2 3 0 0 1 0", {0, 0, -0.1});
    ASSERT_EQ(turned.touches.size(), 1u);
    EXPECT_NEAR(turned.touches[0].room.z, 3.1, 1e-12);
}

TEST(TouchedCorners, ALineThatIsNoneIsNamed) {
    for (const char* line : {"A 1 2", "E 1 2 3", "A 1 2 x", "A nan 2 3", "A 1e9 2 3", "AB 1 2 3",
                             "A 1 2 3 1 1 1 1", "A 1 2 3 4", "A 1 2 3 1 0 0 0 5"})
        EXPECT_THAT(parse_touches(std::string("A 1 2 3\n") + line, {}).problem,
                    HasSubstr("Line 2 of the touches is not"))
            << line;
    EXPECT_THAT(parse_touches("A 1 2 3", {0, 0, 0.1}).problem, HasSubstr("has no rotation"));
}

}  // namespace
}  // namespace theatron::registration
