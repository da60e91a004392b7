// SPDX-License-Identifier: Apache-2.0
#include "filter/chain.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include "filter/test_depth.h"

namespace theatron::filter {
namespace {

constexpr Duration frame_time = std::chrono::microseconds(33'333);

Chain make_chain(const char* text, Size size, const Background* background = nullptr) {
    const ParsedChain parsed = parse_chain(text);
    EXPECT_EQ(parsed.problem, "");
    return Chain(parsed.settings, {.size = size, .background = background});
}

DepthImage applied(Chain& chain, const DepthImage& image, Duration since = frame_time) {
    return copy_of(chain.apply(image.view(), since));
}

DepthImage wall(Size size, int depth) {
    DepthImage image(size);
    std::fill(image.pixels.begin(), image.pixels.end(), std::uint16_t(depth));
    return image;
}

TEST(Chain, OffReturnsItsInput) {
    Chain chain = make_chain("off", {33, 5});
    EXPECT_TRUE(chain.off());
    const DepthImage image = extremes({33, 5}, 1);
    EXPECT_EQ(chain.apply(image.view(), frame_time).pixels, image.pixels.data());
}

TEST(Chain, TakesViewsWithAnyStride) {
    const DepthImage large = two_walls({50, 20}, 1);
    const DepthView part{large.view().row(3) + 5, {33, 11}, 50};
    for (const char* filters : {"off", "holes", "range:max_mm=2000", "default", "stereo"}) {
        Chain first = make_chain(filters, part.size), second = make_chain(filters, part.size);
        EXPECT_EQ(applied(first, copy_of(part)), copy_of(second.apply(part, frame_time)));
    }
}

// An encoder reads the result in the chain's memory.
TEST(Chain, TheResultStaysUntilTheNextFrameWhateverTheThreadDoesMeanwhile) {
    const Size size{40, 30};
    for (const char* filters :
         {"holes", "range:max_mm=2000", "kalman+holes", "default", "steady+holes", "stereo"}) {
        Chain chain = make_chain(filters, size), other = make_chain(filters, size);
        const DepthImage image = two_walls(size, 1);
        const DepthView result = chain.apply(image.view(), frame_time);
        const DepthImage before = copy_of(result);
        applied(other, two_walls(size, 2));
        EXPECT_EQ(copy_of(result), before) << filters;
    }
}

TEST(Chain, StepsRunInTheirOrder) {
    // A hole in a wall that the next filter removes: filled first, it is removed as well.
    DepthImage image = wall({9, 9}, 3000);
    image.view().row(4)[4] = 0;
    Chain fill_first = make_chain("holes+range:min_mm=2000", image.size);
    EXPECT_EQ(applied(fill_first, image), wall(image.size, 3000));
    Chain remove_first = make_chain("range:max_mm=2000+holes", image.size);
    EXPECT_EQ(applied(remove_first, image), wall(image.size, 0));
}

TEST(Chain, RangesAndBackgroundsHaveTheCamerasUnit) {
    const ParsedChain parsed = parse_chain("range:min_mm=1000,max_mm=2000");
    Chain chain(parsed.settings, {.size = {4, 1}, .depth_unit_mm = 0.25});
    DepthImage image({4, 1});
    image.pixels = {3999, 4000, 8000, 8001};
    EXPECT_EQ(applied(chain, image).pixels, (std::vector<std::uint16_t>{0, 4000, 8000, 0}));
}

TEST(Chain, TheRecordedEmptySceneGoesAndWhatStandsInItStays) {
    const Size size{40, 20};
    Background background;
    for (unsigned i = 0; i < 30; ++i)
        EXPECT_TRUE(add_frame(background, two_walls(size, 7 + 0 * i, 3, 0).view()));
    DepthImage frame = two_walls(size, 7, 3, 0);
    for (int y = 5; y < 15; ++y)
        for (int x = 5; x < 15; ++x)
            frame.view().row(y)[x] = 1200;
    Chain chain = make_chain("background", size, &background);
    const DepthImage out = applied(chain, frame);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const bool inside = x >= 5 && x < 15 && y >= 5 && y < 15;
            ASSERT_EQ(out.view().row(y)[x], inside ? 1200 : 0) << x << ", " << y;
        }
}

TEST(Chain, WithoutABackgroundOfItsSizeThatStepDoesNothing) {
    const Background background{wall({8, 8}, 100), 1, 1};
    const DepthImage image = wall({9, 9}, 1000);
    Chain none = make_chain("background", image.size);
    EXPECT_EQ(applied(none, image), image);
    Chain other = make_chain("background", image.size, &background);
    EXPECT_EQ(applied(other, image), image);
}

TEST(Chain, ASecondChainWithTheSameFramesGivesTheSame) {
    Chain first = make_chain("default", {64, 48}), second = make_chain("default", {64, 48});
    for (unsigned i = 0; i < 10; ++i) {
        const DepthImage image = two_walls({64, 48}, i / 4);
        ASSERT_EQ(applied(first, image), applied(second, image));
    }
}

// Scratch memory belongs to the thread; contents left by one chain must not affect another.
TEST(Chain, ChainsThatTakeTurnsOnAThreadGiveWhatEachGivesAlone) {
    constexpr const char* steps = "holes+flying_pixels+steady+speckles+kalman";
    std::vector<Size> sizes;
    // More cameras than a thread keeps scratch memory for.
    for (int i = 0; i < 11; ++i)
        sizes.push_back({40 + 7 * (i / 2), 30 + 5 * (i % 3)});
    const auto image_of_camera = [&](std::size_t camera, unsigned frame) {
        return two_walls(sizes[camera], unsigned(camera) + frame / 3);
    };
    constexpr unsigned frames = 4;
    std::vector<std::vector<DepthImage>> alone(sizes.size());
    for (std::size_t camera = 0; camera < sizes.size(); ++camera)
        std::thread([&] {
            Chain chain = make_chain(steps, sizes[camera]);
            for (unsigned frame = 0; frame < frames; ++frame)
                alone[camera].push_back(applied(chain, image_of_camera(camera, frame)));
        }).join();

    std::vector<Chain> chains;
    for (const Size size : sizes)
        chains.push_back(make_chain(steps, size));
    for (unsigned frame = 0; frame < frames; ++frame)
        for (std::size_t camera = 0; camera < sizes.size(); ++camera)
            ASSERT_EQ(applied(chains[camera], image_of_camera(camera, frame)), alone[camera][frame])
                << camera << ", " << frame;
}

}  // namespace
}  // namespace theatron::filter
