// SPDX-License-Identifier: Apache-2.0
#include "enrol/photo_canvas.h"

#include <gtest/gtest.h>

namespace theatron::enrol {
namespace {

TEST(PhotoPlaceTest, APhotoFitsBesideThePanel) {
    const PhotoPlace place({400, 300}, {1000, 600}, 200);
    EXPECT_DOUBLE_EQ(place.scale(), 2);
    EXPECT_DOUBLE_EQ(place.window_of({0, 0}).x, 200);
    EXPECT_DOUBLE_EQ(place.window_of({400, 300}).x, 1000);
    EXPECT_DOUBLE_EQ(place.photo_of({200, 0}).y, 0);
}

TEST(PhotoPlaceTest, ZoomKeepsThePlaceBelowTheMouse) {
    PhotoPlace place({400, 300}, {1000, 600}, 200);
    const Vec2 mouse{700, 100}, before = place.photo_of(mouse);
    place.zoom(3, mouse);
    EXPECT_NEAR(place.photo_of(mouse).x, before.x, 1e-9);
    EXPECT_NEAR(place.photo_of(mouse).y, before.y, 1e-9);
    EXPECT_DOUBLE_EQ(place.scale(), 6);
    place.zoom(1000, mouse);
    EXPECT_DOUBLE_EQ(place.scale(), 2 * PhotoPlace::most_zoom);
    place.zoom(0.0001, mouse);
    EXPECT_DOUBLE_EQ(place.scale(), 2);
}

TEST(PhotoPlaceTest, AWindowWithoutSpaceGivesNumbers) {
    EXPECT_GT(PhotoPlace({400, 300}, {1, 1}, 5).scale(), 0);
}

class PhotoCanvasTest : public ::testing::Test {
protected:
    static constexpr Size size{40, 30};
    ColorImage photo{size}, canvas{size};
    PhotoPlace place{size, size, 0};

    PhotoCanvasTest() {
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x)
                photo.view().row(y)[x] = {std::uint8_t(5 * x), std::uint8_t(5 * y), 7};
    }
};

TEST_F(PhotoCanvasTest, AtItsOwnSizeAPhotoIsUnchanged) {
    draw_photo(photo.view(), place, false, canvas.view());
    EXPECT_EQ(canvas, photo);
}

TEST_F(PhotoCanvasTest, AMirrorChangesLeftAndRight) {
    draw_photo(photo.view(), place, true, canvas.view());
    for (int x = 0; x < size.width; ++x)
        EXPECT_EQ(canvas.view().row(3)[x], photo.view().row(3)[size.width - 1 - x]) << x;
}

TEST_F(PhotoCanvasTest, BesideThePhotoIsTheGround) {
    const PhotoPlace half({20, 30}, size, 0);
    draw_photo(View<const Rgb>(photo.pixels.data(), {20, 30}, 40), half, false, canvas.view());
    EXPECT_EQ(canvas.view().row(4)[5], canvas_ground);
    EXPECT_EQ(canvas.view().row(4)[12], photo.view().row(4)[2]);
}

TEST_F(PhotoCanvasTest, OnlyLandmarksThatAreThereAreDrawn) {
    face::Landmarks usual{};
    for (std::size_t i = 0; i < usual.size(); ++i)
        usual[i] = {double(i % 10), double(i / 10)};
    face::LandmarkDraft draft(usual);
    const ColorImage empty = canvas;
    draw_landmarks(draft, std::nullopt, place, 2, canvas.view());
    EXPECT_EQ(canvas, empty);
    draft.put({20, 15});
    draw_landmarks(draft, std::nullopt, place, 2, canvas.view());
    EXPECT_EQ(canvas.view().row(15)[20], landmark_color);
    EXPECT_EQ(canvas.view().row(15)[30], empty.view().row(15)[30]);
    // One that was put beyond the window costs nothing.
    draft.put({-1e6, 1e6});
    draw_landmarks(draft, std::nullopt, place, 2, canvas.view());
}

}  // namespace
}  // namespace theatron::enrol
