// SPDX-License-Identifier: Apache-2.0
// Colour of a place in a camera's colour picture. Needs cloud.glsl.

const vec3 color_of_unseen = vec3(0.4);

// `pixel` counts from the centre of the top left pixel.
vec3 color_at(int camera, vec2 pixel) {
    vec2 size = cameras[camera].color_image.xy;
    vec2 place = pixel + 0.5;
    if (any(lessThan(place, vec2(0.0))) || any(greaterThan(place, size)))
        return color_of_unseen;
    // The picture may fill only a part of its layer: do not blend with what lies beside it.
    vec2 inner = clamp(place, vec2(0.5), size - 0.5);
    vec2 layer_size = vec2(textureSize(color_images, 0).xy);
    return texture(color_images, vec3(inner / layer_size, float(layer_of(camera)))).rgb;
}
