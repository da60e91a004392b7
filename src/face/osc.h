// SPDX-License-Identifier: Apache-2.0
// Packets of Open Sound Control (OSC 1.0), as far as trackers send them: messages with a number,
// with a truth value, or with a name and a number, alone or in bundles.
//
// Safe on any bytes: a packet that is not understood gives no message, never an allocation.
#pragma once

#include <functional>
#include <string_view>

#include "base/bytes.h"
#include "base/status.h"
#include "face/channels.h"

namespace theatron::face {

inline constexpr std::size_t max_osc_packet = 65536;
inline constexpr int max_osc_depth = 4;        // bundles in bundles
inline constexpr int max_osc_messages = 1024;  // of one packet

struct OscMessage {
    std::string_view address;  // "/avatar/parameters/v2/JawOpen"
    std::string_view text;     // the first argument where it is a text, as VMC's /VMC/Ext/Blend/Val
    float value = 0;           // the first number or truth value
    bool has_value = false;
    bool is_truth = false;  // the value was a truth value
};

// Calls `take` for each message, in order. Views are valid during the call. Not ok: what precedes
// the damage was given, what follows it was not.
Status read_osc(ByteView packet, const std::function<void(const OscMessage&)>& take);

// A bundle with one float a channel of `mask`, by ARKit's names under /theatron/face/: the scripted
// actor's packet.
Bytes osc_packet(const Channels& values, const ChannelMask& mask);

}  // namespace theatron::face
