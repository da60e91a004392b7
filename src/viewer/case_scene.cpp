// SPDX-License-Identifier: Apache-2.0
#include "viewer/case_scene.h"

#include <cmath>
#include <utility>

#include "medical/mesh_measures.h"
#include "room/organ_mesh.h"

namespace theatron::viewer {
namespace {

// How many times as far from the middle parts that are farthest apart are drawn.
constexpr double farthest = 1.6;
constexpr double tissue_roughness = 0.4;

}  // namespace

const medical::SharedCase* CaseScene::description() const {
    return content_ && content_->description ? &*content_->description : nullptr;
}

bool CaseScene::take(const client::Participant& participant, const session::RoomObjects& objects,
                     bool objects_changed) {
    bool changed = false;
    if (objects_changed) {
        room_ = session::case_in_room(objects);
        changed = true;
    }
    std::uint64_t version = 0;
    auto newest = participant.open_case(version);
    if (version != version_) {
        version_ = version;
        changed = true;
    }
    if (!newest || !content_ || newest->id != content_->id)
        drawn_.clear();
    content_ = std::move(newest);
    // All texts show the name on which the room has agreed: that of the content is the same for
    // two cases of one name.
    if (room_ && description() && content_->id == room_->organ.of_case && !room_->name.empty())
        content_->description->name = room_->name;
    if (const medical::SharedCase* about = description())
        for (std::size_t i = 0; i < content_->meshes.size(); ++i) {
            const auto& mesh = content_->meshes[i];
            if (!mesh || drawn_.contains(i))
                continue;
            const medical::Box box = medical::box_of(*mesh);
            drawn_.emplace(
                i, Drawn{mesh, render::SceneMesh(room::make_organ_mesh(*mesh, about->middle_mm)),
                         room::organ_from_patient((box.low_mm + box.high_mm) * 0.5,
                                                  about->middle_mm)});
        }
    monitor_.take(room_, content());
    return changed;
}

const CaseScene::Drawn* CaseScene::drawn(std::size_t part) const {
    const auto found = drawn_.find(part);
    return found == drawn_.end() ? nullptr : &found->second;
}

Pose CaseScene::exploded(const session::CaseInRoom::Part& part) const {
    Pose pose = part.object.room_from_object;
    const medical::SharedCase* about = description();
    const std::size_t number = part.facts.part;
    // The shell stays, as the frame of the others.
    if (const Drawn* mesh = drawn(number);
        mesh && about && about->parts[number].role != medical::Role::shell)
        pose.translation =
            pose.translation + mesh->middle * (farthest * room_->organ.explosion / 255.0);
    return pose;
}

void CaseScene::add_to(render::SceneFrame& frame, const render::CameraView& view) {
    const medical::SharedCase* about = description();
    if (!room_ || !about || content_->id != room_->organ.of_case)
        return;
    const std::optional<render::Cut> cut = this->cut();
    for (const session::CaseInRoom::Part& part : room_->parts) {
        if (!is_drawn(part))
            continue;
        const Drawn* mesh = drawn(part.facts.part);
        const session::ScaledPose place =
            session::part_in_room(room_->organ_object, exploded(part));
        render::SurfaceLook look{room::linear_color(about->parts[part.facts.part].color), 0,
                                 tissue_roughness};
        look.opacity = part.facts.opacity / 255.0;
        frame.objects.push_back({&mesh->mesh, place.pose, look, false,
                                 render::PickId(std::uint32_t(part.id)), place.scale, cut});
    }
    monitor_.add_to(frame, *room_, about->middle_mm, view);
}

bool CaseScene::is_drawn(const session::CaseInRoom::Part& part) const {
    return drawn(part.facts.part) && has_place(part);
}

bool CaseScene::has_place(const session::CaseInRoom::Part& part) const {
    // Parts are drawn apart along the middles of their surfaces.
    return part.facts.shown && part.facts.opacity > 0 &&
           (drawn(part.facts.part) || room_->organ.explosion == 0);
}

std::optional<render::Cut> CaseScene::cut() const {
    const medical::SharedCase* about = description();
    return room_ && about && room_->organ.cut ? monitor_.plane_in(*room_, about->middle_mm)
                                              : std::nullopt;
}

std::optional<Monitor::SliceFrame> CaseScene::slice_frame() const {
    const medical::SharedCase* about = description();
    return room_ && about ? monitor_.slice_frame(*room_, about->middle_mm) : std::nullopt;
}

std::optional<Pose> CaseScene::shown_pose(session::ObjectId object) const {
    if (!room_)
        return std::nullopt;
    if (object == room_->organ_id)
        return room_->organ_object.room_from_object;
    const session::CaseInRoom::Part* part = room_->find(object);
    return part ? std::optional(session::part_in_room(room_->organ_object, exploded(*part)).pose)
                : std::nullopt;
}

std::optional<Pose> CaseScene::stored_pose(session::ObjectId object,
                                           const Pose& room_from_shown) const {
    if (!room_)
        return std::nullopt;
    const session::CaseInRoom::Part* part = room_->find(object);
    if (!part)
        return std::nullopt;
    Pose pose = session::part_in_organ(room_->organ_object, room_from_shown);
    pose.translation = pose.translation -
                       (exploded(*part).translation - part->object.room_from_object.translation);
    return pose;
}

std::optional<Vec3> CaseScene::twin_place(session::ObjectId object, Vec3 place) const {
    const medical::SharedCase* about = description();
    if (!room_ || !about)
        return std::nullopt;
    if (room_->screen && object == room_->screen->id) {
        const auto patient = monitor_.patient_point(*room_, place);
        const session::RoomObject& organ = room_->organ_object;
        return patient ? std::optional(
                             organ.room_from_object *
                             (room::organ_from_patient(*patient, about->middle_mm) * organ.scale))
                       : std::nullopt;
    }
    const auto patient = patient_point(object, place);
    const auto slice = slice_frame();
    if (!patient || !slice || !slice->on_screen)
        return std::nullopt;
    const Vec3 in_organ = room::organ_from_patient(*patient, about->middle_mm);
    const Vec3 on_screen = slice->screen_from_organ * (in_organ * slice->screen_scale);
    const bool is_on_slice =
        std::abs((slice->picture_from_organ * in_organ).z) <= slice->half_step_m;
    return is_on_slice && monitor_.shows_at(*room_, on_screen) ? std::optional(on_screen)
                                                               : std::nullopt;
}

std::optional<Vec3> CaseScene::patient_point(session::ObjectId object, Vec3 place) const {
    const auto shown = shown_pose(object);
    const medical::SharedCase* about = description();
    if (!shown || !about)
        return std::nullopt;
    return room::patient_from_organ((inverse(*shown) * place) * (1 / room_->organ_object.scale),
                                    about->middle_mm);
}

}  // namespace theatron::viewer
