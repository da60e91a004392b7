// SPDX-License-Identifier: Apache-2.0
// With LOW_QUALITY light is computed at the corners of triangles alone.

uniform mat4 clip_from_room;
uniform mat4 room_from_object;
#if defined(LOW_QUALITY) && !defined(UNLIT)
uniform samplerCube environment;
uniform vec3 to_light;
uniform float light, surroundings;
#endif

layout(location = 0) in vec3 place;
layout(location = 1) in vec3 normal;
#ifdef TEXTURED
layout(location = 2) in vec2 uv;
#endif

out vec3 v_place;   // in the room
out vec3 v_normal;
#ifdef TEXTURED
out vec2 v_uv;  // place in the texture
#endif
#if defined(LOW_QUALITY) && !defined(UNLIT)
out vec3 v_around;  // light from all around
out float v_lamp;   // light from the lamp, where no shadow falls
#endif

void main() {
    vec4 in_room = room_from_object * vec4(place, 1.0);
    v_place = in_room.xyz;
#ifdef TEXTURED
    v_uv = uv;
#endif
    v_normal = mat3(room_from_object) * normal;
#if defined(LOW_QUALITY) && !defined(UNLIT)
    v_around = surroundings * textureLod(environment, v_normal, 4.0).rgb;
    v_lamp = max(dot(normalize(v_normal), to_light), 0.0) * light / 3.14159;
#endif
    gl_Position = clip_from_room * in_room;
}
