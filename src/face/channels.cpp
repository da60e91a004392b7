// SPDX-License-Identifier: Apache-2.0
#include "face/channels.h"

namespace theatron::face {

const std::array<std::string_view, channel_count> channel_names = {
    "eyeBlinkLeft",      "eyeLookDownLeft",    "eyeLookInLeft",
    "eyeLookOutLeft",    "eyeLookUpLeft",      "eyeSquintLeft",
    "eyeWideLeft",       "eyeBlinkRight",      "eyeLookDownRight",
    "eyeLookInRight",    "eyeLookOutRight",    "eyeLookUpRight",
    "eyeSquintRight",    "eyeWideRight",       "jawForward",
    "jawLeft",           "jawRight",           "jawOpen",
    "mouthClose",        "mouthFunnel",        "mouthPucker",
    "mouthLeft",         "mouthRight",         "mouthSmileLeft",
    "mouthSmileRight",   "mouthFrownLeft",     "mouthFrownRight",
    "mouthDimpleLeft",   "mouthDimpleRight",   "mouthStretchLeft",
    "mouthStretchRight", "mouthRollLower",     "mouthRollUpper",
    "mouthShrugLower",   "mouthShrugUpper",    "mouthPressLeft",
    "mouthPressRight",   "mouthLowerDownLeft", "mouthLowerDownRight",
    "mouthUpperUpLeft",  "mouthUpperUpRight",  "browDownLeft",
    "browDownRight",     "browInnerUp",        "browOuterUpLeft",
    "browOuterUpRight",  "cheekPuff",          "cheekSquintLeft",
    "cheekSquintRight",  "noseSneerLeft",      "noseSneerRight",
    "tongueOut"};

std::optional<Channel> channel_of(std::string_view name) {
    const auto equals = [&](std::string_view known) {
        return name.size() == known.size() && name.substr(1) == known.substr(1) &&
               (name[0] == known[0] || name[0] == char(known[0] - 'a' + 'A'));
    };
    for (std::size_t i = 0; i < channel_count; ++i)
        if (!name.empty() && equals(channel_names[i]))
            return Channel(i);
    return std::nullopt;
}

}  // namespace theatron::face
