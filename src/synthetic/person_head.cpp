// SPDX-License-Identifier: Apache-2.0
// A head with face, eyes, cap and mask.
#include "synthetic/implicit.h"
#include "synthetic/noise.h"
#include "synthetic/person.h"

namespace theatron::synthetic {
namespace {

float skull(F3 p) {
    const float cranium = ellipsoid(p, {0, 0.148f, -0.006f}, {0.0755f, 0.093f, 0.096f});
    const float jaw = ellipsoid(p, {0, 0.068f, 0.034f}, {0.057f, 0.068f, 0.064f});
    return blend(cranium, jaw, 0.045f);
}

float face(F3 p, float build) {
    const F3 m{std::abs(p.x), p.y, p.z};
    float d = skull(p);
    d = blend(d, ellipsoid(m, {0.04f, 0.092f, 0.068f}, {0.024f, 0.02f, 0.02f}), 0.025f);  // cheeks
    d = blend(d, capsule(m, {0.0f, 0.131f, 0.0905f}, {0.04f, 0.128f, 0.078f}, 0.0095f, 0.007f),
              0.016f);                                                  // brows
    d = without(d, ball(m, {0.0315f, 0.111f, 0.1f}, 0.0175f), 0.014f);  // eye sockets
    const float nose =
        capsule(p, {0, 0.122f, 0.092f}, {0, 0.08f, 0.112f + build}, 0.0075f, 0.0115f);
    const float wings = ball(m, {0.0105f, 0.077f, 0.102f + build}, 0.0085f);
    d = blend(d, blend(nose, wings, 0.008f), 0.012f);
    // Lids over the eyeballs, open in front.
    const F3 e = m - rest::eye;
    const float lid =
        std::max(length(e) - 0.0142f, 0.0044f - std::abs(e.y + 0.0012f) -
                                          0.16f * std::max(0.0f, std::abs(e.x) - 0.004f));
    d = blend(d, lid, 0.004f);
    d = blend(d, ball(p, {0, 0.012f, 0.084f}, 0.014f), 0.025f);  // chin
    // Ears.
    const float ear = ellipsoid(m, {0.0785f, 0.103f, -0.008f}, {0.011f, 0.031f, 0.02f});
    d = blend(d,
              without(ear, ellipsoid(m, {0.09f, 0.105f, -0.003f}, {0.009f, 0.02f, 0.012f}), 0.006f),
              0.008f);
    const float neck = capsule(p, {0, -0.08f, -0.028f}, {0, 0.06f, -0.012f}, 0.061f, 0.055f);
    return blend(d, neck, 0.03f);
}

float cap_shape(F3 p, float seed) {
    // Over forehead, hair and the tops of the ears, gathered behind.
    float d = skull(p) - 0.011f;
    d = blend(d, ellipsoid(p, {0, 0.185f, -0.045f}, {0.078f, 0.062f, 0.078f}), 0.03f);
    const float turn = std::atan2(p.x, p.z);
    d -= 0.0022f * noise({turn * 6, p.y * 30, seed}) +
         0.0018f * std::sin(turn * 26) * smoothstep(0.03f, -0.08f, p.z);
    const float brim = 0.142f - 0.55f * std::max(0.0f, 0.07f - p.z) - p.y;
    return both(d, brim * 0.85f, 0.006f);
}

float mask_shape(F3 p, float build) {
    // Stands off nose and chin; three pleats; ends before the ears.
    const float nose = capsule(p, {0, 0.105f, 0.1f}, {0, 0.08f, 0.115f + build}, 0.012f, 0.014f);
    float d = blend(skull(p) - 0.0065f, nose - 0.004f, 0.035f);
    d = blend(d, ball(p, {0, 0.018f, 0.082f}, 0.022f), 0.03f);
    const float pleats = std::sin((p.y - 0.02f) * 230);
    d -= 0.0014f * pleats * smoothstep(0.0f, 0.05f, p.z);
    const float upper = p.y - (0.0995f - 4.5f * p.x * p.x), under = -0.004f - p.y;
    const float back = 0.012f + 0.25f * std::abs(p.y - 0.06f) - p.z;
    return both(both(d, std::max(upper, under), 0.004f), back, 0.004f);
}

Mesh loupes() {
    // Frame, bridge, temples, and two short telescopes.
    Mesh m;
    for (const float s : {-1.0f, 1.0f}) {
        std::vector<F3> rim;
        for (int i = 0; i <= 24; ++i) {
            const float a = 2 * pi * float(i) / 24;
            rim.push_back({s * 0.0335f + 0.0245f * std::cos(a), 0.112f + 0.0175f * std::sin(a),
                           0.108f - 0.004f * std::cos(a) * s});
        }
        m.append(make_tube(rim, {0.0019f}, 8, Look::dark_plastic));
        m.append(make_tube(
            {{s * 0.058f, 0.116f, 0.105f}, {s * 0.078f, 0.117f, 0.07f}, {s * 0.083f, 0.116f, 0.0f}},
            {0.002f}, 8, Look::dark_plastic));
        m.append(make_tube({{s * 0.031f, 0.106f, 0.111f},
                            {s * 0.0285f, 0.098f, 0.129f},
                            {s * 0.0275f, 0.094f, 0.137f}},
                           {0.0085f, 0.0105f, 0.0105f}, 16, Look::dark_plastic));
        m.append(make_ball({0.0085f, 0.0085f, 0.003f}, 14, Look::window),
                 translation({s * 0.0272f, 0.0905f, 0.1445f}) * rotation({1, 0, 0}, 0.45f));
    }
    m.append(make_tube({{-0.01f, 0.116f, 0.11f}, {0.01f, 0.116f, 0.11f}}, {0.002f}, 8,
                       Look::dark_plastic));
    return m;
}

}  // namespace

void add_head(MovingMesh& out, std::uint16_t first, const PersonLooks& looks, double detail) {
    const float cell = 0.0033f / float(std::sqrt(detail));
    const float seed = float(looks.seed % 31);
    const float build = 0.002f * float(looks.seed % 3) - 0.002f;
    const F3 low{-0.11f, -0.1f, -0.13f}, high{0.11f, 0.27f, 0.15f};
    Mesh m = make_surface([&](F3 p) { return face(p, build); }, low, high, cell, looks.face);
    m.append(make_surface([&](F3 p) { return cap_shape(p, seed); }, low, high, cell, looks.cap));
    m.append(make_surface([&](F3 p) { return mask_shape(p, build); }, low, high, cell, Look::mask));
    for (const float s : {-1.0f, 1.0f})
        for (const bool upper : {true, false}) {
            const F3 from = upper ? F3{0.066f, 0.085f, 0.03f} : F3{0.05f, 0.02f, 0.03f};
            const F3 middle = upper ? F3{0.078f, 0.098f, 0.012f} : F3{0.067f, 0.05f, 0.0f};
            const F3 ear{0.083f, upper ? 0.115f : 0.085f, -0.016f};
            m.append(make_tube({{s * from.x, from.y, from.z},
                                {s * middle.x, middle.y, middle.z},
                                {s * ear.x, ear.y, ear.z}},
                               {0.0018f}, 6, Look::strap));
        }
    if (looks.loupes)
        m.append(loupes());
    out.append(m, std::uint16_t(first + head));
    const Mesh eyeball = make_ball({0.0123f, 0.0123f, 0.0123f}, 28, Look::eye);
    out.append(eyeball, std::uint16_t(first + eye_left));
    out.append(eyeball, std::uint16_t(first + eye_right));
}

}  // namespace theatron::synthetic
