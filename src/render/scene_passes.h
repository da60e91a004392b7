// SPDX-License-Identifier: Apache-2.0
// Draws a SceneFrame: shadows, lit opaque surfaces, texts, and what is translucent.
//
// A picture with clouds is drawn by room_picture.h, in this order: prepare, and for each eye
// draw_opaque, CloudSet::draw, draw_translucent.
//
// All functions need the GL context current in which the object was made.
#pragma once

#include <memory>

#include "render/cloud_set.h"
#include "render/font_atlas.h"
#include "render/scene_frame.h"

namespace theatron::render {

// High, but low where no graphics card draws but the processor. Needs a current context.
SceneQuality usual_quality();

class ScenePasses {
public:
    // Texts are left out without an atlas.
    explicit ScenePasses(const FontAtlas* atlas = nullptr);
    ~ScenePasses();
    ScenePasses(ScenePasses&&) noexcept;
    ScenePasses& operator=(ScenePasses&&) noexcept;

    // Draws the maps that both eyes share: shadows. Changes framebuffer and viewport.
    void prepare(const SceneFrame& frame);
    void draw_opaque(const SceneFrame& frame, const CameraView& view, const DrawTarget& target);
    // From back to front, each object's inside before its outside: right for objects that
    // do not pass through each other.
    void draw_translucent(const SceneFrame& frame, const CameraView& view,
                          const DrawTarget& target);

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace theatron::render
