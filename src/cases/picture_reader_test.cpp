// SPDX-License-Identifier: Apache-2.0
#include "cases/picture_reader.h"

#include <gtest/gtest.h>
#include <turbojpeg.h>

#include <cstdlib>

#include "files/photo_orientation.h"
#include "files/png_file.h"
#include "medical/picture.h"

namespace theatron::cases {
namespace {

constexpr Rgb red{255, 0, 0}, green{0, 255, 0}, blue{0, 0, 255}, white{255, 255, 255};

// Red above left, green above right, blue below left, white below right.
ColorImage quarters(Size size) {
    ColorImage image(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const bool right = 2 * x >= size.width, low = 2 * y >= size.height;
            image.view().row(y)[x] = low ? right ? white : blue : right ? green : red;
        }
    return image;
}

Bytes jpeg(const ColorImage& image, int quality = 100) {
    unsigned char* out = nullptr;
    unsigned long size = 0;
    tjhandle encoder = tjInitCompress();
    tjCompress2(encoder, reinterpret_cast<const unsigned char*>(image.pixels.data()),
                image.size.width, 0, image.size.height, TJPF_RGB, &out, &size, TJSAMP_444, quality,
                TJFLAG_ACCURATEDCT);
    const auto* first = reinterpret_cast<const std::byte*>(out);
    Bytes bytes(first, first + size);
    tjFree(out);
    tjDestroy(encoder);
    return bytes;
}

Bytes bytes(std::initializer_list<int> values) {
    Bytes out;
    for (const int value : values)
        out.push_back(std::byte(value));
    return out;
}

Bytes with_orientation(Bytes file, int orientation, bool big_endian) {
    const Bytes big = bytes({0xff, 0xe1, 0, 34, 'E', 'x',         'i', 'f', 0,    0,    'M', 'M',
                             0,    42,   0, 0,  0,   8,           0,   1,   0x01, 0x12, 0,   3,
                             0,    0,    0, 1,  0,   orientation, 0,   0,   0,    0,    0,   0});
    const Bytes little = bytes({0xff, 0xe1, 0, 34, 'E',         'x', 'i', 'f', 0,    0,    'I', 'I',
                                42,   0,    8, 0,  0,           0,   1,   0,   0x12, 0x01, 3,   0,
                                1,    0,    0, 0,  orientation, 0,   0,   0,   0,    0,    0,   0});
    const Bytes& segment = big_endian ? big : little;
    file.insert(file.begin() + 2, segment.begin(), segment.end());
    return file;
}

bool near(Rgb a, Rgb b) {
    return std::abs(a.r - b.r) < 12 && std::abs(a.g - b.g) < 12 && std::abs(a.b - b.b) < 12;
}

TEST(PictureReader, PngIsReadExactly) {
    const ColorImage image = quarters({20, 10});
    ColorImage read;
    ASSERT_EQ(read_picture(files::encode_png(image.view()), read), Answer::content);
    EXPECT_EQ(read, image);
}

TEST(PictureReader, GreyOf16BitsKeepsTheUpper8) {
    DepthImage image({256, 1});
    for (std::size_t i = 0; i < 256; ++i)
        image.pixels[i] = std::uint16_t(i * 257);
    ColorImage read;
    ASSERT_EQ(read_picture(files::encode_png(image.view()), read), Answer::content);
    for (std::size_t i = 0; i < 256; ++i)
        EXPECT_EQ(read.pixels[i], (Rgb{std::uint8_t(i), std::uint8_t(i), std::uint8_t(i)}));
}

TEST(PictureReader, JpegIsReadAndTurnedAsItsExifDataSay) {
    const ColorImage image = quarters({48, 32});
    // The corners above left, above right, below left, below right.
    const Rgb seen[8][4] = {{red, green, blue, white}, {green, red, white, blue},
                            {white, blue, green, red}, {blue, white, red, green},
                            {red, blue, green, white}, {blue, red, white, green},
                            {white, green, blue, red}, {green, white, red, blue}};
    for (int orientation = 1; orientation <= 8; ++orientation)
        for (const bool big_endian : {false, true}) {
            ColorImage read;
            ASSERT_EQ(read_picture(with_orientation(jpeg(image), orientation, big_endian), read),
                      Answer::content);
            EXPECT_EQ(read.size, orientation < 5 ? (Size{48, 32}) : (Size{32, 48}));
            const int right = read.size.width - 3, low = read.size.height - 3;
            const Rgb corners[] = {read.view().row(2)[2], read.view().row(2)[right],
                                   read.view().row(low)[2], read.view().row(low)[right]};
            for (int i = 0; i < 4; ++i)
                EXPECT_TRUE(near(corners[i], seen[orientation - 1][i]))
                    << "orientation " << orientation << ", corner " << i;
        }
}

TEST(PictureReader, LargePicturesAreReduced) {
    const ColorImage image = quarters({3 * medical::max_picture_side, 60});
    for (const Bytes& file : {files::encode_png(image.view()), jpeg(image)}) {
        ColorImage read;
        ASSERT_EQ(read_picture(file, read), Answer::content);
        EXPECT_EQ(read.size, (Size{medical::max_picture_side, 20}));
        EXPECT_TRUE(near(read.pixels.front(), red));
        EXPECT_TRUE(near(read.pixels.back(), white));
    }
}

TEST(PictureReader, DamageIsNamed) {
    ColorImage read;
    const Bytes png = files::encode_png(quarters({40, 30}).view()), jpg = jpeg(quarters({40, 30}));
    EXPECT_EQ(read_picture({}, read), Answer::no_picture);
    EXPECT_EQ(read_picture(as_bytes("GIF89a ............"), read), Answer::no_picture);
    for (std::size_t size = 0; size < png.size() - 12; size += 7)
        EXPECT_NE(read_picture(ByteView(png).first(size), read), Answer::content) << size;
    for (std::size_t size = 0; size < jpg.size() - 2; size += 7)
        EXPECT_NE(read_picture(ByteView(jpg).first(size), read), Answer::content) << size;
    EXPECT_EQ(read_picture(ByteView(jpg).first(jpg.size() - 20), read), Answer::cut_off);
    // 60000 x 60000 pixels are announced.
    Bytes bomb = jpg;
    for (std::size_t at = 0; at + 9 < bomb.size(); ++at)
        if (bomb[at] == std::byte(0xff) && bomb[at + 1] == std::byte(0xc0)) {
            bomb[at + 5] = bomb[at + 7] = std::byte(0xea);
            bomb[at + 6] = bomb[at + 8] = std::byte(0x60);
            break;
        }
    EXPECT_EQ(read_picture(bomb, read), Answer::too_large);
}

TEST(PictureReader, ExifDataThatAreWrongMeanUpright) {
    const Bytes file = with_orientation(jpeg(quarters({16, 16})), 6, true);
    EXPECT_EQ(files::exif_orientation(file), 6);
    for (std::size_t size = 0; size < 38; ++size)
        EXPECT_EQ(files::exif_orientation(ByteView(file).first(size)), 1) << size;
    for (const int orientation : {0, 9, 200})
        EXPECT_EQ(
            files::exif_orientation(with_orientation(jpeg(quarters({16, 16})), orientation, false)),
            1);
    Bytes far = file;
    far[14] = std::byte(0xff);  // the offset of the entries
    EXPECT_EQ(files::exif_orientation(far), 1);
}

}  // namespace
}  // namespace theatron::cases
