// SPDX-License-Identifier: Apache-2.0
// One point for each depth pixel (gl_VertexID) of each camera (gl_InstanceID),
// as large in the picture as what the pixel saw.

uniform int columns;           // of the depth images
uniform float pixels_per_tan;  // of the picture, at its centre
uniform float point_scale;     // larger than 1 closes gaps between neighbours

flat out vec3 v_place;  // colour pixel, camera

void main() {
    int camera = gl_InstanceID;
    ivec2 pixel = ivec2(gl_VertexID % columns, gl_VertexID / columns);
    float z = depth_m(camera, pixel);
    vec3 point = point_at(camera, pixel, z);
    if (z == 0.0 || point.x > 1e6) {
        gl_Position = vec4(2.0, 2.0, 2.0, 1.0);  // outside the picture
        gl_PointSize = 1.0;
        return;
    }
    gl_Position = cameras[camera].clip_from_camera * vec4(point, 1.0);
    float size_m = z * cameras[camera].depth_image.z * point_scale;
    gl_PointSize = clamp(size_m * pixels_per_tan / gl_Position.w, 1.0, 64.0);
    v_place = vec3(color_pixel(camera, point), float(camera));
}
