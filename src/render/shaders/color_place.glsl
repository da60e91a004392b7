// SPDX-License-Identifier: Apache-2.0
// The place of the colour picture that shows a point. Needs cloud.glsl.

// The distance of the nearest surface that the colour camera sees, along that camera's axis,
// as a fraction of farthest_m. Filled by color_depth.vert.
uniform sampler2D nearest_in_color;

// Distance in metres of the surface that the colour camera sees at `pixel`; farthest_m: unknown.
float nearest_at(vec2 pixel) {
    vec2 place = (pixel + 0.5) / camera.color_image.xy;
    return texture(nearest_in_color, place).r * farthest_m;
}

bool shows_background(vec2 pixel, float background) {
    float nearest = nearest_at(pixel);
    return nearest > background && nearest < 0.99 * farthest_m;
}

// 1 inside the colour picture, falling to 0 at its border.
float inside_picture(vec2 pixel, vec2 size) {
    vec2 to_border = min(pixel + 0.5, size - 0.5 - pixel);
    return clamp(min(to_border.x, to_border.y) / (0.05 * size.y), 0.0, 1.0);
}

// The pixel of the colour picture to take for a point, and how well the colour camera
// sees the point: 1, less towards the border of its picture, 0 where it does not. From its place beside the depth camera it
// cannot see all that has depth: there the pixel is that of the nearest part of the
// background that it does see, so that silhouettes are not painted on what is behind.
vec3 color_place(vec3 point) {
    vec3 seen_at = color_pixel(point);
    vec2 size = camera.color_image.xy;
    vec2 pixel = seen_at.xy;
    float inside = inside_picture(pixel, size);
    if (inside == 0.0 || camera.color_image.w < 0.0)
        return vec3(pixel, 0.0);
    // The map is coarse: a slanted surface must not hide itself.
    float behind = seen_at.z - (0.03 + 0.03 * seen_at.z);
    if (camera.color_image.w == 0.0)
        return vec3(pixel, inside);
    float hiding = nearest_at(pixel);
    if (hiding > behind)
        return vec3(pixel, inside);
    // In the depth camera's picture the hiding surface lies beside the point, on the colour
    // camera's side. In the opposite direction the background comes into the colour camera's
    // view. Beside the line between the two cameras only the map's coarseness hides a point.
    float background = 0.5 * (hiding + seen_at.z);
    vec2 away = normalize(camera.color_from_camera[3].xy) * size.x / 320.0;
    vec2 beside = vec2(-away.y, away.x);
    for (float distance = 1.0; distance < 40.0; distance *= 1.3) {
        vec2 candidate = pixel + away * distance;
        if (shows_background(candidate, background))
            return vec3(candidate, 0.0);
        if (distance < 6.0) {
            if (shows_background(pixel + beside * distance, background))
                return vec3(pixel + beside * distance, 0.0);
            if (shows_background(pixel - beside * distance, background))
                return vec3(pixel - beside * distance, 0.0);
        }
    }
    return vec3(pixel, 0.0);
}
