// SPDX-License-Identifier: Apache-2.0
// Every filter on every instruction set is compared with its definition.
#include <gtest/gtest.h>

#include "filter/flying_pixels.h"
#include "filter/holes.h"
#include "filter/kalman.h"
#include "filter/limits.h"
#include "filter/speckles.h"
#include "filter/steady.h"
#include "filter/test_depth.h"

namespace theatron::filter {
namespace {

// Calls test(image) for images of awkward sizes and contents.
template <class Test>
void with_images(Test test) {
    unsigned seed = 0;
    for (const Size size : awkward_sizes()) {
        SCOPED_TRACE(std::to_string(size.width) + "x" + std::to_string(size.height));
        test(two_walls(size, ++seed));
        test(two_walls(size, ++seed, 30, 60));
        test(extremes(size, ++seed));
    }
}

TEST(FilterKernels, LimitsEqualTheirDefinition) {
    on_every_target([] {
        with_images([](const DepthImage& image) {
            Limits limits(image.size);
            limits.keep_range(3, 2400);
            Background background{image, 1, 1};
            for (auto& pixel : background.nearest.pixels)
                pixel = std::uint16_t(pixel + 30);
            limits.remove_background(background, 20, 3, {}, 1);
            DepthPlane out(image.size), expected(image.size);
            apply_limits(image.view(), limits, out);
            apply_limits_reference(image.view(), limits, expected);
            ASSERT_EQ(image_of(out), image_of(expected));
        });
    });
}

TEST(FilterKernels, FlyingPixelsEqualTheirDefinition) {
    on_every_target([] {
        with_images([](const DepthImage& image) {
            for (const FlyingPixelRule rule :
                 {FlyingPixelRule{{12, 900}, 3}, FlyingPixelRule{{0, 0}, 1},
                  FlyingPixelRule{{0xffff, 0xffff}, 8}}) {
                const DepthPlane in = plane_of(image);
                DepthPlane out(image.size), expected(image.size);
                remove_flying_pixels(in, rule, out);
                remove_flying_pixels_reference(in, rule, expected);
                ASSERT_EQ(image_of(out), image_of(expected));
            }
        });
    });
}

TEST(FilterKernels, SpecklesEqualTheirDefinition) {
    on_every_target([] {
        with_images([](const DepthImage& image) {
            SpeckleScratch scratch(image.size);
            for (const SpeckleRule rule : {SpeckleRule{20, {12, 900}}, SpeckleRule{1, {0, 0}},
                                           SpeckleRule{100, {3, 0xffff}}}) {
                DepthPlane out = plane_of(image), expected = out;
                remove_speckles(out, rule, scratch);
                remove_speckles_reference(expected, rule);
                ASSERT_EQ(image_of(out), image_of(expected));
            }
        });
    });
}

TEST(FilterKernels, HolesEqualTheirDefinition) {
    on_every_target([] {
        with_images([](const DepthImage& image) {
            HoleScratch scratch(image.size);
            for (const HoleRule rule :
                 {HoleRule{4, 8, 3, {12, 900}}, HoleRule{1, 1, 1, {0, 0}},
                  HoleRule{2, 5, 5, {60, 0}}, HoleRule{9, 16, 2, {0xffff, 0xffff}}}) {
                DepthPlane out = plane_of(image), expected = out;
                fill_holes(out, rule, scratch);
                fill_holes_reference(expected, rule);
                ASSERT_EQ(image_of(out), image_of(expected));
            }
        });
    });
}

TEST(FilterKernels, TheLargestHolesEqualTheirDefinition) {
    const Size size{200, 90};
    const HoleRule rule{20, 31, 2, {100, 0}};
    const DepthImage image = two_walls(size, 5, 3, 400);
    DepthPlane expected = plane_of(image);
    fill_holes_reference(expected, rule);
    on_every_target([&] {
        HoleScratch scratch(size);
        DepthPlane out = plane_of(image);
        fill_holes(out, rule, scratch);
        EXPECT_EQ(image_of(out), image_of(expected));
    });
}

// Frames that drift, jump and lose pixels, one after the other.
template <class Frame>
void expect_equal_states(Size size, const KalmanRule& rule, Frame frame, int frames = 24,
                         int boost_every = 7) {
    KalmanState state(size), expected_state(size);
    for (int i = 0; i < frames; ++i) {
        const DepthPlane in = plane_of(frame(i));
        const int boost = i % boost_every == boost_every - 1 ? 40 * i : 0;
        apply_kalman(in, rule, boost, state);
        apply_kalman_reference(in, rule, boost, expected_state);
        ASSERT_EQ(image_of(state.depth), image_of(expected_state.depth)) << "frame " << i;
        ASSERT_EQ(image_of(state.estimate), image_of(expected_state.estimate)) << "frame " << i;
        ASSERT_EQ(image_of(state.gain), image_of(expected_state.gain)) << "frame " << i;
    }
}

TEST(FilterKernels, KalmanEqualsItsDefinition) {
    on_every_target([] {
        for (const Size size : awkward_sizes()) {
            SCOPED_TRACE(size.width);
            const KalmanRule usual, extreme{1023, 0xffff, 20, 0xffff, 255, 15},
                nervous{0, 0, 1, 0, 1, 0};
            for (const KalmanRule& rule : {usual, extreme, nervous}) {
                expect_equal_states(size, rule, [&](int i) {
                    DepthImage image = two_walls(size, unsigned(i / 8), 2, 0);
                    std::mt19937 random{unsigned(i)};
                    for (auto& pixel : image.pixels)
                        pixel = random() % 5 == 0 ? std::uint16_t(0) : std::uint16_t(pixel + i);
                    return image;
                });
                expect_equal_states(size, rule, [&](int i) { return extremes(size, unsigned(i)); });
            }
        }
    });
}

// Vectors of pixels that were static for long, at all distances; some then move, jump or
// disappear.
TEST(FilterKernels, KalmanAtRestEqualsItsDefinition) {
    constexpr int depths[] = {2000, 1,    2,    3,      4,      5,      80,     281, 3200, 7300,
                              7400, 7500, 8192, 0x7ffd, 0x7fff, 0x8001, 0xffff, 0,   1000};
    const Size size{167, 38};
    on_every_target([&] {
        for (const KalmanRule& rule : {KalmanRule{}, KalmanRule{1023, 0xffff, 20, 0xffff, 30, 15},
                                       KalmanRule{16, 34000, 5, 4096, 0, 0}})
            expect_equal_states(
                size, rule,
                [&](int i) {
                    DepthImage image(size);
                    std::mt19937 random{unsigned(i)};
                    const unsigned one_in = i < 40 ? 0 : i % 3 == 0 ? 20 : 200;
                    for (int y = 0; y < size.height; ++y)
                        for (int x = 0; x < size.width; ++x) {
                            const int depth = depths[unsigned(x / 64 + y) % std::size(depths)];
                            std::uint16_t& pixel = image.view().row(y)[x];
                            pixel = std::uint16_t(depth);
                            if (one_in == 0 || depth == 0 || random() % one_in != 0)
                                continue;
                            constexpr int changes[] = {1,   -1, 2,   -2,     30,
                                                       -30, 66, -66, 0x8000, 0xfffd};
                            const int change = changes[random() % std::size(changes)];
                            pixel = random() % 5 == 0 ? std::uint16_t(0)
                                                      : std::uint16_t(depth + change);
                        }
                    return image;
                },
                70, 61);
    });
}

// Walls that drift by steps, flicker, jump and lose pixels, and values around all thresholds.
TEST(FilterKernels, SteadyEqualsItsDefinition) {
    on_every_target([] {
        for (const Size size : awkward_sizes()) {
            SCOPED_TRACE(size.width);
            const SteadyRule usual, extreme{0xffff, 0xffff, most_steady_frames, 100, 15},
                nervous{0, 0, 1, 1, 0}, patient{3, 200, 4, 51, 3};
            for (const SteadyRule& rule : {usual, extreme, nervous, patient}) {
                SteadyState state(size), expected(size);
                for (int i = 0; i < 40; ++i) {
                    DepthImage image = two_walls(size, unsigned(i / 13), 2, i % 4 * 10);
                    for (auto& pixel : image.pixels)
                        if (pixel != 0)
                            pixel = std::uint16_t(pixel + (i / 5 % 2 == 0 ? i : 0));
                    if (i % 9 > 6)
                        image = extremes(size, unsigned(i));
                    const DepthPlane in = plane_of(image);
                    const int missed = i % 6 == 5 ? i * i : 0;
                    apply_steady(in, rule, missed, state);
                    apply_steady_reference(in, rule, missed, expected);
                    ASSERT_EQ(image_of(state.depth), image_of(expected.depth)) << "frame " << i;
                    ASSERT_EQ(image_of(state.run), image_of(expected.run)) << "frame " << i;
                }
            }
        }
    });
}

}  // namespace
}  // namespace theatron::filter
