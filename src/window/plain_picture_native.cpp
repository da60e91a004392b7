// SPDX-License-Identifier: Apache-2.0
#include "window/plain_picture_native.h"

#include "render/picture_texture.h"

namespace theatron::window {

struct PlainPicture::Parts {
    render::PictureTexture texture;
    render::Framebuffer framebuffer;
};

PlainPicture::PlainPicture() : parts_(std::make_unique<Parts>()) {}
PlainPicture::~PlainPicture() = default;

void PlainPicture::show(ColorView picture, Size window) {
    parts_->texture.set(picture);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, parts_->framebuffer.name());
    glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D,
                           parts_->texture.texture().name(), 0);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    // A texture's first row is the upper one, a window's the lower one.
    glBlitFramebuffer(0, 0, picture.size.width, picture.size.height, 0, window.height, window.width,
                      0, GL_COLOR_BUFFER_BIT, picture.size == window ? GL_NEAREST : GL_LINEAR);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
}

}  // namespace theatron::window
