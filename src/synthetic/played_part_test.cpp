// SPDX-License-Identifier: Apache-2.0
#include "synthetic/played_part.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

namespace theatron::synthetic {
namespace {

using ::testing::ElementsAre;

std::vector<std::size_t> frames_from(PlayedPart& part, std::uint64_t begin, std::size_t count) {
    std::vector<std::size_t> frames;
    for (std::size_t i = 0; i < count; ++i)
        frames.push_back(part.frame_at(begin + i));
    return frames;
}

TEST(PlayedPart, GoesForwardsAndBackwardsUntilTheLoopIsWhole) {
    PlayedPart part(6);
    const std::size_t camera = part.add_camera(3);
    EXPECT_THAT(frames_from(part, 0, 5), ElementsAre(0, 1, 2, 1, 0));
    part.note_frames(camera, 6);
    // The turn that began goes on.
    EXPECT_THAT(frames_from(part, 5, 10), ElementsAre(1, 2, 1, 0, 1, 2, 3, 4, 5, 0));
}

TEST(PlayedPart, HasOnlyFramesThatEveryCameraHas) {
    PlayedPart part(100);
    const std::size_t quick = part.add_camera(5);
    part.add_camera(2);
    part.note_frames(quick, 90);
    EXPECT_THAT(frames_from(part, 0, 4), ElementsAre(0, 1, 0, 1));
}

TEST(PlayedPart, OneFrameStandsStill) {
    PlayedPart part(10);
    part.add_camera(1);
    EXPECT_THAT(frames_from(part, 0, 3), ElementsAre(0, 0, 0));
}

TEST(PlayedPart, TellsALateCameraTheSameFrames) {
    PlayedPart part(100);
    const std::size_t first = part.add_camera(10), second = part.add_camera(10);
    const std::vector<std::size_t> of_first = frames_from(part, 0, 60);
    part.note_frames(first, 100);
    part.note_frames(second, 100);
    EXPECT_EQ(frames_from(part, 0, 60), of_first);
}

TEST(PlayedPart, NeverJumpsByMoreThanOneFrameWhileItGrows) {
    PlayedPart part(50);
    const std::size_t a = part.add_camera(4), b = part.add_camera(7);
    std::size_t last = part.frame_at(0);
    for (std::size_t number = 1; number < 400; ++number) {
        part.note_frames(a, std::min<std::size_t>(50, 4 + number / 3));
        part.note_frames(b, std::min<std::size_t>(50, 7 + number / 5));
        const std::size_t now = part.frame_at(number);
        const bool is_next_round = last == 49 && now == 0;
        EXPECT_TRUE(is_next_round || std::abs(int(now) - int(last)) == 1) << number;
        last = now;
    }
}

TEST(PlayedPart, ALateCameraHasItsFramesFromTheNextTurnOn) {
    PlayedPart part(100);
    part.add_camera(10);
    (void)frames_from(part, 0, 25);  // a turn is 18 pictures
    EXPECT_EQ(part.newest(), 24u);
    part.add_camera(3);
    EXPECT_THAT(frames_from(part, 36, 5), ElementsAre(0, 1, 2, 1, 0));
}

TEST(PlayedPart, APictureFarBehindIsTheFirst) {
    PlayedPart part(10);
    part.add_camera(3);
    part.frame_at(1'000);
    EXPECT_EQ(part.frame_at(0), 0u);
}

}  // namespace
}  // namespace theatron::synthetic
