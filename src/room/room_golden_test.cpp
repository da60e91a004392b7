// SPDX-License-Identifier: Apache-2.0
// Small pictures of the virtual room in both qualities, compared with those in tests/golden. To
// accept a wanted change run this test with THEATRON_WRITE_GOLDEN=1 and look at the new pictures
// before keeping them.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

#include "render/room_picture.h"
#include "render/test_context.h"
#include "room/virtual_room.h"

namespace theatron::room {
namespace {

constexpr Size picture_size{256, 144};
const std::string header = "P6\n256 144\n255\n";

ColorImage read_ppm(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(in)), {});
    ColorImage image(picture_size);
    if (bytes.size() != header.size() + 3 * image.pixels.size() ||
        bytes.compare(0, header.size(), header) != 0)
        return {};
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const auto at = [&](std::size_t c) {
            return std::uint8_t(bytes[header.size() + 3 * i + c]);
        };
        image.pixels[i] = {at(0), at(1), at(2)};
    }
    return image;
}

void write_ppm(const std::string& file, const ColorImage& image) {
    std::ofstream out(file, std::ios::binary);
    out << header;
    out.write(reinterpret_cast<const char*>(image.pixels.data()),
              std::streamsize(image.pixels.size() * sizeof(Rgb)));
    ASSERT_TRUE(out.flush()) << file;
}

void expect_golden(render::SceneQuality quality, const std::string& file) {
    render::test_context();
    VirtualRoom room;
    room.set_cameras({});
    const auto view = render::view_towards({2.4, 2.2, 2.8}, {-0.4, 0.9, -0.5}, 66, picture_size);
    render::SceneFrame frame;
    frame.quality = quality;
    room.build(frame.quality);
    room.add_to(frame, view);
    render::ScenePasses passes;
    const ColorImage drawn = render::draw_and_read(&frame, {}, {view}, picture_size, &passes).color;
    if (std::getenv("THEATRON_WRITE_GOLDEN"))
        write_ppm(file, drawn);
    const ColorImage golden = read_ppm(file);
    ASSERT_EQ(golden.size, picture_size) << "cannot read " << file;
    double sum = 0;
    int different = 0;
    for (std::size_t i = 0; i < golden.pixels.size(); ++i) {
        const Rgb a = drawn.pixels[i], b = golden.pixels[i];
        const int difference = std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b);
        sum += difference / 3.0;
        different += difference > 60;
    }
    // Drivers round differently at outlines.
    EXPECT_LT(sum / double(golden.pixels.size()), 2.5);
    EXPECT_LT(different, int(golden.pixels.size()) / 25);
}

TEST(RoomGolden, LowIsThePictureThatWasLookedAt) {
    expect_golden(render::SceneQuality::low, "tests/golden/room_low.ppm");
}

TEST(RoomGolden, HighIsThePictureThatWasLookedAt) {
    expect_golden(render::SceneQuality::high, "tests/golden/room_high.ppm");
}

}  // namespace
}  // namespace theatron::room
