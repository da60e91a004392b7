// SPDX-License-Identifier: Apache-2.0
#include "synthetic/growing_loop.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "files/file_bytes.h"
#include "synthetic/frame_cache.h"
#include "testing/temporary_folder.h"
#include "testing/wait_until.h"

namespace theatron::synthetic {
namespace {

namespace fs = std::filesystem;

class Growing : public ::testing::Test {
protected:
    Growing() {
        options_.scene = {.seed = 5, .loop = 4s, .detail = 0.05};
        options_.color = {64, 36};
        options_.depth_divisor = 4;
        options_.frames_per_second = 1.5;
        options_.noise = false;
        options_.folder = of_this_test_.path() / "loop";
    }
    // More frames than any test waits for.
    void make_long() {
        options_.scene.loop = 120s;
        options_.frames_per_second = 60;
    }
    std::size_t files() const {
        return std::size_t(std::distance(fs::directory_iterator(options_.folder), {}));
    }

    testing::TemporaryFolder of_this_test_;
    LoopOptions options_;
};

TEST_F(Growing, PlaysItsFirstFramesAndLeavesTheWholeLoopBehind) {
    std::vector<Frame> frames(6);
    {
        GrowingLoop loop(options_, 2);
        EXPECT_GE(loop.frames(), 2u);
        testing::wait_until([&] { return loop.frames() == 6 && fs::exists(loop_path(options_)); });
        for (std::size_t i = 0; i < frames.size(); ++i)
            loop.read(i, frames[i]);
    }
    EXPECT_EQ(files(), 1u);
    const auto never = [](std::string_view, double) { FAIL() << "rendered again"; };
    EXPECT_EQ(GrowingLoop(options_, 2, never).frames(), 6u);
    FrameLoop cached(options_, never);
    ASSERT_EQ(cached.frames(), frames.size());
    for (std::size_t i = 0; i < frames.size(); ++i) {
        Frame frame;
        cached.read(i, frame);
        EXPECT_EQ(frame.depth, frames[i].depth) << i;
        EXPECT_EQ(frame.color.jpeg, frames[i].color.jpeg) << i;
    }
}

TEST_F(Growing, EndsBeforeItIsWholeAndLeavesNothing) {
    make_long();
    {
        GrowingLoop loop(options_, 1);
        Frame frame;
        loop.read(0, frame);
        EXPECT_EQ(frame.depth.size, (Size{160, 144}));
    }
    EXPECT_EQ(files(), 0u);
}

TEST_F(Growing, TellsItsProgressAndStopsWithIt) {
    make_long();
    double last = 0;
    EXPECT_THROW(GrowingLoop(options_, 7'200,
                             [&](std::string_view, double done) {
                                 EXPECT_GE(done, last);
                                 last = done;
                                 if (done > 0.05)
                                     throw Error("stopped");
                             }),
                 Error);
    EXPECT_EQ(files(), 0u);
}

// Each row of a picture asks whether to go on.
TEST(RoomPulse, EndsAPictureInItsMiddle) {
    const OperatingRoom room({.seed = 5, .loop = 4s, .detail = 0.05});
    LoopOptions options;
    options.color = {64, 36};
    const auto view = room.look_from(loop_calibration(options));
    const auto moment = room.at(1s);
    int rows = 0;
    const GroundTruth whole = view->render(*moment, [&] { ++rows; });
    EXPECT_GE(rows, 36);
    int left = rows / 2;
    EXPECT_THROW((void)view->render(*moment,
                                    [&] {
                                        if (--left == 0)
                                            throw Error("stopped");
                                    }),
                 Error);
    EXPECT_EQ(view->render(*moment).depth_m, whole.depth_m) << "it can be used on";
    EXPECT_THROW(OperatingRoom({.detail = 0.05}, [] { throw Error("stopped"); }), Error);
    EXPECT_THROW(
        (void)room.look_from(loop_calibration(options), {}, [] { throw Error("stopped"); }), Error);
}

TEST_F(Growing, AFolderThatCannotBeMadeIsNamed) {
    files::write_file(options_.folder, as_bytes(std::string_view("no folder")));
    EXPECT_THROW(GrowingLoop(options_, 1), Error);
}

}  // namespace
}  // namespace theatron::synthetic
