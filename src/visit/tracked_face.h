// SPDX-License-Identifier: Apache-2.0
// A tracker's OSC packets on a UDP port as the state of a face.
#pragma once

#include "face/face_input.h"
#include "face/osc_face.h"
#include "visit/face_files.h"
#include "visit/face_socket.h"

namespace theatron::visit {

// Time between two looks at a tracker.
inline constexpr Duration face_step = std::chrono::milliseconds(16);

class TrackedFace {
public:
    // Throws Error.
    explicit TrackedFace(const FacePort& at) : socket_(FaceSocket::bound(at.address, at.port)) {}

    // Takes what arrives until `end`, and waits for it.
    face::FaceNow next(TimePoint end);
    const face::OscCounts& counts() const { return osc_.counts(); }

private:
    FaceSocket socket_;
    face::OscFace osc_;
    face::FaceInput input_;
};

}  // namespace theatron::visit
