// SPDX-License-Identifier: Apache-2.0
#include "viewer/trust_panel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace theatron::viewer {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

client::CameraFigures camera(const std::string& name) {
    client::CameraFigures one;
    one.camera.description.name = name;
    one.camera.state.filter = "flying,temporal=4";
    one.depth.frames = 100;
    one.depth.has_come = one.color.has_come = true;
    one.depth.frames_per_second = 29.7;
    one.depth.mbit_per_second = 10;
    one.depth.age_now_ms = 84.6;
    one.depth.codec = "strata";
    one.depth.exact = receive::Exactness::everywhere;
    one.depth.dropped = 3;
    one.color.frames = 90;
    one.color.age_now_ms = 60;
    one.color.codec = "jpeg:quality=85";
    return one;
}

window::PanelRow row_of(const client::CameraFigures& one) {
    return trust_panel({{}, {one}},
                       [](const std::string& filter) {
                           return filter.empty() ? std::string("unfiltered") : "named " + filter;
                       })
        .rows.at(0);
}

TEST(TrustPanel, TellsAgeLossCodecsAndFilters) {
    const window::PanelRow row = row_of(camera("left"));
    EXPECT_EQ(row.text, "left: 85 ms");
    EXPECT_EQ(row.detail,
              "30 fps, 10.0 Mbit/s, 3 left out\n"
              "depth strata, lossless after filters; filters: named flying,temporal=4\n"
              "colour jpeg:quality=85");
}

TEST(TrustPanel, TheOlderOneOfDepthAndColourCounts) {
    client::CameraFigures one = camera("left");
    one.color.age_now_ms = 700;
    EXPECT_EQ(row_of(one).text, "left: 700 ms");
    one.color.has_come = false;
    EXPECT_EQ(row_of(one).text, "left: 85 ms");
}

TEST(TrustPanel, LosslessAloneMeansWhatTheSensorGave) {
    client::CameraFigures one = camera("left");
    one.camera.state.filter.clear();
    EXPECT_EQ(exactness_text(one), "lossless");
    one.depth.exact = receive::Exactness::region;
    EXPECT_EQ(exactness_text(one), "lossless in the region of interest only");
    one.depth.exact = receive::Exactness::nowhere;
    EXPECT_EQ(exactness_text(one), "lossy");
}

TEST(TrustPanel, ACameraThatIsNotLiveIsNamedPlainly) {
    client::CameraFigures stale = camera("right");
    stale.camera.state.condition = wire::CameraCondition::stale;
    stale.camera.state.problem = {wire::TextCode::no_pictures_come};
    stale.depth.age_now_ms = 12'400;
    EXPECT_EQ(row_of(stale).text, "right: NOT LIVE: 12 s old");
    EXPECT_THAT(row_of(stale).detail, HasSubstr("do not arrive"));
    EXPECT_EQ(not_live_text({{}, {camera("left"), stale}}), "Camera right is NOT LIVE: 12 s old");
    EXPECT_EQ(not_live_text({{}, {camera("left")}}), "");
    // One that has never sent a picture shows nothing that could be taken for live.
    stale.depth.has_come = false;
    EXPECT_EQ(not_live_text({{}, {stale}}), "");
    EXPECT_EQ(row_of(stale).text, "right: no picture yet");
}

}  // namespace
}  // namespace theatron::viewer
