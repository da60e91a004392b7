// SPDX-License-Identifier: Apache-2.0
// Gloved hands with jointed fingers.
#include <array>

#include "synthetic/implicit.h"
#include "synthetic/noise.h"
#include "synthetic/person.h"

namespace theatron::synthetic {
namespace {

std::array<Finger, 5> make_fingers() {
    std::array<Finger, 5> all;
    const auto straight = [](F3 base, F3 direction, float a, float b, float c, float r) {
        Finger f;
        const F3 d = normalized(direction);
        f.joint[0] = base;
        f.joint[1] = base + d * a;
        f.joint[2] = base + d * (a + b);
        f.joint[3] = base + d * (a + b + c);
        f.radius[0] = r * 1.08f;
        f.radius[1] = r;
        f.radius[2] = r * 0.92f;
        f.radius[3] = r * 0.78f;
        f.bend_axis = normalized(cross(d, F3{0, -1, 0}));
        return f;
    };
    all[0] =
        straight({0.024f, -0.008f, 0.02f}, {0.72f, -0.2f, 0.66f}, 0.044f, 0.034f, 0.027f, 0.0122f);
    all[0].bend_axis = normalized(cross(F3{0.72f, -0.2f, 0.66f}, F3{-0.55f, -0.55f, 0.6f}));
    all[1] = straight({0.031f, 0.001f, 0.093f}, {0.11f, 0, 1}, 0.042f, 0.026f, 0.021f, 0.0097f);
    all[2] = straight({0.0105f, 0.003f, 0.097f}, {0.03f, 0, 1}, 0.046f, 0.029f, 0.022f, 0.0099f);
    all[3] = straight({-0.0105f, 0.002f, 0.094f}, {-0.05f, 0, 1}, 0.042f, 0.027f, 0.021f, 0.0094f);
    all[4] = straight({-0.03f, -0.001f, 0.086f}, {-0.15f, 0, 1}, 0.033f, 0.02f, 0.019f, 0.0084f);
    return all;
}

float palm_shape(F3 p) {
    float d = rounded_box(p, {0, 0, 0.052f}, {0.041f, 0.0145f, 0.046f}, 0.014f);
    d = blend(d, capsule(p, {0.018f, -0.01f, 0.028f}, {0.03f, -0.008f, 0.06f}, 0.018f, 0.014f),
              0.02f);
    // Wrist, and the glove's cuff over the sleeve, with a rolled end.
    const F3 q{p.x * 0.86f, p.y, p.z};
    d = blend(d, capsule(q, {0, 0, -0.02f}, {0, 0, 0.02f}, 0.026f, 0.023f), 0.03f);
    const float cuff = capsule(p, {0, 0, -0.092f}, {0, 0, -0.03f}, 0.048f, 0.033f) -
                       0.0016f * noise({p.z * 120, std::atan2(p.x, p.y) * 2, 3}) +
                       std::max(0.0f, -0.098f - p.z);
    d = blend(d, cuff, 0.03f);
    const float roll = std::hypot(std::hypot(p.x, p.y) - 0.0475f, p.z + 0.093f) - 0.0036f;
    return blend(d, roll, 0.004f);
}

float phalanx(F3 p, const Finger& f, int k) {
    return capsule(p, f.joint[k], f.joint[k + 1], f.radius[k], f.radius[k + 1]);
}

float finger_shape(F3 p, const Finger& f) {
    float d = phalanx(p, f, 0);
    for (int k = 1; k < 3; ++k)
        d = blend(d, phalanx(p, f, k), 0.003f);
    // Knuckles.
    for (int k = 1; k < 3; ++k)
        d = blend(d, ball(p, f.joint[k], f.radius[k] * 1.06f), 0.004f);
    return d;
}

Mesh right_hand(float cell, Look look, std::vector<Influence>& influences, std::uint16_t first) {
    const Distance whole = [](F3 p) {
        float d = palm_shape(p);
        for (int i = 0; i < 5; ++i)
            d = blend(d, finger_shape(p, finger(i)), i == 0 ? 0.014f : 0.009f);
        return d;
    };
    Mesh m = make_surface(whole, {-0.07f, -0.06f, -0.12f}, {0.12f, 0.06f, 0.21f}, cell, look);
    for (const F3 p : m.positions) {
        int nearest = 1;
        for (int i = 0; i < 5; ++i)
            if (finger_shape(p, finger(i)) < finger_shape(p, finger(nearest)))
                nearest = i;
        const Finger& f = finger(nearest);
        // Weights change from joint to joint along the finger.
        const F3 d = normalized(f.joint[3] - f.joint[0]);
        const float along = dot(p - f.joint[0], d);
        const auto passed = [&](int joint) {
            const float at = dot(f.joint[joint] - f.joint[0], d);
            return smoothstep(at - 0.009f, at + 0.009f, along);
        };
        const float on_finger = smoothstep(-0.012f, 0.004f, palm_shape(p) - finger_shape(p, f));
        const float w0 = on_finger * (nearest == 0 ? smoothstep(-0.005f, 0.03f, along) : passed(0));
        const float w1 = passed(1), w2 = passed(2);
        const auto bone = std::uint16_t(first + 1 + nearest * 3);
        influences.push_back(
            {{first, bone, std::uint16_t(bone + 1), std::uint16_t(bone + 2)},
             {1 - w0 + 1e-6f, w0 * (1 - w1) + 1e-6f, w0 * w1 * (1 - w2) + 1e-6f, w0 * w1 * w2}});
    }
    return m;
}

// The cuff's vertices follow the forearm.
Influence with_cuff(const Influence& in, F3 p, std::uint16_t cuff) {
    const float share = smoothstep(0.002f, -0.045f, p.z);
    if (share <= 0)
        return in;
    return {{cuff, in.bone[0], 0, 0}, {share + 1e-6f, 1 - share, 0, 0}};
}

}  // namespace

const Finger& finger(int number) {
    static const auto all = make_fingers();
    return all[std::size_t(number)];
}

void add_hands(MovingMesh& out, std::uint16_t first, const PersonLooks& looks, double detail) {
    const float cell = 0.0031f / float(std::sqrt(detail));
    std::vector<Influence> influences;
    const Mesh right = right_hand(cell, looks.glove, influences, std::uint16_t(first + hand_right));
    std::vector<Influence> cuffed = influences;
    for (std::size_t i = 0; i < cuffed.size(); ++i)
        cuffed[i] = with_cuff(influences[i], right.positions[i], std::uint16_t(first + cuff_right));
    out.append(right, cuffed);
    Mesh left;
    left.append(right, scaling({-1, 1, 1}));
    for (Influence& in : influences)
        for (auto& b : in.bone)
            b = std::uint16_t(b - hand_right + hand_left);
    for (std::size_t i = 0; i < cuffed.size(); ++i)
        cuffed[i] = with_cuff(influences[i], right.positions[i], std::uint16_t(first + cuff_left));
    out.append(left, cuffed);
}

void pose_hand(const Affine& palm, float side, const Grip& grip, Affine* bones) {
    bones[0] = palm;
    for (int i = 0; i < 5; ++i) {
        const Finger& f = finger(i);
        // A left hand is the right one mirrored.
        const auto mirrored = [&](F3 v) { return side > 0 ? F3{-v.x, v.y, v.z} : v; };
        const auto axis = [&](F3 v) { return side > 0 ? F3{v.x, -v.y, -v.z} : v; };
        static constexpr float full[2][3] = {{0.75f, 0.7f, 0.8f}, {1.25f, 1.5f, 0.95f}};
        Affine at = palm;
        for (int k = 0; k < 3; ++k) {
            const F3 joint = mirrored(f.joint[k]);
            at = at * translation(joint) *
                 rotation(axis(f.bend_axis), grip.bend[i] * full[i > 0][k]) * translation(-joint);
            bones[1 + 3 * i + k] = at;
        }
    }
}

}  // namespace theatron::synthetic
