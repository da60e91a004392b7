// SPDX-License-Identifier: Apache-2.0
// The GPU's chain: its functions in a plain loop and, if a device responds, on the device.
#include "filter/cuda_chain.h"

#include <gtest/gtest.h>

#include <deque>
#include <vector>

#include "filter/chain.h"
#include "filter/frame_gap.h"
#include "filter/parallel_chain.h"
#include "filter/test_depth.h"

namespace theatron::filter {
namespace {

constexpr Duration frame_time = std::chrono::microseconds(33'333);

constexpr const char* chains[] = {
    "paper",
    "default",
    "stereo",
    "steady:frames=3,together_100=30,hold_frames=2+holes",
    "speckles:max_pixels=12+holes:iterations=2,max_size=5,min_neighbours=2",
    "background+flying_pixels+holes:max_size=31,iterations=9+speckles+kalman:hold_frames=3",
};

// A launcher for the tests: runs on this CPU, one pixel after the other.
class HostLauncher {
public:
    struct Atomics {
        static int min(int* at, int value) {
            const int was = *at;
            *at = std::min(was, value);
            return was;
        }
        static void add(int* at, int value) { *at += value; }
    };
    template <class T>
    T* allocate(std::size_t count) {
        memories_.emplace_back(count * sizeof(T));
        return reinterpret_cast<T*>(memories_.back().data());
    }
    void clear(std::uint16_t* pixels, std::size_t count) {
        std::fill_n(pixels, count, std::uint16_t(0));
    }
    template <class Body>
    void launch(int left, int top, int right, int bottom, const Body& body) {
        for (int y = top; y < bottom; ++y)
            for (int x = left; x < right; ++x)
                body(x, y);
    }
    void upload(DepthView in, const ParallelImage& image) {
        for (int y = 0; y < in.size.height; ++y)
            std::copy_n(in.row(y), in.size.width, image.at(0, y));
    }
    void download(const ParallelImage& image, MutableDepthView out) {
        for (int y = 0; y < out.size.height; ++y)
            std::copy_n(image.at(0, y), out.size.width, out.row(y));
    }

private:
    std::deque<std::vector<std::byte>> memories_;
};

// Runs a chain and `other` on the same frames, with a time gap among them.
template <class Apply>
void expect_equal_frames(const ChainSettings& settings, const ChainCamera& camera, Apply other) {
    Chain chain(settings, camera);
    DepthImage out(camera.size);
    for (unsigned i = 0; i < 12; ++i) {
        const DepthImage image =
            i == 8 ? extremes(camera.size, i) : two_walls(camera.size, i / 5, 3, i % 3 ? 30 : 12);
        const Duration since = i == 6 ? 4 * frame_time : i == 10 ? 90 * frame_time : frame_time;
        const DepthImage expected = copy_of(chain.apply(image.view(), since));
        ASSERT_TRUE(other(image.view(), out.view(), since));
        ASSERT_EQ(out, expected) << settings.spelling() << ", frame " << i;
    }
}

Background some_background(Size size) {
    return {two_walls(size, 77, 40, 0), 1, 3};
}

TEST(CudaChain, ItsFunctionsEqualTheChain) {
    for (const Size size : {Size{97, 61}, Size{1, 1}, Size{33, 5}})
        for (const char* text : chains) {
            const Background background = some_background(size);
            const ChainCamera camera{.size = size, .background = &background};
            const ChainSettings settings = parse_chain(text).settings;
            HostLauncher launcher;
            ParallelChain<HostLauncher> chain(settings, camera, launcher);
            FrameGap gap;
            expect_equal_frames(settings, camera,
                                [&](DepthView in, MutableDepthView out, Duration since) {
                                    const FrameGap::Meaning meaning = gap.next(since);
                                    chain.apply(in, out, meaning.forgets, meaning.missed);
                                    return true;
                                });
        }
}

TEST(CudaChain, TheDeviceEqualsTheChain) {
    for (const Size size : {Size{640, 576}, Size{97, 61}})
        for (const char* text : chains) {
            const Background background = some_background(size);
            const ChainCamera camera{.size = size, .background = &background};
            const ChainSettings settings = parse_chain(text).settings;
            std::string problem;
            const auto chain = CudaChain::make(settings, camera, problem);
            if (chain == nullptr)
                GTEST_SKIP() << problem;
            expect_equal_frames(settings, camera,
                                [&](DepthView in, MutableDepthView out, Duration since) {
                                    const auto filtered = chain->apply(in, since);
                                    for (int y = 0; filtered && y < out.size.height; ++y)
                                        std::copy_n(filtered->row(y), out.size.width, out.row(y));
                                    return filtered.has_value();
                                });
        }
}

}  // namespace
}  // namespace theatron::filter
