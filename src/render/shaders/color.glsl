// SPDX-License-Identifier: Apache-2.0
// Colour of a place in a camera's colour picture. Needs cloud.glsl.

const vec3 color_of_unseen = vec3(0.4);

vec3 color_inside(int camera, vec2 place) {
    // The picture may fill only a part of its layer: do not blend with what lies beside it.
    vec2 inner = clamp(place, vec2(0.5), cameras[camera].color_image.xy - 0.5);
    vec2 layer_size = vec2(textureSize(color_images, 0).xy);
    return texture(color_images, vec3(inner / layer_size, float(layer_of(camera)))).rgb;
}

// Depth cameras see further up and down than colour cameras: there the colours at the picture's
// border go on, the more blurred the further away.
vec3 color_beyond(int camera, vec2 place, vec2 size) {
    vec2 outside = max(max(-place, place - size), vec2(0.0));
    float spread = 0.3 * max(outside.x, outside.y);
    vec2 along = outside.x > outside.y ? vec2(0.0, spread) : vec2(spread, 0.0);
    vec3 sum = vec3(0.0);
    for (int i = -2; i <= 2; ++i)
        sum += color_inside(camera, place + float(i) * along);
    return sum / 5.0;
}

// `pixel` counts from the centre of the top left pixel.
vec3 color_at(int camera, vec2 pixel) {
    vec2 size = cameras[camera].color_image.xy;
    vec2 place = pixel + 0.5;
    if (size.x == 0.0)
        return color_of_unseen;
    if (any(lessThan(place, vec2(0.0))) || any(greaterThan(place, size)))
        return color_beyond(camera, place, size);
    return color_inside(camera, place);
}
