// SPDX-License-Identifier: Apache-2.0
#include "render/fill.h"

#include <gtest/gtest.h>

#include "render/render_target.h"
#include "render/test_context.h"

namespace theatron::render {
namespace {

TEST(FillTest, ColoursTheRectangleAndNothingElse) {
    (void)test_context();
    const RenderTarget target({16, 8});
    fill(target.target(), {200, 100, 50});
    fill({target.target().framebuffer, 4, 2, {3, 2}}, {1, 2, 3});
    const Picture picture = target.read();
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 16; ++x) {
            // The target counts rows from below, the picture from above.
            const bool inside = x >= 4 && x < 7 && 7 - y >= 2 && 7 - y < 4;
            EXPECT_EQ(picture.color.view().row(y)[x], inside ? (Rgb{1, 2, 3}) : (Rgb{200, 100, 50}))
                << x << ", " << y;
        }
}

}  // namespace
}  // namespace theatron::render
