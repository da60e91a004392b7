// SPDX-License-Identifier: Apache-2.0
#include "synthetic/frame_cache.h"

#include <gtest/gtest.h>

#include "files/file_bytes.h"
#include "testing/temporary_folder.h"

namespace theatron::synthetic {
namespace {

namespace fs = std::filesystem;

class FrameCache : public ::testing::Test {
protected:
    FrameCache() {
        folder_ = of_this_test_.path() / "loop";
        options_.scene = {.seed = 5, .loop = 2s, .detail = 0.05};
        options_.color = {64, 36};
        options_.depth_divisor = 4;
        options_.frames_per_second = 1.5;
        options_.noise = false;
        options_.folder = folder_;
    }

    std::vector<Frame> all_frames(FrameLoop& loop) {
        std::vector<Frame> frames(loop.frames());
        for (std::size_t i = 0; i < frames.size(); ++i)
            loop.read(i, frames[i]);
        return frames;
    }
    static void expect_same(const std::vector<Frame>& a, const std::vector<Frame>& b) {
        ASSERT_EQ(a.size(), b.size());
        for (std::size_t i = 0; i < a.size(); ++i) {
            EXPECT_EQ(a[i].depth, b[i].depth) << "frame " << i;
            EXPECT_EQ(a[i].color.jpeg, b[i].color.jpeg) << "frame " << i;
        }
    }

    testing::TemporaryFolder of_this_test_;
    fs::path folder_;
    LoopOptions options_;
};

TEST_F(FrameCache, RendersOnceAndPlaysTheSameAgain) {
    double last = 0;
    FrameLoop rendered(options_, [&](std::string_view, double done) {
        EXPECT_GE(done, last);
        last = done;
    });
    EXPECT_FALSE(rendered.was_cached());
    EXPECT_EQ(rendered.frames(), 3u);
    EXPECT_GT(last, 0.9);
    const auto first = all_frames(rendered);
    EXPECT_EQ(first[0].depth.size, (Size{160, 144}));
    EXPECT_FALSE(first[0].color.jpeg.empty());

    FrameLoop again(options_, [](std::string_view, double) { FAIL() << "rendered again"; });
    EXPECT_TRUE(again.was_cached());
    expect_same(first, all_frames(again));
}

TEST_F(FrameCache, DepthIsTheTruthInWholeMillimetresInsideTheHexagon) {
    options_.color = {};
    FrameLoop loop(options_);
    Frame frame;
    loop.read(1, frame);
    EXPECT_TRUE(frame.color.empty());
    const OperatingRoom room(options_.scene);
    const GroundTruth truth =
        room.render(loop.calibration(), Duration(2'000'000 / 3), {.color = false});
    for (int y = 0; y < 144; ++y)
        for (int x = 0; x < 160; ++x) {
            const int mm = frame.depth.view().row(y)[x];
            if (inside_hexagon({160, 144}, x, y))
                EXPECT_NEAR(mm, truth.depth_m.view().row(y)[x] * 1000, 0.5001);
            else
                EXPECT_EQ(mm, 0);
        }
}

TEST_F(FrameCache, DamagedFilesAreRenderedAgain) {
    std::vector<Frame> first;
    fs::path path;
    {
        FrameLoop loop(options_);
        first = all_frames(loop);
        path = loop.path();
    }
    const Bytes whole = files::read_file(path);
    const auto spoil = [&](auto change) {
        Bytes bytes = whole;
        change(bytes);
        files::write_file(path, bytes);
        FrameLoop loop(options_);
        EXPECT_FALSE(loop.was_cached());
        expect_same(first, all_frames(loop));
    };
    spoil([](Bytes& b) { b.resize(b.size() / 2); });
    spoil([](Bytes& b) { b[b.size() / 3] ^= std::byte{1}; });
}

TEST_F(FrameCache, EveryOptionHasItsOwnFile) {
    const auto differs = [&](auto change) {
        LoopOptions other = options_;
        change(other);
        EXPECT_NE(loop_path(options_), loop_path(other));
    };
    differs([](LoopOptions& o) { o.noise = true; });
    differs([](LoopOptions& o) { o.camera = 1; });
    differs([](LoopOptions& o) { o.cameras = 3; });
    differs([](LoopOptions& o) { o.variant = Variant::surgeon; });
    differs([](LoopOptions& o) { o.scene.seed = 9; });
    differs([](LoopOptions& o) { o.scene.detail = 1; });
    differs([](LoopOptions& o) { o.scene.loop = 3s; });
    differs([](LoopOptions& o) { o.scene.people = false; });
    differs([](LoopOptions& o) { o.color = {}; });
    differs([](LoopOptions& o) { o.depth_divisor = 2; });
    differs([](LoopOptions& o) { o.frames_per_second = 3; });
}

TEST_F(FrameCache, RemovesWhatAKilledProcessHasLeft) {
    const fs::path path = loop_path(options_);
    fs::create_directories(folder_);
    const fs::path abandoned = path.string() + ".17.part", in_work = path.string() + ".18.part",
                   other = folder_ / "notes.part";
    for (const fs::path& file : {abandoned, in_work, other})
        files::write_file(file, as_bytes(std::string_view("a draft")));
    for (const fs::path& file : {abandoned, other})
        fs::last_write_time(file, fs::file_time_type::clock::now() - 2h);
    FrameLoop rendered(options_, {});
    EXPECT_FALSE(fs::exists(abandoned));
    EXPECT_TRUE(fs::exists(in_work));
    EXPECT_TRUE(fs::exists(other));
}

}  // namespace
}  // namespace theatron::synthetic
