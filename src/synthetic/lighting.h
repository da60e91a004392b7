// SPDX-License-Identifier: Apache-2.0
// Light in the room: two operating lamps, bright ceiling panels, reflection by the walls, and
// soft shadows.
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
// The lamps of the scene. Their bodies are modelled around these positions.
const std::array<Lamp, lamp_count>& lamps();

// Shadow casters seen from a lamp, blurred to three widths: coverage, and distance from the
// lamp. A point is in shadow if it lies behind the casters.
class ShadowMap {
public:
    // `points` in the room.
    ShadowMap(const Lamp& lamp, std::span<const F3> points, std::span<const Triangle> triangles);
    // For casters whose points are closer together than the map's pixels (6 mm): faster.
    ShadowMap(const Lamp& lamp, std::span<const F3> dense_points);

    struct Shadow {
        float lit = 1;   // share of the lamp's light that arrives
        float open = 1;  // share of the ceiling's ambient light that arrives
    };
    Shadow at(F3 room_point) const;

private:
    struct Layer {
        std::vector<float> cover;
        std::vector<float> covered_depth;  // coverage times depth
    };
    void spread(const Image<float>& depth);

    Affine lamp_from_room_;
    std::array<Layer, 3> layers_;
};

// Light that leaves a point towards the eye, before shadows: the constant part, and the part
// of each lamp.
struct LitPoint {
    F3 base;
    std::array<F3, lamp_count> lamp;
};

// `toward_eye`: unit vector.
LitPoint light_point(const Appearance& look, F3 room_point, F3 toward_eye, float openness);

// Converts scene-linear light to an sRGB pixel.
Rgb tone_map(F3 light);

}  // namespace theatron::synthetic
