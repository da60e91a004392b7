// SPDX-License-Identifier: Apache-2.0

uniform mat4 clip_from_room;
uniform mat4 room_from_object;

layout(location = 0) in vec3 place;
layout(location = 1) in vec3 normal;

out vec3 v_place;   // in the room
out vec3 v_normal;

void main() {
    vec4 in_room = room_from_object * vec4(place, 1.0);
    v_place = in_room.xyz;
    v_normal = mat3(room_from_object) * normal;
    gl_Position = clip_from_room * in_room;
}
