// SPDX-License-Identifier: Apache-2.0
// Walls, floor, ceiling with its light panels, doors, cupboards and machines.
#include "synthetic/scene.h"

namespace theatron::synthetic {
namespace {

constexpr float half_x = 3.2f, half_z = 2.8f, room_height = 2.95f;

Mesh rectangle(F3 a, F3 b, F3 c, F3 d, Look look) {
    Mesh m;
    const F3 n = normalized(cross(b - a, c - a));
    for (const F3 p : {a, b, c, d})
        m.add_vertex(p, n, p);
    m.add_quad(0, 1, 2, 3, look);
    return m;
}

void put_box(Mesh& out, F3 centre, F3 size, Look look, float bevel = 0.008f) {
    out.append(make_box(size, bevel, look), translation(centre));
}

void add_castors(Mesh& out, F3 centre, float dx, float dz) {
    for (const float sx : {-1.0f, 1.0f})
        for (const float sz : {-1.0f, 1.0f}) {
            const Affine turned = translation(centre + F3{sx * dx, 0.045f, sz * dz}) *
                                  rotation({1, 0, 0}, pi / 2) * translation({0, -0.014f, 0});
            out.append(make_cylinder(0.045f, 0.028f, 16, Look::rubber), turned);
            put_box(out, centre + F3{sx * dx, 0.1f, sz * dz}, {0.03f, 0.05f, 0.04f}, Look::steel);
        }
}

// Opens towards -z of its own frame, bottom at the origin.
Mesh double_door() {
    Mesh m;
    put_box(m, {0, 1.07f, 0.02f}, {1.72f, 2.14f, 0.04f}, Look::steel);
    for (const float s : {-1.0f, 1.0f}) {
        put_box(m, {s * 0.41f, 1.04f, -0.02f}, {0.8f, 2.06f, 0.05f}, Look::door);
        put_box(m, {s * 0.3f, 1.5f, -0.045f}, {0.24f, 0.62f, 0.012f}, Look::window, 0.003f);
        put_box(m, {s * 0.41f, 0.2f, -0.048f}, {0.78f, 0.3f, 0.006f}, Look::steel, 0.002f);
        m.append(make_tube({{s * 0.07f, 0.9f, -0.08f}, {s * 0.07f, 1.25f, -0.08f}}, {0.012f}, 10,
                           Look::steel));
    }
    return m;
}

Mesh cupboard() {
    Mesh m;
    put_box(m, {0, 1.0f, 0}, {1.3f, 2.0f, 0.42f}, Look::white_plastic, 0.01f);
    for (const float s : {-1.0f, 1.0f}) {
        put_box(m, {s * 0.325f, 1.45f, -0.215f}, {0.6f, 1.0f, 0.02f}, Look::window, 0.004f);
        put_box(m, {s * 0.325f, 0.47f, -0.215f}, {0.6f, 0.82f, 0.02f}, Look::grey_plastic, 0.004f);
        put_box(m, {s * 0.06f, 0.8f, -0.235f}, {0.015f, 0.14f, 0.02f}, Look::steel, 0.004f);
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 4; ++k)
                put_box(m,
                        {s * 0.325f - 0.22f + 0.145f * float(k), 1.1f + 0.3f * float(i), -0.232f},
                        {0.11f, 0.12f + 0.02f * float((i + k) % 3), 0.006f},
                        (i + k) % 3 == 0   ? Look::blue_plastic
                        : (i + k) % 3 == 1 ? Look::white_plastic
                                           : Look::tray_cloth,
                        0.002f);
    }
    return m;
}

// The anaesthetist's machine; its front looks along +z of its own frame.
Mesh anaesthesia_machine() {
    Mesh m;
    put_box(m, {0, 0.55f, 0}, {0.6f, 0.75f, 0.5f}, Look::white_plastic, 0.03f);
    for (int i = 0; i < 3; ++i) {
        put_box(m, {0, 0.32f + 0.2f * float(i), 0.252f}, {0.5f, 0.17f, 0.02f}, Look::grey_plastic);
        put_box(m, {0, 0.35f + 0.2f * float(i), 0.272f}, {0.2f, 0.02f, 0.025f}, Look::dark_plastic);
    }
    put_box(m, {0, 0.95f, 0.05f}, {0.66f, 0.04f, 0.56f}, Look::grey_plastic, 0.015f);
    put_box(m, {0, 1.25f, -0.14f}, {0.6f, 0.56f, 0.2f}, Look::white_plastic, 0.03f);
    put_box(m, {0.02f, 1.3f, -0.02f}, {0.4f, 0.31f, 0.04f}, Look::dark_plastic, 0.012f);
    m.append(make_picture(0.36f, 0.27f, int(PictureNumber::anaesthesia), Look::screen),
             translation({0.02f, 1.3f, 0.003f}));
    for (int i = 0; i < 2; ++i) {  // vaporisers
        put_box(m, {-0.2f + 0.13f * float(i), 1.06f, 0.0f}, {0.1f, 0.16f, 0.12f},
                i ? Look::brick_yellow : Look::blue_plastic, 0.01f);
        m.append(make_cylinder(0.04f, 0.05f, 18, Look::dark_plastic),
                 translation({-0.2f + 0.13f * float(i), 1.14f, 0}));
    }
    // Breathing hoses, corrugated, towards the patient's head.
    for (int k = 0; k < 2; ++k) {
        std::vector<F3> path;
        std::vector<float> radii;
        for (int i = 0; i <= 90; ++i) {
            const float t = float(i) / 90;
            path.push_back({mix(0.25f, -0.06f, t), 1.0f + 0.2f * std::sin(pi * t) + 0.18f * t,
                            mix(0.28f, 0.96f, t) + 0.07f * float(k) * (1 - t)});
            radii.push_back(0.016f + 0.003f * float(i % 2));
        }
        m.append(make_tube(path, radii, 12, k ? Look::blue_plastic : Look::white_plastic));
    }
    add_castors(m, {}, 0.24f, 0.2f);
    return m;
}

Mesh drip_stand() {
    Mesh m;
    m.append(make_tube({{0, 0.1f, 0}, {0, 2.0f, 0}}, {0.013f}, 12, Look::steel));
    for (int i = 0; i < 5; ++i) {
        const float a = 2 * pi * float(i) / 5;
        const F3 out{std::cos(a), 0, std::sin(a)};
        m.append(
            make_tube({{0, 0.1f, 0}, out * 0.28f + F3{0, 0.08f, 0}}, {0.014f}, 8, Look::steel));
        m.append(make_ball({0.03f, 0.03f, 0.03f}, 12, Look::rubber),
                 translation(out * 0.28f + F3{0, 0.04f, 0}));
    }
    for (const float s : {-1.0f, 1.0f}) {
        m.append(make_tube({{0, 2.0f, 0}, {s * 0.12f, 2.03f, 0}}, {0.006f}, 8, Look::steel));
        Mesh bag = make_ball({0.065f, 0.13f, 0.025f}, 20, Look::clear_bag);
        m.append(bag, translation({s * 0.12f, 1.86f, 0}));
        m.append(
            make_tube({{s * 0.12f, 1.74f, 0}, {s * 0.1f, 1.5f, 0.02f}, {s * 0.04f, 1.2f, 0.04f}},
                      {0.004f}, 6, Look::clear_bag));
    }
    put_box(m, {0, 1.25f, 0.07f}, {0.14f, 0.2f, 0.12f}, Look::grey_plastic, 0.012f);
    return m;
}

Mesh bin(Look bag) {
    Mesh m;
    m.append(make_lathe({{0.19f, 0.06f},
                         {0.2f, 0.3f},
                         {0.205f, 0.62f},
                         {0.22f, 0.64f},
                         {0.2f, 0.65f},
                         {0.18f, 0.5f},
                         {0.0f, 0.48f}},
                        24, bag));
    m.append(make_lathe({{0.215f, 0.63f}, {0.225f, 0.64f}, {0.215f, 0.66f}, {0.2f, 0.65f}}, 24,
                        Look::steel));
    return m;
}

}  // namespace

void add_room_shell(Mesh& still) {
    const float x = half_x, z = half_z, h = room_height;
    still.append(rectangle({-x, 0, z}, {x, 0, z}, {x, 0, -z}, {-x, 0, -z}, Look::floor));
    still.append(rectangle({-x, h, -z}, {x, h, -z}, {x, h, z}, {-x, h, z}, Look::ceiling));
    // Each wall: a coved skirting, a panelled band, bright above.
    const F3 corners[4] = {{-x, 0, -z}, {x, 0, -z}, {x, 0, z}, {-x, 0, z}};
    for (int i = 0; i < 4; ++i) {
        const F3 a = corners[i], b = corners[(i + 1) % 4];
        const F3 inwards = normalized(cross(F3{0, 1, 0}, a - b));
        const F3 lift1{0, 0.12f, 0}, lift2{0, 1.3f, 0}, top{0, h, 0};
        still.append(rectangle(a, b, b + lift1, a + lift1, Look::grey_plastic));
        still.append(rectangle(a + lift1, b + lift1, b + lift2, a + lift2, Look::wall_panel));
        still.append(rectangle(a + lift2, b + lift2, b + top, a + top, Look::wall));
        const F3 along = b - a;
        Mesh rail = make_box({length(along) - 0.1f, 0.14f, 0.025f}, 0.006f, Look::grey_plastic);
        const F3 middle = (a + b) * 0.5f + F3{0, 1.0f, 0} + inwards * 0.012f;
        still.append(rail, facing(middle, inwards, {0, 1, 0}));
    }
    for (const float px : {-1.6f, 0.0f, 1.6f})
        for (const float pz : {-1.5f, 1.5f}) {
            put_box(still, {px, h - 0.01f, pz}, {1.2f, 0.03f, 0.6f}, Look::white_plastic, 0.004f);
        }
}

void add_room_furniture(Mesh& still) {
    still.append(double_door(), facing({1.4f, 0, half_z - 0.02f}, {0, 0, 1}, {0, 1, 0}));
    still.append(double_door(), facing({-half_x + 0.02f, 0, 1.3f}, {-1, 0, 0}, {0, 1, 0}));
    still.append(cupboard(), facing({-1.1f, 0, half_z - 0.23f}, {0, 0, 1}, {0, 1, 0}));
    still.append(cupboard(), facing({half_x - 0.23f, 0, -0.5f}, {1, 0, 0}, {0, 1, 0}));
    still.append(cupboard(), facing({-0.55f, 0, -half_z + 0.23f}, {0, 0, -1}, {0, 1, 0}));
    still.append(anaesthesia_machine(), facing({-1.75f, 0, -0.55f}, {0.8f, 0, 0.45f}, {0, 1, 0}));
    still.append(drip_stand(), translation({-1.15f, 0, -0.85f}));
    still.append(bin(Look::brick_yellow), translation({1.75f, 0, 1.2f}));
    still.append(bin(Look::white_plastic), translation({2.1f, 0, 0.85f}));
    Mesh dial;
    dial.append(make_picture(0.36f, 0.36f, int(PictureNumber::clock), Look::paper));
    still.append(dial, facing({1.5f, 2.3f, -half_z + 0.02f}, {0, 0, 1}, {0, 1, 0}));
    // An instrument table along the wall, with boxes and bowls.
    Mesh side;
    put_box(side, {0, 0.88f, 0}, {1.1f, 0.03f, 0.5f}, Look::steel, 0.006f);
    put_box(side, {0, 0.9f, 0}, {1.06f, 0.02f, 0.48f}, Look::tray_cloth, 0.006f);
    for (const float sx : {-0.5f, 0.5f})
        for (const float sz : {-0.2f, 0.2f})
            side.append(make_tube({{sx, 0.05f, sz}, {sx, 0.87f, sz}}, {0.013f}, 10, Look::steel));
    put_box(side, {0, 0.25f, 0}, {1.0f, 0.02f, 0.42f}, Look::steel, 0.004f);
    const std::vector<std::pair<float, float>> bowl{
        {0.0f, 0.0f},    {0.05f, 0.0f},  {0.1f, 0.05f},    {0.125f, 0.09f},
        {0.13f, 0.095f}, {0.12f, 0.09f}, {0.095f, 0.055f}, {0.0f, 0.012f}};
    side.append(make_lathe(bowl, 28, Look::instrument), translation({-0.35f, 0.91f, 0.05f}));
    side.append(make_lathe(bowl, 28, Look::instrument), translation({-0.05f, 0.91f, -0.08f}));
    put_box(side, {0.32f, 0.96f, 0}, {0.3f, 0.1f, 0.22f}, Look::steel, 0.01f);
    side.append(make_picture(0.18f, 0.09f, int(PictureNumber::label), Look::paper),
                translation({0.32f, 0.96f, 0.112f}));
    still.append(side, facing({1.75f, 0, -1.75f}, {-0.5f, 0, 1}, {0, 1, 0}));
    still.append(side, facing({-0.55f, 0, 1.95f}, {0.2f, 0, -1}, {0, 1, 0}));
}

}  // namespace theatron::synthetic
