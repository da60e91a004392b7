// SPDX-License-Identifier: Apache-2.0
#include "render/vignette.h"

#include <gtest/gtest.h>

#include "render/render_target.h"
#include "render/test_context.h"

namespace theatron::render {
namespace {

TEST(VignetteTest, TheMiddleStaysAndTheSidesOfOneEyeAreDark) {
    (void)test_context();
    constexpr Size eye{64, 64};
    const RenderTarget target({2 * eye.width, eye.height});
    target.clear({200, 100, 50});
    Vignette vignette;
    CameraView view;  // 45 degrees to each side
    vignette.draw(view, {target.target().framebuffer, eye.width, 0, eye}, 1);
    const Picture picture = target.read();
    const auto at = [&](int x, int y) { return picture.color.view().row(y)[x]; };
    EXPECT_EQ(at(eye.width + 32, 32), (Rgb{200, 100, 50}));
    EXPECT_EQ(at(eye.width + 1, 32), (Rgb{0, 0, 0}));
    EXPECT_EQ(at(eye.width + 32, 62), (Rgb{0, 0, 0}));
    EXPECT_EQ(at(1, 32), (Rgb{200, 100, 50}));  // of the other eye
    vignette.draw(view, {target.target().framebuffer, 0, 0, eye}, 0);
    EXPECT_EQ(target.read().color.view().row(1)[1], (Rgb{200, 100, 50}));
}

}  // namespace
}  // namespace theatron::render
