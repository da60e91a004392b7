// SPDX-License-Identifier: Apache-2.0
// The plain colour picture of one camera, and the surface that its depth camera measured: which
// place of the room is seen where.
//
// Pure. Places of the picture are shares of its width and height from its upper left corner. Room
// coordinates, metres.
#pragma once

#include <optional>

#include "base/ids.h"
#include "render/pick.h"
#include "viewer/cloud_pick.h"

namespace theatron::viewer {

class FlatPicture {
public:
    // `calibration` has colour; it and the pixels must outlive the picture. Depth of another size
    // than the calibration's, or of none, is as if none were measured.
    FlatPicture(CameraId camera, const Calibration& calibration, DepthView depth);

    bool has_surface() const { return surface_.depth.size.area() > 0; }
    double aspect() const;  // width over height
    Vec3 eye() const { return room_from_color_.translation; }
    // Nullopt where the lens images nothing.
    std::optional<render::PickRay> ray_through(Vec2 place) const;
    // The surface that this camera measured.
    std::optional<CloudPoint> surface_at(const render::PickRay& ray) const;

    struct Seen {
        Vec2 place;
        double heights_per_m = 0;  // the picture's heights that one metre has at this distance
    };
    // Nullopt behind the camera and far beside the picture, where a lens's model is not valid.
    std::optional<Seen> seen_at(Vec3 in_room) const;

private:
    CloudCamera surface_;
    Pose room_from_color_;
};

}  // namespace theatron::viewer
