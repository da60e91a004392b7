// SPDX-License-Identifier: Apache-2.0
#include "render/scene_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <optional>
#include <vector>

#include "render/label_pass.h"
#include "render/room_picture.h"
#include "render/test_context.h"

namespace theatron::render {
namespace {

constexpr Rgb orange{230, 159, 0}, line_blue{0, 114, 178};
constexpr Size wide{640, 360};

// As in WCAG 2.1, which demands 3 to 1 of signs.
double contrast(Rgb a, Rgb b) {
    const auto luminance = [](Rgb c) {
        const auto linear = [](double byte) { return std::pow(byte / 255, 2.2); };
        return 0.2126 * linear(c.r) + 0.7152 * linear(c.g) + 0.0722 * linear(c.b);
    };
    const double one = luminance(a) + 0.05, other = luminance(b) + 0.05;
    return std::max(one, other) / std::min(one, other);
}

bool is_near(Rgb a, Rgb b, int most = 6) {
    return std::abs(a.r - b.r) <= most && std::abs(a.g - b.g) <= most &&
           std::abs(a.b - b.b) <= most;
}

std::optional<FontAtlas> font_atlas() {
    std::ifstream file("/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", std::ios::binary);
    if (!file)
        return std::nullopt;
    const std::string bytes((std::istreambuf_iterator<char>(file)), {});
    return load_font_atlas(std::as_bytes(std::span(bytes)));
}

class SceneLinesTest : public ::testing::Test {
protected:
    SceneLinesTest() {
        test_context();
        along_x_.emplace(std::vector<LinePiece>{{{-0.1, 0, 0}, {0.1, 0, 0}, 0.0016, 0.0016}});
    }

    static CameraView view_from(double z) { return view_towards({0, 1, z}, {0, 1, 0}, 45, wide); }

    // A line along x at a height of 1 m, 3.2 mm thick.
    SceneLine line(Rgb color = orange) const { return {&*along_x_, {Quat{}, {0, 1, 0}}, color}; }

    ColorImage drawn(const SceneFrame& frame, const CameraView& view,
                     const FontAtlas* atlas = nullptr) {
        ScenePasses passes(atlas);
        return draw_and_read(&frame, {}, {view}, wide, &passes).color;
    }

    // The pixels of this colour in the middle column.
    static int thickness(const ColorImage& picture, Rgb color) {
        int count = 0;
        for (int y = 0; y < wide.height; ++y)
            count += is_near(picture.view().row(y)[wide.width / 2], color);
        return count;
    }

    std::optional<SceneLineMesh> along_x_;
};

TEST_F(SceneLinesTest, ALineHasItsLeastWidthFarAwayAndItsOwnWhereItIsNear) {
    SceneFrame frame;
    frame.lines = {line()};
    for (const double distance_m : {1.0, 3.0, 8.0})
        EXPECT_NEAR(thickness(drawn(frame, view_from(distance_m)), orange), 4, 1) << distance_m;
    // 360 pixels are 0.083 m at this distance.
    EXPECT_NEAR(thickness(drawn(frame, view_from(0.1)), orange), 0.0032 / 0.0828 * 360, 2);
    EXPECT_EQ(least_line_width({640, 360}), 4);
    EXPECT_GT(least_line_width({3840, 2160}), 9);
}

TEST_F(SceneLinesTest, AnOutlineStandsOutFromTheLineAndFromAnyGround) {
    // The colours of people.
    for (const Rgb color : {Rgb{230, 159, 0}, Rgb{86, 180, 233}, Rgb{0, 158, 115},
                            Rgb{240, 228, 66}, Rgb{204, 121, 167}, Rgb{213, 94, 0}, line_blue}) {
        EXPECT_GT(contrast(color, outline_color(color)), 4) << int(color.r);
        for (int grey = 0; grey < 256; grey += 15) {
            const Rgb ground{std::uint8_t(grey), std::uint8_t(grey), std::uint8_t(grey)};
            EXPECT_GT(std::max(contrast(color, ground), contrast(outline_color(color), ground)), 2)
                << int(color.r) << " on " << grey;
        }
    }
    SceneFrame frame;
    frame.lines = {line(line_blue)};
    const ColorImage picture = drawn(frame, view_from(2));
    EXPECT_GE(thickness(picture, outline_color(line_blue)), 2);
    EXPECT_NEAR(thickness(picture, line_blue), 4, 1);
}

TEST_F(SceneLinesTest, APiecewiseLineHasNoGapsAndNoOutlineAcross) {
    std::vector<LinePiece> pieces;
    for (int i = 0; i < 60; ++i) {
        // As of a slow hand: a step of half a millimetre to the side, with noise of depth.
        const auto at = [](int k) { return Vec3{0.0005 * k - 0.015, 0, 0.004 * (k % 3)}; };
        pieces.push_back({at(i), at(i + 1), 0.0016, 0.0016});
    }
    const SceneLineMesh mesh(pieces);
    SceneFrame frame;
    frame.lines = {{&mesh, {Quat{}, {0, 1, 0}}, orange}};
    const ColorImage picture = drawn(frame, view_from(0.5));
    const int row = wide.height / 2;
    int first = wide.width, last = 0, count = 0;
    for (int x = 0; x < wide.width; ++x)
        if (is_near(picture.view().row(row)[x], orange)) {
            first = std::min(first, x);
            last = std::max(last, x);
            ++count;
        }
    EXPECT_GT(count, 20);
    EXPECT_EQ(count, last - first + 1);
}

TEST_F(SceneLinesTest, ALineThatPassesTheEyeIsDrawnToTheEdgeOfThePicture) {
    const SceneLineMesh past({{{0, -0.2, -2}, {0, -0.2, 2}, 0.0016, 0.0016}});
    SceneFrame frame;
    frame.lines = {{&past, {Quat{}, {0, 1, 0}}, orange}};
    const ColorImage picture = drawn(frame, view_from(1));
    EXPECT_TRUE(is_near(picture.view().row(wide.height - 1)[wide.width / 2], orange));
    // All of it behind the eye.
    frame.lines[0].room_from_line.translation.z = 10;
    EXPECT_EQ(drawn(frame, view_from(1)), drawn({}, view_from(1)));
}

TEST_F(SceneLinesTest, OnlySurfacesThatAreClearlyNearerHideALine) {
    const SceneMesh wall(make_box_mesh({-0.5, -0.5, -0.005}, {0.5, 0.5, 0.005}));
    SceneFrame frame;
    frame.lines = {line()};
    frame.lines[0].nearer_m = 0.02;
    const auto width_behind = [&](double z) {
        frame.objects = {{&wall, {Quat{}, {0, 1, z}}, {{0.5, 0.5, 0.5}}}};
        return thickness(drawn(frame, view_from(1)), orange);
    };
    EXPECT_NEAR(width_behind(0.01), 4, 1);
    EXPECT_EQ(width_behind(0.03), 0);
}

TEST_F(SceneLinesTest, AnArrowsHeadIsWiderThanItsShaftAndSharpAtTheTip) {
    const SceneLineMesh arrow({{{-0.1, 0, 0}, {0.086, 0, 0}, 0.0016, 0.0016},
                               {{0.086, 0, 0}, {0.1, 0, 0}, 0.005, 0, 2.6, 0}});
    SceneFrame frame;
    frame.lines = {{&arrow, {Quat{}, {0, 1, 0}}, orange}};
    const ColorImage picture = drawn(frame, view_from(3));
    std::vector<int> columns;
    for (int x = 0; x < wide.width; ++x) {
        int count = 0;
        for (int y = 0; y < wide.height; ++y)
            count += is_near(picture.view().row(y)[x], orange);
        if (count > 0)
            columns.push_back(count);
    }
    ASSERT_GT(columns.size(), 20u);
    EXPECT_LE(columns.front(), 5);
    EXPECT_LE(columns.back(), 3);
    EXPECT_GE(*std::max_element(columns.begin(), columns.end()), 8);
}

// From above, where a text that stands in the room would be seen on its edge.
TEST_F(SceneLinesTest, ALabelIsUprightAndWholeFromAnySideAndBehindAnything) {
    const auto atlas = font_atlas();
    if (!atlas)
        GTEST_SKIP() << "fonts-dejavu-core is not installed";
    const SceneMesh wall(make_box_mesh({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}));
    SceneFrame frame;
    frame.labels = {{"274.7 mm \u00b1 4.4 mm AB", {0, 1, 0}, orange, LabelRank::number}};
    const auto plate = [&](const CameraView& view) {
        const ColorImage picture = drawn(frame, view, &*atlas);
        std::optional<std::pair<int, int>> corner;
        ColorImage cut({200, 24});
        for (int y = 0; y < wide.height && !corner; ++y)
            for (int x = 0; x < wide.width && !corner; ++x)
                if (is_near(picture.view().row(y)[x], orange))
                    corner = {x, y};
        if (!corner)
            return ColorImage();
        for (int y = 0; y < cut.size.height; ++y)
            for (int x = 0; x < cut.size.width; ++x)
                cut.view().row(y)[x] = picture.view().row(corner->second + y)[corner->first + x];
        return cut;
    };
    const ColorImage from_front = plate(view_from(2));
    ASSERT_GT(from_front.size.area(), 0);
    // Bright letters on a dark plate.
    int bright = 0, dark = 0;
    for (const Rgb pixel : from_front.pixels) {
        bright += pixel.r > 200 && pixel.b > 200;
        dark += pixel.r < 40 && pixel.b < 40;
    }
    EXPECT_GT(bright, 200);
    EXPECT_GT(dark, 1000);
    EXPECT_EQ(plate(view_towards({0.05, 3, 0}, {0, 1, 0}, 45, wide)), from_front);
    EXPECT_EQ(plate(view_towards({-9, 4, 3}, {0, 1, 0}, 45, wide)), from_front);
    frame.objects = {{&wall, {Quat{}, {0, 1, 1}}, {{0.1, 0.3, 0.1}}}};
    frame.objects[0].scale = 0.5;
    const ColorImage before_wall = plate(view_from(2));
    ASSERT_EQ(before_wall.size, from_front.size);
    int lost = 0;
    for (std::size_t i = 0; i < before_wall.pixels.size(); ++i)
        lost += from_front.pixels[i].r > 230 && before_wall.pixels[i].r < 225;
    EXPECT_EQ(lost, 0);
}

// A pin behind a screen must not be taken for one on the screen's images.
TEST_F(SceneLinesTest, ANameIsHiddenByWhatIsClearlyBeforeIt) {
    const auto atlas = font_atlas();
    if (!atlas)
        GTEST_SKIP() << "fonts-dejavu-core is not installed";
    const SceneMesh wall(make_box_mesh({-0.5, -0.5, -0.01}, {0.5, 0.5, 0.01}));
    SceneFrame frame;
    const auto orange_pixels = [&](double z) {
        frame.objects = {{&wall, {Quat{}, {0, 1, z}}, {{0.1, 0.3, 0.1}}}};
        frame.labels = {{"12 AB", {0, 1, 0}, orange, LabelRank::name}};
        const ColorImage picture = drawn(frame, view_from(2), &*atlas);
        return std::count_if(picture.pixels.begin(), picture.pixels.end(),
                             [](Rgb pixel) { return is_near(pixel, orange); });
    };
    EXPECT_GT(orange_pixels(-0.1), 60);
    EXPECT_EQ(orange_pixels(0.05), orange_pixels(-0.1));
    EXPECT_EQ(orange_pixels(0.3), 0);
}

TEST_F(SceneLinesTest, BothEyesHaveALabelAtItsPlace) {
    const auto atlas = font_atlas();
    if (!atlas)
        GTEST_SKIP() << "fonts-dejavu-core is not installed";
    SceneFrame frame;
    frame.labels = {{"12.3 mm", {0, 1, 0}, orange, LabelRank::number}};
    ScenePasses passes(&*atlas);
    const auto eyes = stereo_pair(view_from(1), 0.064);
    const ColorImage both = draw_and_read(&frame, {}, {eyes[0], eyes[1]}, wide, &passes).color;
    const auto left_edge = [&](int from) {
        for (int x = from; x < from + wide.width; ++x)
            for (int y = 0; y < wide.height; ++y)
                if (is_near(both.view().row(y)[x], orange))
                    return x - from;
        return -1;
    };
    // As far apart as the places themselves: 0.064 m at a distance of one metre.
    EXPECT_NEAR(left_edge(0) - left_edge(wide.width), 0.064 / 0.8284 * wide.height, 1.5);
}

TEST(LabelPlates, NumbersCoverNothingAndAreInsideOfThePicture) {
    const CameraView view = view_towards({0, 1, 1}, {0, 1, 0}, 45, wide);
    std::vector<SceneLabel> labels;
    std::vector<double> lengths;
    // Twenty distances beside each other, some at the edge, among the initials of strokes.
    for (int i = 0; i < 20; ++i) {
        const double x = 0.7 * (i % 5 - 2) / 2.0, y = 1 + 0.4 * (i / 5 - 1.5) / 1.5;
        labels.push_back({"AB", {x, y, 0.001}, orange, LabelRank::author});
        labels.push_back({"274.7 mm", {x, y, 0}, orange, LabelRank::number});
        lengths.insert(lengths.end(), {1.8, 8.0});
    }
    const auto plates = label_plates(labels, lengths, view, wide);
    const Rect all{0, 0, double(wide.width), double(wide.height)};
    int authors = 0;
    for (std::size_t i = 0; i < plates.size(); ++i) {
        if (labels[i].rank == LabelRank::author) {
            authors += plates[i].has_value();
            continue;
        }
        ASSERT_TRUE(plates[i]) << i;
        const Rect& plate = plates[i]->plate;
        EXPECT_NEAR(shared_area(plate, all), plate.width * plate.height, 1e-6) << i;
        EXPECT_GE(plates[i]->letter, 11) << i;
        double covered = 0;
        for (std::size_t k = 0; k < plates.size(); ++k)
            covered += k != i && plates[k] ? shared_area(plate, plates[k]->plate) : 0;
        EXPECT_EQ(covered, 0) << i;
    }
    EXPECT_GT(authors, 0);
}

TEST(LabelPlates, ATextThatIsTooLongForThePictureHasSmallerLetters) {
    const CameraView view = view_towards({0, 1, 1}, {0, 1, 0}, 45, {160, 120});
    const std::vector<SceneLabel> labels{
        {"1234.5 mm \u00b1 12.5 mm ABC", {0, 1, 0}, orange, LabelRank::number}};
    const auto plates = label_plates(labels, {24}, view, {160, 120});
    EXPECT_LT(plates[0]->letter, 11);
    EXPECT_GE(plates[0]->plate.x, 0);
    EXPECT_LE(plates[0]->plate.right(), 160 + 1e-9);
}

TEST(LabelPlates, APlaceBesideThePictureOrBehindTheEyeHasNone) {
    const CameraView view = view_towards({0, 1, 1}, {0, 1, 0}, 45, wide);
    const std::vector<SceneLabel> labels{{"A", {5, 1, 0}, orange}, {"B", {0, 1, 3}, orange}};
    for (const auto& plate : label_plates(labels, {1, 1}, view, wide))
        EXPECT_FALSE(plate);
}

}  // namespace
}  // namespace theatron::render
