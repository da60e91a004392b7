// SPDX-License-Identifier: Apache-2.0
#include "capture/av_video.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "ffmpeg/ffmpeg.h"

namespace theatron::capture {
namespace {

// A picture of one colour (YCbCr with all 256 steps, 4:2:0).
class OneColor {
public:
    OneColor(Size size, double kr, double kb, Rgb color) : size_(size) {
        const double y = kr * color.r + (1 - kr - kb) * color.g + kb * color.b;
        fill(0, size.area(), y);
        fill(1, size.area() / 4, 128 + (color.b - y) / (2 * (1 - kb)));
        fill(2, size.area() / 4, 128 + (color.r - y) / (2 * (1 - kr)));
    }

    PictureWriter::Source source(AVPixelFormat format, AVColorSpace colors, AVColorRange range) {
        for (int i = 0; i < 3; ++i) {
            rows_[i] = planes_[i].data();
            strides_[i] = i == 0 ? size_.width : size_.width / 2;
        }
        return {format, size_, rows_, strides_, colors, range};
    }

private:
    void fill(int plane, std::size_t pixels, double value) {
        planes_[plane].assign(pixels, std::uint8_t(std::lround(value)));
    }

    Size size_;
    std::vector<std::uint8_t> planes_[3];
    const std::uint8_t* rows_[4] = {};
    int strides_[4] = {};
};

Rgb middle_of(const Bytes& area, Size size) {
    const auto at = 3 * std::size_t(size.height / 2 * size.width + size.width / 2);
    return {std::uint8_t(area[at]), std::uint8_t(area[at + 1]), std::uint8_t(area[at + 2])};
}

int difference(Rgb a, Rgb b) {
    return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

constexpr Size small_picture{64, 48};
constexpr Rgb brick_red{190, 61, 29};

TEST(PictureWriter, KeepsTheColoursOfAllPictures) {
    ASSERT_EQ(ffmpeg::problem(), "");
    struct Case {
        AVPixelFormat format;
        AVColorRange range;
        AVColorSpace colors;
        double kr, kb;
    };
    for (const Case& one :
         {Case{AV_PIX_FMT_YUVJ420P, AVCOL_RANGE_JPEG, AVCOL_SPC_BT709, 0.2126, 0.0722},
          Case{AV_PIX_FMT_YUVJ420P, AVCOL_RANGE_UNSPECIFIED, AVCOL_SPC_BT470BG, 0.299, 0.114},
          Case{AV_PIX_FMT_YUV420P, AVCOL_RANGE_JPEG, AVCOL_SPC_BT709, 0.2126, 0.0722},
          Case{AV_PIX_FMT_YUV420P, AVCOL_RANGE_JPEG, AVCOL_SPC_BT2020_NCL, 0.2627, 0.0593}}) {
        Bytes area(video_bytes(small_picture));
        PictureWriter writer(area);
        ASSERT_TRUE(writer.begin(small_picture));
        OneColor picture(small_picture, one.kr, one.kb, brick_red);
        for (int n = 1; n <= 100; ++n) {
            writer.write(picture.source(one.format, one.colors, one.range));
            ASSERT_LE(difference(middle_of(area, small_picture), brick_red), 2)
                << "picture " << n << ", format " << one.format << ", colours " << one.colors;
        }
    }
}

TEST(PictureWriter, ColoursMayChangeWithinAStream) {
    ASSERT_EQ(ffmpeg::problem(), "");
    Bytes area(video_bytes(small_picture));
    PictureWriter writer(area);
    ASSERT_TRUE(writer.begin(small_picture));
    OneColor sd(small_picture, 0.299, 0.114, brick_red),
        hd(small_picture, 0.2126, 0.0722, brick_red);
    for (int n = 0; n < 10; ++n) {
        OneColor& picture = n % 2 == 0 ? sd : hd;
        writer.write(picture.source(AV_PIX_FMT_YUV420P,
                                    n % 2 == 0 ? AVCOL_SPC_SMPTE170M : AVCOL_SPC_BT709,
                                    AVCOL_RANGE_JPEG));
        EXPECT_LE(difference(middle_of(area, small_picture), brick_red), 2) << "picture " << n;
    }
}

TEST(PictureShape, PixelsAreSquareOnTheScreen) {
    EXPECT_EQ(shown_size({720, 576}, {{16, 15}}), (Size{768, 576}));
    EXPECT_EQ(shown_size({720, 576}, {{64, 45}}), (Size{1024, 576}));
    EXPECT_EQ(shown_size({720, 480}, {{8, 9}}), (Size{720, 540}));
    EXPECT_EQ(shown_size({640, 480}, {{0, 1}}), (Size{640, 480})) << "unknown";
    EXPECT_EQ(shown_size({640, 480}, {{1000, 1}}), (Size{640, 480})) << "a mistake";
    EXPECT_EQ(shown_size({4096, 2700}, {{2, 1}}), (Size{4096, 1350})) << "would be too large";
    EXPECT_EQ(shown_size({1, 5}, {{1, 9}}), (Size{1, 45}));
    EXPECT_EQ(shown_size({720, 576}, {{16, 15}, true}), (Size{576, 768}));
}

// A picture of three columns and two rows as a display matrix shows it, which maps (x, y) to
// (a x + c y, b x + d y).
std::vector<int> turned(double a, double b, double c, double d) {
    EXPECT_EQ(ffmpeg::problem(), "");
    const auto fixed = [](double value) { return std::int32_t(value * 65536); };
    const std::int32_t matrix[9] = {fixed(a), fixed(b), 0, fixed(c), fixed(d), 0, 0, 0, 1 << 30};
    const PictureShape shape = shape_of(matrix, {1, 1});
    const Size size = shown_size({3, 2}, shape);
    Bytes area(video_bytes(size));
    PictureWriter writer(area);
    EXPECT_TRUE(writer.begin(size));
    const std::uint8_t pixels[] = {10, 10, 10, 20, 20, 20, 30, 30, 30,
                                   40, 40, 40, 50, 50, 50, 60, 60, 60};
    const std::uint8_t* const rows[4] = {pixels};
    const int strides[4] = {9};
    writer.write({AV_PIX_FMT_RGB24, {3, 2}, rows, strides, AVCOL_SPC_RGB, AVCOL_RANGE_JPEG, shape});
    std::vector<int> seen;
    for (std::size_t i = 0; i < size.area(); ++i)
        seen.push_back(std::to_integer<int>(area[3 * i]));
    return seen;
}

TEST(PictureShape, PicturesAreTurnedAsTheirMatrixSays) {
    EXPECT_EQ(turned(1, 0, 0, 1), (std::vector{10, 20, 30, 40, 50, 60}));
    EXPECT_EQ(turned(0, 1, -1, 0), (std::vector{40, 10, 50, 20, 60, 30})) << "clockwise";
    EXPECT_EQ(turned(-1, 0, 0, -1), (std::vector{60, 50, 40, 30, 20, 10}));
    EXPECT_EQ(turned(0, -1, 1, 0), (std::vector{30, 60, 20, 50, 10, 40}));
    EXPECT_EQ(turned(-1, 0, 0, 1), (std::vector{30, 20, 10, 60, 50, 40})) << "mirrored";
    EXPECT_EQ(turned(0.99, 0.1, -0.1, 0.99), (std::vector{10, 20, 30, 40, 50, 60}))
        << "nearly upright";
    EXPECT_FALSE(shape_of(nullptr, {1, 1}).is_turned());
}

}  // namespace
}  // namespace theatron::capture
