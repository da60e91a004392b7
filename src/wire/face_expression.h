// SPDX-License-Identifier: Apache-2.0
// The expression of a person's face just now, without a picture: the state of topic `expression`
// (docs/formats/face_expression.md).
#pragma once

#include <array>
#include <optional>

#include "base/bytes.h"
#include "base/status.h"
#include "base/time.h"

namespace theatron::wire {

// Sadness, disgust, happiness, surprise, anger, neutral; and ARKit's 52 blend shapes in its order.
inline constexpr std::size_t face_emotions = 6, face_channels = 52;

struct FaceExpression {
    enum class State : std::uint8_t {
        none,     // the face is no longer sent; the fields below are as in a new object
        tracked,  // a tracker sees the face
        lost,     // the tracker is silent, so the face is at rest
        voiced,   // as tracked, but the mouth is guessed from the person's voice
    };
    TimePoint time;  // session time that the expression is for
    State state = State::none;
    // All values are from 0 to 1. Weights of emotions are a guess; their sum is about 1.
    std::array<float, face_emotions> emotions{};
    // These three move with the person, whatever the emotions are.
    float jaw_open = 0, blink_left = 0, blink_right = 0;
    // Only of a person who chose so: the whole face as it was tracked, in place of the above.
    std::optional<std::array<float, face_channels>> channels;
    bool operator==(const FaceExpression&) const = default;
};

// Values are rounded to 1/255; those that are out of range, or no numbers, are limited.
Bytes encode_face_expression(const FaceExpression& expression);

// Safe for untrusted input. All values that come out are from 0 to 1.
Result<FaceExpression> decode_face_expression(ByteView bytes);

}  // namespace theatron::wire
