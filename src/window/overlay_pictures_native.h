// SPDX-License-Identifier: Apache-2.0
// The plain pictures of the overlay: their textures, and where they stand in the window.
#pragma once

#include <imgui.h>

#include <memory>
#include <optional>
#include <vector>

#include "render/picture_texture.h"
#include "window/overlay_content.h"

namespace theatron::window {

// Needs the window's GL context current, also in the destructor.
class OverlayPictures {
public:
    // The share of the window's width that all columns take at most.
    static constexpr float columns_width = 0.48f;

    // Adds them to `list`, whose data must be drawn before the next call. `unit` is the gap between
    // texts, `from` and `to` the corners of the part of the window that is free for pictures, in
    // pixels.
    void draw(ImDrawList& list, ImFont& font, float unit, ImVec2 window, ImVec2 from, ImVec2 to,
              const std::vector<OverlayPicture>& pictures);
    // The command of the picture that stands at this pixel, if there is one.
    std::optional<int> command_at(ImVec2 pixel) const;

private:
    struct Kept {
        std::shared_ptr<const ColorImage> pixels;  // what the texture holds
        render::PictureTexture texture;
    };
    struct Cell {
        ImVec2 from, to;
        int command = 0;
    };

    std::vector<Kept> kept_;  // in the order of the pictures
    std::vector<Cell> cells_;
};

}  // namespace theatron::window
