// SPDX-License-Identifier: Apache-2.0
#include "render/picture_texture.h"

namespace theatron::render {

void PictureTexture::set(ColorView picture) {
    if (picture.size.area() == 0) {
        texture_.reset();
        size_ = {};
        return;
    }
    glActiveTexture(GL_TEXTURE0);
    if (!texture_ || size_ != picture.size) {  // the storage of a texture is final
        texture_.emplace(make_texture(GL_RGB8, picture.size, GL_LINEAR));
        size_ = picture.size;
    }
    glBindTexture(GL_TEXTURE_2D, texture_->name());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, GLint(picture.stride));
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, size_.width, size_.height, GL_RGB, GL_UNSIGNED_BYTE,
                    picture.pixels);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
}

}  // namespace theatron::render
