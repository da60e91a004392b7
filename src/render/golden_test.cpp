// SPDX-License-Identifier: Apache-2.0
// Small pictures of every renderer.
#include <gtest/gtest.h>

#include "render/ball_scene.h"
#include "render/cloud_set.h"
#include "render/test_context.h"
#include "testing/golden_picture.h"

namespace theatron::render {
namespace {

constexpr Size picture_size = golden_picture_size;

class GoldenTest : public ::testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(EveryRenderer, GoldenTest, ::testing::ValuesIn(renderer_names()),
                         [](const auto& test) { return test.param; });

TEST_P(GoldenTest, DrawsThePictureThatWasLookedAt) {
    test_context();
    CloudSet scene;
    show_golden_scene(scene);
    theatron::testing::expect_golden(scene.render(golden_view(), picture_size, GetParam()).color,
                                     "tests/golden/render_" + GetParam() + ".ppm");
}

TEST_P(GoldenTest, DrawsSensorsOfDifferentKindsTogether) {
    test_context();
    CloudSet scene;
    show_mixed_golden_scene(scene);
    theatron::testing::expect_golden(scene.render(golden_view(), picture_size, GetParam()).color,
                                     "tests/golden/render_mixed_" + GetParam() + ".ppm");
}

}  // namespace
}  // namespace theatron::render
