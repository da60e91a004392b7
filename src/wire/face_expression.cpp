// SPDX-License-Identifier: Apache-2.0
#include "wire/face_expression.h"

#include <cmath>

namespace theatron::wire {
namespace {

constexpr std::size_t state_size = 9;  // time, state
constexpr std::size_t few_channels = 3;
constexpr std::int64_t max_expression_us = std::int64_t(1) << 60;

void put_share(float value, ByteWriter& out) {
    // A value that is no number compares as false.
    const float limited = value > 0 ? (value < 1 ? value : 1) : 0;
    out.put(std::uint8_t(std::lround(limited * 255)));
}

void get_share(ByteReader& in, float& value) {
    value = float(in.get<std::uint8_t>()) / 255;
}

}  // namespace

Bytes encode_face_expression(const FaceExpression& expression) {
    Bytes bytes;
    ByteWriter out(bytes);
    out.put(to_us(expression.time));
    out.put(std::uint8_t(expression.state));
    if (expression.state == FaceExpression::State::none)
        return bytes;
    out.put(std::uint8_t(expression.channels ? face_channels : few_channels));
    for (const float weight : expression.emotions)
        put_share(weight, out);
    if (expression.channels) {
        for (const float value : *expression.channels)
            put_share(value, out);
    } else {
        for (const float value :
             {expression.jaw_open, expression.blink_left, expression.blink_right})
            put_share(value, out);
    }
    return bytes;
}

Result<FaceExpression> decode_face_expression(ByteView bytes) {
    if (bytes.size() < state_size)
        return Status::truncated;
    ByteReader in(bytes);
    const auto us = in.get<std::int64_t>();
    const unsigned state = in.get<std::uint8_t>();
    if (us > max_expression_us || us < -max_expression_us ||
        state > unsigned(FaceExpression::State::voiced))
        return Status::malformed;
    FaceExpression expression;
    expression.time = from_us(us);
    expression.state = FaceExpression::State(state);
    if (expression.state == FaceExpression::State::none)
        return bytes.size() == state_size ? Result(expression) : Status::trailing_bytes;
    if (bytes.size() == state_size)
        return Status::truncated;
    const std::size_t count = in.get<std::uint8_t>();
    if (count != few_channels && count != face_channels)
        return Status::malformed;
    const std::size_t size = state_size + 1 + face_emotions + count;
    if (bytes.size() != size)
        return bytes.size() < size ? Status::truncated : Status::trailing_bytes;
    for (float& weight : expression.emotions)
        get_share(in, weight);
    if (count == face_channels) {
        for (float& value : expression.channels.emplace())
            get_share(in, value);
    } else {
        for (float* value : {&expression.jaw_open, &expression.blink_left, &expression.blink_right})
            get_share(in, *value);
    }
    return expression;
}

}  // namespace theatron::wire
