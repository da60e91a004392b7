// SPDX-License-Identifier: Apache-2.0
// Darkens a picture towards its sides, by the angle from the view's axis.

uniform vec4 tangents;  // left, top, right, bottom of the picture, as in CameraView
uniform vec4 picture;   // x, y, width, height in pixels
uniform vec3 ring;      // tangents where it begins and where it is complete; its opacity there

layout(location = 0) out vec4 out_color;

void main() {
    vec2 place = (gl_FragCoord.xy - picture.xy) / picture.zw;
    vec2 tangent = vec2(mix(tangents.x, tangents.z, place.x), mix(tangents.w, tangents.y, place.y));
    out_color = vec4(0.0, 0.0, 0.0, ring.z * smoothstep(ring.x, ring.y, length(tangent)));
}
