// SPDX-License-Identifier: Apache-2.0
#include "session/room_state.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "session/mark_rules.h"
#include "session/shared_screen.h"

namespace theatron::session {
namespace {

// A shared screen whose source is here.
bool shows_camera(const RoomObject& object) {
    const auto screen = decode_shared_screen(object.kind, object.properties);
    return screen && screen->camera;
}

std::size_t property_bytes(const RoomObjects& objects) {
    std::size_t bytes = 0;
    for (const auto& [id, object] : objects)
        bytes += object.properties.size();
    return bytes;
}

}  // namespace

bool RoomState::is_sound(const Pose& pose, double scale) {
    const Vec3 p = pose.translation;
    for (const double coordinate : {p.x, p.y, p.z})
        if (!(std::abs(coordinate) <= max_coordinate_m))
            return false;
    const Quat q = pose.rotation;
    const double norm = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
    return std::abs(norm - 1) < 1e-3 && scale >= min_scale && scale <= max_scale;
}

bool RoomState::may_be_at(const RoomObject& object, const Pose& pose, double scale) {
    // The scale of a shared screen is its width.
    return is_sound(pose, scale) && (!is_shared_screen(object) || is_screen_width(scale));
}

RoomState::RoomState(const ObjectsSnapshot& snapshot)
    : revision_(snapshot.revision), objects_(snapshot.objects) {
    std::erase_if(objects_,
                  [](const auto& entry) { return entry.second.kind == ObjectKind::person; });
    for (auto& [id, object] : objects_) {
        object.grip = {};
        if (object.kind == ObjectKind::mark || object.kind == ObjectKind::brick)
            object.creator = {};
        newest_id_ = std::max(newest_id_, std::uint32_t(id));
    }
}

ObjectChange RoomState::changed(ObjectId object) {
    const auto found = objects_.find(object);
    return {++revision_, object,
            found == objects_.end() ? std::nullopt : std::optional(found->second)};
}

ObjectChange RoomState::on_joined(ParticipantId participant, Bytes properties, TimePoint joined) {
    participants_.insert(participant);
    const ObjectId person{++newest_id_};
    objects_[person] = {ObjectKind::person, participant, {}, joined, {}, 1, std::move(properties)};
    return changed(person);
}

bool RoomState::has_room_for(std::size_t bytes, std::size_t before) const {
    return bytes <= max_property_bytes &&
           property_bytes(objects_) - before + bytes <= max_property_bytes_of_all;
}

std::vector<ObjectChange> RoomState::on_person(ParticipantId participant, Bytes properties) {
    for (auto& [id, object] : objects_)
        if (object.kind == ObjectKind::person && object.creator == participant) {
            object.properties = std::move(properties);
            return {changed(id)};
        }
    return {};
}

std::vector<ObjectChange> RoomState::release_all(ParticipantId participant) {
    std::vector<ObjectChange> changes;
    for (auto& [id, object] : objects_)
        if (object.grip.holder == participant) {
            object.grip = {};
            changes.push_back(changed(id));
        }
    return changes;
}

std::vector<ObjectChange> RoomState::clear() {
    std::vector<ObjectId> gone;
    for (const auto& [id, object] : objects_)
        if (object.kind != ObjectKind::person && !shows_camera(object))
            gone.push_back(id);
    return remove(gone);
}

std::vector<ObjectChange> RoomState::remove(const std::vector<ObjectId>& gone) {
    std::vector<ObjectChange> changes;
    for (const ObjectId id : gone)
        if (objects_.erase(id) > 0)
            changes.push_back(changed(id));
    return changes;
}

std::vector<ObjectChange> RoomState::set_creator(const std::vector<ObjectId>& objects,
                                                 ParticipantId to) {
    std::vector<ObjectChange> changes;
    for (const ObjectId id : objects)
        if (const auto found = objects_.find(id); found != objects_.end()) {
            found->second.creator = to;
            changes.push_back(changed(id));
        }
    return changes;
}

std::optional<ObjectChange> RoomState::put(std::optional<ObjectId> id, RoomObject object) {
    const auto before = id ? objects_.find(*id) : objects_.end();
    const bool is_new = before == objects_.end();
    if ((is_new && objects_.size() >= max_objects) ||
        !is_sound(object.room_from_object, object.scale) ||
        !has_room_for(object.properties.size(), is_new ? 0 : before->second.properties.size()))
        return std::nullopt;
    const ObjectId place = is_new ? ObjectId(++newest_id_) : *id;
    objects_[place] = std::move(object);
    return changed(place);
}

std::vector<ObjectChange> RoomState::on_left(ParticipantId participant) {
    participants_.erase(participant);
    std::vector<ObjectChange> changes;
    for (auto entry = objects_.begin(); entry != objects_.end();) {
        const auto [id, object] = *entry;
        const bool is_its_person =
            object.kind == ObjectKind::person && object.creator == participant;
        if (!is_its_person && object.grip.holder != participant) {
            ++entry;
            continue;
        }
        if (is_its_person)
            entry = objects_.erase(entry);
        else
            (entry++)->second.grip = {};
        changes.push_back(changed(id));
    }
    return changes;
}

RoomState::Decision RoomState::replace_case(ParticipantId by, std::vector<RoomObject> objects) {
    const auto is_of_case = [](const RoomObject& object) {
        return object.kind == ObjectKind::organ ||
               (object.kind == ObjectKind::screen && !is_shared_screen(object));
    };
    std::vector<ObjectId> old;
    std::size_t old_bytes = 0, bytes = 0;
    for (const auto& [id, object] : objects_)
        if (is_of_case(object)) {
            old.push_back(id);
            old_bytes += object.properties.size();
        }
    for (const RoomObject& object : objects) {
        bytes += object.properties.size();
        if (!is_sound(object.room_from_object, object.scale))
            return {Refusal::malformed, {}};
    }
    if (objects_.size() - old.size() + objects.size() > max_objects ||
        property_bytes(objects_) - old_bytes + bytes > max_property_bytes_of_all)
        return {Refusal::too_many, {}};
    Decision decision;
    decision.changes = remove(old);
    for (ObjectChange& change : remove(marks_without_surface(objects_)))
        decision.changes.push_back(std::move(change));
    for (RoomObject& object : objects) {
        const ObjectId id{++newest_id_};
        object.creator = by;
        objects_[id] = std::move(object);
        decision.changes.push_back(changed(id));
    }
    return decision;
}

bool RoomState::on_pose(ParticipantId from, const ObjectPose& pose) {
    const auto found = objects_.find(pose.object);
    if (found == objects_.end() || pose.grip.holder != from || found->second.grip != pose.grip)
        return false;
    RoomObject& object = found->second;
    if (pose.at <= object.moved_at || !may_be_at(object, pose.room_from_object, pose.scale))
        return false;
    object.moved_at = pose.at;
    object.room_from_object = pose.room_from_object;
    object.scale = pose.scale;
    return true;
}

}  // namespace theatron::session
