// SPDX-License-Identifier: Apache-2.0
#include "xr/scaled_picture_native.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "render/render_target.h"

namespace theatron::xr {
namespace {

constexpr Rgb background{24, 26, 30};

}  // namespace

struct ScaledPicture::Parts {
    std::optional<render::RenderTarget> target;
};

ScaledPicture::ScaledPicture() : parts_(std::make_unique<Parts>()) {}
ScaledPicture::~ScaledPicture() = default;

render::DrawTarget ScaledPicture::begin(Size window, double scale) {
    const auto scaled = [&](int side) { return std::max(1, int(std::lround(side * scale))); };
    const Size size{scaled(window.width), scaled(window.height)};
    if (!parts_->target || parts_->target->size() != size)
        parts_->target.emplace(size);
    parts_->target->clear(background);
    return parts_->target->target();
}

void ScaledPicture::show(Size window) const {
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    if (!parts_->target) {
        glClearColor(background.r / 255.0f, background.g / 255.0f, background.b / 255.0f, 1);
        glClear(GL_COLOR_BUFFER_BIT);
        return;
    }
    const render::DrawTarget from = parts_->target->target();
    glBindFramebuffer(GL_READ_FRAMEBUFFER, from.framebuffer);
    glBlitFramebuffer(0, 0, from.size.width, from.size.height, 0, 0, window.width, window.height,
                      GL_COLOR_BUFFER_BIT, from.size == window ? GL_NEAREST : GL_LINEAR);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
}

}  // namespace theatron::xr
