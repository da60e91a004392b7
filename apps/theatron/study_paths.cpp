// SPDX-License-Identifier: Apache-2.0
#include "study_paths.h"

#include <cstdio>

namespace theatron::app {
namespace {

constexpr std::string_view head_line = "session_us,what,x,y,z,qw,qx,qy,qz,detail\n";
constexpr std::string_view no_pose = ",,,,,,,";

const char* name_of(session::ObjectKind kind) {
    using Kind = session::ObjectKind;
    switch (kind) {
        case Kind::brick:
            return "brick";
        case Kind::mark:
            return "mark";
        case Kind::organ:
            return "organ";
        default:
            return "object";
    }
}

std::string detail_of(session::ObjectId id, session::ObjectKind kind) {
    return std::string(name_of(kind)) + " " + std::to_string(std::uint32_t(id));
}

std::string place_text(const Pose& pose) {
    char text[160];
    std::snprintf(text, sizeof(text), "%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,", pose.translation.x,
                  pose.translation.y, pose.translation.z, pose.rotation.w, pose.rotation.x,
                  pose.rotation.y, pose.rotation.z);
    return text;
}

// Half a line of a program that was killed.
std::size_t whole_lines(const std::string& text) {
    const std::size_t end = text.rfind('\n');
    return end == std::string::npos ? 0 : end + 1;
}

}  // namespace

StudyPaths::StudyPaths(const std::filesystem::path& path) : file_(path) {
    // The last write may have gone beyond the bound.
    const std::string before = file_.text(max_paths_bytes + (std::size_t(1) << 20));
    bytes_ = whole_lines(before);
    if (bytes_ < before.size())
        file_.keep(bytes_);
    if (bytes_ == 0)
        waiting_ = head_line;
}

void StudyPaths::add(TimePoint session_time, std::string_view what, const std::string& values) {
    waiting_ += std::to_string(to_us(session_time)) + "," + std::string(what) + "," + values + "\n";
}

void StudyPaths::add_part(TimePoint time, const char* part,
                          const std::optional<wire::PartPose>& pose) {
    if (!pose)
        return;
    const auto& [x, y, z] = pose->position;
    const auto& [qw, qx, qy, qz] = pose->rotation;
    add(time, part, place_text({Quat{qw, qx, qy, qz}, {x, y, z}}));
}

void StudyPaths::take(ParticipantId person, const wire::PersonPose& pose) {
    const std::lock_guard lock(mutex_);
    if (person != person_ || (pose.time >= last_pose_ && pose.time - last_pose_ < pose_every))
        return;
    last_pose_ = pose.time;
    add_part(pose.time, "head", pose.head);
    add_part(pose.time, "left_hand", pose.left_hand);
    add_part(pose.time, "right_hand", pose.right_hand);
}

void StudyPaths::follow(std::optional<ParticipantId> person, TimePoint session_time) {
    const std::lock_guard lock(mutex_);
    if (person == person_)
        return;
    person_ = person;
    knows_room_ = false;
    last_pose_ = {};
    add(session_time, person ? "came" : "left", std::string(no_pose));
}

void StudyPaths::note(TimePoint session_time, std::string_view event, std::string_view detail) {
    const std::lock_guard lock(mutex_);
    add(session_time, event, std::string(no_pose) + std::string(detail));
}

void StudyPaths::compare(const client::Participant::Room& room, TimePoint session_time) {
    const std::lock_guard lock(mutex_);
    if (!person_ || (knows_room_ && room.version == version_))
        return;
    version_ = room.version;
    const auto holds = [&](const session::RoomObject& object) {
        return object.grip.holder == *person_;
    };
    const auto tell = [&](const char* what, session::ObjectId id,
                          const session::RoomObject& object) {
        add(session_time, what, place_text(object.room_from_object) + detail_of(id, object.kind));
    };
    if (knows_room_) {
        for (const auto& [id, object] : room.objects) {
            if (object.kind == session::ObjectKind::person)
                continue;
            const auto before = objects_.find(id);
            if (before == objects_.end() && object.creator == *person_)
                tell("made", id, object);
            const bool held = before != objects_.end() && holds(before->second);
            if (holds(object) && !held)
                tell("grabbed", id, object);
            if (held && !holds(object))
                tell("let_go", id, object);
        }
        for (const auto& [id, object] : objects_)
            if (object.kind != session::ObjectKind::person && !room.objects.contains(id) &&
                (object.creator == *person_ || holds(object)))
                tell("removed", id, object);
    }
    objects_ = room.objects;
    knows_room_ = true;
}

bool StudyPaths::on_tick(TimePoint now) {
    {
        const std::lock_guard lock(mutex_);
        if (now - written_ < write_every)
            return bytes_ < max_paths_bytes;
        written_ = now;
    }
    write();
    return bytes_ < max_paths_bytes;
}

void StudyPaths::write() {
    std::string lines;
    {
        const std::lock_guard lock(mutex_);
        lines.swap(waiting_);
    }
    if (lines.empty() || bytes_ >= max_paths_bytes)
        return;
    file_.append(lines);
    bytes_ += lines.size();
}

}  // namespace theatron::app
