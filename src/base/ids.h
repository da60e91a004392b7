// SPDX-License-Identifier: Apache-2.0
// Names of things in a session, as types, so that one is never given for another.
#pragma once

#include <cstdint>

namespace theatron {

// A camera of the session, numbered by the host from 0 in the order of joining.
enum class CameraId : std::uint16_t {};
// One image stream of one camera: its depth or its colour.
enum class StreamId : std::uint16_t {};
// One way of encoding one stream; chosen by receivers, numbered by the sender.
enum class SettingId : std::uint16_t {};
// A connected participant; the host is 0.
enum class ParticipantId : std::uint32_t {};

// Depth and colour of a camera are two streams with fixed numbers.
constexpr StreamId depth_stream(CameraId camera) {
    return StreamId(2 * int(camera));
}
constexpr StreamId color_stream(CameraId camera) {
    return StreamId(2 * int(camera) + 1);
}
constexpr bool is_depth(StreamId stream) {
    return int(stream) % 2 == 0;
}
constexpr CameraId camera_of(StreamId stream) {
    return CameraId(int(stream) / 2);
}

// Counts the frames of one stream from 0; wraps after 4.5 years at 30 Hz.
using FrameNumber = std::uint32_t;

}  // namespace theatron
