// SPDX-License-Identifier: Apache-2.0
// Inputs of every cloud shader for the camera that is drawn: its images and its calibration.

layout(std140) uniform Camera {
    mat4 clip_from_camera;   // its w is the distance along the view's axis
    mat4 color_from_camera;  // depth camera's frame to colour camera's frame
    vec4 color_pinhole;      // fx, fy, cx, cy in pixels of the newest colour picture
    vec4 color_radial;       // k1, k2, k3, k4
    vec4 color_more;         // k5, k6, p1, p2
    vec4 color_image;        // width, height, largest radius (0: no limit), 1 if it needs
                             // the map of color_place.glsl, -1 if it is made of depth
    vec4 depth;              // metres per unit, tangent per pixel, metres that are measured too
                             // much (corrected.glsl)
    vec4 viewer;             // the eye in the depth camera's frame
    vec4 color_gain;         // red, green, blue: balances the cameras' exposures; presence
    vec4 keep;               // shown.glsl: middle of a ball, radius (0: no such cut)
    vec4 remove_from;        // beginning of a capsule, radius (0: no such cut)
    vec4 remove_to;          // its end; width of the borders
}
camera;

uniform usampler2D depth_image;
uniform sampler2D rays;
uniform sampler2D color_picture;

// The depth of a pixel, 0 where nothing was measured.
float depth_m(ivec2 pixel) {
    uint units = texelFetch(depth_image, pixel, 0).r;
    return float(units) * camera.depth.x;
}

// The point that `pixel` sees at distance `z`, in the depth camera's frame.
vec3 point_at(ivec2 pixel, float z) {
    vec2 ray = texelFetch(rays, pixel, 0).rg;
    return vec3(ray * z, z);
}

// Largest distance of an occluder, metres.
const float farthest_m = 20.0;

// Where the colour camera sees a point of the depth camera's frame: the pixel, far
// outside its picture where it cannot, and the distance along its axis.
vec3 color_pixel(vec3 point) {
    vec3 p = (camera.color_from_camera * vec4(point, 1.0)).xyz;
    vec4 k = camera.color_radial;
    vec4 more = camera.color_more;
    vec4 pinhole = camera.color_pinhole;
    float limit = camera.color_image.z;

    vec2 d = p.xy / p.z;
    float r2 = dot(d, d);
    if (p.z <= 0.0 || (limit > 0.0 && r2 > limit * limit))
        return vec3(-1e4, -1e4, p.z);
    float radial = (1.0 + r2 * (k.x + r2 * (k.y + r2 * k.z))) /
                   (1.0 + r2 * (k.w + r2 * (more.x + r2 * more.y)));
    vec2 tangential = vec2(more.z, more.w) * (2.0 * d.x * d.y) +
                      vec2(more.w, more.z) * (r2 + 2.0 * d * d);
    return vec3((d * radial + tangential) * pinhole.xy + pinhole.zw, p.z);
}
