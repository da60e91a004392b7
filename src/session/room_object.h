// SPDX-License-Identifier: Apache-2.0
// The objects of a shared room, the requests of participants to change them, and the changes that
// the host decides on.
//
// All state of a room is objects: people, bricks, organs, screens, marks. Poses are in the room's
// frame, in metres.
#pragma once

#include <map>
#include <optional>
#include <variant>
#include <vector>

#include "base/bytes.h"
#include "base/ids.h"
#include "base/time.h"
#include "geometry/vec.h"

namespace theatron::session {

// Assigned by the host, from 1, never used twice in a session.
enum class ObjectId : std::uint32_t {};

enum class ObjectKind : std::uint8_t { person = 1, brick, organ, screen, mark };
constexpr bool is_known(ObjectKind kind) {
    return kind >= ObjectKind::person && kind <= ObjectKind::mark;
}

// One period in which a participant holds an object: its holder, and the number of the request
// that began it. Poses and the end of a grip name it, so that they never affect another one.
struct Grip {
    ParticipantId holder{};  // 0: the object is not held
    std::uint32_t number = 0;

    bool operator==(const Grip&) const = default;
};

struct RoomObject {
    ObjectKind kind{};
    ParticipantId creator{};
    Grip grip;
    TimePoint moved_at;  // session time of the newest pose of this grip; of a person: when it came
    Pose room_from_object;
    double scale = 1;
    // The meaning depends on the kind; the host does not read them.
    Bytes properties;

    bool operator==(const RoomObject&) const = default;
};

using RoomObjects = std::map<ObjectId, RoomObject>;

// Objects and people of a recording that is replayed have their recorded numbers with this bit. The
// host gives no such numbers, and only the recording changes these objects.
inline constexpr std::uint32_t recorded_bit = std::uint32_t(1) << 31;
constexpr bool is_recorded(ObjectId id) {
    return (std::uint32_t(id) & recorded_bit) != 0;
}
constexpr bool is_recorded(ParticipantId id) {
    return (std::uint32_t(id) & recorded_bit) != 0;
}
// Recorded objects with the numbers that they have in a replay, and back: of all objects, those of
// the recording with their original numbers.
RoomObjects as_replayed(const RoomObjects& recorded);
RoomObjects as_recorded(const RoomObjects& objects);

// Numbers of requests are less than this bit. If it is set in the number of a grip, the other bits
// are the number of the request that gave the object to its holder.
inline constexpr std::uint32_t given_grip = std::uint32_t(1) << 31;

// The requests of a participant, which numbers them from 1 in the order of sending.
namespace request {
struct Create {
    ObjectKind kind{};
    Pose room_from_object;
    double scale = 1;
    Bytes properties;
};
struct Remove {
    ObjectId object{};
};
struct Grab {
    ObjectId object{};
};
// Ends the grip that request `grip` began and leaves the object at this pose.
struct Release {
    ObjectId object{};
    std::uint32_t grip = 0;
    Pose room_from_object;
    double scale = 1;
};
// Gives the object to another participant; it is held all the time.
struct HandOver {
    ObjectId object{};
    std::uint32_t grip = 0;
    ParticipantId to{};
};
struct SetProperties {
    ObjectId object{};
    Bytes properties;
};
// Removes the marks of the participant, or of all.
struct ClearMarks {
    bool of_all = false;
};
}  // namespace request
using Request = std::variant<request::Create, request::Remove, request::Grab, request::Release,
                             request::HandOver, request::SetProperties, request::ClearMarks>;

// The pose of an object that is held. Only the newest one of a grip counts, so it may be lost.
struct ObjectPose {
    ObjectId object{};
    Grip grip;
    TimePoint at;  // session time that the pose is for
    Pose room_from_object;
    double scale = 1;
};

// A change that the host decided on; all participants get the changes in the same order.
struct ObjectChange {
    std::uint64_t revision = 0;  // one more than that of the change before
    ObjectId object{};
    std::optional<RoomObject> now;  // none: the object is removed
};
struct ObjectsSnapshot {
    std::uint64_t revision = 0;
    RoomObjects objects;
    // The receiver's newest request that the host has decided on; earlier answers may be lost.
    std::uint32_t decided = 0;
};

enum class Refusal : std::uint8_t {
    none,
    no_such_object,
    held_by_another,
    not_held_by_you,
    role,  // the participant's role does not allow it
    no_such_participant,
    too_many,      // objects, or bytes of properties
    malformed,     // a pose that is not finite, a scale out of range, an unknown kind
    too_often,     // more requests than a host answers
    recorded,      // the object is part of a recording that is replayed
    part_of_case,  // it cannot be removed alone
    of_another,    // a mark of another author
    mark_stays,    // marks cannot be held or changed
    pinned,        // a shared screen that stays where it is
    of_sharer,     // only who shares the screen and operators may do it
};

// FNV-1a over all fields; equal rooms have equal hashes on every machine.
std::uint64_t hash_of(const RoomObjects& objects);

}  // namespace theatron::session
