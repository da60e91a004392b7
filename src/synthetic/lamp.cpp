// SPDX-License-Identifier: Apache-2.0
// Operating lamps: a wide head of many light modules on jointed arms.
#include "synthetic/scene.h"

namespace theatron::synthetic {
namespace {

// Shines along -y of its own frame; the face is at y = 0.
Mesh lamp_head() {
    Mesh m;
    m.append(make_lathe({{0.30f, 0.0f},
                         {0.315f, 0.006f},
                         {0.32f, 0.03f},
                         {0.29f, 0.06f},
                         {0.18f, 0.085f},
                         {0.07f, 0.1f},
                         {0.0f, 0.1f}},
                        48, Look::painted_metal));
    m.append(make_lathe({{0.0f, 0.004f}, {0.3f, 0.004f}, {0.302f, 0.0f}}, 48, Look::grey_plastic),
             scaling({1, -1, 1}));
    // Light modules in rings.
    for (const auto& [ring, count] : {std::pair{0.09f, 6}, {0.17f, 12}, {0.25f, 18}})
        for (int i = 0; i < count; ++i) {
            const float a = 2 * pi * (float(i) + 0.5f * float(count % 12 == 0)) / float(count);
            m.append(make_lathe({{0.0f, 0.012f}, {0.02f, 0.011f}, {0.027f, 0.006f}, {0.03f, 0.0f}},
                                14, Look::lamp_glass),
                     translation({ring * std::cos(a), -0.003f, ring * std::sin(a)}) *
                         scaling({1, -1, 1}));
        }
    m.append(make_tube({{0, -0.01f, 0}, {0, -0.1f, 0}}, {0.019f, 0.016f}, 18, Look::white_plastic));
    // The yoke that holds it.
    std::vector<F3> yoke;
    for (int i = 0; i <= 24; ++i) {
        const float a = pi * float(i) / 24;
        yoke.push_back({0.345f * std::cos(a), 0.03f + 0.2f * std::sin(a), 0});
    }
    m.append(make_tube(yoke, {0.014f}, 12, Look::painted_metal));
    for (const float s : {-1.0f, 1.0f}) {
        m.append(make_tube({{s * 0.31f, 0.03f, 0}, {s * 0.36f, 0.03f, 0}}, {0.022f}, 14,
                           Look::grey_plastic));
        m.append(make_tube({{s * 0.1f, 0.02f, 0.33f}, {s * 0.16f, 0.03f, 0.37f}, {0, 0.035f, 0.4f}},
                           {0.008f}, 10, Look::dark_plastic));
    }
    return m;
}

}  // namespace

void add_lamps(Mesh& still) {
    constexpr float ceiling = 2.95f;
    const F3 column{0.0f, ceiling, -0.35f};
    still.append(make_cylinder(0.22f, 0.06f, 36, Look::white_plastic),
                 translation(column + F3{0, -0.06f, 0}));
    still.append(make_tube({column, column + F3{0, -0.32f, 0}}, {0.05f}, 20, Look::painted_metal));
    float joint = 2.8f;
    for (const Lamp& lamp : lamps()) {
        const F3 up = normalized(lamp.position - lamp.target);
        const F3 side = normalized(cross(up, {0, 0, 1}));
        const Affine head{side, up, cross(side, up), lamp.position};
        still.append(lamp_head(), head);
        // Column, horizontal arm, spring arm, yoke.
        const F3 top = lamp.position + up * 0.23f;
        const F3 shoulder{column.x, joint, column.z};
        const F3 out = normalized(F3{lamp.position.x - column.x, 0, lamp.position.z - column.z});
        const F3 bend{-out.z, 0, out.x};
        const F3 elbow = shoulder + out * 0.42f + bend * 0.34f;
        still.append(make_tube({shoulder, elbow}, {0.04f}, 18, Look::painted_metal));
        still.append(make_tube({elbow + F3{0, 0.06f, 0}, elbow + F3{0, -0.12f, 0}}, {0.05f}, 20,
                               Look::grey_plastic));
        const F3 wrist = top + F3{0, 0.06f, 0};
        still.append(
            make_tube({elbow + F3{0, -0.08f, 0}, mix(elbow, wrist, 0.5f) + F3{0, -0.02f, 0}, wrist},
                      {0.036f, 0.034f, 0.028f}, 18, Look::painted_metal));
        still.append(make_tube({wrist + F3{0, 0.03f, 0}, top + F3{0, -0.01f, 0}}, {0.026f}, 16,
                               Look::grey_plastic));
        joint -= 0.1f;
    }
}

}  // namespace theatron::synthetic
