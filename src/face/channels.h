// SPDX-License-Identifier: Apache-2.0
// The internal vector of a face: the 52 blend shapes of ARKit, in ARKit's order.
//
// Every tracker is mapped to it (sources.h). A mask says which channels a tracker really has: one
// that it lacks is 0 and says nothing.
#pragma once

#include <array>
#include <bitset>
#include <optional>
#include <string_view>

namespace theatron::face {

inline constexpr std::size_t channel_count = 52;

// Positions of the channels that code names.
enum Channel : std::size_t {
    eye_blink_left,
    eye_look_down_left,
    eye_look_in_left,
    eye_look_out_left,
    eye_look_up_left,
    eye_squint_left,
    eye_wide_left,
    eye_blink_right,
    eye_look_down_right,
    eye_look_in_right,
    eye_look_out_right,
    eye_look_up_right,
    eye_squint_right,
    eye_wide_right,
    jaw_forward,
    jaw_left,
    jaw_right,
    jaw_open,
    mouth_close,
    mouth_funnel,
    mouth_pucker,
    mouth_left,
    mouth_right,
    mouth_smile_left,
    mouth_smile_right,
    mouth_frown_left,
    mouth_frown_right,
    mouth_dimple_left,
    mouth_dimple_right,
    mouth_stretch_left,
    mouth_stretch_right,
    mouth_roll_lower,
    mouth_roll_upper,
    mouth_shrug_lower,
    mouth_shrug_upper,
    mouth_press_left,
    mouth_press_right,
    mouth_lower_down_left,
    mouth_lower_down_right,
    mouth_upper_up_left,
    mouth_upper_up_right,
    brow_down_left,
    brow_down_right,
    brow_inner_up,
    brow_outer_up_left,
    brow_outer_up_right,
    cheek_puff,
    cheek_squint_left,
    cheek_squint_right,
    nose_sneer_left,
    nose_sneer_right,
    tongue_out,
};
static_assert(tongue_out + 1 == channel_count);

// Values from 0 (at rest) to 1.
using Channels = std::array<float, channel_count>;
using ChannelMask = std::bitset<channel_count>;

// ARKit's names: "eyeBlinkLeft" and so on.
extern const std::array<std::string_view, channel_count> channel_names;

// The channel that ARKit calls so; the first letter may be a capital one.
std::optional<Channel> channel_of(std::string_view name);

}  // namespace theatron::face
