// SPDX-License-Identifier: Apache-2.0
// Every filter on every instruction set against its definition.
#include <gtest/gtest.h>

#include "filter/flying_pixels.h"
#include "filter/holes.h"
#include "filter/kalman.h"
#include "filter/limits.h"
#include "filter/speckles.h"
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
void expect_equal_states(Size size, const KalmanRule& rule, Frame frame) {
    KalmanState state(size), expected_state(size);
    DepthImage out(size), expected(size);
    for (int i = 0; i < 24; ++i) {
        const DepthPlane in = plane_of(frame(i));
        const int boost = i % 7 == 6 ? 40 * i : 0;
        apply_kalman(in, rule, boost, state, out.view());
        apply_kalman_reference(in, rule, boost, expected_state, expected.view());
        ASSERT_EQ(out, expected) << "frame " << i;
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

}  // namespace
}  // namespace theatron::filter
