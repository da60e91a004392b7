// SPDX-License-Identifier: Apache-2.0
#include "host/place_watch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <mutex>

#include "geometry/ray_table.h"
#include "geometry/screen.h"
#include "testing/wait_until.h"

namespace theatron::host {
namespace {

capture::CameraInfo camera_in_the_room() {
    capture::CameraInfo info;
    info.name = "left";
    Calibration& c = info.calibration;
    c.depth = {{320, 288}, 252, 252, 159.5, 143.5, {}, {}};
    c.registered = true;
    c.room_from_camera = look_at({0, 1.5, 2}, {0, 1.5, 0}, {0, 1, 0});
    return info;
}

// A floor, a wall and a box, by a camera that is `forward_m` before its place.
FramePtr frame_of(const CameraModel& lens, double forward_m, TimePoint captured) {
    auto frame = std::make_shared<Frame>();
    frame->times.captured = captured;
    frame->depth.resize(lens.size);
    const Image<Ray> rays = make_ray_table(lens);
    const double box_m = 2 - forward_m;
    for (std::size_t i = 0; i < rays.pixels.size(); ++i) {
        const Ray ray = rays.pixels[i];
        double z = 3 - forward_m;
        if (ray.y > 0)
            z = std::min(z, 1.5 / ray.y);
        if (std::abs(box_m * ray.x) < 0.4 && box_m * ray.y > 0.2)
            z = std::min(z, box_m);
        frame->depth.pixels[i] = std::uint16_t(std::lround(z * 1000));
    }
    return frame;
}

TEST(PlaceWatch, LeavesScreensAlone) {
    capture::CameraInfo screen;
    screen.calibration = screen_calibration({1280, 720}, 1.2, usual_screen_place);
    const PlaceWatch watch({camera_in_the_room(), screen}, [](CameraId, const wire::Text&) {});
    EXPECT_TRUE(watch.figures().cameras[0].has_place);
    EXPECT_FALSE(watch.figures().cameras[1].has_place);
}

TEST(PlaceWatch, TellsTheSizeOfAMotionAgainOnceItHasDoubled) {
    const capture::CameraInfo camera = camera_in_the_room();
    std::mutex mutex;
    std::vector<wire::Text> told;
    PlaceWatch watch({camera}, [&](CameraId, const wire::Text& problem) {
        const std::lock_guard lock(mutex);
        told.push_back(problem);
    });
    const auto told_now = [&] {
        const std::lock_guard lock(mutex);
        return told;
    };
    TimePoint captured = from_us(100'000'000);
    const auto offer_until = [&](double forward_m, const std::function<bool()>& is_enough) {
        for (int i = 0; i < 60 && !is_enough(); ++i) {
            FramePtr frame = frame_of(camera.calibration.depth, forward_m, captured);
            const std::weak_ptr<const Frame> offered = frame;
            watch.offer(0, frame);
            frame.reset();
            captured += std::chrono::milliseconds(500);
            // The watch lets go of a picture once it has looked at it.
            testing::wait_until([&] { return offered.expired(); });
        }
        return is_enough();
    };
    ASSERT_TRUE(offer_until(0, [&] { return watch.figures().cameras[0].is_watched; }));
    ASSERT_TRUE(offer_until(0.005, [&] { return told_now().size() == 1; }));
    EXPECT_EQ(told_now()[0].code, wire::TextCode::camera_moved);
    const double first_mm = std::stod(told_now()[0].arguments.at(0));
    EXPECT_NEAR(first_mm, 5, 1.5);
    ASSERT_TRUE(offer_until(0.016, [&] { return told_now().size() == 2; }));
    EXPECT_EQ(told_now()[1].code, wire::TextCode::camera_moved);
    EXPECT_NEAR(std::stod(told_now()[1].arguments.at(0)), 16, 2);
    ASSERT_TRUE(offer_until(0, [&] { return told_now().back().empty(); }));
    EXPECT_EQ(told_now().size(), 3u);
}

}  // namespace
}  // namespace theatron::host
