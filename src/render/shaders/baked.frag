// SPDX-License-Identifier: Apache-2.0
// Colours are those of the picture already; only shadows of objects that move fall on them.

uniform sampler2D surface_texture;
uniform sampler2DShadow shadow_map;
uniform vec3 base_color;
uniform bool tells_distance;

in vec2 v_uv;
in vec3 v_color;
in vec3 v_in_light;

// The lamp's part of the light, about.
const float shadow = 0.38;

void main() {
    // Beside the map nothing casts a shadow, as at its border.
    float lit = texture(shadow_map, vec3(v_in_light.xy, min(v_in_light.z, 1.0) - 0.001));
    vec3 color = base_color * v_color * texture(surface_texture, v_uv).rgb;
    write_surface(color * (1.0 - shadow + shadow * lit), tells_distance ? 1.0 / gl_FragCoord.w : 0.0);
}
