// SPDX-License-Identifier: Apache-2.0
#include "participant_json.h"

#include <gtest/gtest.h>

namespace theatron::app {
namespace {

TEST(AgePart, WhileThePastIsShownItIsItsAge) {
    client::ParticipantFigures figures;
    client::CameraFigures camera;
    camera.depth.age_p50_ms = 38;
    camera.depth.age_max_ms = 90;
    camera.depth.age_now_ms = 41;
    figures.cameras = {camera, camera};
    EXPECT_EQ(age_part(figures), "age 38 ms");
    EXPECT_EQ(age_of(camera.depth).max, 90);
    camera.depth.past = true;
    camera.depth.age_now_ms = 23'400;
    figures.cameras[1] = camera;
    EXPECT_EQ(age_part(figures), "NOT LIVE: 23 s ago");
    EXPECT_EQ(age_of(camera.depth).p50, 23'400);
    EXPECT_EQ(age_of(camera.depth).max, 23'400);
}

TEST(MomentsPart, TellsTheSkewAndThePicturesThatCameAlone) {
    EXPECT_EQ(moments_part({}), "") << "one camera";
    EXPECT_EQ(moments_part({.skew_p50_ms = 15.25, .skew_max_ms = 18, .whole = 90, .unpaired = 12}),
              "cameras 15 ms apart (at most 18), 12 pictures alone");
}

}  // namespace
}  // namespace theatron::app
