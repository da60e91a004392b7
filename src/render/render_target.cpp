// SPDX-License-Identifier: Apache-2.0
#include "render/render_target.h"

#include "base/error.h"
#include "render/complete_framebuffer.h"

namespace theatron::render {
namespace {

void attach(const Texture& texture, GLenum format, Size size, GLenum attachment) {
    glBindTexture(GL_TEXTURE_2D, texture.name());
    glTexStorage2D(GL_TEXTURE_2D, 1, format, size.width, size.height);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glFramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D, texture.name(), 0);
}

}  // namespace

RenderTarget::RenderTarget(Size size) : size_(size) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    attach(color_, GL_RGBA8, size, GL_COLOR_ATTACHMENT0);
    attach(depth_mm_, GL_R16UI, size, GL_COLOR_ATTACHMENT1);
    attach(depth_, GL_DEPTH_COMPONENT24, size, GL_DEPTH_ATTACHMENT);
    const GLenum buffers[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    glDrawBuffers(2, buffers);
    if (!is_complete_framebuffer<RenderTarget>())
        throw Error("The graphics driver cannot draw a picture of " + std::to_string(size.width) +
                    "x" + std::to_string(size.height) + " pixels.");
}

void RenderTarget::clear(Rgb background) const {
    const float color[] = {background.r / 255.0f, background.g / 255.0f, background.b / 255.0f, 1};
    const GLuint nothing[] = {0, 0, 0, 0};
    const float furthest = 1;
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    glDepthMask(GL_TRUE);
    glClearBufferfv(GL_COLOR, 0, color);
    glClearBufferuiv(GL_COLOR, 1, nothing);
    glClearBufferfv(GL_DEPTH, 0, &furthest);
}

Picture RenderTarget::read() const {
    // The two forms that every driver must be able to give; rows come bottom first.
    std::vector<std::uint8_t> rgba(size_.area() * 4);
    std::vector<std::uint32_t> mm(size_.area() * 4);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadBuffer(GL_COLOR_ATTACHMENT0);
    glReadPixels(0, 0, size_.width, size_.height, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
    glReadBuffer(GL_COLOR_ATTACHMENT1);
    glReadPixels(0, 0, size_.width, size_.height, GL_RGBA_INTEGER, GL_UNSIGNED_INT, mm.data());

    Picture picture{ColorImage(size_), DepthImage(size_)};
    for (int y = 0; y < size_.height; ++y) {
        const std::size_t row = std::size_t(size_.height - 1 - y) * std::size_t(size_.width);
        for (int x = 0; x < size_.width; ++x) {
            const std::size_t i = 4 * (row + std::size_t(x));
            picture.color.view().row(y)[x] = {rgba[i], rgba[i + 1], rgba[i + 2]};
            picture.depth_mm.view().row(y)[x] = std::uint16_t(mm[i]);
        }
    }
    return picture;
}

}  // namespace theatron::render
