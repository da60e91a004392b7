// SPDX-License-Identifier: Apache-2.0
#include "xr/xr_input.h"

#include <cmath>
#include <utility>

namespace theatron::xr {
namespace {

// Two limits each, so that a value between them changes nothing.
constexpr double trigger_closes = 0.6, trigger_opens = 0.4;
constexpr double pinch_closes_m = 0.018, pinch_opens_m = 0.035;
constexpr double stick_acts = 0.7, stick_rests = 0.4;
// Sticks at rest are not exactly in the middle.
constexpr double walk_from = 0.2;
constexpr double squeeze_points = 0.6;
// The index finger's tip is this much further from the wrist than those of the curled fingers.
constexpr double pointing_ratio = 1.35;

bool is_gripping(const HandState& hand, bool gripped) {
    if (!hand.joints)
        return hand.trigger > (gripped ? trigger_opens : trigger_closes);
    const double gap = length(hand.joints->thumb_tip - hand.joints->index_tip);
    return gap < (gripped ? pinch_opens_m : pinch_closes_m);
}

bool is_pointing(const HandState& hand) {
    if (!hand.joints)
        return hand.squeeze > squeeze_points;
    const auto reach = [&](Vec3 tip) { return length(tip - hand.joints->wrist); };
    const double index = reach(hand.joints->index_tip);
    return index > pointing_ratio * reach(hand.joints->middle_tip) &&
           index > pointing_ratio * reach(hand.joints->ring_tip);
}

// True in the frame in which a button goes down.
bool is_pressed(bool is_down, bool& was_down) {
    return !std::exchange(was_down, is_down) && is_down;
}

double beyond_rest(double value) {
    return std::abs(value) < walk_from ? 0 : value;
}

}  // namespace

Intents XrInput::update(const HeadsetFrame& frame, std::array<bool, 2> is_holding) {
    Intents intents;
    for (const Side side : {left_side, right_side}) {
        const auto& state = frame.hands[side];
        HandIntents& hand = intents.hands[side];
        if (!state) {
            hand.lets_go = std::exchange(hands_[side], {}).grips;
            continue;
        }
        Hand& before = hands_[side];
        hand.is_present = true;
        hand.is_bare = state->joints.has_value();
        hand.floor_from_aim = state->floor_from_aim;
        hand.floor_from_grip = state->floor_from_grip;
        hand.holds = is_gripping(*state, before.grips);
        hand.takes = hand.holds && !before.grips;
        hand.lets_go = !hand.holds && before.grips;
        before.grips = hand.holds;
        hand.points = !hand.holds && is_pointing(*state);
        hand.gives = is_pressed(state->lower_button, before.lower_button);
        intents.menu |= is_pressed(state->upper_button, before.upper_button);

        const Vec2 stick = state->stick;
        if (is_holding[side]) {
            hand.pushes_away = beyond_rest(stick.y);
            hand.turns_held = -beyond_rest(stick.x);
            before.aims = false;
            continue;
        }
        // With one hand alone, its stick turns and teleports.
        if (side == left_side && frame.hands[right_side]) {
            intents.walk = {beyond_rest(stick.x), beyond_rest(stick.y)};
            continue;
        }
        hand.aims_teleport = stick.y > (before.aims ? stick_rests : stick_acts);
        hand.teleports = !hand.aims_teleport && before.aims;
        before.aims = hand.aims_teleport;
        const bool snaps =
            !hand.aims_teleport && std::abs(stick.x) > (before.snapped ? stick_rests : stick_acts);
        if (snaps && !before.snapped)
            intents.turn_degrees = stick.x > 0 ? -snap_degrees : snap_degrees;
        before.snapped = snaps;
    }
    return intents;
}

}  // namespace theatron::xr
