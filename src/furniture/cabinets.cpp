// SPDX-License-Identifier: Apache-2.0
// Cabinets, bins and trolleys.
#include <algorithm>
#include <numbers>

#include "furniture/pieces.h"

namespace theatron::furniture {
namespace {

constexpr double pi = std::numbers::pi;

void add_handle(Model& m, Vec3 low, double height, double front) {
    m.rod(Material::chrome,
          {{low.x, low.y, front},
           {low.x, low.y, front + 0.03},
           {low.x, low.y + height, front + 0.03},
           {low.x, low.y + height, front}},
          0.007, 5);
}

}  // namespace

Model glass_cabinet() {
    Model m;
    const double half = 0.6, top = 2.05, back = 0.0, front = 0.42;
    m.box(Material::grey_enamel, {-half + 0.03, 0, back + 0.02}, {half - 0.03, 0.1, front - 0.04},
          0.006);
    // The carcass: sides, back, and boards.
    for (const double s : {-1.0, 1.0})
        m.box(Material::enamel, {s > 0 ? half - 0.02 : -half, 0.1, back},
              {s > 0 ? half : -half + 0.02, top, front}, 0.006);
    m.box(Material::enamel, {-half + 0.015, 0.1, back}, {half - 0.015, top - 0.01, back + 0.02},
          0.003);
    for (const double y : {0.1, 0.86, 1.16, 1.46, 1.76, top - 0.03})
        m.box(Material::enamel, {-half + 0.015, y, back + 0.01},
              {half - 0.015, y + 0.025, front - 0.035}, 0.004);
    // Supplies on the boards.
    const Material colors[] = {
        Material::white_plastic, Material::blue,        Material::white_plastic, Material::green,
        Material::white_plastic, Material::grey_enamel, Material::yellow};
    int next = 0;
    for (int row = 0; row < 4; ++row)
        for (int i = 0; i < 7; ++i) {
            const double x = -half + 0.06 + 0.157 * i, y = 0.885 + 0.3 * row;
            const double high = 0.12 + 0.035 * ((i * 3 + row * 2) % 4),
                         deep = 0.2 + 0.03 * ((i + row) % 3);
            m.box(colors[std::size_t(next++ % 7)], {x, y, 0.05}, {x + 0.125, y + high, 0.05 + deep},
                  0.006);
        }
    // Frames of the glass doors stay open in the middle: what is behind glass is in plain sight.
    for (const double s : {-1.0, 1.0}) {
        const double in = s * 0.006, out = s * (half - 0.004);
        const double l = std::min(in, out), h = std::max(in, out);
        m.box(Material::steel, {l, 0.885, front - 0.03}, {l + 0.035, top - 0.01, front - 0.006},
              0.004);
        m.box(Material::steel, {h - 0.035, 0.885, front - 0.03}, {h, top - 0.01, front - 0.006},
              0.004);
        m.box(Material::steel, {l + 0.03, 0.885, front - 0.03}, {h - 0.03, 0.925, front - 0.006},
              0.004);
        m.box(Material::steel, {l + 0.03, top - 0.05, front - 0.03},
              {h - 0.03, top - 0.01, front - 0.006}, 0.004);
        add_handle(m, {s * 0.024, 1.3, 0}, 0.14, front - 0.01);
        // Below, two doors of metal.
        m.box(Material::enamel, {l, 0.11, front - 0.03}, {h, 0.875, front - 0.004}, 0.006);
        add_handle(m, {s * 0.05, 0.6, 0}, 0.14, front - 0.006);
    }
    return m;
}

Model drawer_cabinet() {
    Model m;
    const double half = 0.8, top = 0.9, front = 0.55;
    m.box(Material::grey_enamel, {-half + 0.03, 0, 0.03}, {half - 0.03, 0.1, front - 0.06}, 0.006);
    m.box(Material::enamel, {-half, 0.1, 0}, {half, top - 0.035, front - 0.02}, 0.008);
    m.box(Material::steel, {-half - 0.01, top - 0.035, 0}, {half + 0.01, top, front + 0.02}, 0.008);
    for (int c = 0; c < 4; ++c) {
        const double x = -half + 0.4 * c;
        if (c % 3 == 0) {
            m.box(Material::white_plastic, {x + 0.008, 0.12, front - 0.03},
                  {x + 0.392, 0.85, front}, 0.005);
            add_handle(m, {c == 0 ? x + 0.35 : x + 0.05, 0.6, 0}, 0.14, front - 0.003);
            continue;
        }
        for (int r = 0; r < 4; ++r) {
            const double y = 0.12 + 0.183 * r;
            m.box(Material::white_plastic, {x + 0.008, y, front - 0.03},
                  {x + 0.392, y + 0.175, front}, 0.005);
            m.rod(Material::chrome,
                  {{x + 0.12, y + 0.12, front - 0.003},
                   {x + 0.12, y + 0.12, front + 0.024},
                   {x + 0.28, y + 0.12, front + 0.024},
                   {x + 0.28, y + 0.12, front - 0.003}},
                  0.006, 6);
        }
    }
    // On the worktop: boxes of gloves and a sharps bin.
    const Material gloves[] = {Material::blue, Material::green, Material::white_plastic};
    for (int i = 0; i < 3; ++i)
        m.box(gloves[i], {-0.66 + 0.27 * i, top, 0.06}, {-0.42 + 0.27 * i, top + 0.09, 0.19},
              0.006);
    m.round(Material::yellow, {0.45, top, 0.18},
            {{0, 0}, {0.075, 0}, {0.085, 0.01}, {0.1, 0.2}, {0, 0.2}}, 18);
    m.round(Material::red, {0.45, top + 0.2, 0.18},
            {{0, 0}, {0.106, 0}, {0.106, 0.02}, {0.06, 0.035}, {0.05, 0.05}, {0, 0.05}}, 18);
    return m;
}

Model waste_bin(Material lid) {
    Model m;
    // A frame on wheels with a bag, and the lid above.
    for (const double x : {-0.19, 0.19})
        for (const double z : {-0.19, 0.19}) {
            m.rod(Material::chrome, {{x, 0.07, z}, {x, 0.80, z}}, 0.011, 6);
            m.round(Material::rubber, {x, 0, z},
                    {{0, 0}, {0.02, 0.008}, {0.032, 0.036}, {0.02, 0.066}, {0.01, 0.08}, {0, 0.08}},
                    10);
        }
    m.box(Material::steel, {-0.2, 0.09, -0.2}, {0.2, 0.105, 0.2}, 0.004);
    m.round(
        lid, {0, 0.11, 0},
        {{0, 0}, {0.12, 0.0}, {0.165, 0.04}, {0.18, 0.2}, {0.172, 0.45}, {0.178, 0.66}, {0, 0.66}},
        14);
    m.round(Material::grey_plastic, {0, 0.79, 0},
            {{0, 0}, {0.2, 0}, {0.215, 0.012}, {0.215, 0.03}, {0.19, 0.05}, {0, 0.065}}, 16);
    m.round(lid, {0, 0.85, 0}, {{0, 0}, {0.07, 0}, {0.065, 0.012}, {0, 0.012}}, 16);
    return m;
}

Model linen_trolley() {
    Model m;
    for (const double x : {-0.4, 0.4})
        for (const double z : {-0.22, 0.22}) {
            m.rod(Material::chrome, {{x, 0.1, z}, {x, 1.3, z}}, 0.014, 6);
            const Pose lying{rotation_about({1, 0, 0}, pi / 2), {x, 0.05, z - 0.015}};
            m.turned_round(Material::rubber, lying, {{0, 0}, {0.05, 0}, {0.05, 0.03}, {0, 0.03}},
                           12);
            m.box(Material::grey_plastic, {x - 0.016, 0.05, z - 0.025},
                  {x + 0.016, 0.12, z + 0.025}, 0.004);
        }
    for (const double y : {0.2, 0.72, 1.24})
        m.box(Material::steel, {-0.42, y, -0.24}, {0.42, y + 0.018, 0.24}, 0.005);
    // Folded sheets and gowns.
    const Material cloth[] = {Material::green_cloth, Material::blue_cloth, Material::white_plastic};
    for (int shelf = 0; shelf < 2; ++shelf)
        for (int pile = 0; pile < 3; ++pile)
            for (int i = 0; i < 3 + (pile + shelf) % 2; ++i) {
                const double x = -0.385 + 0.265 * pile, y = 0.218 + 0.52 * shelf + 0.066 * i;
                m.box(cloth[(pile + shelf) % 3], {x, y, -0.19 + 0.006 * (i % 2)},
                      {x + 0.24, y + 0.064, 0.2 - 0.008 * (i % 3)}, 0.02);
            }
    for (int i = 0; i < 2; ++i)
        m.box(Material::grey_enamel, {-0.34 + 0.36 * i, 1.258, -0.18},
              {-0.02 + 0.36 * i, 1.4, 0.18}, 0.01);
    return m;
}

}  // namespace theatron::furniture
