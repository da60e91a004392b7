// SPDX-License-Identifier: Apache-2.0
// The six classes of Fischer et al. (EuroXR 2022).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace theatron::face {

enum class Emotion : std::uint8_t { sadness, disgust, happiness, surprise, anger, neutral };
inline constexpr std::size_t emotion_count = 6;
inline constexpr std::array<std::string_view, emotion_count> emotion_names = {
    "sadness", "disgust", "happiness", "surprise", "anger", "neutral"};

// One probability an emotion.
using Emotions = std::array<float, emotion_count>;

constexpr std::string_view to_text(Emotion emotion) {
    return emotion_names[std::size_t(emotion)];
}
constexpr std::optional<Emotion> emotion_of(std::string_view name) {
    for (std::size_t i = 0; i < emotion_count; ++i)
        if (emotion_names[i] == name)
            return Emotion(i);
    return std::nullopt;
}

}  // namespace theatron::face
