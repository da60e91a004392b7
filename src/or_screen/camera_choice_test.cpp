// SPDX-License-Identifier: Apache-2.0
#include "or_screen/camera_choice.h"

#include <gtest/gtest.h>

#include "image/image.h"

namespace theatron::or_screen {
namespace {

constexpr CameraId a{0}, b{1};

TimePoint at(double seconds) {
    return TimePoint(std::chrono::hours(1)) + seconds_to_duration(seconds);
}

std::vector<CameraScore> scores(double of_a, double of_b, bool a_live = true, bool b_live = true) {
    return {{a, a_live, of_a}, {b, b_live, of_b}};
}

// A camera that looks down at the floor from this height; everything is measured.
struct DownwardCamera {
    explicit DownwardCamera(double height) : depth(Size{64, 48}) {
        calibration.depth = pinhole(depth.size, 70);
        calibration.color = pinhole({640, 480}, 70);
        calibration.room_from_camera = look_at({0, height, 0}, {0, 0, 0}, {0, 0, -1});
        std::fill(depth.pixels.begin(), depth.pixels.end(), std::uint16_t(height * 1000));
    }
    double score(const std::vector<Vec3>& places) const {
        return score_of(calibration, depth.view(), places);
    }
    DepthImage depth;
    Calibration calibration;
};

TEST(CameraScore, NearerCamerasAndTheMiddleOfAPictureAreBetter) {
    const DownwardCamera near(1), far(2);
    EXPECT_GT(near.score({{0, 0, 0}}), 1.9 * far.score({{0, 0, 0}}));
    EXPECT_GT(far.score({{0, 0, 0}}), far.score({{1, 0, 0}}));
}

TEST(CameraScore, HiddenPlacesAndThoseBesideThePictureCountForNothing) {
    const DownwardCamera camera(2);
    EXPECT_EQ(camera.score({{0, -0.5, 0}}), 0);
    EXPECT_EQ(camera.score({{9, 0, 0}}), 0);
    EXPECT_EQ(camera.score({}), 0);
    EXPECT_DOUBLE_EQ(camera.score({{0, 0, 0}, {9, 0, 0}}), camera.score({{0, 0, 0}}) / 2);
}

TEST(CameraChoice, BeginsWithTheBestLiveCamera) {
    EXPECT_EQ(CameraChoice().choose(scores(1, 2), at(0)), b);
    EXPECT_EQ(CameraChoice().choose(scores(1, 2, true, false), at(0)), a);
    EXPECT_EQ(CameraChoice().choose(scores(1, 2, false, false), at(0)), b);
    EXPECT_EQ(CameraChoice().choose(scores(0, 0), at(0)), a);
    EXPECT_EQ(CameraChoice().choose({}, at(0)), std::nullopt);
}

TEST(CameraChoice, DoesNotChangeForALittleOrForAMoment) {
    CameraChoice choice;
    choice.choose(scores(1, 0.9), at(0));
    for (int i = 0; i < 600; ++i)
        ASSERT_EQ(choice.choose(scores(1, 1.3), at(i * 0.1)), a);
    // Much better, but only for a second out of two.
    for (int i = 600; i < 1200; ++i)
        ASSERT_EQ(choice.choose(scores(1, i / 10 % 2 == 0 ? 3 : 0.5), at(i * 0.1)), a);
}

TEST(CameraChoice, ChangesWhenAnotherIsMuchBetterForAWhile) {
    CameraChoice choice;
    choice.choose(scores(1, 0.5), at(0));
    choice.choose(scores(1, 0.5), at(10));
    EXPECT_EQ(choice.choose(scores(1, 2), at(20)), a);
    EXPECT_EQ(choice.choose(scores(1, 2), at(21.9)), a);
    EXPECT_EQ(choice.choose(scores(1, 2), at(22)), b);
    // And stays there for a while, whatever happens.
    EXPECT_EQ(choice.choose(scores(9, 2), at(22.1)), b);
    EXPECT_EQ(choice.choose(scores(9, 2), at(27.9)), b);
    EXPECT_EQ(choice.choose(scores(9, 2), at(28.1)), a);
}

TEST(CameraChoice, LeavesACameraThatSeesNothingOfItSooner) {
    CameraChoice choice;
    choice.choose(scores(1, 0.5), at(0));
    choice.choose(scores(0, 0.5), at(10));
    EXPECT_EQ(choice.choose(scores(0, 0.5), at(10.9)), a);
    EXPECT_EQ(choice.choose(scores(0, 0.5), at(11)), b);
}

TEST(CameraChoice, LeavesACameraThatIsGoneOrStaleAtOnce) {
    CameraChoice choice;
    choice.choose(scores(2, 1), at(0));
    EXPECT_EQ(choice.choose(scores(2, 1, false, true), at(0.1)), b);
    EXPECT_EQ(choice.choose({{a, true, 1}}, at(0.2)), a);
    // A stale one stays where there is no other.
    EXPECT_EQ(choice.choose({{a, false, 1}}, at(0.3)), a);
}

}  // namespace
}  // namespace theatron::or_screen
