// SPDX-License-Identifier: Apache-2.0
// One surface from the layers of all cameras: what lies near the foremost one is
// averaged by weight, what is further behind is hidden. As neither depends on which
// camera is drawn first, overlapping surfaces do not fight. LAYERS is how many there are: a number
// known to the compiler lets it keep them in registers.

uniform sampler2DArray layer_colors;  // colour, square root of the weight
uniform sampler2DArray layer_depths;
uniform vec2 depth_from_w;    // window depth of distance w: x + y / w
uniform ivec2 picture_corner;  // of the target in its framebuffer
uniform float presence[16];
uniform float tan_per_pixel;  // of the coarsest depth image: the side of its pixels at one metre

const float set_back_from_behind = 0.15;  // metres

void main() {
    ivec2 place = ivec2(gl_FragCoord.xy) - picture_corner;
    float distances[LAYERS], tested[LAYERS];
    vec4 layers[LAYERS];
    float front = 1e6;
    for (int i = 0; i < LAYERS; ++i) {
        float depth = texelFetch(layer_depths, ivec3(place, i), 0).r;
        // An empty layer is at the far plane; without presence a camera shows nothing.
        bool empty = depth == 1.0 || presence[i] == 0.0;
        distances[i] = empty ? 1e6 : depth_from_w.y / (depth - depth_from_w.x);
        // Surfaces are thin: their other side, as another camera sees it, must not show through.
        layers[i] = texelFetch(layer_colors, ivec3(place, i), 0);
        bool from_behind = layers[i].a < 1.5 / 255.0;
        tested[i] = distances[i] + (from_behind && !empty ? set_back_from_behind : 0.0);
        front = min(front, tested[i]);
    }
    if (front == 1e6)
        discard;

    // Sensors and their registration agree on a surface to within some centimetres and pixels, mostly
    // within one. An instrument is an edge in its camera's picture and has little weight, so the
    // weight of a surface that another camera sees a few centimetres behind it must be less.
    float agreement = 0.03 + 4.5 * tan_per_pixel * front;
    vec4 color = vec4(0.0);
    float distance = 0.0;
    float coverage = 0.0;
    for (int i = 0; i < LAYERS; ++i) {
        float behind = tested[i] - front;
        if (behind > agreement)
            continue;
        vec4 layer = layers[i];
        float apart = behind / agreement;
        float weight = pow(layer.a, 3.0) * presence[i] * pow(1.0 - apart * apart, 8.0) + 1e-9;
        color += vec4(layer.rgb, 1.0) * weight;
        distance += distances[i] * weight;
        coverage = max(coverage, presence[i]);
    }
    distance /= color.a;
    write_surface(color.rgb / color.a, distance);
    out_color.a = coverage;
    gl_FragDepth = depth_from_w.x + depth_from_w.y / distance;
}
