// SPDX-License-Identifier: Apache-2.0
// Outputs of the cloud shaders: a colour, and the distance along the view's axis in
// millimetres, 0 where it does not fit into 16 bits.

layout(location = 0) out vec4 out_color;
layout(location = 1) out uint out_depth_mm;

void write_surface(vec3 color, float distance_m) {
    out_color = vec4(color, 1.0);
    float mm = round(distance_m * 1000.0);
    out_depth_mm = mm < 65536.0 ? uint(mm) : 0u;
}
