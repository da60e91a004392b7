// SPDX-License-Identifier: Apache-2.0
#include "viewer/head_text.h"

#include <gtest/gtest.h>

#include "image/image.h"

namespace theatron::viewer {
namespace {

TEST(SeenPeople, ACameraThatSeesNothingOfThePersonIsNamed) {
    Calibration calibration;
    calibration.depth = pinhole({80, 60}, 70);
    calibration.room_from_camera = look_at({0, 1.5, 2}, {0, 1.5, 0}, {0, 1, 0});
    DepthImage depth(calibration.depth.size);
    const SeenPerson person = parse_seen_person("left=0:1.65:-0.5", Seen::other);
    EXPECT_NE(nothing_seen(person, calibration, depth.view()), "") << "nothing is measured";
    depth.pixels.assign(depth.size.area(), 2400);
    EXPECT_EQ(nothing_seen(person, calibration, depth.view()), "");
    depth.pixels.assign(depth.size.area(), 4400);
    EXPECT_EQ(nothing_seen(person, calibration, depth.view()),
              "Camera left sees nothing within 1.1 m of the person with the head at "
              "0.00:1.65:-0.50, so nothing of it is drawn; the camera stands at 0.00:1.50:2.00.");
}

}  // namespace
}  // namespace theatron::viewer
