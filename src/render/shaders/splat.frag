// SPDX-License-Identifier: Apache-2.0

flat in vec3 v_place;

void main() {
    write_surface(color_at(int(v_place.z), v_place.xy), 1.0 / gl_FragCoord.w);
}
