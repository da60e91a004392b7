// SPDX-License-Identifier: Apache-2.0
// An adjustment of a camera by operators, for all who see it: its registered pose is moved and
// turned a little, and its depth is kept in a region of the picture only.
// Bytes: docs/formats/camera_adjustment.md.
#pragma once

#include <optional>
#include <string>

#include "base/bytes.h"
#include "base/status.h"
#include "geometry/calibration.h"
#include "image/view.h"

namespace theatron::session {

// A box in a picture, in pixels.
struct PictureBox {
    int x = 0, y = 0, width = 0, height = 0;
    bool operator==(const PictureBox&) const = default;
};

struct CameraAdjustment {
    static constexpr double max_moved_m = 0.3, max_turned_deg = 15;

    Vec3 moved_m;     // along the room's axes
    Vec3 turned_deg;  // about them, through the camera: the axis times the angle
    // The part of the depth picture that is sent. Empty: all of it.
    std::optional<PictureBox> region;

    bool is_nudged() const { return moved_m != Vec3{} || turned_deg != Vec3{}; }
    bool operator==(const CameraAdjustment&) const = default;
};

// True if the nudge is within its limits, and the region within a depth picture of this size.
bool is_within_limits(const CameraAdjustment& adjustment, Size depth);

// The pose of a camera that is registered at `registered`.
Pose nudged(const Pose& registered, const CameraAdjustment& adjustment);
// The inverse: the registered pose of a camera that now stands here.
Pose without_nudge(const Pose& nudged, const CameraAdjustment& adjustment);

// "moved by 12.0, 0.0, 0.0 mm; turned by 0.00, 1.50, 0.00 degrees"; "as registered".
std::string text_of(const CameraAdjustment& adjustment);

// In steps of a micrometre and a millionth of a degree; empty where nothing is adjusted.
Bytes encode_adjustment(const CameraAdjustment& adjustment);
// The adjustment as it is after encoding and decoding.
CameraAdjustment rounded(const CameraAdjustment& adjustment);
// Safe for untrusted input; limits are not checked. Empty bytes: nothing is adjusted.
Result<CameraAdjustment> decode_adjustment(ByteView bytes);

}  // namespace theatron::session
