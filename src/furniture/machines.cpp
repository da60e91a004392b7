// SPDX-License-Identifier: Apache-2.0
// Machines and carts.
#include <cmath>
#include <numbers>

#include "furniture/pieces.h"

namespace theatron::furniture {
namespace {

constexpr double pi = std::numbers::pi;

void add_castors(Model& m, double x, double z, double radius = 0.06) {
    for (const double sx : {-1.0, 1.0})
        for (const double sz : {-1.0, 1.0}) {
            const Pose lying{rotation_about({1, 0, 0}, pi / 2), {sx * x, radius, sz * z - 0.018}};
            m.turned_round(Material::rubber, lying,
                           {{0, 0}, {radius, 0}, {radius, 0.036}, {0, 0.036}}, 10);
            m.box(Material::grey_plastic, {sx * x - 0.02, radius, sz * z - 0.03},
                  {sx * x + 0.02, 2 * radius + 0.015, sz * z + 0.03}, 0.006);
        }
}

void add_knob(Model& m, Vec3 at, double radius, Material material = Material::grey_plastic) {
    m.turned_round(material, {rotation_about({1, 0, 0}, pi / 2), at},
                   {{0, 0}, {radius, 0}, {0.85 * radius, 0.022}, {0, 0.022}}, 10);
}

void add_drawers(Model& m, double half_width, double front, double low, double high, int count) {
    const double each = (high - low) / count;
    for (int i = 0; i < count; ++i) {
        const double y = low + each * i;
        m.box(Material::white_plastic, {-half_width, y + 0.006, front - 0.01},
              {half_width, y + each - 0.006, front + 0.014}, 0.005);
        m.rod(Material::chrome,
              {{-0.09, y + 0.6 * each, front + 0.012},
               {-0.09, y + 0.6 * each, front + 0.036},
               {0.09, y + 0.6 * each, front + 0.036},
               {0.09, y + 0.6 * each, front + 0.012}},
              0.006, 6);
    }
}

// A monitor on an arm: `at` is the middle of its picture, turned about y.
void add_monitor(Model& m, Vec3 at, double width, double height, double turn) {
    const Pose pose{rotation_about({0, 1, 0}, turn), at};
    m.turned_box(Material::grey_plastic, pose, {width, height, 0.05}, 0.012);
    m.turned_box(Material::screen, {pose.rotation, pose * Vec3{0, 0.006, 0.024}},
                 {width - 0.045, height - 0.055, 0.008}, 0.002);
}

}  // namespace

Model anaesthesia_machine() {
    Model m;
    add_castors(m, 0.30, 0.25);
    m.box(Material::grey_enamel, {-0.38, 0.12, -0.33}, {0.38, 0.2, 0.33}, 0.02);
    m.box(Material::enamel, {-0.36, 0.19, -0.32}, {0.36, 0.80, 0.26}, 0.02);
    add_drawers(m, 0.31, 0.262, 0.24, 0.76, 3);
    // The writing desk, and the housing behind it.
    m.box(Material::steel, {-0.38, 0.80, -0.33}, {0.38, 0.83, 0.38}, 0.01);
    m.rod(Material::chrome,
          {{-0.36, 0.815, 0.37}, {-0.36, 0.815, 0.43}, {0.36, 0.815, 0.43}, {0.36, 0.815, 0.37}},
          0.012, 6);
    m.box(Material::enamel, {-0.36, 0.82, -0.33}, {0.36, 1.36, 0.06}, 0.02);
    m.box(Material::grey_plastic, {-0.33, 1.0, 0.05}, {0.33, 1.3, 0.066}, 0.006);
    // Flow tubes, gauges and vaporizers.
    for (int i = 0; i < 3; ++i)
        m.rod(Material::fluid, {{-0.28 + 0.05 * i, 1.06, 0.08}, {-0.28 + 0.05 * i, 1.27, 0.08}},
              0.014, 10);
    for (int i = 0; i < 3; ++i)
        add_knob(m, {-0.28 + 0.05 * i, 1.025, 0.066}, 0.016,
                 i == 0   ? Material::white_plastic
                 : i == 1 ? Material::blue
                          : Material::grey_plastic);
    for (int i = 0; i < 2; ++i) {
        const double x = 0.02 + 0.18 * i;
        m.box(Material::grey_enamel, {x - 0.065, 0.96, 0.06}, {x + 0.065, 1.18, 0.2}, 0.015);
        m.cylinder(i ? Material::yellow : Material::blue, {x, 1.175, 0.13}, 0.055, 0.055, 0.008,
                   12);
    }
    // The absorber with its bag and tubes.
    m.cylinder(Material::fluid, {-0.30, 0.62, 0.40}, 0.075, 0.17, 0.01, 16);
    m.cylinder(Material::grey_plastic, {-0.30, 0.78, 0.40}, 0.085, 0.05, 0.01, 16);
    m.rod(Material::steel, {{-0.30, 0.81, 0.33}, {-0.30, 0.81, 0.40}}, 0.02, 10);
    m.round(
        Material::green, {-0.18, 0.42, 0.45},
        {{0, 0}, {0.05, 0.02}, {0.075, 0.1}, {0.065, 0.18}, {0.03, 0.26}, {0.02, 0.33}, {0, 0.33}},
        12);
    m.rod(Material::steel, {{-0.18, 0.74, 0.45}, {-0.19, 0.80, 0.44}, {-0.26, 0.81, 0.42}}, 0.014,
          8);
    for (const double s : {0.0, 1.0}) {
        std::vector<Vec3> hose;
        for (int i = 0; i <= 9; ++i) {
            const double t = i / 9.0;
            hose.push_back({-0.36 - 0.36 * t, 0.80 - 0.42 * std::sin(pi * t) + 0.2 * t,
                            0.40 + 0.06 * s + 0.05 * t});
        }
        m.rod(Material::grey_plastic, hose, 0.016, 6);
    }
    // The shelf above, with two screens.
    m.box(Material::enamel, {-0.37, 1.36, -0.33}, {0.37, 1.40, 0.10}, 0.012);
    m.rod(Material::steel, {{-0.12, 1.39, -0.15}, {-0.12, 1.62, -0.12}}, 0.022, 10);
    add_monitor(m, {-0.15, 1.62, -0.05}, 0.46, 0.34, 0.12);
    m.rod(Material::steel, {{0.24, 1.39, -0.15}, {0.24, 1.54, -0.12}}, 0.018, 10);
    add_monitor(m, {0.25, 1.54, -0.06}, 0.28, 0.22, -0.2);
    // Gas bottles behind.
    for (const double x : {-0.16, 0.16})
        m.round(x < 0 ? Material::white_plastic : Material::blue, {x, 0.14, -0.40},
                {{0, 0},
                 {0.065, 0.0},
                 {0.07, 0.01},
                 {0.07, 0.52},
                 {0.05, 0.6},
                 {0.02, 0.64},
                 {0.02, 0.7},
                 {0, 0.7}},
                12);
    return m;
}

Model electrosurgery_cart() {
    Model m;
    add_castors(m, 0.22, 0.2, 0.05);
    m.box(Material::grey_enamel, {-0.28, 0.1, -0.26}, {0.28, 0.15, 0.26}, 0.015);
    for (const double x : {-0.26, 0.26})
        for (const double z : {-0.23, 0.21})
            m.rod(Material::enamel, {{x, 0.14, z}, {x, 1.06, z}}, 0.014, 6);
    for (const double y : {0.45, 0.75, 1.05})
        m.box(Material::enamel, {-0.28, y - 0.022, -0.26}, {0.28, y, 0.24}, 0.008);
    m.box(Material::white_plastic, {-0.23, 1.05, -0.22}, {0.23, 1.22, 0.2}, 0.015);
    m.box(Material::screen, {-0.19, 1.1, 0.196}, {-0.02, 1.19, 0.204}, 0.003);
    for (int i = 0; i < 3; ++i)
        add_knob(m, {0.04 + 0.065 * i, 1.15, 0.198}, 0.02,
                 i == 0   ? Material::yellow
                 : i == 1 ? Material::blue
                          : Material::grey_plastic);
    m.box(Material::grey_enamel, {-0.22, 0.75, -0.2}, {0.22, 0.89, 0.2}, 0.012);
    for (int i = 0; i < 4; ++i)
        add_knob(m, {-0.15 + 0.1 * i, 0.82, 0.198}, 0.016);
    m.box(Material::grey_plastic, {-0.2, 0.45, -0.18}, {0.15, 0.60, 0.18}, 0.012);
    m.box(Material::blue, {-0.19, 0.15, -0.15}, {0.19, 0.26, 0.17}, 0.02);
    std::vector<Vec3> cable;
    for (int i = 0; i <= 10; ++i) {
        const double t = i / 10.0;
        cable.push_back({0.04 + 0.25 * t, 1.15 - 0.5 * std::sin(pi * t) * 0.9 - 0.1 * t,
                         0.215 + 0.03 * std::sin(pi * t)});
    }
    m.rod(Material::rubber, cable, 0.006, 6);
    return m;
}

Model infusion_stand() {
    Model m;
    for (int i = 0; i < 5; ++i) {
        const double a = 2 * pi * (i + 0.25) / 5;
        const Vec3 end{0.27 * std::cos(a), 0.085, 0.27 * std::sin(a)};
        m.rod(Material::chrome, {{0, 0.1, 0}, end}, 0.014, 6);
        m.round(Material::rubber, {end.x, 0, end.z},
                {{0, 0}, {0.018, 0.006}, {0.03, 0.035}, {0.018, 0.065}, {0.01, 0.085}, {0, 0.085}},
                10);
    }
    m.cylinder(Material::chrome, {0, 0.08, 0}, 0.018, 1.0, 0.003, 12);
    m.cylinder(Material::chrome, {0, 1.05, 0}, 0.011, 0.98, 0.003, 12);
    m.cylinder(Material::grey_plastic, {0, 1.03, 0}, 0.026, 0.06, 0.006, 10);
    for (const double s : {-1.0, 1.0}) {
        m.rod(Material::chrome,
              {{0, 2.0, 0},
               {s * 0.1, 2.02, 0},
               {s * 0.16, 2.0, 0},
               {s * 0.165, 1.965, 0},
               {s * 0.185, 1.975, 0}},
              0.006, 6);
        m.rod(Material::chrome,
              {{0, 1.99, 0},
               {0, 2.01, s * 0.1},
               {0, 1.99, s * 0.16},
               {0, 1.955, s * 0.165},
               {0, 1.965, s * 0.185}},
              0.006, 6);
        m.box(Material::fluid, {s * 0.165 - 0.06, 1.66, -0.018}, {s * 0.165 + 0.06, 1.93, 0.018},
              0.017);
        m.box(Material::white_plastic, {s * 0.165 - 0.015, 1.92, -0.004},
              {s * 0.165 + 0.015, 1.975, 0.004}, 0.003);
        m.cylinder(Material::fluid, {s * 0.165, 1.53, 0}, 0.014, 0.09, 0.004, 10);
        m.rod(Material::fluid, {{s * 0.165, 1.67, 0}, {s * 0.165, 1.61, 0}}, 0.004, 6);
        m.rod(Material::fluid,
              {{s * 0.165, 1.54, 0}, {s * 0.16, 1.36, 0.03}, {s * 0.09, 1.3, 0.06}}, 0.003, 5);
    }
    // An infusion pump.
    m.box(Material::white_plastic, {-0.1, 1.18, 0.02}, {0.1, 1.36, 0.14}, 0.014);
    m.box(Material::screen, {-0.07, 1.26, 0.136}, {0.07, 1.33, 0.143}, 0.002);
    m.box(Material::grey_plastic, {-0.03, 1.22, -0.03}, {0.03, 1.30, 0.03}, 0.006);
    return m;
}

Model suction_unit() {
    Model m;
    add_castors(m, 0.15, 0.15, 0.04);
    m.box(Material::grey_enamel, {-0.2, 0.09, -0.2}, {0.2, 0.13, 0.2}, 0.012);
    m.rod(Material::chrome, {{0, 0.12, 0}, {0, 1.0, 0}, {0.06, 1.06, 0}, {0.14, 1.06, 0}}, 0.014,
          10);
    m.cylinder(Material::steel, {0, 0.72, 0}, 0.03, 0.05, 0.006, 10);
    for (const double s : {-1.0, 1.0}) {
        m.cylinder(Material::fluid, {s * 0.115, 0.42, 0}, 0.082, 0.26, 0.012, 16);
        m.cylinder(s < 0 ? Material::yellow : Material::white_plastic, {s * 0.115, 0.675, 0}, 0.088,
                   0.03, 0.006, 16);
        m.rod(Material::steel, {{0, 0.745, 0}, {s * 0.115, 0.745, 0}, {s * 0.115, 0.70, 0}}, 0.009,
              8);
    }
    m.box(Material::grey_plastic, {-0.12, 0.13, -0.12}, {0.12, 0.3, 0.12}, 0.02);
    return m;
}

Model ultrasound_cart() {
    Model m;
    add_castors(m, 0.2, 0.24, 0.055);
    m.box(Material::grey_plastic, {-0.25, 0.11, -0.3}, {0.25, 0.2, 0.3}, 0.03);
    m.box(Material::white_plastic, {-0.17, 0.19, -0.25}, {0.17, 0.78, 0.1}, 0.03);
    m.turned_box(Material::white_plastic, {rotation_about({1, 0, 0}, 0.18), {0, 0.88, 0.08}},
                 {0.5, 0.09, 0.42}, 0.025);
    m.turned_box(Material::grey_plastic, {rotation_about({1, 0, 0}, 0.18), {0, 0.924, 0.088}},
                 {0.42, 0.012, 0.32}, 0.004);
    m.rod(Material::grey_plastic, {{0, 0.76, -0.16}, {0, 1.2, -0.16}, {0, 1.26, -0.10}}, 0.025, 10);
    add_monitor(m, {0, 1.28, -0.05}, 0.48, 0.32, 0);
    for (int i = 0; i < 3; ++i)
        m.cylinder(Material::grey_plastic, {0.28, 0.78, -0.04 + 0.09 * i}, 0.02, 0.13, 0.006, 10);
    m.box(Material::grey_plastic, {0.235, 0.80, -0.08}, {0.27, 0.84, 0.2}, 0.006);
    return m;
}

}  // namespace theatron::furniture
