// SPDX-License-Identifier: Apache-2.0
#include "synthetic/instruments.h"

#include "synthetic/materials.h"

namespace theatron::synthetic {
namespace {

// A ring in the x-z plane.
Mesh finger_ring(F3 centre, float radius, Look look) {
    std::vector<F3> path;
    for (int i = 0; i <= 20; ++i) {
        const float a = 2 * pi * float(i) / 20;
        path.push_back(centre + F3{radius * std::cos(a), 0, radius * 1.25f * std::sin(a)});
    }
    return make_tube(path, {0.0026f}, 7, look);
}

}  // namespace

Mesh make_scalpel() {
    Mesh m;
    m.append(make_tube({{0, 0, -0.155f}, {0, 0, -0.12f}, {0, 0, -0.06f}, {0, 0, -0.034f}},
                       {0.0035f, 0.0045f, 0.0045f, 0.003f}, 10, Look::instrument, 0.5f));
    // The blade: a thin wedge with a curved edge.
    m.append(make_tube({{0, 0, -0.036f}, {0.001f, 0, -0.02f}, {0.0005f, 0, -0.01f}, {0, 0, 0}},
                       {0.0035f, 0.0045f, 0.0038f, 0.0004f}, 10, Look::instrument, 0.14f));
    return m;
}

Mesh make_forceps(float opening) {
    Mesh m;
    for (const float s : {-1.0f, 1.0f}) {
        std::vector<F3> path;
        std::vector<float> radii;
        for (int i = 0; i <= 16; ++i) {
            const float t = float(i) / 16;  // from the joined end to the tip
            const float bow = 0.011f * std::sin(pi * std::min(t * 0.75f + 0.05f, 1.0f));
            path.push_back({s * mix(bow, opening / 2, t * t), 0, mix(-0.16f, 0.0f, t)});
            radii.push_back(mix(0.0052f, 0.0013f, t * t));
        }
        m.append(make_tube(path, radii, 8, Look::instrument, 0.45f));
    }
    return m;
}

Mesh make_scissor_half(int side, float angle) {
    Mesh m;
    const auto s = float(side);
    m.append(make_tube({{-s * 0.003f, 0, -0.055f}, {-s * 0.0025f, 0, -0.03f}, {0, 0.001f, 0}},
                       {0.004f, 0.0034f, 0.0008f}, 8, Look::instrument, 0.45f));
    m.append(make_tube({{-s * 0.003f, 0, -0.055f},
                        {s * 0.004f, 0, -0.075f},
                        {s * 0.01f, 0, -0.12f},
                        {s * 0.014f, 0, -0.15f}},
                       {0.004f, 0.004f, 0.003f, 0.0028f}, 8, Look::instrument, 0.7f));
    m.append(finger_ring({s * 0.02f, 0, -0.166f}, 0.0125f, Look::gold));
    if (side > 0)
        m.append(make_cylinder(0.0035f, 0.006f, 10, Look::instrument),
                 translation({0, -0.003f, -0.058f}));
    Mesh turned;
    const F3 joint{0, 0, -0.058f};
    turned.append(m, translation(joint) * rotation({0, 1, 0}, s * angle) * translation(-joint));
    return turned;
}

Mesh make_clamp(float opening) {
    Mesh m;
    for (const int side : {-1, 1})
        m.append(make_scissor_half(side, opening));
    m.append(make_box({0.02f, 0.003f, 0.006f}, 0.001f, Look::instrument),
             translation({0, 0, -0.14f}));
    return m;
}

Mesh make_hand_retractor() {
    // A flat handle, and a blade bent down at the far end.
    Mesh m;
    m.append(make_tube({{0, 0.065f, -0.26f},
                        {0, 0.066f, -0.2f},
                        {0, 0.066f, -0.1f},
                        {0, 0.064f, -0.03f},
                        {0, 0.05f, -0.005f},
                        {0, 0.02f, 0.002f},
                        {0, 0, -0.008f}},
                       {0.012f, 0.0095f, 0.0085f, 0.012f, 0.016f, 0.017f, 0.015f}, 14,
                       Look::instrument, 0.14f, {0, 1, 0.3f}));
    return m;
}

Mesh make_suction() {
    Mesh m;
    m.append(make_tube({{0, 0, 0}, {0, 0.004f, -0.06f}, {0, 0.02f, -0.16f}, {0, 0.03f, -0.22f}},
                       {0.0032f, 0.0036f, 0.0045f, 0.009f}, 10, Look::instrument));
    return m;
}

}  // namespace theatron::synthetic
