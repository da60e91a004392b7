// SPDX-License-Identifier: Apache-2.0
// The network that tells six emotions from a window of channels: one hidden layer, about 8000
// weights.
//
// Pure; evaluation allocates nothing.
#pragma once

#include "base/bytes.h"
#include "base/status.h"
#include "face/window.h"

namespace theatron::face {

inline constexpr std::size_t hidden_count = 48;

struct Network {
    Source source = Source::arkit;
    ChannelMask mask;  // what it was trained on; others are ignored
    bool is_synthetic_only = true;
    std::uint32_t own_takes = 0;  // of the user, beside the synthetic ones
    // Features are scaled to mean 0 and deviation 1 of the training set; a missing one is 0.
    Features mean{}, scale{};
    std::array<std::array<float, hidden_count>, feature_count> into_hidden{};  // by feature
    std::array<float, hidden_count> hidden_bias{};
    std::array<std::array<float, hidden_count>, emotion_count> into_output{};
    std::array<float, emotion_count> output_bias{};
};

// Probabilities (softmax). `present`: the channels that are known just now.
Emotions evaluate(const Network& network, const Features& features, const ChannelMask& present);

// The most probable emotion; anger only where it is twice as probable as the next one, neutral
// otherwise: it is the class that real data confuses most, and a false angry face does harm.
Emotion decide(const Emotions& emotions);

// A trained network as bytes: see docs/formats/face_network.md.
Bytes network_bytes(const Network& network);
// Safe on any bytes.
Result<Network> parse_network(ByteView bytes);

}  // namespace theatron::face
