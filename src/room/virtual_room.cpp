// SPDX-License-Identifier: Apache-2.0
#include "room/virtual_room.h"

#include <algorithm>
#include <cmath>

#include "room/facing.h"
#include "room/mesh_parts.h"

namespace theatron::room {
namespace {

using render::MeshData;

// Distance between the cameras and the walls, and the smallest room.
constexpr double margin_m = 1.5, least_side_m = 6, least_height_m = 2.8, above_cameras_m = 0.4;
// The walls also enclose the point at this distance ahead of each camera.
constexpr double looks_at_m = 2.5;
// Sensors measure a floor some centimetres too low now and then.
constexpr double floor_below_m = 0.03;
constexpr double label_height_m = 0.065, label_below_m = 0.14;
constexpr double letter_width = 0.8;  // of a capital's height, about
// A camera's mark is not drawn if the eye is nearer than this: it would fill the picture.
constexpr double free_around_eye_m = 0.35;
// Nearer labels would fill the picture.
constexpr double label_from_m = 1.2;

const render::SurfaceLook floor_look{{0.105, 0.125, 0.135}, 0, 0.55, 1, 1};
const render::SurfaceLook wall_look{{0.16, 0.19, 0.20}, 0, 0.9, 1, 0};
const render::SurfaceLook mark_look{{0.75, 0.77, 0.78}, 0, 0.4, 1, 0};

// A rectangle, counter-clockwise seen from where its normal points to.
void add_rectangle(MeshData& mesh, Vec3 corner, Vec3 along, Vec3 up) {
    const Vec3 n = normalized(cross(along, up));
    const auto first = std::uint32_t(mesh.vertices.size());
    for (const Vec3 p : {corner, corner + along, corner + along + up, corner + up})
        mesh.vertices.push_back(
            {float(p.x), float(p.y), float(p.z), float(n.x), float(n.y), float(n.z)});
    for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u})
        mesh.indices.push_back(first + i);
}

MeshData floor_mesh(const RoomExtent& e) {
    MeshData mesh;
    add_rectangle(mesh, {e.left, -floor_below_m, e.front}, {e.right - e.left, 0, 0},
                  {0, 0, e.back - e.front});
    return mesh;
}

// Seen from inside.
MeshData wall_meshes(const RoomExtent& e) {
    MeshData mesh;
    const Vec3 up{0, e.height + floor_below_m, 0};
    const double y = -floor_below_m, width = e.right - e.left, depth = e.front - e.back;
    add_rectangle(mesh, {e.left, y, e.back}, {width, 0, 0}, up);
    add_rectangle(mesh, {e.right, y, e.front}, {-width, 0, 0}, up);
    add_rectangle(mesh, {e.left, y, e.front}, {0, 0, -depth}, up);
    add_rectangle(mesh, {e.right, y, e.back}, {0, 0, depth}, up);
    return mesh;
}

// A camera's housing, behind its lens.
MeshData mark_mesh() {
    MeshData mesh = render::make_box_mesh({-0.05, -0.02, -0.09}, {0.05, 0.02, -0.005});
    const MeshData lens = render::make_box_mesh({-0.018, -0.018, -0.005}, {0.018, 0.018, 0.005});
    append(mesh, lens, {1, 1, 1}, {});
    return mesh;
}

}  // namespace

std::optional<RoomExtent> extent_of(const std::vector<RoomCamera>& cameras) {
    std::optional<RoomExtent> extent;
    const auto include = [&](Vec3 p) {
        if (!extent)
            extent = RoomExtent{p.x, p.x, p.z, p.z, least_height_m};
        extent->left = std::min(extent->left, p.x);
        extent->right = std::max(extent->right, p.x);
        extent->back = std::min(extent->back, p.z);
        extent->front = std::max(extent->front, p.z);
        extent->height = std::max(extent->height, p.y + above_cameras_m);
    };
    for (const RoomCamera& camera : cameras)
        if (camera.calibration.registered) {
            include(camera.calibration.room_from_camera.translation);
            Vec3 ahead = camera.calibration.room_from_camera * Vec3{0, 0, looks_at_m};
            ahead.y = 0;
            include(ahead);
        }
    if (cameras.empty())
        include({});
    if (!extent)
        return extent;
    const auto widen = [](double& low, double& high) {
        const double more = std::max(margin_m, (least_side_m - (high - low)) / 2);
        low -= more;
        high += more;
    };
    widen(extent->left, extent->right);
    widen(extent->back, extent->front);
    return extent;
}

void VirtualRoom::set_cameras(const std::vector<RoomCamera>& cameras) {
    if (cameras == cameras_)
        return;
    cameras_ = cameras;
    const auto extent = extent_of(cameras);
    if (extent == extent_)
        return;
    extent_ = extent;
    if (!extent)
        return;
    floor_.emplace(floor_mesh(*extent));
    walls_.emplace(wall_meshes(*extent));
    if (!mark_)
        mark_.emplace(mark_mesh());
}

void VirtualRoom::add_to(render::SceneFrame& frame, const render::CameraView& view) const {
    if (!extent_)
        return;
    const RoomExtent& e = *extent_;
    frame.to_light = {0.25, 1, 0.35};
    frame.shadow_middle = {(e.left + e.right) / 2, e.height / 2, (e.back + e.front) / 2};
    frame.shadow_radius_m = 0.5 * length({e.right - e.left, e.height, e.front - e.back});
    frame.objects.push_back({&*floor_, {}, floor_look, true});
    frame.objects.push_back({&*walls_, {}, wall_look, true});
    const Vec3 eye = view.room_from_eye.translation;
    for (const RoomCamera& camera : *cameras_) {
        const Pose& pose = camera.calibration.room_from_camera;
        const double distance = length(pose.translation - eye);
        if (!camera.calibration.registered || distance < free_around_eye_m)
            continue;
        frame.objects.push_back({&*mark_, pose, mark_look});
        if (distance < label_from_m)
            continue;
        // Cameras hang high.
        Pose place = facing(pose.translation - Vec3{0, label_below_m, 0}, eye);
        const double half_width = 0.5 * label_height_m * letter_width * double(camera.label.size());
        place.translation = place * Vec3{-half_width, 0, 0};
        frame.texts.push_back({camera.label, place, label_height_m, {225, 230, 230}});
    }
}

}  // namespace theatron::room
