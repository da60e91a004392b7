// SPDX-License-Identifier: Apache-2.0
// Draws the OR screen: large calm texts on a dark ground, the pictures, and what people point at.
#pragma once

#include <memory>

#include "or_screen/content.h"
#include "or_screen/layout.h"
#include "render/draw_target.h"
#include "render/picture_texture.h"

namespace theatron::or_screen {

// Null: there is none. The room's picture has its lower row first.
struct Pictures {
    const render::PictureTexture* camera = nullptr;
    const render::Texture* room = nullptr;
    const render::PictureTexture* slice = nullptr;
};

// Use from one thread, with the same GL context current, also in the destructor.
class Drawing {
public:
    // Throws Error where the driver does not accept the shaders.
    Drawing();
    ~Drawing();

    // Fills the whole of `target`. `by` moves everything (pixels).
    void draw(const Content& content, const Layout& layout, Vec2 by, const Pictures& pictures,
              const render::DrawTarget& target);

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace theatron::or_screen
