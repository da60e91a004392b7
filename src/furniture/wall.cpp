// SPDX-License-Identifier: Apache-2.0
// Furniture that hangs on the walls.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "furniture/pieces.h"

namespace theatron::furniture {
namespace {

constexpr double pi = std::numbers::pi;
const Quat facing_room = rotation_about({1, 0, 0}, pi / 2);  // +y to +z

void add_disc(Model& m, Material material, Vec3 at, double radius, double depth, int sides = 16) {
    m.turned_round(material, {facing_room, at},
                   {{0, 0}, {radius, 0}, {radius, 0.7 * depth}, {0.9 * radius, depth}, {0, depth}},
                   sides);
}

}  // namespace

Model double_door() {
    Model m;
    const double top = 2.1, half = 0.85;
    // The frame.
    m.box(Material::steel, {-half - 0.08, 0, 0}, {-half, top + 0.08, 0.06}, 0.006);
    m.box(Material::steel, {half, 0, 0}, {half + 0.08, top + 0.08, 0.06}, 0.006);
    m.box(Material::steel, {-half - 0.002, top, 0}, {half + 0.002, top + 0.08, 0.06}, 0.006);
    for (const double s : {-1.0, 1.0}) {
        const double in = s * 0.004, out = s * (half - 0.003), l = std::min(in, out),
                     h = std::max(in, out);
        m.box(Material::enamel, {l, 0.008, 0.002}, {h, top - 0.004, 0.04}, 0.005);
        // A window with its frame, a handle, and the plate that beds and feet meet.
        const double x = s * 0.42;
        m.box(Material::grey_enamel, {x - 0.2, 1.28, 0.036}, {x + 0.2, 1.82, 0.048}, 0.004);
        m.box(Material::glass, {x - 0.165, 1.315, 0.04}, {x + 0.165, 1.785, 0.0505}, 0.002);
        m.box(Material::steel, {l + 0.02, 0.03, 0.036}, {h - 0.02, 0.42, 0.044}, 0.002);
        m.box(Material::steel, {s * 0.1 - 0.05, 0.86, 0.036}, {s * 0.1 + 0.05, 1.22, 0.043}, 0.002);
        m.rod(Material::chrome,
              {{s * 0.1, 0.92, 0.04},
               {s * 0.1, 0.92, 0.095},
               {s * 0.1, 1.16, 0.095},
               {s * 0.1, 1.16, 0.04}},
              0.012, 6);
    }
    // The opener above.
    m.box(Material::white_plastic, {-0.62, top + 0.085, 0}, {0.62, top + 0.19, 0.11}, 0.012);
    return m;
}

Model wall_monitor() {
    Model m;
    const double middle = 1.72, w = 0.63, h = 0.37;
    m.box(Material::grey_enamel, {-0.2, middle - 0.16, 0}, {0.2, middle + 0.16, 0.05}, 0.008);
    m.box(Material::black_plastic, {-w, middle - h, 0.045}, {w, middle + h, 0.1}, 0.014);
    m.box(Material::screen, {-w + 0.022, middle - h + 0.03, 0.09},
          {w - 0.022, middle + h - 0.022, 0.1035}, 0.003);
    m.box(Material::green, {w - 0.06, middle - h + 0.012, 0.096},
          {w - 0.045, middle - h + 0.017, 0.102}, 0.001);
    return m;
}

Model light_box() {
    Model m;
    const double middle = 1.62;
    m.box(Material::enamel, {-0.46, middle - 0.29, 0}, {0.46, middle + 0.29, 0.09}, 0.01);
    for (const double s : {-1.0, 1.0})
        m.box(Material::light, {s * 0.225 - 0.205, middle - 0.235, 0.08},
              {s * 0.225 + 0.205, middle + 0.215, 0.0935}, 0.004);
    m.box(Material::steel, {-0.44, middle + 0.225, 0.085}, {0.44, middle + 0.255, 0.1}, 0.004);
    for (int i = 0; i < 2; ++i)
        m.box(Material::grey_plastic, {0.30 + 0.06 * i, middle - 0.275, 0.086},
              {0.34 + 0.06 * i, middle - 0.25, 0.097}, 0.002);
    return m;
}

Model scrub_sink() {
    Model m;
    const double rim = 0.98, half = 0.75;
    // A trough: front, back, ends and a bottom that falls towards the wall.
    m.box(Material::steel, {-half, 0.62, 0}, {half, 1.42, 0.03}, 0.006);
    m.box(Material::steel, {-half, 0.62, 0.02}, {half, 0.66, 0.52}, 0.01);
    m.box(Material::steel, {-half, 0.63, 0.5}, {half, rim - 0.08, 0.53}, 0.01);
    for (const double s : {-1.0, 0.0, 1.0})
        m.box(Material::steel, {s * (half - 0.015) - 0.015, 0.63, 0.02},
              {s * (half - 0.015) + 0.015, rim - 0.06, 0.52}, 0.008);
    m.box(Material::grey_enamel, {-half + 0.1, 0.32, 0}, {half - 0.1, 0.63, 0.32}, 0.01);
    for (const double s : {-1.0, 1.0}) {
        const double x = s * 0.37;
        m.rod(Material::chrome,
              {{x, 1.16, 0.02},
               {x, 1.18, 0.1},
               {x, 1.24, 0.18},
               {x, 1.25, 0.24},
               {x, 1.2, 0.3},
               {x, 1.12, 0.31}},
              0.014, 7);
        m.box(Material::chrome, {x - 0.05, 1.12, 0.025}, {x + 0.05, 1.2, 0.05}, 0.008);
        // The lever that an elbow moves.
        m.rod(Material::chrome,
              {{x + 0.09, 1.15, 0.03}, {x + 0.09, 1.15, 0.08}, {x + 0.12, 1.13, 0.24}}, 0.009, 6);
        m.box(Material::white_plastic, {x - 0.25, 1.16, 0.025}, {x - 0.16, 1.38, 0.13}, 0.012);
        m.rod(Material::chrome,
              {{x - 0.205, 1.17, 0.11}, {x - 0.205, 1.14, 0.16}, {x - 0.205, 1.14, 0.28}}, 0.006,
              6);
        m.cylinder(Material::grey_plastic, {x, 0.655, 0.24}, 0.03, 0.01, 0.002, 14);
    }
    m.rod(Material::chrome, {{0, 0.33, 0.16}, {0, 0.2, 0.16}, {0, 0.17, 0.1}, {0, 0.17, 0.01}},
          0.025, 7);
    // Brushes in their box.
    m.box(Material::grey_plastic, {-0.1, 1.2, 0.025}, {0.1, 1.36, 0.12}, 0.008);
    m.box(Material::blue, {-0.08, 1.22, 0.115}, {0.08, 1.34, 0.125}, 0.003);
    return m;
}

Model dispenser() {
    Model m;
    m.box(Material::white_plastic, {-0.07, 1.15, 0}, {0.07, 1.42, 0.11}, 0.014);
    m.box(Material::fluid, {-0.055, 1.19, 0.1}, {0.055, 1.34, 0.118}, 0.006);
    m.rod(Material::chrome, {{0, 1.4, 0.09}, {0, 1.39, 0.14}, {0, 1.33, 0.25}}, 0.008, 6);
    m.box(Material::chrome, {-0.05, 1.08, 0.02}, {0.05, 1.088, 0.15}, 0.003);
    m.box(Material::blue, {-0.06, 1.425, 0}, {0.06, 1.6, 0.006}, 0.002);
    return m;
}

Model wall_clock() {
    Model m;
    const Vec3 at{0, clock_height_m, 0};
    m.turned_round(Material::grey_plastic, {facing_room, at},
                   {{0, 0},
                    {0.165, 0},
                    {0.172, 0.008},
                    {0.172, 0.045},
                    {0.165, 0.052},
                    {0.152, 0.052},
                    {0.15, 0.04},
                    {0, 0.04}},
                   36);
    m.turned_round(Material::white_plastic, {facing_room, at + Vec3{0, 0, 0.036}},
                   {{0, 0}, {0.149, 0}, {0.149, 0.006}, {0, 0.006}}, 28);
    for (int i = 0; i < 12; ++i) {
        const Quat turn = rotation_about({0, 0, 1}, -pi / 6 * i);
        const double l = i % 3 == 0 ? 0.03 : 0.018;
        m.turned_box(Material::black_plastic, {turn, at + rotate(turn, {0, 0.136 - l / 2, 0.042})},
                     {i % 3 == 0 ? 0.009 : 0.006, l, 0.002}, 0.0005);
    }
    return m;
}

Model clock_hand(double length_m, double width_m) {
    Model m;
    m.box(Material::black_plastic, {-width_m / 2, -0.2 * length_m, 0},
          {width_m / 2, length_m, 0.002}, 0.0006);
    return m;
}

Model socket_rail() {
    Model m;
    m.box(Material::enamel, {-0.9, 1.28, 0}, {0.9, 1.5, 0.06}, 0.008);
    m.box(Material::grey_enamel, {-0.89, 1.375, 0.056}, {0.89, 1.385, 0.063}, 0.002);
    for (int i = 0; i < 8; ++i)
        m.box(i % 4 == 3 ? Material::green : Material::white_plastic,
              {-0.85 + 0.1 * i, 1.395, 0.055}, {-0.77 + 0.1 * i, 1.475, 0.068}, 0.004);
    for (int i = 0; i < 6; ++i)
        m.box(Material::grey_plastic, {-0.85 + 0.1 * i, 1.295, 0.055},
              {-0.77 + 0.1 * i, 1.365, 0.066}, 0.004);
    const Material gases[] = {Material::white_plastic, Material::blue, Material::yellow,
                              Material::green};
    for (int i = 0; i < 4; ++i) {
        add_disc(m, Material::chrome, {0.2 + 0.18 * i, 1.39, 0.055}, 0.045, 0.025, 12);
        add_disc(m, gases[i], {0.2 + 0.18 * i, 1.39, 0.07}, 0.03, 0.03, 7);
    }
    return m;
}

Model air_grille() {
    Model m;
    m.box(Material::grey_enamel, {-0.3, 0.18, 0}, {0.3, 0.66, 0.012}, 0.004);
    for (int i = 0; i < 10; ++i)
        m.turned_box(Material::enamel,
                     {rotation_about({1, 0, 0}, 0.6), {0, 0.215 + 0.045 * i, 0.016}},
                     {0.55, 0.004, 0.036}, 0.001);
    m.box(Material::enamel, {-0.31, 0.17, 0}, {-0.275, 0.67, 0.026}, 0.004);
    m.box(Material::enamel, {0.275, 0.17, 0}, {0.31, 0.67, 0.026}, 0.004);
    m.box(Material::enamel, {-0.28, 0.17, 0}, {0.28, 0.195, 0.026}, 0.004);
    m.box(Material::enamel, {-0.28, 0.645, 0}, {0.28, 0.67, 0.026}, 0.004);
    return m;
}

Model door_panel() {
    Model m;
    m.box(Material::steel, {-0.16, 1.0, 0}, {0.16, 1.52, 0.02}, 0.005);
    m.box(Material::screen, {-0.12, 1.34, 0.016}, {0.12, 1.48, 0.023}, 0.002);
    for (int i = 0; i < 6; ++i)
        m.box(i == 0   ? Material::green
              : i == 5 ? Material::red
                       : Material::white_plastic,
              {-0.11 + 0.08 * (i % 3), 1.08 + 0.09 * (i / 3), 0.016},
              {-0.05 + 0.08 * (i % 3), 1.14 + 0.09 * (i / 3), 0.026}, 0.004);
    return m;
}

Model exit_sign() {
    Model m;
    // A running person and an arrow, as far as boxes show them.
    m.box(Material::green, {-0.2, 2.36, 0}, {0.2, 2.56, 0.03}, 0.006);
    m.box(Material::light, {0.03, 2.385, 0.026}, {0.15, 2.535, 0.0325}, 0.001);
    m.turned_box(Material::light, {rotation_about({0, 0, 1}, 0), {-0.1, 2.46, 0.0295}},
                 {0.1, 0.018, 0.006}, 0.001);
    m.turned_box(Material::light, {rotation_about({0, 0, 1}, 0.7), {-0.135, 2.443, 0.0295}},
                 {0.06, 0.018, 0.006}, 0.001);
    m.turned_box(Material::light, {rotation_about({0, 0, 1}, -0.7), {-0.135, 2.477, 0.0295}},
                 {0.06, 0.018, 0.006}, 0.001);
    return m;
}

}  // namespace theatron::furniture
