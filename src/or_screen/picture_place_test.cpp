// SPDX-License-Identifier: Apache-2.0
#include "or_screen/picture_place.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "image/image.h"
#include "viewer/cloud_pick.h"

namespace theatron::or_screen {
namespace {

// The truth: a floor at height 0, and a ball on it. Distances along rays, in metres.
constexpr Vec3 ball{0.1, 0.3, 0};
constexpr double ball_radius = 0.3;

std::optional<double> meets(Vec3 from, Vec3 direction) {
    std::optional<double> nearest;
    if (direction.y < -1e-9)
        nearest = -from.y / direction.y;
    const Vec3 to = from - ball;
    const double b = dot(to, direction), c = dot(to, to) - ball_radius * ball_radius;
    if (const double root = b * b - c; root >= 0)
        if (const double t = -b - std::sqrt(root); t > 0 && t < nearest.value_or(1e9))
            nearest = t;
    return nearest;
}

// A camera like an Azure Kinect: lenses with distortion, the colour lens 32 mm beside the other and
// turned by 2 degrees.
struct TrueCamera {
    TrueCamera(Vec3 eye, Vec3 target) : depth(Size{320, 288}) {
        calibration.depth = pinhole(depth.size, 65);
        calibration.depth.k = {0.1, -0.05, 0, 0, 0, 0};
        calibration.color = pinhole({1280, 720}, 80);
        calibration.color.k = {0.08, -0.06, 0, 0, 0, 0};
        calibration.depth.max_radius = calibration.color.max_radius = 1.2;
        calibration.color_from_depth = {rotation_about({1, 0.2, 0}, radians_of(2)),
                                        {-0.032, -0.002, 0.004}};
        calibration.room_from_camera = look_at(eye, target, {0, 1, 0});
        calibration.registered = true;
        for (int y = 0; y < depth.size.height; ++y)
            for (int x = 0; x < depth.size.width; ++x)
                depth.view().row(y)[x] = measured(x, y);
    }
    std::uint16_t measured(int x, int y) const {
        const auto ray = unproject(calibration.depth, {double(x), double(y)});
        if (!ray)
            return 0;
        const Vec3 direction = normalized(Vec3{ray->x, ray->y, 1});
        const Pose& pose = calibration.room_from_camera;
        const auto t = meets(pose.translation, rotate(pose.rotation, direction));
        return t ? std::uint16_t(std::lround(*t * direction.z * 1000)) : std::uint16_t(0);
    }
    PicturePlace look(Vec3 place) const {
        return place_in_picture(calibration, depth.view(), place);
    }
    // Without any picture: how far before a place on a surface the line from the colour lens meets
    // another one.
    double truly_before(Vec3 place) const {
        const Pose room_from_color =
            calibration.room_from_camera * inverse(calibration.color_from_depth);
        const Vec3 line = place - room_from_color.translation;
        return length(line) - *meets(room_from_color.translation, normalized(line));
    }

    DepthImage depth;
    Calibration calibration;
};

Vec3 on_ball(double around, double up) {
    return ball +
           Vec3{std::cos(up) * std::sin(around), std::sin(up), std::cos(up) * std::cos(around)} *
               ball_radius;
}

TEST(PicturePlace, APointerShowsWithinFivePixelsOfWhereItsRayMeetsTheCloud) {
    const TrueCamera left({-1, 1.8, 1.6}, {0, 0.3, 0}), right({1.3, 1.6, 1.2}, {0, 0.3, 0});
    const std::vector<viewer::CloudCamera> cloud{{0, &left.calibration, left.depth.view()},
                                                 {1, &right.calibration, right.depth.view()}};
    int compared = 0, judged = 0, wrong_sight = 0;
    double worst = 0;
    // Experts point from around the table at places on the ball and on the floor.
    for (int expert = 0; expert < 8; ++expert)
        for (int target = 0; target < 40; ++target) {
            const double around = expert * 0.8 - 2.8;
            const Vec3 from{1.2 * std::sin(around), 1.4, 1.2 * std::cos(around)};
            const Vec3 to{-0.5 + 0.14 * (target % 8), 0.1 * (target % 3),
                          -0.4 + 0.2 * (target / 8)};
            const Vec3 direction = normalized(to - from);
            const auto t = meets(from, direction);
            const auto met = viewer::pick_cloud(cloud, {from, direction});
            if (!t || !met || std::abs(met->distance_m - *t) > 0.03)
                continue;  // no camera measured that place
            const Vec3 truth = from + direction * *t;
            for (const TrueCamera* camera : {&left, &right}) {
                const PicturePlace shown = camera->look(met->place), wanted = camera->look(truth);
                if (shown.sight == Sight::outside || wanted.sight == Sight::outside)
                    continue;
                ++compared;
                worst = std::max(worst, std::hypot(shown.pixel.x - wanted.pixel.x,
                                                   shown.pixel.y - wanted.pixel.y));
                const double before = camera->truly_before(truth);
                if (before < 0.001 || before > 0.1) {
                    ++judged;
                    wrong_sight += (shown.sight == Sight::visible) != (before < 0.001);
                }
            }
        }
    EXPECT_GT(compared, 300);
    EXPECT_LT(worst, 5);
    // Places at the very outline of the ball may go either way.
    EXPECT_GT(judged, 300);
    EXPECT_LE(wrong_sight, judged / 100);
    RecordProperty("worst_pixels", std::to_string(worst));
    RecordProperty("compared", compared);
    RecordProperty("wrong_sight", wrong_sight);
}

TEST(PicturePlace, ThePixelIsThatOfTheColourLens) {
    const TrueCamera camera({0, 1.5, 2}, {0, 0.3, 0});
    const Vec3 in_color = camera.calibration.color_from_depth *
                          (inverse(camera.calibration.room_from_camera) * on_ball(0.3, 0.5));
    const auto pixel = project(camera.calibration.color, in_color);
    const PicturePlace place = camera.look(on_ball(0.3, 0.5));
    EXPECT_EQ(place.sight, Sight::visible);
    EXPECT_DOUBLE_EQ(place.pixel.x, pixel->x);
    EXPECT_DOUBLE_EQ(place.pixel.y, pixel->y);
}

TEST(PicturePlace, ThatBehindTheBallIsHidden) {
    const TrueCamera camera({0, 1.5, 2}, {0, 0.3, 0});
    EXPECT_EQ(camera.look(on_ball(3.1, 0)).sight, Sight::hidden);
    EXPECT_EQ(camera.look({0.1, 0, -0.2}).sight, Sight::hidden);
    EXPECT_EQ(camera.look({0.8, 0, 0}).sight, Sight::visible);
}

TEST(PicturePlace, APlaceInTheAirBeforeASurfaceIsVisible) {
    const TrueCamera camera({0, 1.5, 2}, {0, 0.3, 0});
    EXPECT_EQ(camera.look({0.1, 0.75, 0.5}).sight, Sight::visible);
}

TEST(PicturePlace, PlacesBesideThePictureAndBehindTheCameraAreOutside) {
    const TrueCamera camera({0, 1.5, 2}, {0, 0.3, 0});
    EXPECT_EQ(camera.look({5, 0, 0}).sight, Sight::outside);
    EXPECT_EQ(camera.look({0, 2.5, 4}).sight, Sight::outside);
}

TEST(PicturePlace, WithoutAMeasurementNothingIsSaidAboutWhatIsBeforeIt) {
    TrueCamera camera({0, 1.5, 2}, {0, 0.3, 0});
    std::fill(camera.depth.pixels.begin(), camera.depth.pixels.end(), std::uint16_t(0));
    EXPECT_EQ(camera.look(on_ball(0.3, 0.5)).sight, Sight::unmeasured);
    EXPECT_EQ(place_in_picture(camera.calibration, {}, on_ball(0.3, 0.5)).sight, Sight::unmeasured);
}

TEST(PicturePlace, ACameraWithoutColourShowsNothing) {
    TrueCamera camera({0, 1.5, 2}, {0, 0.3, 0});
    camera.calibration.color = {};
    EXPECT_EQ(camera.look(on_ball(0.3, 0.5)).sight, Sight::outside);
}

}  // namespace
}  // namespace theatron::or_screen
