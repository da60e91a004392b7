// SPDX-License-Identifier: Apache-2.0
// The operating table, and what stands beside it.
#include <cmath>
#include <numbers>

#include "furniture/pieces.h"

namespace theatron::furniture {
namespace {

constexpr double pi = std::numbers::pi;

// A wheel below `place`, with its fork.
void add_castor(Model& model, Vec3 place, double radius = 0.045) {
    const Pose lying{rotation_about({1, 0, 0}, pi / 2), {place.x, radius, place.z - 0.014}};
    model.turned_round(Material::rubber, lying, {{0, 0}, {radius, 0}, {radius, 0.028}, {0, 0.028}},
                       12);
    model.box(Material::grey_plastic, {place.x - 0.014, radius, place.z - 0.022},
              {place.x + 0.014, place.y, place.z + 0.022}, 0.004);
}

// A clamp or scissors that lies in the plane y = height: two rings, a joint and two tips.
void add_instrument(Model& model, Vec3 at, double length_m, double angle, double opening) {
    const Pose lying{rotation_about({0, 1, 0}, angle), at};
    for (const double side : {-1.0, 1.0}) {
        const double spread = side * opening;
        model.rod(Material::chrome,
                  {lying * Vec3{-0.45 * length_m, 0, spread}, lying * Vec3{0, 0.001 * side, 0},
                   lying * Vec3{0.55 * length_m, 0, -0.25 * spread}},
                  0.0025, 4);
        std::vector<Vec3> ring;
        for (int i = 0; i <= 6; ++i) {
            const double turn = 2 * pi * i / 6.2;
            ring.push_back(lying * Vec3{-0.45 * length_m - 0.011 + 0.011 * std::cos(turn), 0,
                                        spread * 1.25 + 0.011 * std::sin(turn)});
        }
        model.rod(Material::chrome, ring, 0.0022, 3);
    }
}

void add_scalpel(Model& model, Vec3 at, double angle) {
    const Quat turn = rotation_about({0, 1, 0}, angle);
    model.turned_box(Material::chrome, {turn, at}, {0.125, 0.005, 0.009}, 0.001);
    model.turned_box(Material::steel, {turn, at + rotate(turn, {0.08, 0, 0})},
                     {0.035, 0.002, 0.006}, 0.0005);
}

void add_bowl(Model& model, Vec3 at, double radius, double height) {
    model.round(Material::steel, at,
                {{0, 0},
                 {0.55 * radius, 0},
                 {0.9 * radius, 0.55 * height},
                 {radius, height},
                 {0.94 * radius, height},
                 {0.82 * radius, 0.55 * height},
                 {0.5 * radius, 0.012},
                 {0, 0.012}},
                20);
}

}  // namespace

Model operating_table() {
    Model m;
    // Base and column.
    m.box(Material::grey_enamel, {-0.42, 0.015, -0.24}, {0.62, 0.09, 0.24}, 0.03);
    m.box(Material::steel, {-0.30, 0.09, -0.2}, {0.42, 0.15, 0.2}, 0.025);
    m.box(Material::rubber, {-0.40, 0.0, -0.21}, {0.58, 0.02, 0.21}, 0.004);
    m.box(Material::steel, {-0.17, 0.14, -0.14}, {0.19, 0.46, 0.14}, 0.03);
    m.box(Material::grey_enamel, {-0.14, 0.45, -0.115}, {0.16, 0.72, 0.115}, 0.025);
    m.box(Material::grey_enamel, {-0.28, 0.70, -0.19}, {0.32, 0.79, 0.19}, 0.02);
    // Head, back, seat and legs: each with a plate and a pad.
    const struct {
        double from, to, lift;
    } parts[] = {{-1.0, -0.72, 0.0}, {-0.71, -0.02, 0}, {-0.01, 0.38, 0}, {0.39, 1.0, 0}};
    for (const auto& p : parts) {
        const bool head = p.from < -0.9;
        const double half = head ? 0.16 : 0.26;
        m.box(Material::enamel, {p.from, 0.79, -half + 0.02}, {p.to, 0.835, half - 0.02}, 0.008);
        m.box(Material::pad, {p.from, 0.835, -half}, {p.to, table_top_m, half}, 0.022);
    }
    // Side rails with their clamps.
    for (const double s : {-1.0, 1.0}) {
        for (const auto& p : {parts[1], parts[2], parts[3]}) {
            m.box(Material::steel, {p.from + 0.04, 0.798, s * 0.268 - 0.005},
                  {p.to - 0.04, 0.826, s * 0.268 + 0.005}, 0.002);
            for (const double x : {p.from + 0.1, p.to - 0.1})
                m.rod(Material::steel, {{x, 0.812, s * 0.235}, {x, 0.812, s * 0.268}}, 0.008, 6);
        }
        // Arm boards beside the back.
        const Pose board{rotation_about({0, 1, 0}, s * 0.28), {-0.52, 0.86, s * 0.47}};
        m.turned_box(Material::grey_enamel, {board.rotation, board * Vec3{0, -0.038, 0}},
                     {0.11, 0.02, 0.52}, 0.006);
        m.turned_box(Material::pad, board, {0.14, 0.055, 0.54}, 0.018);
        m.rod(Material::steel, {{-0.52, 0.81, s * 0.25}, {-0.52, 0.822, s * 0.36}}, 0.012, 6);
    }
    // The frame of the sheet before the anaesthetist.
    m.rod(Material::chrome,
          {{-0.66, 0.80, 0.285},
           {-0.66, 1.34, 0.285},
           {-0.66, 1.38, 0.245},
           {-0.66, 1.38, -0.245},
           {-0.66, 1.34, -0.285},
           {-0.66, 0.80, -0.285}},
          0.009, 6);
    // A folded sheet on the legs, and the belt.
    m.box(Material::blue_cloth, {0.45, table_top_m - 0.004, -0.22},
          {0.96, table_top_m + 0.014, 0.22}, 0.008);
    m.box(Material::blue_cloth, {0.52, table_top_m + 0.012, -0.19},
          {0.90, table_top_m + 0.027, 0.17}, 0.007);
    m.box(Material::rubber, {0.10, table_top_m - 0.09, -0.266}, {0.15, table_top_m + 0.004, 0.266},
          0.003);
    // The remote control that hangs on the rail.
    m.box(Material::grey_plastic, {0.2, 0.60, 0.278}, {0.27, 0.77, 0.305}, 0.008);
    m.rod(Material::rubber, {{0.235, 0.77, 0.29}, {0.235, 0.81, 0.28}}, 0.006, 6);
    return m;
}

Model instrument_stand() {
    Model m;
    const double top = 1.10;
    // The foot stands beside the table, the tray is above it.
    m.rod(Material::chrome, {{0.72, 0.1, 0.56}, {0.72, top - 0.03, 0.56}, {0.72, top - 0.012, 0.3}},
          0.013, 10);
    for (const double x : {0.5, 0.94}) {
        m.rod(Material::steel, {{0.72, 0.09, 0.56}, {x, 0.085, 0.60}}, 0.016, 6);
        add_castor(m, {x, 0.1, 0.60});
    }
    m.rod(Material::steel, {{0.72, 0.09, 0.56}, {0.72, 0.085, 0.36}}, 0.016, 6);
    add_castor(m, {0.72, 0.1, 0.36});
    m.box(Material::steel, {0.44, top - 0.012, -0.20}, {1.04, top, 0.22}, 0.004);
    for (const double z : {-0.20, 0.21})
        m.box(Material::steel, {0.44, top - 0.006, z}, {1.04, top + 0.016, z + 0.01}, 0.003);
    for (const double x : {0.44, 1.03})
        m.box(Material::steel, {x, top - 0.006, -0.19}, {x + 0.01, top + 0.016, 0.21}, 0.003);
    m.box(Material::green_cloth, {0.455, top - 0.002, -0.185}, {1.025, top + 0.005, 0.205}, 0.002);
    const double y = top + 0.009;
    for (int i = 0; i < 5; ++i)
        add_instrument(m, {0.54 + 0.075 * i, y, 0.02}, 0.15 + 0.01 * (i % 3),
                       pi / 2 + 0.05 * (i % 2), 0.012 + 0.004 * (i % 2));
    add_scalpel(m, {0.93, y, -0.06}, pi / 2);
    add_scalpel(m, {0.965, y, -0.05}, pi / 2 + 0.06);
    add_bowl(m, {0.95, top + 0.005, 0.12}, 0.055, 0.04);
    return m;
}

Model instrument_table() {
    Model m;
    const double top = 0.92;
    m.box(Material::steel, {-0.7, top - 0.05, -0.32}, {0.7, top, 0.32}, 0.01);
    for (const double x : {-0.62, 0.62})
        for (const double z : {-0.26, 0.26}) {
            m.rod(Material::chrome, {{x, 0.09, z}, {x, top - 0.04, z}}, 0.016, 6);
            add_castor(m, {x, 0.1, z});
        }
    m.box(Material::steel, {-0.63, 0.3, -0.27}, {0.63, 0.32, 0.27}, 0.004);
    // The drape falls in folds at the front and the sides.
    m.box(Material::green_cloth, {-0.725, top - 0.02, -0.345}, {0.725, top + 0.012, 0.345}, 0.012);
    for (int i = 0; i < 12; ++i) {
        const double x = -0.66 + 0.12 * i, deep = i % 2 ? 0.012 : 0.0;
        for (const double s : {-1.0, 1.0})
            m.box(Material::green_cloth,
                  {x - 0.066, top - 0.34 - 0.01 * (i % 3), s * (0.334 + deep) - 0.012},
                  {x + 0.066, top, s * (0.334 + deep) + 0.012}, 0.011);
    }
    for (int i = 0; i < 5; ++i)
        for (const double s : {-1.0, 1.0}) {
            const double z = -0.26 + 0.13 * i, deep = i % 2 ? 0.012 : 0.0;
            m.box(Material::green_cloth, {s * (0.714 + deep) - 0.012, top - 0.32, z - 0.07},
                  {s * (0.714 + deep) + 0.012, top, z + 0.07}, 0.011);
        }
    const double y = top + 0.016;
    for (int i = 0; i < 7; ++i)
        add_instrument(m, {-0.58 + 0.075 * i, y, 0.12}, 0.15 + 0.012 * (i % 4), pi / 2,
                       0.011 + 0.005 * (i % 2));
    for (int i = 0; i < 4; ++i)
        add_scalpel(m, {-0.56 + 0.05 * i, y, -0.12}, pi / 2);
    for (int i = 0; i < 3; ++i)
        m.box(Material::white_plastic, {-0.3 + 0.12 * i, top + 0.01, -0.2},
              {-0.2 + 0.12 * i, top + 0.03 + 0.01 * i, -0.1}, 0.008);
    add_bowl(m, {0.36, top + 0.012, -0.12}, 0.12, 0.07);
    add_bowl(m, {0.56, top + 0.012, 0.14}, 0.085, 0.055);
    m.box(Material::steel, {0.16, top + 0.012, 0.02}, {0.42, top + 0.045, 0.24}, 0.01);
    return m;
}

Model stool() {
    Model m;
    for (int i = 0; i < 5; ++i) {
        const double a = 2 * pi * i / 5;
        const Vec3 end{0.26 * std::cos(a), 0.085, 0.26 * std::sin(a)};
        m.rod(Material::chrome, {{0, 0.12, 0}, end}, 0.017, 6);
        add_castor(m, {end.x, 0.1, end.z}, 0.035);
    }
    m.cylinder(Material::chrome, {0, 0.10, 0}, 0.03, 0.40, 0.004, 12);
    m.round(Material::grey_plastic, {0, 0.47, 0}, {{0, 0}, {0.11, 0.0}, {0.14, 0.03}, {0, 0.03}},
            16);
    m.round(Material::pad, {0, 0.495, 0},
            {{0, 0},
             {0.155, 0},
             {0.175, 0.02},
             {0.178, 0.045},
             {0.165, 0.066},
             {0.14, 0.075},
             {0, 0.078}},
            24);
    return m;
}

Model step() {
    Model m;
    m.box(Material::grey_plastic, {-0.3, 0.17, -0.18}, {0.3, 0.2, 0.18}, 0.008);
    m.box(Material::rubber, {-0.28, 0.195, -0.16}, {0.28, 0.205, 0.16}, 0.003);
    for (const double x : {-0.26, 0.26})
        for (const double z : {-0.145, 0.145})
            m.rod(Material::steel, {{x, 0, z}, {x, 0.18, z}}, 0.016, 6);
    return m;
}

}  // namespace theatron::furniture
