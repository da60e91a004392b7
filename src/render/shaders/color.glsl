// SPDX-License-Identifier: Apache-2.0
// Colour of a place in a camera's colour picture. Needs cloud.glsl.

const vec3 color_of_unseen = vec3(0.4);

vec3 color_inside(vec2 place) {
    return texture(color_picture, place / camera.color_image.xy).rgb;
}

// Depth cameras see further up and down than colour cameras: there the colours at the picture's
// border go on, the more blurred the further away.
vec3 color_beyond(vec2 place, vec2 size) {
    vec2 outside = max(max(-place, place - size), vec2(0.0));
    float spread = 0.3 * max(outside.x, outside.y);
    vec2 along = outside.x > outside.y ? vec2(0.0, spread) : vec2(spread, 0.0);
    vec3 sum = vec3(0.0);
    for (int i = -2; i <= 2; ++i)
        sum += color_inside(place + float(i) * along);
    return sum / 5.0;
}

// `pixel` counts from the centre of the top left pixel.
vec3 color_at(vec2 pixel) {
    vec2 size = camera.color_image.xy;
    vec2 place = pixel + 0.5;
    if (size.x == 0.0)
        return color_of_unseen;
    if (any(lessThan(place, vec2(0.0))) || any(greaterThan(place, size)))
        return color_beyond(place, size);
    return color_inside(place);
}
