// SPDX-License-Identifier: Apache-2.0

uniform mat4 clip_from_text;

layout(location = 0) in vec2 place;
layout(location = 1) in vec2 in_atlas;

out vec2 v_in_atlas;

void main() {
    v_in_atlas = in_atlas;
    gl_Position = clip_from_text * vec4(place, 0.0, 1.0);
}
