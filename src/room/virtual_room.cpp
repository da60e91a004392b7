// SPDX-License-Identifier: Apache-2.0
#include "room/virtual_room.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "furniture/baked_light.h"
#include "furniture/pieces.h"
#include "furniture/shell.h"
#include "room/facing.h"
#include "room/mesh_parts.h"

namespace theatron::room {
namespace {

using render::MeshData;

// Distance between the cameras and the walls, and the smallest room.
constexpr double margin_m = 1.5, least_side_m = 7, least_height_m = 3, above_cameras_m = 0.4;
constexpr double step_m = 0.5;
// The walls also enclose the point at this distance ahead of each camera.
constexpr double looks_at_m = 2.5;
constexpr double label_height_m = 0.065, label_below_m = 0.14;
constexpr double letter_width = 0.8;  // of a capital's height, about
// A camera's mark is not drawn if the eye is nearer than this: it would fill the picture.
constexpr double free_around_eye_m = 0.35;
// The lamps of the table, as in furniture/baked_light.cpp.
constexpr double spot_strength = 14, spot_slope = 0.42;

const render::SurfaceLook mark_look{{0.75, 0.77, 0.78}, 0, 0.4, 1, 0};

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
        low = step_m * std::floor((low - more) / step_m + 1e-6);
        high = step_m * std::ceil((high + more) / step_m - 1e-6);
    };
    widen(extent->left, extent->right);
    widen(extent->back, extent->front);
    extent->height = step_m * std::ceil(extent->height / step_m - 1e-6);
    return extent;
}

// The room on the GPU, in one quality.
struct VirtualRoom::Meshes {
    struct Surface {
        render::SceneMesh mesh;
        std::optional<render::SceneTexture> texture;
        render::SurfaceLook look;
        bool backdrop, casts_shadow;
    };
    render::SceneQuality quality;
    std::vector<Surface> surfaces;
    std::vector<render::Spotlight> spots;
    render::SceneMesh mark{mark_mesh()};
    bool complete = false;

    explicit Meshes(render::SceneQuality wanted) : quality(wanted) {}

    void step(const RoomExtent& extent, const std::vector<furniture::Piece>& pieces) {
        const bool low = quality == render::SceneQuality::low;
        if (!light) {
            light.emplace(extent);
        } else if (!light_is_made) {
            light_is_made = light->step(pieces);
        } else if (sides_done < std::size(furniture::all_sides)) {
            const furniture::Side side = furniture::all_sides[sides_done];
            // Nothing throws a shadow on the ceiling.
            const bool is_lit = low || side == furniture::Side::ceiling;
            if (!picture)
                picture.emplace(extent, side, is_lit ? &*light : nullptr);
            if (picture->step()) {
                add_side(extent, side, is_lit);
                picture.reset();
                ++sides_done;
            }
        } else if (low && pieces_done < pieces.size()) {
            furniture::append_baked(baked, pieces[pieces_done++], *light);
        } else {
            if (low)
                add(std::exchange(baked, {}), baked_look(), false);
            else
                add_materials(pieces);
            add_spots(pieces);
            light.reset();
            complete = true;
        }
    }

private:
    // While they are made:
    std::optional<furniture::BakedLight> light;
    bool light_is_made = false;
    std::optional<furniture::SidePicture> picture;  // of the next side
    std::size_t sides_done = 0, pieces_done = 0;
    MeshData baked;

    static render::SurfaceLook baked_look() {
        render::SurfaceLook look{{1, 1, 1}};
        look.baked = true;
        return look;
    }
    void add(const MeshData& mesh, const render::SurfaceLook& look, bool casts_shadow) {
        surfaces.push_back({render::SceneMesh(mesh), std::nullopt, look, false, casts_shadow});
    }
    void add_side(const RoomExtent& extent, furniture::Side side, bool is_lit) {
        render::SurfaceLook look = baked_look();
        if (!is_lit)
            look = {{1, 1, 1}, 0, furniture::roughness_of(side)};
        surfaces.push_back({render::SceneMesh(furniture::side_mesh(extent, side)),
                            render::SceneTexture(picture->image().size), look, true, false});
        surfaces.back().texture->set(picture->image().view());
    }
    // One mesh of each material.
    void add_materials(const std::vector<furniture::Piece>& pieces) {
        for (const bool shadow : {true, false}) {
            furniture::Model all;
            for (const furniture::Piece& piece : pieces)
                if (piece.casts_shadow == shadow)
                    all.add(piece.model, piece.room_from_piece);
            for (const furniture::Model::Part& part : all.parts)
                add(part.mesh, furniture::look_of(part.material), shadow);
        }
    }
    void add_spots(const std::vector<furniture::Piece>& pieces) {
        for (const furniture::Piece& piece : pieces)
            if (piece.name == "table lamps")
                for (const Vec3 lamp : furniture::lamp_places)
                    spots.push_back({lamp, furniture::lamp_target, spot_strength, spot_slope});
    }
};

VirtualRoom::VirtualRoom() = default;
VirtualRoom::~VirtualRoom() = default;
VirtualRoom::VirtualRoom(VirtualRoom&&) noexcept = default;
VirtualRoom& VirtualRoom::operator=(VirtualRoom&&) noexcept = default;

void VirtualRoom::set_cameras(const std::vector<RoomCamera>& cameras) {
    if (cameras == cameras_)
        return;
    cameras_ = cameras;
    const auto extent = extent_of(cameras);
    if (!extent) {
        space_.reset();
        pieces_.clear();
        meshes_.reset();
        return;
    }
    std::vector<Calibration> calibrations;
    for (const RoomCamera& camera : cameras)
        calibrations.push_back(camera.calibration);
    std::vector<furniture::Piece> pieces = furniture::furnish(*extent, calibrations);
    // The extent says where a piece stands.
    const bool same = space_ && space_->extent == *extent &&
                      std::equal(pieces.begin(), pieces.end(), pieces_.begin(), pieces_.end(),
                                 [](const auto& a, const auto& b) { return a.name == b.name; });
    if (same)
        return;
    space_ = FreeSpace{*extent, {}};
    for (const furniture::Piece& piece : pieces)
        if (piece.blocks)
            for (const furniture::Box& box : furniture::obstacles_of(piece))
                space_->obstacles.push_back(box);
    pieces_ = std::move(pieces);
    meshes_.reset();
}

bool VirtualRoom::build_step(render::SceneQuality quality) {
    if (!space_ || (meshes_ && meshes_->quality == quality && meshes_->complete))
        return false;
    if (!meshes_ || meshes_->quality != quality)
        meshes_ = std::make_unique<Meshes>(quality);
    meshes_->step(space_->extent, pieces_);
    return meshes_->complete;
}

void VirtualRoom::build(render::SceneQuality quality) {
    while (space_ && !(meshes_ && meshes_->quality == quality && meshes_->complete))
        (void)build_step(quality);
}

void VirtualRoom::add_to(render::SceneFrame& frame, const render::CameraView& view) {
    if (!space_ || !meshes_ || !meshes_->complete)
        return;
    const RoomExtent& e = space_->extent;
    frame.to_light = {0.2, 1, 0.28};
    frame.light = 2.5;
    frame.surroundings = 1.45;
    frame.shadow_middle = {(e.left + e.right) / 2, e.height / 2, (e.back + e.front) / 2};
    frame.shadow_radius_m = 0.5 * length({e.right - e.left, e.height, e.front - e.back});
    frame.spots = meshes_->spots;
    for (const Meshes::Surface& surface : meshes_->surfaces) {
        frame.objects.push_back({&surface.mesh, {}, surface.look, surface.backdrop});
        frame.objects.back().casts_shadow = surface.casts_shadow;
        if (surface.texture)
            frame.objects.back().look.texture = &*surface.texture;
    }
    const Vec3 eye = view.room_from_eye.translation;
    for (const RoomCamera& camera : *cameras_) {
        const Pose& pose = camera.calibration.room_from_camera;
        const double distance = length(pose.translation - eye);
        if (!camera.calibration.registered || distance < free_around_eye_m)
            continue;
        frame.objects.push_back({&meshes_->mark, pose, mark_look});
        if (distance < camera_label_from_m)
            continue;
        // Cameras hang high.
        Pose place = facing(pose.translation - Vec3{0, label_below_m, 0}, eye);
        const double half_width = 0.5 * label_height_m * letter_width * double(camera.label.size());
        place.translation = place * Vec3{-half_width, 0, 0};
        frame.texts.push_back({camera.label, place, label_height_m, {225, 230, 230}});
    }
}

}  // namespace theatron::room
