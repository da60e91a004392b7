// SPDX-License-Identifier: Apache-2.0
#include "video/jpeg_file_native.h"

#include <gtest/gtest.h>
#include <turbojpeg.h>

#include <cstdlib>
#include <vector>

#include "video/jpeg_header.h"

namespace theatron::video {
namespace {

constexpr Size size{48, 32};

// A picture of one colour, whose pixels have `channels` bytes.
Bytes encoded(std::vector<unsigned char> channels, TJPF pixels, int flags) {
    std::vector<unsigned char> image;
    for (std::size_t i = 0; i < size.area(); ++i)
        image.insert(image.end(), channels.begin(), channels.end());
    void* const encoder = tjInitCompress();
    unsigned char* bytes = nullptr;
    unsigned long count = 0;
    EXPECT_EQ(tjCompress2(encoder, image.data(), size.width, 0, size.height, pixels, &bytes, &count,
                          TJSAMP_444, 95, flags),
              0);
    const ByteView view = std::as_bytes(std::span(bytes, count));
    const Bytes result(view.begin(), view.end());
    tjFree(bytes);
    tjDestroy(encoder);
    return result;
}

void expect_near(const ColorImage& image, Rgb color) {
    ASSERT_EQ(image.size, size);
    for (const Rgb& pixel : {image.pixels.front(), image.pixels.back()}) {
        EXPECT_NEAR(pixel.r, color.r, 2);
        EXPECT_NEAR(pixel.g, color.g, 2);
        EXPECT_NEAR(pixel.b, color.b, 2);
    }
}

TEST(JpegFile, ReadsProgressivePictures) {
    const Bytes jpeg = encoded({190, 61, 29}, TJPF_RGB, TJFLAG_PROGRESSIVE);
    ASSERT_EQ(read_jpeg_size(jpeg).error(), Status::unsupported);
    ColorImage image;
    ASSERT_EQ(decode_jpeg_file(jpeg, image), Status::ok);
    expect_near(image, {190, 61, 29});
    EXPECT_EQ(decode_jpeg_file(ByteView(jpeg).first(jpeg.size() / 2), image), Status::malformed);
}

TEST(JpegFile, ReadsPicturesInFourInks) {
    // The share of the paper that is left: 200 x 128 / 255 of red, and so on.
    Bytes jpeg = encoded({200, 60, 255, 128}, TJPF_CMYK, 0);
    ASSERT_EQ(read_jpeg_size(jpeg).error(), Status::unsupported);
    ColorImage image;
    ASSERT_EQ(decode_jpeg_file(jpeg, image), Status::ok);
    expect_near(image, {100, 30, 128});
}

TEST(JpegFile, RefusesWhatIsNone) {
    ColorImage image;
    EXPECT_EQ(decode_jpeg_file({}, image), Status::malformed);
    EXPECT_EQ(decode_jpeg_file(as_bytes("not a picture"), image), Status::malformed);
}

}  // namespace
}  // namespace theatron::video
