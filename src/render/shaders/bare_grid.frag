// SPDX-License-Identifier: Apache-2.0

in vec2 v_place;

void main() {
    write_surface(color_at(v_place), 1.0 / gl_FragCoord.w);
}
