// SPDX-License-Identifier: Apache-2.0
// Furniture that hangs from the ceiling.
#include <cmath>
#include <numbers>

#include "furniture/pieces.h"

namespace theatron::furniture {
namespace {

constexpr double pi = std::numbers::pi;

// The rotation that takes +y to this direction.
Quat up_to(Vec3 direction) {
    const Vec3 d = normalized(direction), axis = cross({0, 1, 0}, d);
    return length(axis) < 1e-9 ? Quat{} : rotation_about(axis, std::acos(d.y));
}

void add_ceiling_mount(Model& model, Vec3 at, double radius) {
    model.round(Material::enamel, {at.x, at.y - 0.1, at.z},
                {{0, 0}, {0.7 * radius, 0}, {radius, 0.06}, {radius, 0.1}, {0, 0.1}}, 20);
}

}  // namespace

namespace {

void add_lamp(Model& m, int number, double room_height) {
    const Vec3 head = lamp_places[number];
    const Vec3 to_table = normalized(lamp_target - head);
    const Pose frame{up_to(to_table * -1), head};  // y away from the table
    // A dish with a ring of lights around a handle.
    m.turned_round(Material::enamel, frame,
                   {{0, 0.0},
                    {0.29, 0.0},
                    {lamp_radius_m, 0.015},
                    {lamp_radius_m + 0.006, 0.035},
                    {0.30, 0.065},
                    {0.2, 0.1},
                    {0.1, 0.118},
                    {0, 0.12}},
                   20);
    const auto light = [&](double x, double z, double radius) {
        const Pose place{frame.rotation, frame * Vec3{x, -0.006, z}};
        m.turned_round(Material::light, place, {{0, 0}, {radius, 0}, {radius, 0.008}, {0, 0.008}},
                       12);
    };
    for (int i = 0; i < 10; ++i)
        light(0.225 * std::cos(2 * pi * i / 10), 0.225 * std::sin(2 * pi * i / 10), 0.052);
    for (int i = 0; i < 5; ++i)
        light(0.115 * std::cos(2 * pi * i / 5), 0.115 * std::sin(2 * pi * i / 5), 0.042);
    m.turned_round(Material::white_plastic, {frame.rotation, frame * Vec3{0, -0.13, 0}},
                   {{0, 0}, {0.016, 0.004}, {0.02, 0.03}, {0.014, 0.1}, {0.045, 0.135}, {0, 0.135}},
                   8);
    // The fork, two arms and the post that all lamps share.
    const Vec3 joint = frame * Vec3{0, 0.12, 0} + Vec3{0, 0.1, 0};
    m.rod(Material::enamel, {frame * Vec3{0, 0.1, 0}, joint}, 0.025, 8);
    const double side = number == 0 ? -1 : 1;
    const double level = room_height - 0.36 - 0.13 * number;
    const Vec3 post{0, room_height, 0}, elbow{side * 0.72, level, -side * 0.28};
    if (number == 0) {
        add_ceiling_mount(m, post, 0.2);
        m.rod(Material::enamel, {post - Vec3{0, 0.05, 0}, post - Vec3{0, 0.56, 0}}, 0.045, 10);
    }
    m.cylinder(Material::grey_enamel, {0, level - 0.05, 0}, 0.065, 0.1, 0.01, 14);
    m.rod(Material::enamel, {{0, level, 0}, elbow}, 0.035, 9);
    m.cylinder(Material::grey_enamel, elbow - Vec3{0, 0.075, 0}, 0.05, 0.15, 0.01, 12);
    m.rod(Material::enamel, {elbow - Vec3{0, 0.05, 0}, joint}, 0.03, 8);
    m.cylinder(Material::grey_enamel, joint - Vec3{0, 0.04, 0}, 0.042, 0.08, 0.01, 10);
}

}  // namespace

Model table_lamps(double room_height) {
    Model m;
    add_lamp(m, 0, room_height);
    add_lamp(m, 1, room_height);
    return m;
}

Model supply_unit(double room_height) {
    Model m;
    add_ceiling_mount(m, {0, room_height, 0}, 0.2);
    m.rod(Material::enamel, {{0, room_height - 0.06, 0}, {0, room_height - 0.38, 0}}, 0.07, 12);
    // The head: a column with outlets, two shelves and a drawer.
    m.box(Material::enamel, {-0.17, 0.72, -0.13}, {0.17, room_height - 0.36, 0.13}, 0.02);
    for (const double y : {0.80, 1.22}) {
        m.box(Material::white_plastic, {-0.29, y - 0.035, -0.13}, {0.29, y, 0.36}, 0.01);
        m.box(Material::steel, {-0.30, y - 0.03, 0.0}, {-0.288, y - 0.005, 0.34}, 0.003);
        m.box(Material::steel, {0.288, y - 0.03, 0.0}, {0.30, y - 0.005, 0.34}, 0.003);
    }
    m.box(Material::white_plastic, {-0.27, 0.60, -0.1}, {0.27, 0.77, 0.34}, 0.012);
    m.box(Material::grey_plastic, {-0.255, 0.62, 0.335}, {0.255, 0.75, 0.348}, 0.004);
    m.rod(Material::chrome,
          {{-0.1, 0.69, 0.352}, {-0.1, 0.69, 0.375}, {0.1, 0.69, 0.375}, {0.1, 0.69, 0.352}}, 0.006,
          6);
    // Devices on the shelves.
    m.box(Material::grey_enamel, {-0.23, 0.80, -0.02}, {0.21, 0.94, 0.32}, 0.012);
    m.box(Material::screen, {-0.2, 0.83, 0.316}, {0.0, 0.91, 0.324}, 0.003);
    for (int i = 0; i < 3; ++i)
        m.turned_round(Material::grey_plastic,
                       {rotation_about({1, 0, 0}, pi / 2), {0.05 + 0.055 * i, 0.87, 0.316}},
                       {{0, 0}, {0.018, 0}, {0.015, 0.02}, {0, 0.02}}, 12);
    m.box(Material::white_plastic, {-0.2, 1.22, 0.0}, {0.2, 1.32, 0.30}, 0.012);
    m.box(Material::screen, {-0.17, 1.245, 0.296}, {0.05, 1.3, 0.304}, 0.003);
    // Sockets and gas outlets.
    const Material gases[] = {Material::blue, Material::white_plastic, Material::yellow,
                              Material::green};
    for (int i = 0; i < 4; ++i)
        m.turned_round(gases[i],
                       {rotation_about({1, 0, 0}, pi / 2), {-0.105 + 0.07 * i, 1.78, 0.128}},
                       {{0, 0}, {0.026, 0}, {0.026, 0.012}, {0.014, 0.022}, {0, 0.022}}, 12);
    for (int i = 0; i < 6; ++i)
        m.box(Material::grey_plastic, {-0.13 + 0.09 * (i % 3), 1.52 + 0.09 * (i / 3), 0.126},
              {-0.05 + 0.09 * (i % 3), 1.6 + 0.09 * (i / 3), 0.138}, 0.004);
    return m;
}

Model ceiling_panel(double room_height) {
    Model m;
    const double y = room_height, half = 1.25;
    // A frame with filter panels, and a light in each long side.
    for (const double s : {-1.0, 1.0}) {
        m.box(Material::enamel, {-half - 0.1, y - 0.06, s * half - 0.1},
              {half + 0.1, y, s * half + 0.1}, 0.012);
        m.box(Material::enamel, {s * half - 0.1, y - 0.06, -half + 0.1},
              {s * half + 0.1, y, half - 0.1}, 0.012);
        for (int i = 0; i < 2; ++i)
            m.box(Material::light, {-half + 0.12 + 1.22 * i, y - 0.066, s * half - 0.065},
                  {-half + 1.16 + 1.22 * i, y - 0.056, s * half + 0.065}, 0.003);
    }
    m.box(Material::diffuser, {-half + 0.1, y - 0.03, -half + 0.1},
          {half - 0.1, y - 0.002, half - 0.1});
    for (int i = 1; i < 4; ++i) {
        const double at = -half + 0.1 + 0.575 * i;
        m.box(Material::enamel, {at - 0.012, y - 0.036, -half + 0.1},
              {at + 0.012, y - 0.028, half - 0.1});
        m.box(Material::enamel, {-half + 0.1, y - 0.037, at - 0.012},
              {half - 0.1, y - 0.028, at + 0.012});
    }
    return m;
}

Model ceiling_lights(double room_height) {
    Model m;
    for (const double s : {-1.0, 1.0})
        for (const double t : {-1.0, 1.0})
            for (const Vec3 at :
                 {Vec3{s * 0.9, room_height, t * 2.4}, Vec3{s * 2.7, room_height, t * 0.6}}) {
                m.box(Material::enamel, at - Vec3{0.3, 0.012, 0.3}, at + Vec3{0.3, 0, 0.3}, 0.004);
                m.box(Material::light, at - Vec3{0.275, 0.018, 0.275},
                      at + Vec3{0.275, -0.006, 0.275}, 0.003);
            }
    return m;
}

Model hanging_monitor(double room_height) {
    Model m;
    const double middle = 1.78;
    add_ceiling_mount(m, {0, room_height, -0.12}, 0.13);
    m.rod(Material::enamel, {{0, room_height - 0.05, -0.12}, {0, middle, -0.12}}, 0.032, 12);
    m.box(Material::grey_enamel, {-0.1, middle - 0.1, -0.15}, {0.1, middle + 0.1, -0.04}, 0.01);
    m.box(Material::black_plastic, {-0.37, middle - 0.23, -0.045}, {0.37, middle + 0.23, 0.0},
          0.012);
    m.box(Material::screen, {-0.345, middle - 0.2, -0.008}, {0.345, middle + 0.205, 0.0035}, 0.002);
    m.rod(Material::steel,
          {{-0.25, middle - 0.235, -0.02},
           {-0.25, middle - 0.27, 0.01},
           {0.25, middle - 0.27, 0.01},
           {0.25, middle - 0.235, -0.02}},
          0.009, 8);
    return m;
}

}  // namespace theatron::furniture
