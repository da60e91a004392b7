// SPDX-License-Identifier: Apache-2.0
// The instrument table over the patient's legs: cloth, instruments in a row,
// dishes, gauze, printed sheets.
#include "synthetic/instruments.h"
#include "synthetic/noise.h"
#include "synthetic/scene.h"

namespace theatron::synthetic {
namespace {

constexpr float top = 1.17f;

Mesh kidney_dish() {
    return make_sheet(
        36, 14,
        [](float u, float v) {
            const float a = 2 * pi * u;
            const float dent = 0.35f * std::exp(-std::pow((a > pi ? a - 2 * pi : a) / 0.7f, 2.0f));
            const float rim = (1 - dent);
            const float r = v < 0.55f ? v / 0.55f * 0.82f : 0.82f + 0.18f * (v - 0.55f) / 0.45f;
            const float y = v < 0.55f ? 0.003f : 0.003f + 0.035f * (v - 0.55f) / 0.45f;
            return F3{0.06f * r * rim * std::cos(a), y, 0.11f * r * std::sin(a)};
        },
        Look::instrument);
}

}  // namespace

void add_tray(Mesh& still, std::uint32_t seed) {
    // A cloth that hangs over the plate's edge, with folds.
    constexpr float cx = 0.73f, half_x = 0.34f, half_z = 0.25f;
    still.append(make_box({2 * half_x - 0.01f, 0.02f, 2 * half_z - 0.01f}, 0.006f, Look::steel),
                 translation({cx, top - 0.02f, 0}));
    still.append(make_sheet(
        150, 120,
        [&](float u, float v) {
            const auto over = [](float s, float half, float& drop) {
                const float beyond = std::abs(s) - half;
                drop = std::max(beyond, 0.0f);
                return std::copysign(
                    std::min(std::abs(s), half + 0.012f * smoothstep(0, 0.03f, drop)), s);
            };
            float dx, dz;
            float x = over((u - 0.5f) * 2 * (half_x + 0.17f), half_x, dx);
            float z = over((0.5f - v) * 2 * (half_z + 0.17f), half_z, dz);
            const float drop = std::max(dx, dz) + 0.3f * std::min(dx, dz);
            const float along = dx > dz ? z : x;
            const float fold = 0.02f * smoothstep(0.0f, 0.14f, drop) *
                               (std::sin(along * 46 + 1.3f * std::sin(along * 17)) + 0.6f);
            if (dx > dz)
                x += std::copysign(fold, x);
            else
                z += std::copysign(fold, z);
            const float ripple = drop > 0 ? 0.0f : 0.0016f * fractal({x * 14, 3, z * 14}, 3);
            return F3{cx + x, top - drop + ripple, z};
        },
        Look::tray_cloth));
    // Its stand beside the table.
    still.append(make_tube({{cx + 0.26f, top - 0.03f, -0.2f},
                            {cx + 0.26f, top - 0.08f, -0.46f},
                            {cx + 0.26f, 0.06f, -0.46f}},
                           {0.018f}, 14, Look::steel));
    still.append(make_tube({{cx - 0.1f, 0.05f, -0.46f}, {cx + 0.5f, 0.05f, -0.46f}}, {0.02f}, 12,
                           Look::steel));
    still.append(make_tube({{cx + 0.26f, 0.05f, -0.46f}, {cx + 0.26f, 0.05f, -0.1f}}, {0.02f}, 12,
                           Look::steel));

    // Instruments side by side, handles towards the assistant.
    const auto lay = [&](const Mesh& m, float x, float z, float turn) {
        still.append(m, translation({x, top + 0.006f, z}) * rotation({0, 1, 0}, turn));
    };
    const float wobble = 0.04f * hash01(seed);
    float x = 0.43f;
    for (int i = 0; i < 8; ++i, x += 0.036f) {
        const float turn = wobble + 0.05f * (hash01(seed + std::uint32_t(i) * 7) - 0.5f);
        if (i == 3 || i == 4)
            continue;  // places of the tools that are handed over
        switch (i % 4) {
            case 0:
                lay(make_scalpel(), x, 0.1f, turn);
                break;
            case 1:
                lay(make_forceps(0.008f), x, 0.11f, turn);
                break;
            case 2: {
                Mesh scissors = make_scissor_half(-1, 0.06f);
                scissors.append(make_scissor_half(1, 0.06f));
                lay(scissors, x, 0.1f, turn);
                break;
            }
            default:
                lay(make_clamp(0.05f), x, 0.1f, turn);
        }
    }
    for (int i = 0; i < 3; ++i)
        lay(make_clamp(0.04f), 0.45f + 0.045f * float(i), -0.09f, 0.08f * float(i - 1) + wobble);
    still.append(kidney_dish(), translation({0.66f, top + 0.002f, -0.12f}));
    const auto gauze_pile = [&](float px, float pz, float turn) {
        for (int i = 0; i < 3; ++i)
            still.append(make_sheet(
                             20, 20,
                             [&](float u, float v) {
                                 const F3 p{(u - 0.5f) * 0.09f, 0, (0.5f - v) * 0.09f};
                                 return p +
                                        F3{0,
                                           0.006f + 0.007f * float(i) +
                                               0.003f * fractal(p * 40.0f + F3{float(i), 0, 0}, 2),
                                           0};
                             },
                             Look::cuff),
                         translation({px, top, pz}) * rotation({0, 1, 0}, turn + 0.3f * float(i)));
    };
    gauze_pile(0.66f, 0.17f, 0.2f);
    // Printed sheets, lying flat, readable from the surgeon's side.
    const auto sheet = [&](PictureNumber picture, float w, float h, F3 at, float turn) {
        still.append(make_picture(w, h, int(picture), Look::paper),
                     translation(at) * rotation({0, 1, 0}, turn) * rotation({1, 0, 0}, -pi / 2));
    };
    sheet(PictureNumber::checklist, 0.17f, 0.24f, {0.93f, top + 0.006f, 0.115f}, 0.35f);
    sheet(PictureNumber::calibration_note, 0.2f, 0.14f, {0.76f, top + 0.006f, 0.16f}, -0.12f);
}

}  // namespace theatron::synthetic
