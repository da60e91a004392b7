// SPDX-License-Identifier: Apache-2.0
#include "viewer/eye.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace theatron::viewer {
namespace {

using namespace std::chrono_literals;

constexpr Size picture{640, 360};

struct TwoCameras {
    std::map<CameraId, Calibration> calibrations;
    std::map<CameraId, receive::CameraFramePtr> newest;

    TwoCameras() {
        for (const int number : {0, 1}) {
            Calibration calibration;
            calibration.depth = pinhole({64, 48}, 65);
            calibration.room_from_camera.translation = Vec3{double(number), 1.5, 0};
            calibrations[CameraId(number)] = calibration;
        }
    }
    void send(int number) {
        auto frame = std::make_shared<receive::CameraFrame>();
        frame->camera = CameraId(number);
        frame->depth = DepthImage({64, 48});
        newest[frame->camera] = frame;
    }
    operator ViewableCameras() const { return {calibrations, newest}; }
};

double x_of(const Eye& eye) {
    return eye.view(picture).room_from_eye.translation.x;
}

TEST(Eye, WaitsForItsCameraAndThenTakesTheOneThatSends) {
    TwoCameras cameras;
    Eye eye({CameraId{1}, 0, 0});
    EXPECT_FALSE(eye.follow(cameras, true, picture, TimePoint(1s)));
    cameras.send(0);
    EXPECT_FALSE(eye.follow(cameras, true, picture, TimePoint(1s)));
    EXPECT_FALSE(eye.follow(cameras, true, picture, TimePoint(1s) + Eye::camera_patience - 1ms));
    EXPECT_FALSE(eye.is_placed());
    EXPECT_TRUE(eye.follow(cameras, true, picture, TimePoint(1s) + Eye::camera_patience));
    EXPECT_EQ(x_of(eye), 0);
}

TEST(Eye, FollowsItsCameraUntilThePersonMoves) {
    TwoCameras cameras;
    cameras.send(1);
    Eye eye({CameraId{1}, 0, 0});
    EXPECT_TRUE(eye.follow(cameras, true, picture, TimePoint(1s)));
    EXPECT_EQ(x_of(eye), 1);
    cameras.calibrations[CameraId{1}].room_from_camera.translation.x = 3;
    EXPECT_TRUE(eye.follow(cameras, true, picture, TimePoint(2s)));
    EXPECT_EQ(x_of(eye), 3);

    window::Steering steering;
    steering.turn = {0.1, 0};
    EXPECT_TRUE(eye.steer(steering, picture, TimePoint(3s)));
    const double moved_to = x_of(eye);
    EXPECT_NE(moved_to, 3);
    cameras.calibrations[CameraId{1}].room_from_camera.translation.x = 5;
    EXPECT_FALSE(eye.follow(cameras, true, picture, TimePoint(4s)));
    EXPECT_EQ(x_of(eye), moved_to);
    eye.go_home(eye.home(), cameras, picture);
    EXPECT_EQ(x_of(eye), 5);
}

TEST(Eye, FliesOnlyWhileKeysAreHeld) {
    TwoCameras cameras;
    cameras.send(0);
    Eye eye({CameraId{0}, 0, 0});
    eye.follow(cameras, true, picture, TimePoint(1s));
    window::Steering forward;
    forward.fly = {0, 0, 1};
    // The time before the key was pressed does not count.
    EXPECT_TRUE(eye.steer(forward, picture, TimePoint(100s)));
    EXPECT_EQ(eye.view(picture).room_from_eye.translation.z, 0);
    EXPECT_TRUE(eye.steer(forward, picture, TimePoint(100s + 50ms)));
    const double flown = eye.view(picture).room_from_eye.translation.z;
    EXPECT_LT(flown, 0);
    EXPECT_FALSE(eye.steer({}, picture, TimePoint(101s)));
    EXPECT_EQ(eye.view(picture).room_from_eye.translation.z, flown);
}

TEST(Eye, StandsWithoutCamerasUntilOneSends) {
    const Pose place{{}, {0, 1.6, 2}};
    for (const bool has_moved : {false, true}) {
        TwoCameras cameras;
        Eye eye({CameraId{1}, 0, 0});
        eye.stand(place);
        ASSERT_TRUE(eye.is_placed());
        EXPECT_EQ(eye.view(picture).room_from_eye, place);
        if (has_moved)
            eye.go_to({{}, {0, 1.6, 3}});
        cameras.send(1);
        EXPECT_NE(eye.follow(cameras, false, picture, TimePoint(1s)), has_moved);
        EXPECT_EQ(x_of(eye), has_moved ? 0 : 1);
    }
}

TEST(Eye, NamesACameraThatDoesNotExist) {
    TwoCameras cameras;
    cameras.send(0);
    Eye first_time({CameraId{7}, 0, 0});
    EXPECT_THROW(first_time.follow(cameras, true, picture, TimePoint(1s)), Error);
    Eye host_came_back({CameraId{7}, 0, 0});
    EXPECT_FALSE(host_came_back.follow(cameras, false, picture, TimePoint(1s)));
}

}  // namespace
}  // namespace theatron::viewer
