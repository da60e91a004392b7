// SPDX-License-Identifier: Apache-2.0
// The materials of the furniture: metal-rough, as render::SurfaceLook describes them.
#pragma once

#include <cstddef>

#include "render/scene_frame.h"

namespace theatron::furniture {

enum class Material {
    enamel,         // white paint on metal
    grey_enamel,    // of housings and bases
    steel,          // brushed stainless steel
    chrome,         // polished rods and instruments
    white_plastic,  //
    grey_plastic,   //
    black_plastic,  //
    rubber,         // wheels, seals
    pad,            // foam with a dark cover
    green_cloth,    // drapes
    blue_cloth,     //
    glass,          // of doors and cabinets, in front of a pale inside
    screen,         // a monitor that shows nothing: the room never shows invented patient data
    light,          // shines
    diffuser,       // of the ceiling panel, shines a little
    yellow,         // waste bins, signs
    red,            //
    blue,           //
    green,          //
    fluid,          // infusion bags
};
inline constexpr std::size_t material_count = std::size_t(Material::fluid) + 1;

render::SurfaceLook look_of(Material material);
// True for what shines by itself: it has the same colour in any light.
bool shines(Material material);

}  // namespace theatron::furniture
