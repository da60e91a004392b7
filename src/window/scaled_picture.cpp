// SPDX-License-Identifier: Apache-2.0
#include "window/scaled_picture.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "base/statistics.h"
#include "render/render_target.h"

namespace theatron::window {
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
    // Also below a picture: Chromium does not notice a canvas into which pixels are only copied,
    // and neither shows it nor gives it to a file.
    glClearColor(background.r / 255.0f, background.g / 255.0f, background.b / 255.0f, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    if (!parts_->target)
        return;
    const render::DrawTarget from = parts_->target->target();
    glBindFramebuffer(GL_READ_FRAMEBUFFER, from.framebuffer);
    glBlitFramebuffer(0, 0, from.size.width, from.size.height, 0, 0, window.width, window.height,
                      GL_COLOR_BUFFER_BIT, from.size == window ? GL_NEAREST : GL_LINEAR);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
}

std::optional<double> ScaledPicture::distance_at(Vec2 place) const {
    if (!parts_->target)
        return std::nullopt;
    // The median of the points around: single points may be holes or noise.
    constexpr int side = 7;
    const render::DrawTarget from = parts_->target->target();
    const int width = std::min(side, from.size.width), height = std::min(side, from.size.height);
    const auto first = [](double share, int size, int part) {
        return std::clamp(int(share * size) - part / 2, 0, size - part);
    };
    // Integer textures are read four components at a time.
    std::vector<std::uint32_t> pixels(std::size_t(4 * width * height));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, from.framebuffer);
    glReadBuffer(GL_COLOR_ATTACHMENT1);
    glReadPixels(first(place.x, from.size.width, width),
                 first(1 - place.y, from.size.height, height), width, height, GL_RGBA_INTEGER,
                 GL_UNSIGNED_INT, pixels.data());
    glReadBuffer(GL_COLOR_ATTACHMENT0);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    std::vector<double> distances;
    for (std::size_t i = 0; i < pixels.size(); i += 4)
        if (pixels[i] != 0)
            distances.push_back(pixels[i] / 1000.0);
    if (distances.empty())
        return std::nullopt;
    return median(distances);
}

}  // namespace theatron::window
