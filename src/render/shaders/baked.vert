// SPDX-License-Identifier: Apache-2.0
// Surfaces whose light was computed before.

uniform mat4 clip_from_room;
uniform mat4 room_from_object;
uniform mat4 light_from_room;

layout(location = 0) in vec3 place;
layout(location = 2) in vec2 uv;
layout(location = 3) in vec3 color;

out vec2 v_uv;
out vec3 v_color;
out vec3 v_in_light;  // place and depth in the shadow map

void main() {
    vec4 in_room = room_from_object * vec4(place, 1.0);
    v_uv = uv;
    v_color = color;
    v_in_light = (light_from_room * in_room).xyz * 0.5 + 0.5;
    gl_Position = clip_from_room * in_room;
}
