// SPDX-License-Identifier: Apache-2.0
// The weight of a camera's view of a point beside other cameras'. Needs cloud.glsl.

// Distance to the next edge of the surface, from 0 to 1.
uniform sampler2D edge_distances;

// `steepness`: change of depth per footprint, to the right and downwards. `seen`: how well
// the colour camera sees the point, see color_place.glsl. The factor that depends on the view
// is in alignment.glsl.
float quality_at(ivec2 pixel, vec3 point, vec2 steepness, float seen) {
    // Noise and the size of a pixel grow with the distance; one metre is as good as it gets.
    float near = min(1.0, 1.0 / (point.z * point.z));
    // The cosine at which the camera sees the surface.
    float facing = inversesqrt(1.0 + dot(steepness, steepness));
    // Weights fall to 0 at edges, so that no camera's share begins or ends suddenly.
    vec2 place = (vec2(pixel) + 0.5) / (4.0 * vec2(textureSize(edge_distances, 0)));
    float inner = texture(edge_distances, place).r;
    return near * facing * facing * inner * max(seen, 0.002);
}
