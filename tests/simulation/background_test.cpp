// SPDX-License-Identifier: Apache-2.0
// The recorded background on the generated operating room, where the true foreground
// is known.
#include "filter/background.h"

#include <gtest/gtest.h>

#include "filter/chain.h"
#include "synthetic/frame_cache.h"
#include "testing/temporary_folder.h"

namespace theatron {
namespace {

using namespace std::chrono_literals;

constexpr int frames = 12;
// Nearer than the empty room by more than the margin and the sensor's errors.
constexpr int before_mm = 100;

class RecordedBackground : public ::testing::Test {
protected:
    synthetic::FrameLoop loop(bool people, bool noise) const {
        synthetic::LoopOptions options;
        options.scene = {.seed = 5, .loop = 2s, .detail = 0.05, .people = people};
        options.color = {};
        options.depth_divisor = 2;
        options.frames_per_second = frames / 2;
        options.noise = noise;
        options.folder = folder_.path();
        return synthetic::FrameLoop(options);
    }

    testing::TemporaryFolder folder_;
};

TEST_F(RecordedBackground, LeavesPeopleAndPatientAndTakesTheRoomAway) {
    synthetic::FrameLoop empty = loop(false, true), room = loop(true, true);
    synthetic::FrameLoop empty_exact = loop(false, false), exact = loop(true, false);
    filter::Background background;
    Frame frame;
    for (int i = 0; i < frames / 2; ++i) {
        empty.read(std::size_t(i), frame);
        ASSERT_TRUE(filter::add_frame(background, frame.depth.view()));
    }

    Frame truth, truth_empty;
    empty_exact.read(0, truth_empty);
    for (const char* line : {"background", "default+background"}) {
        filter::Chain chain(filter::parse_chain(line).settings,
                            {.size = background.nearest.size, .background = &background});
        double people = 0, kept = 0, behind = 0, left = 0;
        // Frames whose noise the background has not seen.
        for (int i = frames / 2; i < frames; ++i) {
            room.read(std::size_t(i), frame);
            exact.read(std::size_t(i), truth);
            const DepthImage out = copy_of(chain.apply(frame.depth.view(), 83ms));
            for (std::size_t p = 0; p < out.pixels.size(); ++p) {
                if (frame.depth.pixels[p] == 0 || truth.depth.pixels[p] == 0)
                    continue;
                const int nearer = truth_empty.depth.pixels[p] - truth.depth.pixels[p];
                if (nearer > before_mm) {
                    ++people;
                    kept += out.pixels[p] != 0;
                } else if (nearer == 0) {
                    ++behind;
                    left += out.pixels[p] != 0;
                }
            }
        }
        SCOPED_TRACE(line);
        EXPECT_GT(people, 0.1 * behind) << "people fill a part of the picture";
        EXPECT_GT(kept / people, 0.97);
        EXPECT_LT(left / behind, 0.02);
        RecordProperty(std::string(line) + " kept", std::to_string(kept / people));
        RecordProperty(std::string(line) + " left", std::to_string(left / behind));
    }
}

}  // namespace
}  // namespace theatron
