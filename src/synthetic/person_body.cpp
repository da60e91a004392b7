// SPDX-License-Identifier: Apache-2.0
// Gown, sleeves, trousers and shoes.
#include "synthetic/implicit.h"
#include "synthetic/noise.h"
#include "synthetic/person.h"

namespace theatron::synthetic {
namespace {

// Distances to the gown's parts in the rest pose.
struct Gown {
    float seed;

    float torso(F3 p) const {
        // Round shoulders, chest, a loose belly, a skirt that widens to the floor.
        const float yoke =
            capsule(p, {-0.13f, 1.405f, -0.015f}, {0.13f, 1.405f, -0.015f}, 0.072f, 0.072f);
        const float ribs = ellipsoid(p, {0, 1.26f, 0.0f}, {0.178f, 0.235f, 0.132f});
        const float belly = ellipsoid(p, {0, 1.06f, 0.008f}, {0.172f, 0.23f, 0.142f});
        float d = blend(blend(yoke, ribs, 0.1f), belly, 0.1f);
        d = blend(d, skirt(p), 0.09f);
        // The opening for the neck.
        const float collar = capsule(p, {0, 1.43f, -0.012f}, {0, 1.505f, 0.0f}, 0.088f, 0.066f);
        d = blend(d, collar, 0.04f);
        // A belt draws the cloth in.
        const float belt = std::exp(-std::pow((p.y - 1.03f) / 0.02f, 2.0f));
        return d + 0.008f * belt;
    }
    float skirt(F3 p) const {
        const float t = clamp01((1.0f - p.y) / 0.72f);
        const float rx = mix(0.178f, 0.25f, t), rz = mix(0.15f, 0.215f, t);
        const float turn = std::atan2(p.x / rx, p.z / rz);
        const float folds =
            std::sin(turn * 9 +
                     2 * noise({2 * std::sin(turn), p.y * 2, 2 * std::cos(turn) + seed})) +
            0.5f * std::sin(turn * 17 +
                            3 * noise({3 * std::sin(turn), p.y * 3, 3 * std::cos(turn) + seed}));
        const float k = std::hypot(p.x / rx, p.z / rz) - 1;
        const float side =
            k * std::min(rx, rz) * 0.95f - folds * 0.014f * smoothstep(0.05f, 0.8f, t);
        return both(side, std::abs(p.y - 0.65f) - 0.37f, 0.03f);
    }
    // `along` receives the position from shoulder to wrist, 0 to 1.
    float sleeve(F3 p, float side, float& along) const {
        const F3 a{rest::shoulder.x * side, rest::shoulder.y, rest::shoulder.z};
        const F3 d = rest::arm_direction(side);
        const F3 b = a + d * (rest::upper_arm + rest::forearm);
        float r = capsule(p, a, b, 0, 0, &along);
        // The glove's cuff goes over the narrow end.
        const float width = along < 0.53f   ? mix(0.074f, 0.058f, along / 0.53f)
                            : along < 0.82f ? mix(0.058f, 0.045f, (along - 0.53f) / 0.29f)
                                            : mix(0.045f, 0.027f, smoothstep(0.82f, 0.9f, along));
        // Creases around the sleeve, deepest at the elbow.
        const F3 q = p - (a + d * dot(p - a, d));
        const float turn = std::atan2(q.y, q.x);
        const float crease = std::sin(along * 48 + 1.6f * std::sin(turn + side + seed) +
                                      4.5f * noise({along * 7, turn, seed + side}));
        const float deep = 0.0016f + 0.0034f * std::exp(-std::pow((along - 0.53f) / 0.13f, 2.0f));
        return r - width - deep * crease * smoothstep(0.9f, 0.8f, along) -
               0.004f * noise(p * 13.0f + F3{seed, 0, 0});
    }
    float whole(F3 p) const {
        float ignored;
        const float arms = std::min(sleeve(p, 1, ignored), sleeve(p, -1, ignored));
        float d = blend(torso(p), arms, 0.055f);
        // Drawn cloth: slanting folds over chest and belly.
        d -= 0.0055f * noise({p.x * 9 + p.y * 7 + seed, p.y * 5 - p.x * 6, p.z * 6});
        return d;
    }
};

Influence influence_at(const Gown& gown, F3 p, std::uint16_t first) {
    float along_left, along_right;
    const float left = gown.sleeve(p, 1, along_left), right = gown.sleeve(p, -1, along_right);
    const bool is_left = left < right;
    const float along = is_left ? along_left : along_right;
    const float arm_share = smoothstep(-0.025f, 0.05f, gown.torso(p) - std::min(left, right)) *
                            smoothstep(0.0f, 0.2f, along);
    const float bend = smoothstep(0.42f, 0.64f, along);
    const float upright = smoothstep(0.84f, 1.26f, p.y);
    const auto bone = [&](int b) { return std::uint16_t(first + b); };
    return {{bone(lower), bone(chest), bone(is_left ? upper_arm_left : upper_arm_right),
             bone(is_left ? forearm_left : forearm_right)},
            {(1 - arm_share) * (1 - upright) + 1e-6f, (1 - arm_share) * upright + 1e-6f,
             arm_share * (1 - bend) + 1e-6f, arm_share * bend}};
}

}  // namespace

F3 rest::arm_direction(float side) {
    return normalized({0.48f * side, -0.72f, 0.5f});
}

void add_body(MovingMesh& out, std::uint16_t first, const PersonLooks& looks, double detail) {
    const Gown gown{float(looks.seed % 97) * 0.37f};
    const float cell = 0.0095f / float(std::sqrt(detail));
    const Mesh cloth = make_surface([&](F3 p) { return gown.whole(p); }, {-0.55f, 0.26f, -0.28f},
                                    {0.55f, 1.56f, 0.42f}, cell, looks.gown);
    std::vector<Influence> influences;
    for (const F3 p : cloth.positions)
        influences.push_back(influence_at(gown, p, first));
    out.append(cloth, influences);

    // The belt, tied behind.
    std::vector<F3> around;
    for (int i = 0; i <= 40; ++i) {
        const float a = 2 * pi * float(i) / 40;
        const F3 outwards{std::sin(a), 0, -std::cos(a)};
        float r = 0.1f;
        for (int k = 0; k < 12; ++k)  // towards the surface
            r -= gown.whole(outwards * r + F3{0, 1.03f, 0}) * 0.8f;
        around.push_back(outwards * (r + 0.001f) + F3{0, 1.03f, 0});
    }
    Mesh belt = make_tube(around, {0.0026f}, 8, looks.gown, 5, {0, 0, 1});
    const F3 knot = around[0] + F3{0, 0, -0.006f};
    belt.append(make_ball({0.016f, 0.013f, 0.011f}, 12, looks.gown), translation(knot));
    for (const float s : {-1.0f, 1.0f})
        belt.append(make_tube(
            {knot, knot + F3{s * 0.02f, -0.08f, -0.012f}, knot + F3{s * 0.035f, -0.2f, -0.004f}},
            {0.005f, 0.009f, 0.011f}, 8, looks.gown, 0.3f, {1, 0, 0}));
    std::vector<Influence> belt_influences;
    for (const F3 p : belt.positions)
        belt_influences.push_back(influence_at(gown, {p.x, 1.03f, p.z}, first));
    out.append(belt, belt_influences);

    Mesh legs;
    for (const float s : {-1.0f, 1.0f}) {
        const float x = 0.105f * s;
        legs.append(make_tube({{x, 0.55f, 0}, {x, 0.3f, -0.01f}, {x, 0.12f, -0.02f}},
                              {0.085f, 0.075f, 0.082f}, 24, Look::scrubs));
        const Distance shoe = [x, s](F3 p) {
            const float sole = rounded_box(p, {x, 0.028f, 0.05f}, {0.045f, 0.028f, 0.135f}, 0.026f);
            const float upper =
                ellipsoid(p, {x + 0.004f * s, 0.05f, 0.04f}, {0.046f, 0.058f, 0.13f});
            return blend(sole, upper, 0.03f);
        };
        legs.append(make_surface(shoe, {x - 0.09f, -0.01f, -0.14f}, {x + 0.09f, 0.15f, 0.24f},
                                 0.009f, Look::shoe));
    }
    out.append(legs, std::uint16_t(first + lower));
}

void add_people(MovingMesh& moving, double detail, std::uint32_t seed, const Pulse& pulse) {
    const auto go_on = [&] {
        if (pulse)
            pulse();
    };
    const PersonLooks people[2] = {
        {Look::gown, Look::cap, Look::face, Look::glove, true, seed * 7 + 1},
        {Look::gown_assistant, Look::cap_assistant, Look::face_assistant, Look::glove_assistant,
         false, seed * 7 + 4}};
    for (int i = 0; i < 2; ++i) {
        const auto first = std::uint16_t(first_person + i * person_bone_count);
        add_body(moving, first, people[i], detail);
        go_on();
        add_head(moving, first, people[i], detail);
        go_on();
        add_hands(moving, first, people[i], detail);
        go_on();
    }
}

}  // namespace theatron::synthetic
