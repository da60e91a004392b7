// SPDX-License-Identifier: Apache-2.0
// The least that draws a depth image as a surface: what the other renderers' times
// are compared with.

uniform int columns;  // of the depth images

out vec3 v_place;  // colour pixel, camera

void main() {
    int camera = gl_InstanceID;
    ivec2 pixel = ivec2(gl_VertexID % columns, gl_VertexID / columns);
    vec3 point = point_at(camera, pixel, depth_m(camera, pixel));
    gl_Position = cameras[camera].clip_from_camera * vec4(point, 1.0);
    v_place = vec3(color_pixel(camera, point).xy, float(camera));
}
