// SPDX-License-Identifier: Apache-2.0
// The motion of the loop, on a clock of 24 beats without a seam: the surgeon clamps, returns
// the clamp, gets scissors, cuts, returns them, steps back to see the monitor, and is handed
// the clamp again. All small motions are sums of sines with whole periods in the loop.
#include <span>

#include "synthetic/instruments.h"
#include "synthetic/noise.h"
#include "synthetic/person_pose.h"

namespace theatron::synthetic {
namespace {

constexpr float beats = 24;

struct Key {
    float at;  // beats
    HandPose hand;
    float busy;  // amplitude of the small motion, metres
};

// Interpolates smoothly between keys; the first follows the last.
Key between(std::span<const Key> keys, float beat) {
    std::size_t next = 0;
    while (next < keys.size() && keys[next].at <= beat)
        ++next;
    const Key& a = keys[(next + keys.size() - 1) % keys.size()];
    const Key& b = keys[next % keys.size()];
    const float from = a.at > beat ? a.at - beats : a.at;
    const float to = b.at <= beat ? b.at + beats : b.at;
    const float t = smoothstep(from, to, beat);
    Key k = a;
    k.hand.grip = mix(a.hand.grip, b.hand.grip, t);
    k.hand.yaw = mix(a.hand.yaw, b.hand.yaw, t);
    k.hand.pitch = mix(a.hand.pitch, b.hand.pitch, t);
    k.hand.roll = mix(a.hand.roll, b.hand.roll, t);
    k.hand.bend = mix(a.hand.bend, b.hand.bend, t);
    k.busy = mix(a.busy, b.busy, t);
    return k;
}

// A sine with `times` periods per loop.
float swing(double phase, int times, float shift) {
    return std::sin(2 * pi * (float(phase * times - std::floor(phase * times)) + shift));
}

F3 wander(double phase, std::uint32_t seed) {
    const float s = hash01(seed);
    return {0.6f * swing(phase, 7, s) + 0.4f * swing(phase, 17, s + 0.3f),
            0.5f * swing(phase, 9, s + 0.1f) + 0.35f * swing(phase, 19, s + 0.7f),
            0.6f * swing(phase, 8, s + 0.5f) + 0.4f * swing(phase, 15, s + 0.2f)};
}

// A tool's frame in the hand's frame: its tip is `reach` beyond the grip point along `direction`.
Affine held(F3 direction, float reach, float side) {
    const F3 grip{grip_point.x * -side, grip_point.y, grip_point.z};
    const F3 d = normalized(F3{direction.x * -side, direction.y, direction.z});
    return facing(grip + d * reach, d, {0, 1, 0.2f});
}

Affine mixed(const Affine& a, const Affine& b, float t) {
    const F3 z = normalized(mix(a.z, b.z, t));
    const F3 y = mix(a.y, b.y, t);
    Affine m = facing(mix(a.origin, b.origin, t), z, y);
    return m;
}

const F3 clamp_place{0.538f, 1.177f, -0.045f}, scissors_place{0.574f, 1.177f, -0.045f};

// The assistant's grip point for a tool on the tray with its tip at `place`.
F3 picking(F3 place) {
    return place + F3{0, 0.008f, 0.03f};
}

const F3 exchange{0.19f, 1.262f, -0.05f};  // position where the assistant hands over tools

constexpr float carry_pitch = 0.5f;

const std::array<Key, 9>& surgeon_right() {
    static const HandPose work{{0.075f, 1.17f, 0.105f}, 0.25f, 0.62f, 0.35f, 0.5f};
    static const HandPose deep{{0.045f, 1.155f, 0.09f}, 0.3f, 0.7f, 0.3f, 0.52f};
    static const HandPose meet{{0.19f, 1.262f, 0.085f}, -0.02f, -0.12f, 0.5f, 0.45f};
    static const HandPose wait{{0.14f, 1.21f, 0.13f}, 0.3f, 0.35f, 0.25f, 0.22f};
    static const std::array<Key, 9> keys{{{1.4f, work, 0.012f},
                                          {3.0f, deep, 0.009f},
                                          {4.4f, work, 0.012f},
                                          {6.0f, meet, 0.001f},
                                          {8.0f, wait, 0.004f},
                                          {11.6f, meet, 0.001f},
                                          {13.2f, work, 0.013f},
                                          {15.0f, deep, 0.01f},
                                          {18.0f, meet, 0.001f}}};
    return keys;
}

HandPose surgeon_right_waiting() {
    return {{0.16f, 1.2f, 0.16f}, 0.2f, 0.3f, 0.2f, 0.25f};
}

const std::array<Key, 8>& assistant_left() {
    const auto at = [](F3 grip, float bend) { return HandPose{grip, 0, carry_pitch, 0.1f, bend}; };
    static const HandPose rest{{0.2f, 1.17f, -0.11f}, -0.25f, 0.55f, 0.3f, 0.35f};
    static const std::array<Key, 8> keys{{{0.2f, at(exchange, 0.4f), 0.001f},
                                          {2.5f, rest, 0.008f},
                                          {4.0f, rest, 0.008f},
                                          {6.0f, at(exchange, 0.42f), 0.001f},
                                          {8.4f, at(picking(clamp_place), 0.5f), 0},
                                          {9.2f, at(picking(scissors_place), 0.5f), 0},
                                          {11.6f, at(exchange, 0.45f), 0.001f},
                                          {14.0f, rest, 0.008f}}};
    return keys;
}

const std::array<Key, 4>& assistant_left_later() {
    const auto at = [](F3 grip, float bend) { return HandPose{grip, 0, carry_pitch, 0.1f, bend}; };
    static const std::array<Key, 4> keys{{{16.2f, assistant_left()[7].hand, 0.008f},
                                          {18.0f, at(exchange, 0.42f), 0.001f},
                                          {20.4f, at(picking(scissors_place), 0.5f), 0},
                                          {21.2f, at(picking(clamp_place), 0.5f), 0}}};
    return keys;
}

template <std::size_t A, std::size_t B>
std::array<Key, A + B> joined(const std::array<Key, A>& a, const std::array<Key, B>& b) {
    std::array<Key, A + B> all;
    std::copy(a.begin(), a.end(), all.begin());
    std::copy(b.begin(), b.end(), all.begin() + A);
    return all;
}

// The owner of a tool at this beat, as shares that sum up to one.
struct Holders {
    float tray = 0, assistant = 0, surgeon = 0;
};
Holders clamp_holders(float beat) {
    const float given = smoothstep(5.85f, 6.2f, beat) - smoothstep(23.75f, 24.1f, beat) -
                        smoothstep(-0.25f, 0.1f, beat) + 1;
    const float away = clamp01(given);  // 1 while not in the surgeon's hand
    const float laid = smoothstep(8.3f, 8.5f, beat) - smoothstep(21.1f, 21.3f, beat);
    return {away * laid, away * (1 - laid), 1 - away};
}
Holders scissors_holders(float beat) {
    const float away = 1 - (smoothstep(11.5f, 11.85f, beat) - smoothstep(17.85f, 18.2f, beat));
    const float carried = smoothstep(9.1f, 9.3f, beat) - smoothstep(20.3f, 20.5f, beat);
    return {away * (1 - carried), away * carried, 1 - away};
}

constexpr std::uint16_t tool_bone(Tool tool) {
    return std::uint16_t(std::uint16_t(first_tool) + std::uint16_t(tool));
}

Affine lying(F3 tip) {
    return translation(tip) * rotation({0, 1, 0}, pi);
}

Affine tool_frame(const Holders& who, const Affine& tray, const Affine& assistant,
                  const Affine& surgeon) {
    if (who.tray > 0.999f)
        return tray;
    Affine at =
        mixed(tray, assistant, clamp01(who.assistant / std::max(who.assistant + who.tray, 1e-4f)));
    return who.surgeon > 0 ? mixed(at, surgeon, who.surgeon) : at;
}

}  // namespace

void add_tools(MovingMesh& moving) {
    for (const int side : {-1, 1})
        moving.append(make_scissor_half(side, 0), tool_bone((side < 0 ? scissors_a : scissors_b)));
    moving.append(make_forceps(0.006f), tool_bone(forceps));
    moving.append(make_clamp(0.05f), tool_bone(hemostat));
    moving.append(make_hand_retractor(), tool_bone(retractor));
}

std::vector<Affine> pose_bones(double phase, double, std::uint32_t seed) {
    std::vector<Affine> bones(bone_count);
    const float beat = float(phase) * beats;
    // Ventilation: six breaths per loop; inspiration is faster than expiration.
    const float fill = 0.5f - 0.5f * std::cos(2 * pi * float(phase * 6 - std::floor(phase * 6)) +
                                              0.5f * swing(phase, 6, 0.1f));
    bones[breath] = translation({0, 0.007f * fill, 0});
    bones[organ] = translation({0.004f * fill, 0.006f * fill, 0.001f * swing(phase, 6, 0.3f)});

    // A step back, facing the monitor.
    const float back = smoothstep(18.6f, 20.0f, beat) - smoothstep(21.6f, 23.2f, beat);
    const F3 situs{0.0f, 1.04f, 0.01f}, monitor{0.3f, 1.7f, -1.8f};

    PersonPose surgeon;
    surgeon.root = translation({0.015f + 0.008f * swing(phase, 2, 0.2f), 0, 0.555f + 0.1f * back}) *
                   rotation({0, 1, 0}, pi + 0.04f * swing(phase, 3, 0) - 0.05f * back);
    surgeon.lean = 0.33f - 0.16f * back + 0.015f * swing(phase, 5, 0.4f);
    surgeon.sway = 0.015f * swing(phase, 3, 0.15f);
    surgeon.breath = swing(phase, 5, 0.6f);
    surgeon.look_at = mix(situs + wander(phase, seed + 11) * 0.03f, monitor, back);
    const float glance = smoothstep(5.0f, 5.7f, beat) - smoothstep(6.6f, 7.4f, beat) +
                         smoothstep(10.6f, 11.2f, beat) - smoothstep(12.0f, 12.6f, beat);
    surgeon.look_at = mix(surgeon.look_at, exchange, 0.8f * glance);

    auto keys =
        joined(surgeon_right(), std::array<Key, 2>{{{20.0f, surgeon_right_waiting(), 0.003f},
                                                    {22.0f, surgeon_right_waiting(), 0.003f}}});
    auto offered = joined(keys, std::array<Key, 1>{{{23.95f, surgeon_right()[3].hand, 0.001f}}});
    Key right = between(offered, beat);
    right.hand.grip += wander(phase, seed + 1) * right.busy;
    surgeon.hands[1] = right.hand;
    HandPose left{{-0.085f, 1.165f, 0.105f}, -0.3f, 0.6f, 0.4f, 0.5f};
    left.grip += wander(phase, seed + 2) * 0.013f + F3{-0.01f, 0.02f, 0.03f} * back;
    surgeon.hands[0] = left;

    PersonPose assistant;
    assistant.root = translation({0.12f + 0.006f * swing(phase, 3, 0.7f), 0, -0.56f}) *
                     rotation({0, 1, 0}, 0.1f + 0.05f * swing(phase, 2, 0.4f));
    assistant.lean = 0.27f + 0.02f * swing(phase, 4, 0.1f);
    assistant.sway = 0.015f * swing(phase, 2, 0.6f);
    assistant.breath = swing(phase, 6, 0.2f);
    const float at_tray = smoothstep(6.6f, 7.6f, beat) - smoothstep(9.6f, 10.6f, beat) +
                          smoothstep(18.5f, 19.4f, beat) - smoothstep(21.4f, 22.4f, beat);
    assistant.look_at = mix(situs + wander(phase, seed + 12) * 0.03f, F3{0.56f, 1.17f, 0}, at_tray);
    const float to_face = smoothstep(14.6f, 15.4f, beat) - smoothstep(16.2f, 17.0f, beat);
    assistant.look_at = mix(assistant.look_at, F3{0.0f, 1.62f, 0.4f}, to_face);
    auto later = joined(joined(assistant_left(), assistant_left_later()),
                        std::array<Key, 1>{{{23.7f, assistant_left()[0].hand, 0.001f}}});
    Key offering = between(later, beat);
    offering.hand.grip += wander(phase, seed + 3) * offering.busy;
    assistant.hands[0] = offering.hand;
    HandPose holding{{-0.1f, 1.2f, -0.2f}, 0.15f, 0.12f, 0.75f, 0.82f};
    holding.grip += wander(phase, seed + 4) * 0.003f;
    assistant.hands[1] = holding;

    std::array<Affine, 2> surgeon_palms, assistant_palms;
    pose_person(surgeon, &bones[first_person], surgeon_palms);
    pose_person(assistant, &bones[first_person + person_bone_count], assistant_palms);

    // Tools follow their hands.
    const F3 pen{0.02f, -0.5f, 0.86f};
    const F3 offered_direction{0, -std::sin(carry_pitch), -std::cos(carry_pitch)};
    const auto place = [&](Tool tool) -> Affine& { return bones[tool_bone(tool)]; };
    const Affine in_surgeon = surgeon_palms[1] * held(pen, 0.145f, -1);
    const Affine in_assistant = assistant_palms[0] * held(offered_direction, 0.03f, 1);
    place(hemostat) = tool_frame(clamp_holders(beat), lying(clamp_place), in_assistant, in_surgeon);
    const Affine scissors =
        tool_frame(scissors_holders(beat), lying(scissors_place), in_assistant, in_surgeon);
    const float cutting = smoothstep(12.6f, 13.2f, beat) - smoothstep(16.6f, 17.2f, beat);
    const float open = 0.05f + cutting * (0.1f + 0.1f * swing(phase, 22, 0));
    const F3 joint{0, 0, -0.058f};
    for (const float s : {-1.0f, 1.0f})
        place(s < 0 ? scissors_a : scissors_b) =
            scissors * translation(joint) * rotation({0, 1, 0}, s * open) * translation(-joint);
    place(forceps) = surgeon_palms[0] * held(pen, 0.085f, 1);
    place(retractor) = assistant_palms[1] * held({-0.05f, -0.25f, 0.97f}, 0.17f, -1);
    return bones;
}

}  // namespace theatron::synthetic
