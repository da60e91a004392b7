// SPDX-License-Identifier: Apache-2.0
#include "image/srgb.h"

#include <gtest/gtest.h>

namespace theatron {
namespace {

TEST(Srgb, IsTheCurveOfTheStandardAndItsInverse) {
    EXPECT_NEAR(srgb_to_linear(0.5), 0.21404, 1e-5);
    EXPECT_NEAR(linear_to_srgb(0.18), 0.46136, 1e-5);
    for (int value = 0; value <= 255; ++value)
        EXPECT_NEAR(255 * linear_to_srgb(srgb_to_linear(value / 255.0)), value, 1e-3);
}

}  // namespace
}  // namespace theatron
