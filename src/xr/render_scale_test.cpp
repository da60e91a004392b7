// SPDX-License-Identifier: Apache-2.0
#include "xr/render_scale.h"

#include <gtest/gtest.h>

#include <set>

namespace theatron::xr {
namespace {

// A machine that needs `fixed` for the points and `pixels` for a full picture.
double settle(RenderScale& scale, Duration fixed, Duration pixels, int pictures = 400) {
    for (int i = 0; i < pictures; ++i)
        scale.add(fixed +
                  Duration(std::int64_t(double(pixels.count()) * scale.scale() * scale.scale())));
    return scale.scale();
}

TEST(RenderScale, AFastMachineDrawsAllPixels) {
    RenderScale scale;
    EXPECT_EQ(settle(scale, 2ms, 10ms), 1.0);
    EXPECT_EQ(settle(scale, 2ms, 40ms), 1.0);
}

TEST(RenderScale, ManyPixelsAreTooMuchForASlowMachine) {
    RenderScale scale;
    EXPECT_EQ(settle(scale, 5ms, 100ms), 0.5);
    RenderScale slower;
    EXPECT_EQ(settle(slower, 5ms, 1000ms), 0.35);
}

TEST(RenderScale, AVerySlowMachineIsHelpedSoon) {
    RenderScale scale;
    EXPECT_EQ(settle(scale, 5ms, 1000ms, 3), 0.75);
    EXPECT_EQ(settle(scale, 5ms, 1000ms, 6), 0.35);
}

TEST(RenderScale, WherePointsCostAllThePictureStaysSharp) {
    RenderScale scale;
    EXPECT_EQ(settle(scale, 100ms, 5ms), 1.0);
}

TEST(RenderScale, DoesNotSwingToAndFro) {
    for (const Duration pixels : {30ms, 50ms, 60ms, 90ms, 150ms, 400ms}) {
        RenderScale scale;
        settle(scale, 5ms, pixels);
        std::set<double> used;
        for (int i = 0; i < 100; ++i)
            used.insert(settle(scale, 5ms, pixels, 1));
        EXPECT_EQ(used.size(), 1u) << pixels.count();
    }
}

TEST(RenderScale, ComesBackWhenThereIsTimeAgain) {
    RenderScale scale;
    settle(scale, 5ms, 300ms);
    EXPECT_LT(scale.scale(), 1.0);
    EXPECT_EQ(settle(scale, 1ms, 10ms), 1.0);
}

TEST(RenderScale, OneSlowPictureChangesNothing) {
    RenderScale scale;
    for (int i = 0; i < 100; ++i)
        scale.add(i % 8 == 0 ? Duration(2s) : Duration(10ms));
    EXPECT_EQ(scale.scale(), 1.0);
}

TEST(RenderScale, ForgetsWhatItLearnedOfAnotherPicture) {
    RenderScale scale;
    EXPECT_EQ(settle(scale, 100ms, 5ms), 1.0);
    scale.forget();
    EXPECT_EQ(settle(scale, 5ms, 1000ms), 0.35);
}

}  // namespace
}  // namespace theatron::xr
