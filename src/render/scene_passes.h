// SPDX-License-Identifier: Apache-2.0
// Draws a SceneFrame: shadows, lit opaque surfaces, translucent surfaces, lines, texts, labels.
//
// draw() of room_picture.h draws a picture with clouds in this order: prepare, then for each eye
// draw_opaque, CloudSet::draw, draw_translucent.
//
// All functions need the GL context current in which the object was made.
#pragma once

#include <memory>

#include "render/cloud_set.h"
#include "render/font_atlas.h"
#include "render/scene_frame.h"

namespace theatron::render {

// High; low if the processor draws instead of a graphics card. Needs a current context.
SceneQuality usual_quality();

class BegunPrograms;

// The programs for most surfaces, begun without waiting for the driver (BegunPrograms of gl.h).
// ScenePasses takes them over as long as this object lives.
class BegunScenePrograms {
public:
    explicit BegunScenePrograms(SceneQuality quality);
    ~BegunScenePrograms();
    bool are_ready() const;

private:
    std::unique_ptr<BegunPrograms> programs_;
};

class ScenePasses {
public:
    // Texts are left out without an atlas.
    explicit ScenePasses(const FontAtlas* atlas = nullptr);
    ~ScenePasses();
    ScenePasses(ScenePasses&&) noexcept;
    ScenePasses& operator=(ScenePasses&&) noexcept;

    // Draws and computes what both eyes share: shadows, and the places of labels, which are those
    // of the first eye's picture. Changes framebuffer and viewport.
    void prepare(const SceneFrame& frame, const CameraView& first, Size picture);
    void draw_opaque(const SceneFrame& frame, const CameraView& view, const DrawTarget& target);
    // Draws from back to front: the far sides of objects by their farthest, the near sides by their
    // nearest places, so that an object inside of another one is drawn between the other's sides.
    // Correct for objects that do not intersect. Lines, texts and labels follow.
    void draw_translucent(const SceneFrame& frame, const CameraView& view,
                          const DrawTarget& target);

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace theatron::render
