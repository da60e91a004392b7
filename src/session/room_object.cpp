// SPDX-License-Identifier: Apache-2.0
#include "session/room_object.h"

namespace theatron::session {
namespace {

class Fnv1a {
public:
    void add(ByteView bytes) {
        for (const std::byte byte : bytes)
            hash_ = (hash_ ^ std::to_integer<std::uint64_t>(byte)) * 0x100000001b3ull;
    }
    std::uint64_t hash() const { return hash_; }

private:
    std::uint64_t hash_ = 0xcbf29ce484222325ull;
};

}  // namespace

RoomObjects as_replayed(const RoomObjects& recorded) {
    RoomObjects objects;
    for (const auto& [id, object] : recorded) {
        RoomObject& replayed = objects[ObjectId(std::uint32_t(id) | recorded_bit)] = object;
        replayed.creator = ParticipantId(std::uint32_t(object.creator) | recorded_bit);
        if (object.grip.holder != ParticipantId{})
            replayed.grip.holder = ParticipantId(std::uint32_t(object.grip.holder) | recorded_bit);
    }
    return objects;
}

RoomObjects as_recorded(const RoomObjects& objects) {
    RoomObjects recorded;
    for (const auto& [id, object] : objects) {
        if (!is_recorded(id))
            continue;
        RoomObject& original = recorded[ObjectId(std::uint32_t(id) & ~recorded_bit)] = object;
        original.creator = ParticipantId(std::uint32_t(object.creator) & ~recorded_bit);
        original.grip.holder = ParticipantId(std::uint32_t(object.grip.holder) & ~recorded_bit);
    }
    return recorded;
}

std::uint64_t hash_of(const RoomObjects& objects) {
    Bytes bytes;
    ByteWriter out(bytes);
    Fnv1a hash;
    for (const auto& [id, object] : objects) {
        bytes.clear();
        out.put(std::uint32_t(id));
        out.put(std::uint8_t(object.kind));
        out.put(std::uint32_t(object.creator));
        out.put(std::uint32_t(object.grip.holder));
        out.put(object.grip.number);
        const Pose& pose = object.room_from_object;
        for (const double value :
             {pose.rotation.w, pose.rotation.x, pose.rotation.y, pose.rotation.z,
              pose.translation.x, pose.translation.y, pose.translation.z, object.scale})
            out.put_f64(value);
        out.put(std::uint32_t(object.properties.size()));
        out.put_bytes(object.properties);
        hash.add(bytes);
    }
    return hash.hash();
}

}  // namespace theatron::session
