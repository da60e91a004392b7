// SPDX-License-Identifier: Apache-2.0
#include "viewer/flat/flat_picture.h"

#include "geometry/camera_model.h"

namespace theatron::viewer {
namespace {

constexpr double margin = 0.25;  // beside the picture, shares of it

}  // namespace

FlatPicture::FlatPicture(CameraId camera, const Calibration& calibration, DepthView depth)
    : surface_{std::uint32_t(camera), &calibration, depth},
      room_from_color_(calibration.room_from_camera * inverse(calibration.color_from_depth)) {
    if (depth.size != calibration.depth.size)
        surface_.depth = {};
}

double FlatPicture::aspect() const {
    const Size size = surface_.calibration->color.size;
    return double(size.width) / size.height;
}

std::optional<render::PickRay> FlatPicture::ray_through(Vec2 place) const {
    const CameraModel& lens = surface_.calibration->color;
    const auto direction =
        unproject(lens, {place.x * lens.size.width - 0.5, place.y * lens.size.height - 0.5});
    if (!direction)
        return std::nullopt;
    return render::PickRay{
        eye(), normalized(rotate(room_from_color_.rotation, {direction->x, direction->y, 1}))};
}

std::optional<CloudPoint> FlatPicture::surface_at(const render::PickRay& ray) const {
    return has_surface() ? pick_cloud({surface_}, ray) : std::nullopt;
}

std::optional<FlatPicture::Seen> FlatPicture::seen_at(Vec3 in_room) const {
    const CameraModel& lens = surface_.calibration->color;
    const Vec3 p = inverse(room_from_color_) * in_room;
    const auto pixel = project(lens, p);
    if (!pixel)
        return std::nullopt;
    const Vec2 place{(pixel->x + 0.5) / lens.size.width, (pixel->y + 0.5) / lens.size.height};
    if (!(place.x > -margin && place.x < 1 + margin && place.y > -margin && place.y < 1 + margin))
        return std::nullopt;
    return Seen{place, lens.fy / (p.z * lens.size.height)};
}

}  // namespace theatron::viewer
