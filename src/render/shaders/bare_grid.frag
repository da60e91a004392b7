// SPDX-License-Identifier: Apache-2.0

in vec3 v_place;

void main() {
    write_surface(color_at(int(v_place.z + 0.5), v_place.xy), 1.0 / gl_FragCoord.w);
}
