// SPDX-License-Identifier: Apache-2.0
// The window of a face that the network sees: the channels of the last 0.7 s, relative to the
// person at rest.
//
// Three numbers a channel: the mean of the last 0.2 s, the mean of the window and its deviation.
// They do not depend on the tracker's rate. On recorded data a window is worth five points of
// accuracy over single frames (docs/face.md).
#pragma once

#include <span>

#include "face/recording.h"

namespace theatron::face {

inline constexpr float window_s = 0.7F, recent_s = 0.2F;
inline constexpr std::size_t features_per_channel = 3;
inline constexpr std::size_t feature_count = features_per_channel * channel_count;

using Features = std::array<float, feature_count>;

// The features of `samples` in the order of their times, of which those within window_s of the last
// one count. Precondition: at least one sample.
Features features_of(std::span<const Sample> samples, const Channels& rest);

// The mean of each channel: what a person's face is at rest.
Channels mean_of(std::span<const Sample> samples);

// True if the samples reach back far enough for a whole window.
bool fills_window(std::span<const Sample> samples);

}  // namespace theatron::face
