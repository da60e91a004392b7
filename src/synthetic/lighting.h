// SPDX-License-Identifier: Apache-2.0
// Light in the room: two operating lamps, bright ceiling panels, what the walls
// send back, and soft shadows.
#pragma once

#include <array>
#include <span>

#include "synthetic/materials.h"
#include "synthetic/rasteriser.h"

namespace theatron::synthetic {

inline constexpr int lamp_count = 2;

struct Lamp {
    F3 position;
    F3 target;  // the middle of its pool of light
};
// Where the lamps of the scene are; the lamp's body is built around the same place.
const std::array<Lamp, lamp_count>& lamps();

// What hides a lamp, blurred to three widths: how much is covered, and how far
// from the lamp the cover is. A point is in shadow where it lies behind the cover.
class ShadowMap {
public:
    // `points` in the room.
    ShadowMap(const Lamp& lamp, std::span<const F3> points, std::span<const Triangle> triangles);
    // Of bodies whose points lie closer together than the map's (6 mm): quicker.
    ShadowMap(const Lamp& lamp, std::span<const F3> dense_points);

    struct Shadow {
        float lit = 1;   // share of the lamp's light that arrives
        float open = 1;  // the same for light from all over the ceiling
    };
    Shadow at(F3 room_point) const;

private:
    struct Layer {
        std::vector<float> cover;
        std::vector<float> covered_depth;  // cover times depth
    };
    void spread(const Image<float>& depth);

    Affine lamp_from_room_;
    std::array<Layer, 3> layers_;
};

// The light that leaves a point towards the eye, in parts: what is always there,
// and each lamp's, before shadows.
struct LitPoint {
    F3 base;
    std::array<F3, lamp_count> lamp;
};

// `toward_eye`: unit vector.
LitPoint light_point(const Appearance& look, F3 room_point, F3 toward_eye, float openness);

// Scene-linear light to an sRGB pixel.
Rgb tone_map(F3 light);

}  // namespace theatron::synthetic
