// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#include "window/font.h"
#include "window/text_picture_native.h"

namespace theatron::window {
namespace {

constexpr Rgb text_ink{255, 190, 70}, text_ground{10, 12, 14};

const render::FontAtlas& text_atlas() {
    static const render::FontAtlas atlas = render::load_font_atlas(text_font());
    return atlas;
}

// The share of the picture that is mostly ink.
double inked(const ColorImage& picture) {
    const auto dark = std::count_if(picture.pixels.begin(), picture.pixels.end(),
                                    [](const Rgb& pixel) { return pixel.r > 128; });
    return double(dark) / double(picture.pixels.size());
}

TEST(TextPicture, HasTheLettersInTheMiddleAndAMargin) {
    const ColorImage picture = text_picture(text_atlas(), "HH", 20, text_ink, text_ground);
    EXPECT_EQ(picture.size.height, 60);
    EXPECT_NEAR(picture.size.width, 40 + text_width(text_atlas(), "HH", 20), 1);
    for (int y = 0; y < picture.size.height; ++y)
        for (int x = 0; x < picture.size.width; ++x)
            if (y < 18 || y > 42 || x < 18)
                ASSERT_EQ(picture.view().row(y)[x], text_ground) << x << ", " << y;
    EXPECT_GT(inked(picture), 0.03);
    EXPECT_LT(inked(picture), 0.3);
}

TEST(TextPicture, IsAsWideAsTheLettersAreHigh) {
    const double width = text_width(text_atlas(), "Seit 5 s für alle", 10);
    EXPECT_GT(width, 90);
    EXPECT_NEAR(text_width(text_atlas(), "Seit 5 s für alle", 30), 3 * width, 1e-6);
    EXPECT_EQ(text_width(text_atlas(), "", 30), 0);
}

TEST(TextPicture, TellsTextsApart) {
    const ColorImage one = text_picture(text_atlas(), "5 s", 20, text_ink, text_ground);
    const ColorImage other = text_picture(text_atlas(), "6 s", 20, text_ink, text_ground);
    EXPECT_EQ(one.size, other.size);
    EXPECT_NE(one, other);
}

TEST(TextPicture, LettersThatTheFontLacksStandForThemselves) {
    const ColorImage picture =
        text_picture(text_atlas(), "\xe5\xb1\xb1", 20, text_ink, text_ground);
    EXPECT_GT(inked(picture), 0);
}

}  // namespace
}  // namespace theatron::window
