// SPDX-License-Identifier: Apache-2.0
// The draped patient: a sheet over the body, raised over the frame at the head and hanging
// down the table's sides in folds, with a window over the situs.
#include "synthetic/patient.h"

#include "synthetic/implicit.h"
#include "synthetic/noise.h"
#include "synthetic/scene.h"

namespace theatron::synthetic {
namespace {

constexpr float table_top = 0.925f;
constexpr float half_width = 0.30f;  // from the middle to the edge of the table

float cover_height(float x, float z) {
    float h = body_height(x, z) + 0.006f;
    // Rises to the frame in front of the patient's head.
    const float up = smoothstep(-0.50f, -0.665f, x);
    h = mix(h, 1.5f - 0.03f * smoothstep(0.15f, 0.42f, std::abs(z)), up);
    // Cloth spans hollows and wrinkles, calmer near the window where it is glued.
    const float calm = smoothstep(1.05f, 1.7f, window_distance(x, z));
    const float ridge = 1 - std::abs(noise({x * 9 + 3 * noise({x * 4, 0, z * 4}), 1.7f, z * 7}));
    h += calm * (0.006f * fractal({x * 11, 5, z * 11}, 3) + 0.011f * ridge * ridge * ridge);
    return h;
}

F3 cover_point(float u, float v) {
    // Along: from behind the frame to beyond the feet; across: both sides to the floor.
    const float along = mix(-0.672f, 1.72f, u);
    const float across = (v - 0.5f) * 2 * 0.98f;
    float drop_x = 0, drop_z = 0;
    float x = along;
    const auto leave = [](float s, float edge, float radius, float& drop) {
        const float beyond = std::abs(s) - edge;
        if (beyond <= 0)
            return s;
        const float arc = radius * pi / 2;
        if (beyond < arc) {
            drop = radius * (1 - std::cos(beyond / radius));
            return std::copysign(edge + radius * std::sin(beyond / radius), s);
        }
        drop = radius + beyond - arc;
        return std::copysign(edge + radius, s);
    };
    if (along > 0)
        x = leave(along, 1.11f, 0.05f, drop_x);
    // Near the frame at the head the sheet hangs from further out.
    const float raised = smoothstep(-0.5f, -0.66f, x);
    float z = leave(across, mix(half_width, 0.4f, raised), 0.045f, drop_z);
    const float drop = std::max(drop_x, drop_z) + 0.25f * std::min(drop_x, drop_z);
    float y = cover_height(x, z);
    const float edge_y = cover_height(x, std::copysign(std::min(std::abs(z), half_width), z));
    y = mix(y, edge_y, smoothstep(0.0f, 0.03f, drop_z)) - drop;
    // Folds that deepen on the way down.
    const float deep = smoothstep(0.02f, 0.45f, drop);
    const float t = drop_x > drop_z ? z : x;
    const float side = z > 0 ? 0.0f : 40.0f;
    const float wave = std::sin(t * 21 + 2.2f * noise({t * 3 + side, 0.5f, drop * 1.5f}) + side) +
                       0.45f * std::sin(t * 47 + 3 * noise({t * 5, 3 + side, drop * 2}));
    const float out = deep * (0.022f * wave + 0.035f) +
                      0.008f * smoothstep(0, 0.05f, drop) * fractal({t * 12, drop * 8, side}, 2);
    if (drop_x > drop_z)
        x += out;
    else
        z += std::copysign(out, z);
    return {x, std::max(y, 0.12f + 0.05f * deep), z};
}

}  // namespace

float body_height(float x, float z) {
    // Upper surfaces of ellipsoids and capsules, joined smoothly.
    const auto dome = [&](float cx, float cy, float cz, float rx, float ry, float rz) {
        const float dx = (x - cx) / rx, dz = (z - cz) / rz;
        return cy + ry * std::sqrt(std::max(1 - dx * dx - dz * dz, 0.0f)) -
               0.3f * smoothstep(1.0f, 1.3f, dx * dx + dz * dz);
    };
    const auto join = [](float a, float b, float k) { return -blend(-a, -b, k); };
    float h = table_top;
    h = join(h, dome(-0.32f, 0.93f, 0, 0.42f, 0.185f, 0.23f), 0.08f);  // chest
    h = join(h, dome(0.08f, 0.93f, 0, 0.46f, 0.165f, 0.225f), 0.08f);  // belly
    for (const float s : {-1.0f, 1.0f}) {
        h = join(h, dome(0.55f, 0.93f, s * 0.1f, 0.36f, 0.1f, 0.1f), 0.06f);
        h = join(h, dome(0.86f, 0.93f, s * 0.1f, 0.26f, 0.075f, 0.075f), 0.05f);
        h = join(h, dome(1.02f, 0.93f, s * 0.085f, 0.045f, 0.2f, 0.055f), 0.05f);  // toes up
    }
    return h;
}

void add_patient(Mesh& still, MovingMesh& moving, double detail) {
    const int nu = int(300 * std::sqrt(detail)), nv = int(280 * std::sqrt(detail));
    // Finer towards the window.
    const auto warp_u = [](float u) {
        constexpr float c = 0.32f;  // the window's place
        return u - 0.05f * (std::sin(2 * pi * (u - c)) + std::sin(2 * pi * c));
    };
    const auto warp_v = [](float v) { return v - 0.05f * std::sin(2 * pi * (v - 0.5f)); };
    Mesh sheet = make_sheet(
        nu, nv,
        [&](float u, float v) {
            F3 p = cover_point(clamp01(warp_u(u)), 1 - clamp01(warp_v(v)));
            // Vertices just inside the window's border are moved onto it, for a clean hem.
            const float d = window_distance(p.x, p.z);
            if (p.y > 1.0f && d < 1 && d > 0.86f) {
                p.x /= d;
                p.z /= d;
            }
            return p;
        },
        Look::drape);
    smooth_normals(sheet);
    Mesh back = sheet;  // the sheet's other side
    for (Triangle& t : back.triangles)
        std::swap(t.b, t.c);
    for (F3& n : back.normals)
        n = -n;

    Mesh low, high;  // static part, and part moved by the breath
    low.positions = high.positions = sheet.positions;
    low.normals = high.normals = sheet.normals;
    low.textures = high.textures = sheet.textures;
    low.openness = high.openness = sheet.openness;
    for (Triangle t : sheet.triangles) {
        const F3 a = sheet.positions[t.a], b = sheet.positions[t.b], c = sheet.positions[t.c];
        const F3 middle = (a + b + c) * (1.0f / 3);
        const bool over_body = middle.y > 0.98f && std::abs(middle.z) < 0.3f;
        const float d = window_distance(middle.x, middle.z);
        if (over_body && d < 0.995f)
            continue;
        const bool moves = breath_lift(a) + breath_lift(b) + breath_lift(c) > 0;
        (moves ? high : low).triangles.push_back(t);
    }
    const auto drop_unused = [](const Mesh& m) {
        Mesh out;
        std::vector<std::uint32_t> moved(m.positions.size(), ~0u);
        for (Triangle t : m.triangles) {
            for (std::uint32_t* v : {&t.a, &t.b, &t.c}) {
                if (moved[*v] == ~0u)
                    moved[*v] = out.add_vertex(m.positions[*v], m.normals[*v], m.textures[*v]);
                *v = moved[*v];
            }
            out.triangles.push_back(t);
        }
        return out;
    };
    still.append(drop_unused(low));
    for (std::size_t i = 0; i < back.positions.size(); ++i)
        back.positions[i] += back.normals[i] * 0.002f;
    std::erase_if(back.triangles, [&](const Triangle& t) {
        const F3 p = back.positions[t.a];
        return p.x > -0.5f && p.y > 0.9f;  // on the body: never visible from below
    });
    still.append(drop_unused(back));

    const Mesh belly = drop_unused(high);
    std::vector<Influence> influences;
    for (const F3 p : belly.positions) {
        const float lift = breath_lift(p);
        influences.push_back({{breath, Bone::still, 0, 0}, {lift, 1 - lift, 0, 0}});
        if (lift <= 0)
            influences.back() = {};
    }
    moving.append(belly, influences);

    // The head behind the frame: on its cushion, with a cap and a tube.
    const F3 head{-0.86f, 1.03f, 0};
    still.append(make_box({0.3f, 0.08f, 0.3f}, 0.035f, Look::mattress),
                 translation(head + F3{-0.02f, -0.075f, 0}));
    still.append(make_ball({0.11f, 0.095f, 0.078f}, 28, Look::patient_face), translation(head));
    still.append(make_ball({0.026f, 0.022f, 0.013f}, 16, Look::patient_face),
                 translation(head + F3{0.022f, 0.092f, 0}));
    for (const float s : {-1.0f, 1.0f}) {
        still.append(make_ball({0.028f, 0.018f, 0.009f}, 14, Look::patient_face),
                     translation(head + F3{-0.005f, 0.005f, s * 0.079f}));
        still.append(make_ball({0.008f, 0.009f, 0.014f}, 12, Look::patient_face),
                     translation(head + F3{-0.012f, 0.085f, s * 0.031f}));
    }
    still.append(make_ball({0.085f, 0.1f, 0.084f}, 28, Look::cap_assistant),
                 translation(head + F3{-0.04f, -0.004f, 0}));
    still.append(make_ball({0.04f, 0.02f, 0.034f}, 20, Look::clear_bag),
                 translation(head + F3{0.05f, 0.092f, 0}));
    still.append(make_tube({head + F3{0.05f, 0.1f, 0}, head + F3{0.04f, 0.2f, 0.05f},
                            head + F3{-0.06f, 0.22f, 0.2f}, head + F3{-0.16f, 0.02f, 0.34f}},
                           {0.012f}, 10, Look::clear_bag));
}

}  // namespace theatron::synthetic
