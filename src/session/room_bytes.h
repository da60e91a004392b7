// SPDX-License-Identifier: Apache-2.0
// The bytes of a room's objects, of requests and of poses (docs/formats/room.md): on the wire, in
// the host's state folder and in recordings.
#pragma once

#include <string>

#include "base/status.h"
#include "session/permissions.h"
#include "session/room_object.h"

namespace theatron::session {

// Bytes of an encoded object without its properties.
inline constexpr std::size_t object_bytes = 91;

// Encoders. append_object() appends one object to `out`.
void append_object(ObjectId id, const RoomObject& object, Bytes& out);
Bytes encode_objects(const RoomObjects& objects);
Bytes encode_request(const Request& request);
Bytes encode_object_pose(const ObjectPose& pose);

// Decoders, safe for untrusted input: Status::malformed for missing or additional bytes, numbers
// that are not finite, unknown kinds, and more than `max_objects` objects.
Result<RoomObjects> decode_objects(ByteView bytes, std::size_t max_objects);
Result<Request> decode_request(ByteView bytes);
Result<ObjectPose> decode_object_pose(ObjectId object, ByteView bytes);

// The properties of a person object.
struct PersonFacts {
    Role role = Role::expert;
    bool records = false;
    std::string name;
    bool muted = false;
    bool voice_recorded = false;  // the person agrees that others record its voice
    bool hand_raised = false;
    bool operator==(const PersonFacts&) const = default;
};
Bytes encode_person(const PersonFacts& facts);
// The name is clean text (base/outside_text.h). An unknown role is taken for an observer.
Result<PersonFacts> decode_person(ByteView properties);

}  // namespace theatron::session
