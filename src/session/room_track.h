// SPDX-License-Identifier: Apache-2.0
// The state of a room over time as a sequence of parts (docs/formats/room.md), for recordings:
// what a part holds are snapshots and changes, each with its time.
//
// Pure: times are session times, passed in.
#pragma once

#include <map>
#include <optional>

#include "base/status.h"
#include "session/room_object.h"
#include "wire/person_pose.h"

namespace theatron::session {

// Bytes of one part; more is malformed. The largest snapshot that a host can have is smaller.
inline constexpr std::size_t max_room_part_bytes = std::size_t(2) << 20;
// Objects of a recorded room, people included; a part with more is malformed.
inline constexpr std::size_t max_recorded_objects = 3072;
// Bytes of their properties together; the same.
inline constexpr std::size_t max_recorded_property_bytes = std::size_t(320) << 10;

// Encoded poses (wire/person_pose.h), so that they are compared and written exactly.
using PoseBodies = std::map<ParticipantId, Bytes>;

class RoomTrackWriter {
public:
    // Longest time between two snapshots while the room changes.
    static constexpr Duration key_interval = std::chrono::seconds(2);

    // The room at `now`; times must not decrease. Only the differences are written.
    void note_objects(const RoomObjects& objects, TimePoint now);
    // A new pose of a person; one without parts means that the person has left.
    void note_pose(ParticipantId person, const wire::PersonPose& pose, TimePoint now);

    struct Part {
        TimePoint begin;  // the time of its first entry
        bool key = false;
        Bytes bytes;
    };
    // The changes noted since the last call; nothing if nothing has changed. A key part begins with
    // a snapshot and needs no part before it.
    std::optional<Part> take(TimePoint now);
    // The next part must be a key part: parts before it were not recorded. Drops what was noted.
    void want_key();
    // The state is not known any more: the connection was lost.
    void forget();

private:
    ByteWriter entry(std::uint8_t kind, TimePoint now);
    void put_snapshot(TimePoint now);

    bool known_ = false, wants_key_ = true, changed_ = false;
    RoomObjects objects_;
    PoseBodies poses_;
    TimePoint last_key_;
    std::optional<Part> part_;
};

// Reads the parts one after another, entry by entry. Safe for untrusted input.
class RoomTrackReader {
public:
    // Begins a part whose first entry has the time `begin`; the one before must be finished.
    // missing_reference: it needs a part that was not read. After any other problem only a key part
    // can follow.
    Status begin(Bytes part, TimePoint begin, bool key);
    // The time of the next entry; empty at the part's end.
    std::optional<TimePoint> next() const;
    // Applies the next entry. Not ok: the rest of the part is left out.
    Status step();
    // Parts are missing before the next one.
    void lose() { known_ = false; }

    const RoomObjects& objects() const { return objects_; }
    const PoseBodies& poses() const { return poses_; }

private:
    void read_time();
    Status apply(ByteReader& in, std::uint8_t kind);
    Status read_object(ByteReader& in);
    Status read_snapshot(ByteReader& in);
    Status read_moved(ByteReader& in);
    Status read_pose(ByteReader& in);

    bool known_ = false;
    RoomObjects objects_;
    std::size_t property_bytes_ = 0;  // of objects_
    PoseBodies poses_;
    Bytes part_;
    std::size_t at_ = 0;  // of the next entry's kind in part_
    TimePoint begin_;
    std::optional<TimePoint> next_;
};

}  // namespace theatron::session
