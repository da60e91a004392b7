// SPDX-License-Identifier: Apache-2.0

uniform mat4 clip_from_object;

layout(location = 0) in vec3 place;

void main() {
    gl_Position = clip_from_object * vec4(place, 1.0);
}
