// SPDX-License-Identifier: Apache-2.0
// Appearance of surfaces: colour, gloss and fine relief, computed from noise.
#pragma once

#include <vector>

#include "synthetic/mesh.h"
#include "synthetic/picture.h"

namespace theatron::synthetic {

enum class Look : std::uint8_t {
    wall,
    wall_panel,
    ceiling,
    floor,
    door,
    window,
    white_plastic,
    grey_plastic,
    dark_plastic,
    blue_plastic,
    painted_metal,
    steel,
    instrument,
    gold,
    rubber,
    mattress,
    lamp_glass,
    drape,
    tray_cloth,
    gown,
    gown_assistant,
    cuff,
    cap,
    cap_assistant,
    mask,
    strap,
    glove,
    glove_assistant,
    face,
    face_assistant,
    patient_skin,
    patient_face,
    eye,
    hair,
    muscle,
    peritoneum,
    bowel,
    artery,
    vein,
    liver,
    gallbladder,
    fat,
    gauze,
    blood,
    paper,
    screen,
    scrubs,
    shoe,
    clear_bag,
    brick_red,
    brick_blue,
    brick_yellow,
    brick_white,
    brick_green,
    count
};

// Properties that are constant over a surface.
struct LookTraits {
    Material material = Material::none;
    F3 color;            // linear, 0 … 1
    float infrared = 0;  // see SurfaceSample
    float specular = 0;  // strength of the highlight
    float gloss = 16;    // its sharpness: exponent of the half-angle
    float mirror = 0;    // share of the reflected room
};
const LookTraits& traits(Look look);

// A surface point, input of the lighting.
struct Appearance {
    F3 color;
    F3 normal;
    float specular = 0, gloss = 16, mirror = 0;
    F3 glow;            // emitted light
    float through = 0;  // share of light transmitted from behind: skin, gloves, tissue
};

// `footprint` is the width of one pixel on the surface in metres; finer detail is omitted.
Appearance appearance(Look look, F3 texture, F3 normal, float footprint,
                      const std::vector<Picture>& pictures);

// Share of infrared light reflected diffusely at a place: the look's, with its pattern.
float infrared(Look look, F3 texture, const std::vector<Picture>& pictures);

}  // namespace theatron::synthetic
