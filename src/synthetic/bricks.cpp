// SPDX-License-Identifier: Apache-2.0
// Interlocking toy bricks: a regular, sharp and fine structure that shows the quality of
// cameras and codecs.
#include "synthetic/noise.h"
#include "synthetic/scene.h"

namespace theatron::synthetic {
namespace {

constexpr float pitch = 0.016f, brick_height = 0.0192f, stud_radius = 0.0048f,
                stud_height = 0.0036f;  // preschool size: twice the common one

Mesh make_brick(int nx, int nz, Look look) {
    Mesh m;
    const float w = pitch * float(nx) - 0.0004f, d = pitch * float(nz) - 0.0004f;
    m.append(make_box({w, brick_height, d}, 0.0006f, look), translation({0, brick_height / 2, 0}));
    for (int z = 0; z < nz; ++z)
        for (int x = 0; x < nx; ++x)
            m.append(make_lathe({{stud_radius, 0},
                                 {stud_radius, stud_height * 0.85f},
                                 {stud_radius * 0.9f, stud_height},
                                 {0, stud_height}},
                                12, look),
                     translation({(float(x) - float(nx - 1) / 2) * pitch, brick_height,
                                  (float(z) - float(nz - 1) / 2) * pitch}));
    return m;
}

Look brick_look(std::uint32_t number) {
    static constexpr Look looks[] = {Look::brick_red, Look::brick_blue, Look::brick_yellow,
                                     Look::brick_white, Look::brick_green};
    return looks[hash(number) % 5];
}

}  // namespace

void add_bricks(Mesh& still, std::uint32_t seed) {
    // On the instrument table over the patient's legs: a stepped wall on a plate.
    Mesh model;
    model.append(make_box({pitch * 12, 0.006f, pitch * 8}, 0.0005f, Look::brick_green),
                 translation({0, 0.003f, 0}));
    for (int z = 0; z < 8; ++z)
        for (int x = 0; x < 12; ++x)
            model.append(
                make_lathe({{stud_radius, 0}, {stud_radius, stud_height}, {0, stud_height}}, 10,
                           Look::brick_green),
                translation({(float(x) - 5.5f) * pitch, 0.006f, (float(z) - 3.5f) * pitch}));
    std::uint32_t number = seed * 131;
    for (int level = 0; level < 4; ++level) {
        const int length = 10 - 2 * level;
        const float y = 0.006f + brick_height * float(level);
        for (int x = 0; x < length; x += 2) {
            const float px = (float(x) - float(length) / 2 + 1) * pitch;
            model.append(make_brick(2, 2, brick_look(number++)), translation({px, y, -pitch * 2}));
            if (level < 2)
                model.append(make_brick(2, 2, brick_look(number++)), translation({px, y, pitch}));
        }
    }
    still.append(model, translation({0.84f, 1.172f, -0.09f}) * rotation({0, 1, 0}, 0.25f));
    still.append(make_brick(4, 2, Look::brick_red),
                 translation({0.79f, 1.172f, 0.07f}) * rotation({0, 1, 0}, 0.9f));
    still.append(make_brick(2, 2, Look::brick_blue),
                 translation({0.93f, 1.172f, 0.04f}) * rotation({0, 1, 0}, -0.4f));
}

}  // namespace theatron::synthetic
