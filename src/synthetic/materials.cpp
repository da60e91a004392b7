// SPDX-License-Identifier: Apache-2.0
#include "synthetic/materials.h"

#include <array>

#include "synthetic/noise.h"
#include "synthetic/patient.h"

namespace theatron::synthetic {
namespace {

F3 srgb(int r, int g, int b) {
    return {linear_from_srgb(std::uint8_t(r)), linear_from_srgb(std::uint8_t(g)),
            linear_from_srgb(std::uint8_t(b))};
}

using enum Material;

std::array<LookTraits, std::size_t(Look::count)> make_table() {
    std::array<LookTraits, std::size_t(Look::count)> t;
    const auto set = [&](Look look, LookTraits v) { t[std::size_t(look)] = v; };
    // Paint, vinyl and plastic reflect more infrared light than their colour suggests.
    //                      material, colour, infrared, specular, gloss, mirror
    set(Look::wall, {wall, srgb(196, 208, 204), 0.9f, 0.03f, 12});
    set(Look::wall_panel, {wall, srgb(150, 184, 178), 0.88f, 0.06f, 20});
    set(Look::ceiling, {wall, srgb(226, 228, 226), 0.9f});
    set(Look::floor, {floor, srgb(150, 166, 168), 0.74f, 0.16f, 30, 0.05f});
    set(Look::door, {door, srgb(172, 178, 176), 0.8f, 0.12f, 30, 0.03f});
    set(Look::window, {glass, srgb(50, 66, 74), 0.08f, 0.6f, 90, 0.25f});
    set(Look::white_plastic, {plastic, srgb(224, 224, 218), 0.85f, 0.2f, 36, 0.03f});
    set(Look::grey_plastic, {plastic, srgb(142, 148, 152), 0.42f, 0.15f, 28, 0.02f});
    set(Look::dark_plastic, {plastic, srgb(34, 36, 40), 0.1f, 0.25f, 40, 0.03f});
    set(Look::blue_plastic, {plastic, srgb(44, 96, 160), 0.4f, 0.2f, 36, 0.02f});
    set(Look::painted_metal, {metal, srgb(206, 208, 206), 0.8f, 0.25f, 50, 0.06f});
    set(Look::steel, {metal, srgb(150, 154, 158), 0.3f, 0.7f, 60, 0.4f});
    set(Look::instrument, {polished, srgb(118, 122, 126), 0.25f, 0.7f, 90, 0.42f});
    set(Look::gold, {polished, srgb(206, 168, 84), 0.35f, 0.8f, 60, 0.4f});
    set(Look::rubber, {rubber, srgb(28, 28, 30), 0.07f, 0.08f, 14});
    set(Look::mattress, {rubber, srgb(38, 40, 44), 0.09f, 0.15f, 20, 0.01f});
    set(Look::lamp_glass, {glass, srgb(240, 240, 235), 0.2f, 0.4f, 80, 0.1f});
    set(Look::drape, {drape, srgb(70, 136, 170), 0.58f, 0.05f, 8});
    set(Look::tray_cloth, {drape, srgb(62, 132, 116), 0.56f, 0.05f, 8});
    set(Look::gown, {gown, srgb(98, 158, 186), 0.55f, 0.04f, 8});
    set(Look::gown_assistant, {gown, srgb(118, 176, 168), 0.55f, 0.04f, 8});
    set(Look::cuff, {gown, srgb(222, 224, 220), 0.68f});
    set(Look::cap, {cap, srgb(44, 104, 122), 0.5f, 0.03f, 8});
    set(Look::cap_assistant, {cap, srgb(70, 132, 150), 0.52f, 0.03f, 8});
    set(Look::mask, {mask, srgb(160, 198, 208), 0.62f, 0.03f, 8});
    set(Look::strap, {mask, srgb(232, 234, 232), 0.65f});
    set(Look::glove, {glove, srgb(226, 208, 174), 0.6f, 0.3f, 22, 0.02f});
    set(Look::glove_assistant, {glove, srgb(230, 216, 188), 0.6f, 0.3f, 22, 0.02f});
    set(Look::face, {skin, srgb(214, 164, 138), 0.56f, 0.16f, 18});
    set(Look::face_assistant, {skin, srgb(172, 118, 88), 0.52f, 0.18f, 18});
    set(Look::patient_skin, {skin, srgb(204, 138, 88), 0.55f, 0.16f, 22});
    set(Look::patient_face, {skin, srgb(212, 166, 142), 0.55f, 0.14f, 18});
    set(Look::eye, {eye, srgb(232, 228, 224), 0.25f, 0.9f, 120, 0.06f});
    set(Look::hair, {hair, srgb(40, 28, 20), 0.18f, 0.15f, 12});
    set(Look::muscle, {tissue, srgb(158, 42, 38), 0.42f, 0.7f, 46, 0.05f});
    set(Look::peritoneum, {tissue, srgb(186, 84, 74), 0.46f, 0.8f, 56, 0.06f});
    set(Look::bowel, {tissue, srgb(216, 132, 118), 0.5f, 0.9f, 60, 0.06f});
    set(Look::artery, {tissue, srgb(170, 30, 30), 0.4f, 0.8f, 60, 0.05f});
    set(Look::vein, {tissue, srgb(78, 44, 78), 0.3f, 0.8f, 60, 0.05f});
    set(Look::liver, {liver, srgb(116, 34, 26), 0.3f, 0.55f, 60, 0.04f});
    set(Look::gallbladder, {tissue, srgb(92, 116, 66), 0.36f, 0.9f, 64, 0.06f});
    set(Look::fat, {fat, srgb(230, 186, 96), 0.66f, 0.6f, 40, 0.04f});
    set(Look::gauze, {gauze, srgb(236, 232, 224), 0.72f});
    set(Look::blood, {tissue, srgb(104, 8, 8), 0.25f, 1.2f, 90, 0.1f});
    set(Look::paper, {paper, srgb(245, 244, 240), 0.75f, 0.02f, 8});
    set(Look::screen, {screen, srgb(8, 8, 10), 0.08f, 0.3f, 80, 0.06f});
    set(Look::scrubs, {scrubs, srgb(46, 98, 108), 0.52f, 0.02f, 8});
    set(Look::shoe, {rubber, srgb(216, 218, 216), 0.6f, 0.15f, 24});
    set(Look::clear_bag, {plastic, srgb(206, 216, 220), 0.4f, 0.7f, 70, 0.12f});
    set(Look::brick_red, {brick, srgb(196, 28, 30), 0.5f, 0.45f, 56, 0.05f});
    set(Look::brick_blue, {brick, srgb(18, 84, 176), 0.4f, 0.45f, 56, 0.05f});
    set(Look::brick_yellow, {brick, srgb(244, 196, 28), 0.66f, 0.45f, 56, 0.05f});
    set(Look::brick_white, {brick, srgb(238, 238, 234), 0.72f, 0.45f, 56, 0.05f});
    set(Look::brick_green, {brick, srgb(32, 132, 62), 0.45f, 0.45f, 56, 0.05f});
    return t;
}

// Tilts `normal` by the slope of `height` (metres) around `p`.
template <class Height>
F3 bumped(F3 normal, F3 p, float step, const Height& height) {
    const float here = height(p);
    const F3 gradient = F3{height(p + F3{step, 0, 0}) - here, height(p + F3{0, step, 0}) - here,
                           height(p + F3{0, 0, step}) - here} *
                        (1 / step);
    return normalized(normal - (gradient - normal * dot(gradient, normal)));
}

void weave(Appearance& a, F3 p, float footprint, float crease) {
    // Soft creases, a slight unevenness of the dye, the weave where it is seen.
    a.normal = bumped(a.normal, p, 0.006f, [&](F3 q) {
        const F3 drawn{q.x * 14 + q.y * 5, q.y * 6, q.z * 14};
        const float coarse = 0.0024f * noise(drawn);
        return crease * (footprint > 0.0025f ? coarse : coarse + 0.0008f * noise(drawn * 2.7f));
    });
    const float fine = smoothstep(0.004f, 0.001f, footprint);
    a.color = a.color * (1 + 0.02f * noise(p * 7.0f) + 0.08f * fine * noise(p * 900.0f));
}

void wet(Appearance& a, F3 p, float relief, float scale) {
    a.normal = bumped(a.normal, p, 0.25f / scale,
                      [&](F3 q) { return relief / scale * fractal(q * scale, 3); });
}

// A net of fine vessels: thin where two scattered cells meet.
float vessels(F3 p, float scale) {
    float second;
    const F3 bent = p * scale + F3{noise(p * scale * 0.8f), noise(p * scale * 0.9f + F3{7, 0, 0}),
                                   noise(p * scale + F3{0, 9, 0})} *
                                    0.5f;
    const float first = cells(bent, &second);
    return smoothstep(0.09f, 0.0f, second - first);
}

void tissue_appearance(Look look, Appearance& a, F3 p) {
    const float blotch = fractal(p * 45.0f, 3);
    switch (look) {
        case Look::liver:
            a.color = a.color * (1 + 0.28f * blotch);
            a.color = mix(a.color, srgb(150, 66, 48),
                          0.35f * smoothstep(0.25f, 0.02f, cells(p * 420.0f)));
            wet(a, p, 0.035f, 170);
            break;
        case Look::fat: {
            // Globules with darker seams between them.
            float second;
            const float first = cells(p * 150.0f, &second);
            const float seam = smoothstep(0.16f, 0.0f, second - first);
            a.color = a.color * (1 + 0.12f * blotch);
            a.color = mix(a.color, srgb(196, 96, 54), 0.75f * seam);
            a.color = mix(a.color, srgb(168, 32, 26), 0.5f * smoothstep(0.15f, 0.5f, blotch));
            wet(a, p, 0.5f, 150);
            break;
        }
        case Look::muscle: {
            const float fibre = noise({p.x * 60, p.y * 900, p.z * 420});
            a.color = a.color * (1 + 0.3f * fibre + 0.25f * blotch);
            a.color = mix(a.color, srgb(214, 150, 130), 0.4f * smoothstep(0.55f, 0.8f, fibre));
            wet(a, p, 0.3f, 240);
            break;
        }
        case Look::bowel:
        case Look::peritoneum: {
            a.color = a.color * (1 + 0.16f * blotch);
            const float net = std::max(vessels(p, 70), 0.6f * vessels(p + F3{1, 2, 3}, 160));
            a.color = mix(a.color, srgb(160, 26, 32), 0.75f * net);
            wet(a, p, 0.16f, 150);
            break;
        }
        case Look::patient_skin: {
            // Stained with disinfectant, brighter to its edge; blood near the wound.
            a.color = a.color * (1 + 0.1f * blotch + 0.08f * noise(p * 600.0f));
            const float blood = smoothstep(0.22f, 0.6f, fractal(p * 55.0f + F3{3, 0, 8}, 3));
            a.color = mix(a.color, srgb(122, 14, 12), 0.8f * blood);
            a.specular += 0.6f * blood;
            wet(a, p, 0.06f, 500);
            break;
        }
        default:
            a.color = a.color * (1 + 0.2f * blotch);
            wet(a, p, 0.14f, 220);
    }
    a.through = 0.25f;
}

void face_appearance(Look look, Appearance& a, F3 p) {
    // p: in the head's frame, metres; brows, lids and lips by place.
    const F3 skin = a.color;
    a.color = a.color * (1 + 0.06f * fractal(p * 60.0f, 3) + 0.05f * noise(p * 900.0f));
    const float cheek =
        smoothstep(0.035f, 0.0f, length(F3{std::abs(p.x) - 0.042f, p.y - 0.085f, 0}));
    a.color = mix(a.color, skin * F3{1.02f, 0.78f, 0.74f}, 0.45f * cheek);
    if (p.z > 0.05f) {
        const float x = std::abs(p.x) - 0.033f;
        const float arch = 0.1335f - 6.0f * x * x + 0.06f * x;
        const float brow = smoothstep(0.0062f, 0.0032f, std::abs(p.y - arch)) *
                           smoothstep(0.024f, 0.019f, std::abs(x));
        const float hairs = 0.75f + 0.25f * noise({p.x * 900, p.y * 260, 0});
        a.color = mix(a.color, srgb(44, 30, 22), 0.9f * brow * hairs);
        // Lashes and the shaded rim of the lids.
        const float lid = length(F3{x / 0.0165f, (p.y - 0.112f) / 0.0085f, 0});
        const float rim = smoothstep(0.35f, 0.0f, std::abs(lid - 1.0f));
        a.color = mix(a.color, srgb(92, 52, 42), 0.55f * rim);
    }
    a.normal = bumped(a.normal, p, 0.0015f, [](F3 q) { return 0.00025f * noise(q * 700.0f); });
    a.through = 0.15f;
    if (look == Look::face_assistant)
        a.specular *= 1.15f;
}

}  // namespace

const LookTraits& traits(Look look) {
    static const auto table = make_table();
    return table[std::size_t(look)];
}

Appearance appearance(Look look, F3 p, F3 normal, float footprint,
                      const std::vector<Picture>& pictures) {
    const LookTraits& t = traits(look);
    Appearance a{t.color, normal, t.specular, t.gloss, t.mirror, {}, 0};
    switch (look) {
        case Look::drape:
            // A paler, stuck-down border around the window.
            if (p.y > 1 && std::abs(p.z) < 0.3f) {
                const float d = window_distance(p.x, p.z);
                a.color = mix(a.color, srgb(132, 182, 202), smoothstep(1.235f, 1.22f, d));
            }
            weave(a, p, footprint, 1);
            break;
        case Look::tray_cloth:
            weave(a, p, footprint, 1);
            break;
        case Look::gown:
        case Look::gown_assistant:
        case Look::scrubs:
            weave(a, p, footprint, 1.25f);
            break;
        case Look::cap:
            weave(a, p, footprint, 0.6f);
            a.color = mix(a.color, srgb(196, 214, 214), smoothstep(0.32f, 0.22f, cells(p * 55.0f)));
            break;
        case Look::cap_assistant:
        case Look::mask:
        case Look::cuff:
        case Look::strap:
            weave(a, p, footprint, 0.5f);
            break;
        case Look::gauze: {
            const float grid = std::sin(p.x * 2200) * std::sin(p.z * 2200);
            a.color = a.color * (1 + 0.1f * grid * smoothstep(0.002f, 0.0005f, footprint));
            const float blood = smoothstep(0.0f, 0.35f, fractal(p * 40.0f, 3));
            a.color = mix(a.color, srgb(164, 22, 20), 0.85f * blood);
            a.normal =
                bumped(a.normal, p, 0.003f, [](F3 q) { return 0.0016f * fractal(q * 120.0f, 2); });
            break;
        }
        case Look::glove:
        case Look::glove_assistant: {
            a.normal = bumped(a.normal, p, 0.002f, [](F3 q) {
                return 0.0009f * noise({q.x * 160, q.y * 70, q.z * 160}) +
                       0.0003f * noise(q * 420.0f);
            });
            // Blood on the fingers: the hand's frame has them at +z beyond the palm.
            const float blood =
                smoothstep(0.05f, 0.17f, p.z) * smoothstep(-0.05f, 0.35f, fractal(p * 38.0f, 3));
            a.color = mix(a.color, srgb(140, 16, 14), 0.85f * blood);
            a.specular += 0.5f * blood;
            a.through = 0.12f;
            break;
        }
        case Look::face:
        case Look::face_assistant:
            face_appearance(look, a, p);
            break;
        case Look::eye: {
            // p: in the eyeball's frame, z outwards, radius 12 mm.
            const float r = std::hypot(p.x, p.y);
            if (p.z > 0) {
                const float angle = std::atan2(p.y, p.x);
                const F3 iris = srgb(74, 92, 84) * (1 + 0.35f * noise({angle * 9, r * 600, 0}));
                a.color = mix(a.color, iris, smoothstep(0.0062f, 0.0056f, r));
                a.color = mix(a.color, F3{0.01f, 0.01f, 0.01f}, smoothstep(0.0028f, 0.0023f, r));
            }
            break;
        }
        case Look::hair:
            a.color = a.color * (1 + 0.5f * noise({p.x * 700, p.y * 120, p.z * 700}));
            break;
        case Look::muscle:
        case Look::peritoneum:
        case Look::bowel:
        case Look::artery:
        case Look::vein:
        case Look::liver:
        case Look::gallbladder:
        case Look::fat:
        case Look::blood:
        case Look::patient_skin:
            tissue_appearance(look, a, p);
            break;
        case Look::floor: {
            const float speck = noise(p * 260.0f);
            a.color = a.color * (1 + 0.05f * fractal(p * 2.0f, 3) +
                                 0.2f * smoothstep(0.012f, 0.003f, footprint) * speck);
            break;
        }
        case Look::wall:
        case Look::wall_panel: {
            // Sheets of 1.2 m with thin joints, here along both horizontal axes.
            const auto joint = [&](float v) {
                const float d = std::abs(v - std::round(v / 1.2f) * 1.2f);
                return smoothstep(0.002f + footprint, 0.0f, d) *
                       std::min(1.0f, 0.004f / (footprint + 1e-5f));
            };
            const float dark = std::abs(normal.x) > 0.5f ? joint(p.z + 0.6f) : joint(p.x + 0.6f);
            // Less light reaches the room's edges.
            const float edge =
                0.72f + 0.28f * smoothstep(0.0f, 0.7f, p.y) - 0.12f * smoothstep(2.3f, 2.95f, p.y) -
                0.15f * smoothstep(2.2f, 3.2f, std::min(std::abs(p.x), std::abs(p.z) + 0.4f));
            a.color = a.color * ((1 - 0.45f * dark) * edge * (1 + 0.02f * fractal(p * 1.3f, 2)));
            break;
        }
        case Look::ceiling: {
            const auto joint = [&](float v) {
                return smoothstep(0.006f + footprint, 0.0f,
                                  std::abs(v - std::round(v / 0.6f) * 0.6f));
            };
            a.color = a.color * (1 - 0.3f * std::max(joint(p.x), joint(p.z)));
            break;
        }
        case Look::steel: {
            a.normal = bumped(a.normal, p, 0.004f, [](F3 q) {
                return 0.00012f * noise({q.x * 30, q.y * 600, q.z * 600});
            });
            break;
        }
        case Look::mattress:
            weave(a, p, footprint, 0.5f);
            break;
        case Look::paper:
            a.color = pictures[std::size_t(p.z + 0.5f)].sample(p.x, p.y, footprint);
            break;
        case Look::screen: {
            const F3 c = pictures[std::size_t(p.z + 0.5f)].sample(p.x, p.y, footprint);
            a.glow = c * 0.75f;
            break;
        }
        default:
            a.color = a.color * (1 + 0.03f * noise(p * 30.0f));
    }
    return a;
}

float infrared(Look look, F3 p, const std::vector<Picture>& pictures) {
    const float base = traits(look).infrared;
    switch (look) {
        case Look::paper: {
            const F3 c = pictures[std::size_t(p.z + 0.5f)].sample(p.x, p.y, 0.003f);
            return base * (0.2f + 0.8f * c.x);  // carbon ink is dark in infrared too
        }
        case Look::liver:
        case Look::muscle:
        case Look::fat:
        case Look::bowel:
        case Look::peritoneum:
            return base * (1 + 0.15f * fractal(p * 45.0f, 2));
        default:
            return base;
    }
}

}  // namespace theatron::synthetic
