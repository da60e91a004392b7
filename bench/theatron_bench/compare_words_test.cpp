// SPDX-License-Identifier: Apache-2.0
#include "compare_words.h"

#include <gtest/gtest.h>

namespace theatron::bench {
namespace {

TEST(CompareWords, EachLikenessHasTheWordOfItsStep) {
    EXPECT_EQ(psnr_words(99), "no visible difference");
    EXPECT_EQ(psnr_words(40), "no visible difference");
    EXPECT_EQ(psnr_words(39.9), "small differences");
    EXPECT_EQ(psnr_words(20), "clear differences");
    EXPECT_EQ(psnr_words(19.9), "strong differences");
    EXPECT_EQ(ssim_words(1), "no visible difference");
    EXPECT_EQ(ssim_words(0.9), "small differences");
    EXPECT_EQ(ssim_words(0.89), "clear differences");
    EXPECT_EQ(ssim_words(0.1), "strong differences");
}

TEST(CompareWords, TheScaleSaysWhereEachWordBegins) {
    EXPECT_EQ(psnr_scale(),
              "Likeness in dB (PSNR): no visible difference from 40 dB on, small differences from "
              "30 dB, clear differences from 20 dB, strong differences below.");
    EXPECT_EQ(ssim_scale(),
              "Likeness of shapes (SSIM, 1 is equal): no visible difference from 0.98 on, small "
              "differences from 0.9, clear differences from 0.7, strong differences below.");
}

}  // namespace
}  // namespace theatron::bench
