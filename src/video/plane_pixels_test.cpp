// SPDX-License-Identifier: Apache-2.0
#include "video/plane_pixels.h"

#include <gtest/gtest.h>
#include <turbojpeg.h>

#include <random>

#include "image/frame.h"

namespace theatron::video {
namespace {

// Planes of random samples, those of colour interleaved or not, with rows longer than needed.
struct Planes {
    Planes(Size shown, bool interleaved) : size(shown) {
        const auto width = std::size_t(size.width + 1) / 2,
                   height = std::size_t(size.height + 1) / 2;
        layout.y_stride = std::size_t(size.width) + 5;
        layout.chroma_step = interleaved ? 2 : 1;
        layout.chroma_stride = layout.chroma_step * width + 3;
        layout.y = 7;
        layout.u = layout.y + layout.y_stride * std::size_t(size.height);
        layout.v = interleaved ? layout.u + 1 : layout.u + layout.chroma_stride * height;
        samples.resize(layout.v + layout.chroma_stride * (height - 1) +
                       layout.chroma_step * (width - 1) + 1);
        std::mt19937 rng(5);
        for (std::byte& sample : samples)
            sample = std::byte(rng());
    }

    ColorImage by_libjpeg() const {
        const auto width = std::size_t(size.width + 1) / 2,
                   height = std::size_t(size.height + 1) / 2;
        std::vector<unsigned char> u, v;
        for (std::size_t y = 0; y < height; ++y)
            for (std::size_t x = 0; x < width; ++x) {
                const std::size_t at = y * layout.chroma_stride + x * layout.chroma_step;
                u.push_back(std::to_integer<unsigned char>(samples[layout.u + at]));
                v.push_back(std::to_integer<unsigned char>(samples[layout.v + at]));
            }
        const unsigned char* planes[] = {
            reinterpret_cast<const unsigned char*>(samples.data()) + layout.y, u.data(), v.data()};
        const int strides[] = {int(layout.y_stride), int(width), int(width)};
        ColorImage image(size);
        void* const library = tjInitDecompress();
        EXPECT_EQ(tjDecodeYUVPlanes(library, planes, strides, TJSAMP_420,
                                    reinterpret_cast<unsigned char*>(image.pixels.data()),
                                    size.width, size.width * 3, size.height, TJPF_RGB, 0),
                  0);
        tjDestroy(library);
        return image;
    }

    Size size;
    PlaneLayout layout;
    Bytes samples;
};

TEST(PlanePixels, EqualThoseOfLibjpeg) {
    for (const Size size : {Size{1, 1}, Size{2, 2}, Size{33, 7}, Size{64, 48}, Size{639, 3}})
        for (const bool interleaved : {false, true}) {
            const Planes planes(size, interleaved);
            ColorImage image(size);
            ASSERT_EQ(pixels_of_planes(planes.samples, planes.layout, image.view()), Status::ok);
            EXPECT_EQ(image.pixels, planes.by_libjpeg().pixels)
                << size.width << "x" << size.height << (interleaved ? " interleaved" : "");
        }
}

TEST(PlanePixels, PlanesOutsideOfTheSamplesAreRefused) {
    const Planes planes({33, 7}, false);
    ColorImage image(planes.size);
    const ByteView all = planes.samples;
    for (std::size_t size = 0; size < all.size(); ++size)
        EXPECT_EQ(pixels_of_planes(all.first(size), planes.layout, image.view()),
                  Status::truncated);
    for (std::size_t PlaneLayout::*field :
         {&PlaneLayout::y, &PlaneLayout::u, &PlaneLayout::v, &PlaneLayout::y_stride,
          &PlaneLayout::chroma_stride, &PlaneLayout::chroma_step}) {
        PlaneLayout damaged = planes.layout;
        damaged.*field = std::size_t(-1);
        EXPECT_EQ(pixels_of_planes(all, damaged, image.view()), Status::truncated);
    }
    EXPECT_EQ(image.pixels, ColorImage(planes.size).pixels);
}

TEST(PlanePixels, OfFourBytesLoseTheLast) {
    Bytes samples(2 + 2 * 11);
    for (std::size_t i = 0; i < samples.size(); ++i)
        samples[i] = std::byte(i);
    ColorImage image({2, 2});
    ASSERT_EQ(pixels_of_quads(samples, 2, 11, image.view()), Status::ok);
    EXPECT_EQ(image.pixels, (std::vector<Rgb>{{2, 3, 4}, {6, 7, 8}, {13, 14, 15}, {17, 18, 19}}));
    EXPECT_EQ(pixels_of_quads(ByteView(samples).first(20), 2, 11, image.view()), Status::truncated);
    EXPECT_EQ(pixels_of_quads(samples, 2, 7, image.view()), Status::truncated);
}

}  // namespace
}  // namespace theatron::video
