// SPDX-License-Identifier: Apache-2.0
#include "render/room_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "base/error.h"
#include "render/test_context.h"

namespace theatron::render {
namespace {

constexpr CameraId camera{0};
constexpr std::uint16_t wall_mm = 2000, board_mm = 1200;
constexpr Size depth_size{96, 72}, picture_size{192, 144};
constexpr double eye_distance_m = 0.063;
constexpr Rgb grey{120, 120, 120}, red{220, 20, 20};

bool is_red(Rgb c) {
    return c.r > c.g + 60 && c.r > c.b + 60;
}
bool is_blue(Rgb c) {
    return c.b > c.r + 40 && c.b > c.g + 40;
}

Calibration calibration() {
    Calibration c;
    c.depth = c.color = pinhole(depth_size, 60);
    c.registered = true;
    c.room_from_camera = {Quat{}, {0, 1.4, 0}};  // looks along +z, x right, y down
    return c;
}

// A grey wall with a board before it, and on each of them a red square.
bool on_board(int x, int y) {
    return x >= 30 && x < 66 && y >= 10 && y < 40;
}
bool in_square(int x, int y, bool board) {
    return x >= 44 && x < 52 && (board ? y >= 20 && y < 28 : y >= 52 && y < 60);
}

// The mean column of the red pixels in rows `top` to `bottom` (shares of the height).
double red_column(const ColorImage& image, int left, int right, double top, double bottom) {
    double sum = 0, count = 0;
    for (int y = int(top * image.size.height); y < int(bottom * image.size.height); ++y)
        for (int x = left; x < right; ++x)
            if (is_red(image.view().row(y)[x])) {
                sum += x - left;
                ++count;
            }
    EXPECT_GT(count, 100) << "of rows from " << top;
    return sum / count;
}

class RoomPictureTest : public ::testing::TestWithParam<std::string> {
protected:
    void SetUp() override {
        test_context();
        clouds.emplace();
        passes.emplace();
        box.emplace(make_box_mesh({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}));
        wide.emplace(make_box_mesh({-9, -9, -0.1}, {9, 9, 0}));
        clouds->set_camera(camera, calibration());
        DepthImage depth(depth_size);
        ColorImage color(depth_size);
        for (int y = 0; y < depth_size.height; ++y)
            for (int x = 0; x < depth_size.width; ++x) {
                const bool board = on_board(x, y);
                depth.view().row(y)[x] = board ? board_mm : wall_mm;
                color.view().row(y)[x] = in_square(x, y, board) ? red : grey;
            }
        ASSERT_EQ(clouds->upload(camera, depth.view(), color.view()), Status::ok);
    }
    void TearDown() override {
        box.reset();
        wide.reset();
        passes.reset();
        clouds.reset();
    }

    static CameraView own_view() {
        return view_of_camera(calibration().depth, calibration().room_from_camera, picture_size);
    }
    void add_box(Vec3 place, double opacity = 1) {
        scene.objects.push_back({&*box, {Quat{}, place}, {{0.05, 0.1, 0.9}, 0, 0.7, opacity}});
    }
    Picture draw(const std::vector<CameraView>& eyes) {
        return draw_and_read(&scene, {{&*clouds, GetParam()}}, eyes, picture_size, &*passes);
    }
    // The room place in a direction (tangents to the right and downwards) and distance (metres).
    static Vec3 seen_at(double right, double below, double away) {
        return calibration().room_from_camera * Vec3{right * away, below * away, away};
    }
    static Rgb at_place(const Picture& picture, Vec3 place) {
        const CameraView v = own_view();
        const Vec3 p = inverse(v.room_from_eye) * place;
        return picture.color.view().row(
            int((p.y / p.z - v.top) / (v.bottom - v.top) * picture_size.height))[int(
            (p.x / p.z - v.left) / (v.right - v.left) * picture_size.width)];
    }

    void expect_each_alone(const std::vector<CameraView>& eyes) {
        const Picture pair = draw(eyes);
        ASSERT_EQ(pair.color.size, (Size{2 * picture_size.width, picture_size.height}));
        for (int eye = 0; eye < 2; ++eye) {
            const Picture alone = draw({eyes[std::size_t(eye)]});
            for (int y = 0; y < picture_size.height; ++y)
                for (int x = 0; x < picture_size.width; ++x) {
                    const int there = eye * picture_size.width + x;
                    ASSERT_EQ(pair.color.view().row(y)[there], alone.color.view().row(y)[x])
                        << "eye " << eye << " at " << x << ", " << y;
                    ASSERT_EQ(pair.depth_mm.view().row(y)[there], alone.depth_mm.view().row(y)[x]);
                }
        }
    }

    std::optional<CloudSet> clouds;
    std::optional<ScenePasses> passes;
    std::optional<SceneMesh> box, wide;
    SceneFrame scene;
};

INSTANTIATE_TEST_SUITE_P(EveryRenderer, RoomPictureTest, ::testing::ValuesIn(renderer_names()),
                         [](const auto& test) { return test.param; });

TEST_P(RoomPictureTest, CloudsAndObjectsHideEachOtherByDistance) {
    const Vec3 before_board = seen_at(-0.15, -0.2, 0.9), behind_board = seen_at(0.15, -0.2, 1.6);
    const Vec3 before_wall = seen_at(0.5, 0.3, 1.6), behind_wall = seen_at(-0.5, 0.3, 2.4);
    for (const Vec3 place : {before_board, behind_board, before_wall, behind_wall})
        add_box(place);
    const Picture picture = draw({own_view()});
    EXPECT_TRUE(is_blue(at_place(picture, before_board)));
    EXPECT_FALSE(is_blue(at_place(picture, behind_board)));
    EXPECT_TRUE(is_blue(at_place(picture, before_wall)));
    EXPECT_FALSE(is_blue(at_place(picture, behind_wall)));
}

TEST_P(RoomPictureTest, ThroughATranslucentObjectTheCloudIsSeen) {
    const Vec3 before = seen_at(0.3, 0.3, 0.9);
    const Rgb without = at_place(draw({own_view()}), before);
    add_box(before, 0.5);
    add_box(seen_at(0.3, 0.3, 3), 0.5);  // hidden by the wall
    const Rgb with = at_place(draw({own_view()}), before);
    EXPECT_GT(with.b, without.b + 15);
    EXPECT_LT(with.b, 190) << "not solid";
    scene.objects.erase(scene.objects.begin());
    EXPECT_EQ(at_place(draw({own_view()}), before), without);
}

TEST_P(RoomPictureTest, ABackdropNeverHidesACloud) {
    const Picture without = draw({own_view()});
    // Nearer than all that was measured.
    scene.objects.push_back(
        {&*wide, {Quat{0, 1, 0, 0}, {0, 1.4, 0.5}}, {{0.05, 0.1, 0.9}, 0, 0.7}, true});
    const Picture with = draw({own_view()});
    for (std::size_t i = 0; i < with.color.pixels.size(); ++i) {
        if (without.depth_mm.pixels[i] != 0) {
            ASSERT_EQ(with.color.pixels[i], without.color.pixels[i]);
        }
    }
    EXPECT_EQ(with.depth_mm.pixels, without.depth_mm.pixels) << "it has no distance";
    // It is there, though: where there is no cloud.
    clouds->remove_camera(camera);
    EXPECT_TRUE(is_blue(draw({own_view()}).color.view().row(70)[90]));
}

TEST_P(RoomPictureTest, TheCloudsAreTheSameInEveryQuality) {
    add_box(seen_at(-0.15, -0.2, 0.9));
    scene.quality = SceneQuality::low;
    const Picture low = draw({own_view()});
    scene.quality = SceneQuality::high;
    const Picture high = draw({own_view()});
    EXPECT_EQ(low.depth_mm.pixels, high.depth_mm.pixels);
    int differ = 0;
    for (std::size_t i = 0; i < low.color.pixels.size(); ++i) {
        const bool cloud = low.depth_mm.pixels[i] >= board_mm - 5;
        if (cloud) {
            ASSERT_EQ(low.color.pixels[i], high.color.pixels[i]);
        }
        differ += low.color.pixels[i] != high.color.pixels[i];
    }
    EXPECT_GT(differ, 0) << "the box is lit otherwise";
}

TEST_P(RoomPictureTest, EachEyeOfAPairSeesWhatItWouldSeeAlone) {
    add_box(seen_at(-0.15, -0.2, 0.9));
    add_box(seen_at(0.15, 0.2, 0.9), 0.5);
    const auto eyes = stereo_pair(own_view(), eye_distance_m);
    const CameraView& first = eyes[0];
    CameraView second = eyes[1];
    expect_each_alone({first, second});
    // Here the first picture is full at its right edge, and the second is empty at its left.
    second.room_from_eye.translation.x -= 1;
    expect_each_alone({first, second});
}

TEST_P(RoomPictureTest, NearThingsLieFurtherApartInTheTwoEyesThanFarOnes) {
    const auto eyes = stereo_pair(own_view(), eye_distance_m);
    const ColorImage pair = draw({eyes[0], eyes[1]}).color;
    const CameraView view = own_view();
    const double pixels_per_tangent = picture_size.width / (view.right - view.left);
    const int width = picture_size.width;
    const auto disparity = [&](double top, double bottom) {
        return red_column(pair, 0, width, top, bottom) -
               red_column(pair, width, 2 * width, top, bottom);
    };
    // The left eye sees things further to the right. Points are drawn at whole pixels.
    EXPECT_NEAR(disparity(0.2, 0.5), pixels_per_tangent * eye_distance_m / 1.2, 0.8);
    EXPECT_NEAR(disparity(0.65, 0.95), pixels_per_tangent * eye_distance_m / 2.0, 0.8);
}

// A second set whose camera stands where the first one does.
void show_flat(CloudSet& set, std::uint16_t mm, Rgb color) {
    set.set_camera(camera, calibration());
    DepthImage depth(depth_size);
    std::fill(depth.pixels.begin(), depth.pixels.end(), mm);
    ColorImage picture(depth_size);
    std::fill(picture.pixels.begin(), picture.pixels.end(), color);
    ASSERT_EQ(set.upload(camera, depth.view(), picture.view()), Status::ok);
}

TEST_P(RoomPictureTest, SetsOfCloudsHideEachOtherByDistanceInEitherOrder) {
    constexpr Rgb green{20, 200, 20};
    const auto programs = std::make_shared<CloudPrograms>();
    CloudSet room(programs);
    // Between the board and the wall of the other set.
    show_flat(room, 1600, green);
    const DrawnClouds own{&*clouds, GetParam()}, between{&room, "mesh"};
    const auto picture = [&](std::vector<DrawnClouds> order) {
        return draw_and_read(nullptr, order, {own_view()}, picture_size, nullptr);
    };
    const Picture one = picture({own, between}), other = picture({between, own});
    EXPECT_EQ(one.color.view().row(50)[70], grey) << "the board hides it";
    EXPECT_EQ(one.color.view().row(120)[70], green) << "it hides the wall";
    EXPECT_EQ(one.depth_mm, other.depth_mm);
}

TEST_P(RoomPictureTest, SetsThatShareProgramsDrawAsAlone) {
    const auto programs = std::make_shared<CloudPrograms>();
    CloudSet red_set(programs), grey_set(programs), alone;
    for (int frame = 0; frame < 3; ++frame) {
        for (CloudSet* set : {&red_set, &alone})
            show_flat(*set, 1500, red);
        show_flat(grey_set, 1700, grey);
        const Picture expected = alone.render(own_view(), picture_size, GetParam());
        (void)grey_set.render(own_view(), picture_size, GetParam());
        const Picture drawn = red_set.render(own_view(), picture_size, GetParam());
        ASSERT_EQ(drawn.color, expected.color);
        ASSERT_EQ(drawn.depth_mm, expected.depth_mm);
    }
}

TEST(RoomPicture, EyesStandBesideEachOtherHoweverTheHeadIsTurned) {
    CameraView view = view_towards({1, 1.7, 2}, {0, 1, 0}, 60, {100, 100});
    const auto eyes = stereo_pair(view, 0.064);
    const Vec3 across = eyes[1].room_from_eye.translation - eyes[0].room_from_eye.translation;
    EXPECT_NEAR(length(across), 0.064, 1e-12);
    EXPECT_NEAR(dot(across, rotate(view.room_from_eye.rotation, {1, 0, 0})), 0.064, 1e-12);
    EXPECT_EQ(eyes[0].room_from_eye.rotation, view.room_from_eye.rotation);
    EXPECT_EQ(eyes[1].left, view.left);
}

TEST(RoomPicture, AnUnknownRendererIsNamed) {
    test_context();
    CloudSet clouds;
    EXPECT_THROW(draw({nullptr, {{&clouds, "fog"}}, {}}, nullptr), Error);
}

}  // namespace
}  // namespace theatron::render
