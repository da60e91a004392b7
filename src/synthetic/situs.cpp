// SPDX-License-Identifier: Apache-2.0
// The open belly: stained skin, the wound's edge with fat and muscle, a frame
// with retractors, and in the depth liver, gall bladder, bowel and vessels.
//
// The surgeon stands on the patient's right, at +z; the head is at -x. The liver therefore
// extends from -x and +z.
#include "synthetic/implicit.h"
#include "synthetic/noise.h"
#include "synthetic/patient.h"
#include "synthetic/scene.h"

namespace theatron::synthetic {
namespace {

constexpr float skin_y = 1.094f;  // the belly at the wound

// A point of the wound: angle `turn`, `scale` relative to the window, `depth` below the skin.
F3 wound_point(float turn, float scale, float depth) {
    const float c = std::cos(turn), s = std::sin(turn);
    const float reach = 1 / window_distance(c, s);
    const float x = c * reach * scale, z = s * reach * scale;
    const float skin = std::max(body_height(x, z), skin_y - 0.01f);
    return {x, mix(skin, skin_y, smoothstep(0.0f, 0.02f, depth)) - depth, z};
}

// The ring-shaped wall from the skin down to the floor, row by row.
Mesh wound_wall(double detail) {
    struct Row {
        float scale, depth;
        Look look;  // of the strip from here to the next row
        float rough;
    };
    static constexpr Row rows[] = {{1.08f, -0.001f, Look::patient_skin, 0},
                                   {0.97f, 0.000f, Look::patient_skin, 0},
                                   {0.90f, 0.000f, Look::patient_skin, 0.0005f},
                                   {0.85f, -0.003f, Look::patient_skin, 0.001f},
                                   {0.815f, -0.005f, Look::patient_skin, 0.001f},
                                   {0.795f, -0.002f, Look::patient_skin, 0.001f},
                                   {0.785f, 0.003f, Look::fat, 0.0015f},
                                   {0.765f, 0.008f, Look::fat, 0.005f},
                                   {0.75f, 0.014f, Look::fat, 0.006f},
                                   {0.745f, 0.02f, Look::fat, 0.005f},
                                   {0.75f, 0.027f, Look::muscle, 0.0015f},
                                   {0.73f, 0.031f, Look::muscle, 0.002f},
                                   {0.735f, 0.038f, Look::muscle, 0.002f},
                                   {0.76f, 0.043f, Look::peritoneum, 0.002f},
                                   {0.86f, 0.06f, Look::peritoneum, 0.003f},
                                   {0.95f, 0.085f, Look::peritoneum, 0.003f},
                                   {0.8f, 0.115f, Look::peritoneum, 0.005f},
                                   {0.4f, 0.125f, Look::peritoneum, 0.006f},
                                   {0.02f, 0.125f, Look::peritoneum, 0.0f}};
    constexpr int count = int(std::size(rows));
    const int around = int(300 * std::sqrt(detail));
    constexpr int between = 3;  // additional strips between the rows
    Mesh m;
    for (int i = 0; i < (count - 1) * between + 1; ++i) {
        const int k = std::min(i / between, count - 2);
        const float t = float(i - k * between) / between;
        const Row &a = rows[k], &b = rows[k + 1];
        for (int j = 0; j < around; ++j) {
            const float turn = 2 * pi * float(j) / float(around);
            // The cut is not quite regular.
            const float ragged = 0.02f * fractal({3 * std::cos(turn), 3 * std::sin(turn), 9}, 3) *
                                 smoothstep(0.9f, 0.8f, mix(a.scale, b.scale, t));
            F3 p = wound_point(turn, mix(a.scale, b.scale, t) + ragged, mix(a.depth, b.depth, t));
            const float rough = mix(a.rough, b.rough, t);
            const F3 bump{fractal(p * 90.0f, 3), fractal(p * 90.0f + F3{5, 0, 0}, 3),
                          fractal(p * 90.0f + F3{0, 5, 0}, 3)};
            m.add_vertex(p + bump * rough, {}, p);
            m.openness.back() = mix(1.0f, 0.35f, smoothstep(0.0f, 0.11f, mix(a.depth, b.depth, t)));
        }
    }
    const auto at = [&](int i, int j) { return std::uint32_t(i * around + j % around); };
    for (int i = 0; i < (count - 1) * between; ++i)
        for (int j = 0; j < around; ++j)
            m.add_quad(at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j),
                       rows[i / between].look);
    smooth_normals(m);
    if (dot(m.normals[0], {0, 1, 0}) < 0) {
        for (Triangle& t : m.triangles)
            std::swap(t.b, t.c);
        smooth_normals(m);
    }
    return m;
}

// Vertices below the situs' rim get less light.
void darken_deep(Mesh& m) {
    for (std::size_t i = 0; i < m.positions.size(); ++i) {
        const F3 p = m.positions[i];
        const float wall = smoothstep(1.05f, 0.55f, window_distance(p.x, p.z));
        m.openness[i] *= mix(mix(0.45f, 0.8f, wall), 1.0f, smoothstep(1.0f, 1.09f, p.y));
    }
}

Mesh liver_mesh(float cell) {
    const Distance shape = [](F3 p) {
        // A flat wedge with a sharp front edge, and a smaller lobe beside it.
        const float right = ellipsoid(p, {-0.085f, 1.012f, 0.055f}, {0.125f, 0.048f, 0.085f});
        const float left = ellipsoid(p, {-0.075f, 1.02f, -0.04f}, {0.085f, 0.034f, 0.06f});
        float d = blend(right, left, 0.018f);
        // The notch where the ligament runs.
        d = without(d, capsule(p, {-0.2f, 1.075f, 0.0f}, {0.06f, 1.045f, -0.002f}, 0.009f, 0.012f),
                    0.012f);
        return d + 0.0022f * fractal(p * 26.0f, 2);
    };
    return make_surface(shape, {-0.23f, 0.94f, -0.12f}, {0.07f, 1.09f, 0.16f}, cell, Look::liver);
}

Mesh bowel_mesh(float cell) {
    // One long winding tube with constrictions.
    std::vector<F3> path;
    for (int i = 0; i <= 60; ++i) {
        const float t = float(i) / 60;
        path.push_back({0.145f - 0.09f * t + 0.03f * std::sin(t * 23),
                        0.995f + 0.017f * std::sin(t * 31 + 1) - 0.012f * t,
                        0.1f * std::cos(t * 10.5f) - 0.01f});
    }
    const Distance shape = [path](F3 p) {
        float best = 1;
        for (std::size_t i = 0; i + 1 < path.size(); ++i) {
            float along;
            const float r = 0.0215f;
            const float d = capsule(p, path[i], path[i + 1], r, r, &along);
            const float s = (float(i) + along) * 0.9f;
            best = blend(best, d + 0.0016f * std::sin(s * 2.6f), 0.006f);
        }
        return best + 0.0012f * fractal(p * 60.0f, 2);
    };
    return make_surface(shape, {-0.04f, 0.94f, -0.16f}, {0.21f, 1.06f, 0.15f}, cell, Look::bowel);
}

Mesh gallbladder_mesh(float cell) {
    const Distance shape = [](F3 p) {
        return capsule(p, {0.03f, 1.028f, 0.075f}, {-0.03f, 1.0f, 0.03f}, 0.0185f, 0.009f) +
               0.0006f * fractal(p * 90.0f, 2);
    };
    return make_surface(shape, {-0.06f, 0.97f, 0.0f}, {0.07f, 1.06f, 0.11f}, cell,
                        Look::gallbladder);
}

Mesh omentum_mesh(float cell) {
    const Distance shape = [](F3 p) {
        const float apron = ellipsoid(p, {0.06f, 1.005f, -0.075f}, {0.085f, 0.026f, 0.05f});
        return apron + 0.006f * fractal(p * 48.0f, 3);
    };
    return make_surface(shape, {-0.05f, 0.95f, -0.15f}, {0.17f, 1.06f, 0.0f}, cell, Look::fat);
}

Mesh vessels_mesh() {
    Mesh m;
    const auto vessel = [&](std::vector<F3> corners, float r0, float r1, Look look) {
        // Rounded by repeated halving.
        for (int k = 0; k < 3; ++k) {
            std::vector<F3> finer{corners.front()};
            for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
                finer.push_back(mix(corners[i], corners[i + 1], 0.25f));
                finer.push_back(mix(corners[i], corners[i + 1], 0.75f));
            }
            finer.push_back(corners.back());
            corners = finer;
        }
        std::vector<float> radii;
        for (std::size_t i = 0; i < corners.size(); ++i)
            radii.push_back(mix(r0, r1, float(i) / float(corners.size())));
        m.append(make_tube(corners, radii, 10, look));
    };
    vessel({{0.12f, 1.0f, -0.03f},
            {0.08f, 1.022f, 0.0f},
            {0.04f, 1.024f, 0.01f},
            {0.0f, 1.02f, -0.01f}},
           0.006f, 0.0045f, Look::vein);
    vessel({{0.1f, 1.0f, -0.09f},
            {0.07f, 1.026f, -0.06f},
            {0.03f, 1.03f, -0.03f},
            {-0.01f, 1.03f, -0.02f}},
           0.0042f, 0.003f, Look::artery);
    vessel({{0.07f, 1.026f, -0.06f}, {0.06f, 1.03f, -0.09f}, {0.07f, 1.03f, -0.12f}}, 0.0025f,
           0.0012f, Look::artery);
    vessel({{0.03f, 1.03f, -0.03f}, {0.04f, 1.035f, 0.02f}, {0.06f, 1.03f, 0.05f}}, 0.0025f, 0.001f,
           Look::artery);
    vessel({{0.03f, 1.024f, 0.01f}, {0.035f, 1.03f, 0.05f}, {0.055f, 1.025f, 0.09f}}, 0.003f,
           0.0015f, Look::vein);
    return m;
}

// A blade hooked over the wound's edge. In its own frame the hook is at the origin and pulls
// along +z.
Mesh blade(float width) {
    return make_sheet(
        10, 40,
        [&](float u, float v) {
            // Down into the wound, bent over the edge, a flat handle outwards.
            static constexpr F3 path[] = {{0, -0.062f, -0.014f}, {0, -0.055f, -0.006f},
                                          {0, -0.02f, -0.001f},  {0, 0.004f, 0.001f},
                                          {0, 0.013f, 0.012f},   {0, 0.015f, 0.03f},
                                          {0, 0.016f, 0.075f}};
            const float s = v * 6;
            const int i = std::min(int(s), 5);
            F3 p = mix(path[i], path[i + 1], s - float(i));
            const float half = width / 2 * mix(1.0f, 0.4f, smoothstep(0.6f, 0.8f, v));
            p.x = (u - 0.5f) * 2 * half;
            p.z -= 0.006f * (1 - (2 * u - 1) * (2 * u - 1)) * (1 - v);
            return p;
        },
        Look::instrument);
}

void add_retractors(Mesh& m) {
    // An oval ring above the skin, with blades fixed to it.
    std::vector<F3> ring;
    for (int i = 0; i <= 72; ++i) {
        const float a = 2 * pi * float(i) / 72;
        F3 p = wound_point(a, 1.2f, -0.02f);
        p.y = 1.118f - 0.25f * p.z * p.z;
        ring.push_back(p);
    }
    m.append(make_tube(ring, {0.0048f}, 12, Look::instrument));
    for (const float degrees : {28.0f, 152.0f, 205.0f, 335.0f}) {
        const float a = degrees * pi / 180;
        const F3 at = wound_point(a, 0.79f, 0);
        const F3 outward = normalized(F3{at.x * 0.7f, 0, at.z});
        Mesh b = blade(0.034f);
        Mesh reverse = b;
        for (Triangle& t : reverse.triangles)
            std::swap(t.b, t.c);
        for (F3& n : reverse.normals)
            n = -n;
        b.append(reverse);
        m.append(b, facing(at + F3{0, 0.004f, 0}, outward, {0, 1, 0}));
        m.append(make_box({0.016f, 0.014f, 0.02f}, 0.003f, Look::instrument),
                 facing(wound_point(a, 1.19f, -0.02f) + F3{0, 0.004f, 0}, outward, {0, 1, 0}));
    }
}

void add_gauze(Mesh& m) {
    struct Pad {
        float x, z, turn, size;
    };
    for (const Pad pad : {Pad{0.02f, 0.148f, 0.1f, 0.1f}, Pad{-0.14f, -0.135f, 0.5f, 0.085f},
                          Pad{0.17f, -0.1f, 1.1f, 0.08f}}) {
        Mesh g = make_sheet(
            26, 26,
            [&](float u, float v) {
                const float lx = (u - 0.5f) * pad.size, lz = (0.5f - v) * pad.size * 0.7f;
                const float c = std::cos(pad.turn), s = std::sin(pad.turn);
                const float x = pad.x + lx * c + lz * s, z = pad.z - lx * s + lz * c;
                const float edge = std::max(std::abs(u - 0.5f), std::abs(v - 0.5f)) * 2;
                const float y = std::max(body_height(x, z), skin_y - 0.012f) + 0.013f -
                                0.008f * smoothstep(0.8f, 1.0f, edge) +
                                0.004f * fractal({x * 45, pad.turn, z * 45}, 3);
                // Its inner edge sinks into the wound.
                const float in = smoothstep(0.86f, 0.66f, window_distance(x, z));
                return F3{x, y - 0.02f * in, z};
            },
            Look::gauze);
        m.append(g);
    }
}

}  // namespace

void add_situs(Mesh& still, MovingMesh& moving, double detail) {
    const float cell = 0.0028f / float(std::sqrt(detail));
    Mesh organs = liver_mesh(cell);
    organs.append(bowel_mesh(cell));
    organs.append(gallbladder_mesh(cell));
    organs.append(omentum_mesh(cell));
    organs.append(vessels_mesh());
    darken_deep(organs);
    moving.append(organs, organ);

    Mesh wall = wound_wall(detail);
    Mesh tools;
    add_retractors(tools);
    add_gauze(tools);
    wall.append(tools);
    moving.append(wall, breath);

    // A suction hose and a cable over the cover and down its side.
    const auto lay = [&](float x0, float x1, float radius, Look look) {
        std::vector<F3> path;
        for (int i = 0; i <= 60; ++i) {
            const float t = float(i) / 60;
            const float z = -0.1f - 0.26f * t;
            const float x = mix(x0, x1, t) + 0.02f * std::sin(t * 9);
            const float over = smoothstep(0.28f, 0.36f, -z);
            path.push_back(
                {x, body_height(x, std::max(z, -0.3f)) + 0.024f - 0.35f * over * over, z});
        }
        still.append(make_tube(path, {radius}, 10, look));
    };
    lay(-0.2f, -0.3f, 0.006f, Look::clear_bag);
    lay(0.2f, 0.33f, 0.0035f, Look::blue_plastic);
}

}  // namespace theatron::synthetic
