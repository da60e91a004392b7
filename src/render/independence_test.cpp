// SPDX-License-Identifier: Apache-2.0
// The picture of one camera depends on no other one: neither on their sizes nor on their coming
// and going. It does not depend either on how often the camera itself was moved.
#include <gtest/gtest.h>

#include <memory>
#include <random>

#include "geometry/camera_model.h"
#include "render/cloud_camera.h"
#include "render/cloud_set.h"
#include "render/test_context.h"

namespace theatron::render {
namespace {

constexpr CameraId shown{3}, other{1};

// A slope with a board in front of it, which reaches the image's lower and right border.
DepthImage noisy_depth(Size size, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> noise(0, 3);
    DepthImage depth(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const bool board = x > size.width / 2 && y > size.height / 2;
            depth.view().row(y)[x] =
                std::uint16_t(std::lround((board ? 1200 : 1900 + 2 * x) + noise(random)));
        }
    return depth;
}

ColorImage noisy_color(Size size, unsigned seed) {
    std::mt19937 random(seed);
    ColorImage color(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            color.view().row(y)[x] = {std::uint8_t(60 + x + random() % 8),
                                      std::uint8_t(90 + y + random() % 8), 128};
    return color;
}

// A colour camera beside the depth camera, with pictures of another form.
Calibration calibrated(Size depth, Size color, Vec3 place) {
    Calibration calibration;
    calibration.depth = pinhole(depth, 60);
    calibration.color = pinhole(color, 70);
    calibration.color_from_depth.translation = {-0.03, 0, 0};
    calibration.registered = true;
    calibration.room_from_camera.translation = place;
    return calibration;
}

class IndependenceTest : public ::testing::TestWithParam<std::string> {
protected:
    void SetUp() override { test_context(); }

    static void upload(CloudSet& scene, CameraId id, const Calibration& calibration,
                       unsigned frame) {
        scene.set_camera(id, calibration);
        ASSERT_EQ(scene.upload(id, noisy_depth(calibration.depth.size, frame).view(),
                               noisy_color(calibration.color.size, frame).view()),
                  Status::ok);
    }
    static Picture render(CloudSet& scene) {
        const Calibration camera = calibrated({97, 71}, {122, 63}, {0, 1.5, 0});
        const CameraView view =
            orbited(view_of_camera(camera.depth, camera.room_from_camera, {120, 90}),
                    camera.room_from_camera * Vec3{0, 0, 1.5}, 25, 10);
        return scene.render(view, {120, 90}, GetParam());
    }

    // Neither width nor height of one is a multiple of the other's.
    const Calibration camera = calibrated({97, 71}, {122, 63}, {0, 1.5, 0});
    const Calibration larger = calibrated({160, 93}, {90, 130}, {500, 1.5, 0});
};

INSTANTIATE_TEST_SUITE_P(EveryRenderer, IndependenceTest, ::testing::ValuesIn(renderer_names()),
                         [](const auto& test) { return test.param; });

TEST_P(IndependenceTest, ACameraLooksTheSameBesideALargerOne) {
    CloudSet alone, together;
    upload(alone, shown, camera, 1);
    upload(together, other, larger, 2);
    upload(together, shown, camera, 1);
    const Picture expected = render(alone), drawn = render(together);
    EXPECT_EQ(drawn.color, expected.color);
    EXPECT_EQ(drawn.depth_mm, expected.depth_mm);
}

TEST_P(IndependenceTest, WhoComesOrGoesDoesNotDisturbTheOthersOverTime) {
    CloudSet alone, together;
    for (unsigned frame = 0; frame < 8; ++frame) {
        upload(alone, shown, camera, frame);
        upload(together, shown, camera, frame);
        if (frame == 3)
            upload(together, other, larger, 1);
        if (frame == 6)
            together.remove_camera(other);
        ASSERT_EQ(render(together).color, render(alone).color) << "frame " << frame;
    }
}

TEST_P(IndependenceTest, MovingACameraIsNoNewFrame) {
    CloudSet still, moved;
    for (CloudSet* scene : {&still, &moved})
        for (unsigned frame = 0; frame < 3; ++frame) {
            upload(*scene, shown, camera, frame);
            (void)render(*scene);
        }
    for (int step = 1; step <= 5; ++step) {
        Calibration elsewhere = camera;
        elsewhere.room_from_camera.translation.x += 0.05 * step;
        moved.set_camera(shown, elsewhere);
        EXPECT_NE(render(moved).depth_mm, render(still).depth_mm);
    }
    moved.set_camera(shown, camera);
    EXPECT_EQ(render(moved).color, render(still).color);
    EXPECT_EQ(render(moved).depth_mm, render(still).depth_mm);
}

TEST_P(IndependenceTest, ANewCameraHasNoMemoryOfOneThatWent) {
    CloudSet fresh, reused;
    for (unsigned frame = 0; frame < 4; ++frame) {
        Calibration before = camera;
        before.depth_unit_mm = 1.03;
        upload(reused, other, before, 100 + frame);
        (void)render(reused);
    }
    reused.remove_camera(other);
    upload(reused, shown, camera, 1);
    upload(fresh, shown, camera, 1);
    EXPECT_EQ(render(reused).color, render(fresh).color);
    EXPECT_EQ(render(reused).depth_mm, render(fresh).depth_mm);
}

TEST_P(IndependenceTest, ANewLensStartsAnewAndStaysAsPresent) {
    CloudSet fresh, changed;
    Calibration before = camera;
    before.depth = pinhole(camera.depth.size, 50);
    for (unsigned frame = 0; frame < 4; ++frame) {
        upload(changed, shown, before, 100 + frame);
        changed.set_presence(shown, 0.4);
        (void)render(changed);
    }
    upload(changed, shown, camera, 1);
    upload(fresh, shown, camera, 1);
    fresh.set_presence(shown, 0.4);
    EXPECT_EQ(render(changed).color, render(fresh).color);
    EXPECT_EQ(render(changed).depth_mm, render(fresh).depth_mm);
}

TEST(CloudCamera, KnowsWhatANewCalibrationChanges) {
    test_context();
    const Calibration calibration = calibrated({20, 10}, {30, 20}, {0, 1.5, 0});
    CloudCamera camera(calibration, nullptr);
    const Buffer staging;
    ASSERT_EQ(camera.upload(DepthImage({20, 10}).view(), {}, staging), Status::ok);
    const unsigned images = camera.images(), content = camera.content();

    Calibration changed = calibration;
    changed.room_from_camera.translation.x = 2;
    changed.registered = false;
    camera.set_calibration(changed);
    EXPECT_EQ(camera.content(), content) << "only the place";
    changed.color_gain = {1.2, 1, 0.9};
    camera.set_calibration(changed);
    EXPECT_EQ(camera.content(), content) << "gains are factors of the last pass";

    changed.color.k[0] = 0.1;
    camera.set_calibration(changed);
    EXPECT_NE(camera.content(), content) << "places in the colour picture";
    EXPECT_EQ(camera.images(), images);
}

TEST(CloudCamera, MovesToNewGainsWithItsImages) {
    test_context();
    const Calibration calibration = calibrated({20, 10}, {30, 20}, {0, 1.5, 0});
    CloudCamera camera(calibration, nullptr);
    const Buffer staging;
    const DepthImage depth({20, 10});
    const auto upload = [&] { ASSERT_EQ(camera.upload(depth.view(), {}, staging), Status::ok); };
    Calibration known = calibration;
    known.color_gain = {1.2, 1, 0.9};
    camera.set_calibration(known);
    upload();
    EXPECT_EQ(camera.color_gain, *known.color_gain) << "the first image";

    known.color_gain = {1.4, 1, 0.9};
    camera.set_calibration(known);
    EXPECT_EQ(camera.color_gain.x, 1.2);
    upload();
    EXPECT_GT(camera.color_gain.x, 1.2);
    EXPECT_LT(camera.color_gain.x, 1.22) << "no jump";
    for (int i = 0; i < 90; ++i)
        upload();
    EXPECT_NEAR(camera.color_gain.x, 1.4, 0.002);

    camera.set_calibration(calibration);
    camera.color_gain = {0.8, 1, 1};
    upload();
    EXPECT_EQ(camera.color_gain, (Vec3{0.8, 1, 1})) << "the viewer's own";
}

TEST(CloudCamera, SettingsOutliveALens) {
    test_context();
    CloudCamera before(calibrated({20, 10}, {30, 20}, {0, 1.5, 0}), nullptr);
    before.presence = 0.5;
    before.color_gain = {1.1, 1, 0.9};
    before.depth_offset_m = 0.004;
    before.cut.keep = {{1, 2, 3}, 0.5};
    CloudCamera after(calibrated({40, 30}, {30, 20}, {0, 1.5, 0}), nullptr);
    after.take_settings(before);
    EXPECT_EQ(after.presence, 0.5);
    EXPECT_EQ(after.color_gain, (Vec3{1.1, 1, 0.9}));
    EXPECT_EQ(after.depth_offset_m, 0.004);
    EXPECT_EQ(after.cut, before.cut);
}

}  // namespace
}  // namespace theatron::render
