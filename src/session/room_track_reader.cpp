// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include "session/room_bytes.h"
#include "session/room_track.h"
#include "session/room_track_entries.h"

namespace theatron::session {
namespace {

// A part's entries are within this time.
constexpr Duration max_span = std::chrono::seconds(60);

}  // namespace

Status RoomTrackReader::begin(Bytes part, TimePoint begin, bool key) {
    part_.clear();
    next_.reset();
    at_ = 0;
    if (!key && !known_)
        return Status::missing_reference;
    known_ = false;
    if (part.size() > max_room_part_bytes)
        return Status::too_large;
    if (part.empty() || (key != (part[0] == std::byte(TrackEntry::snapshot))))
        return Status::malformed;
    part_ = std::move(part);
    begin_ = begin;
    known_ = true;
    read_time();
    return next_ ? Status::ok : Status::malformed;
}

std::optional<TimePoint> RoomTrackReader::next() const {
    return next_;
}

// The time of the entry at at_; empty at the end. A damaged time is found by step().
void RoomTrackReader::read_time() {
    next_.reset();
    if (at_ >= part_.size())
        return;
    ByteReader in(ByteView(part_).subspan(at_ + 1));
    next_ = begin_ + Duration(std::int64_t(
                         std::min<std::uint64_t>(get_varint(in), std::uint64_t(max_span.count()))));
}

Status RoomTrackReader::step() {
    if (!next_)
        return Status::truncated;
    ByteReader in(ByteView(part_).subspan(at_));
    const auto kind = in.get<std::uint8_t>();
    const bool is_late = get_varint(in) > std::uint64_t(max_span.count());
    Status status = is_late ? Status::malformed : apply(in, kind);
    if (status == Status::ok && !in.ok())
        status = Status::truncated;
    if (status != Status::ok) {
        known_ = false;
        at_ = part_.size();
    } else {
        at_ = part_.size() - in.rest().size();
    }
    read_time();
    return status;
}

Status RoomTrackReader::apply(ByteReader& in, std::uint8_t kind) {
    switch (TrackEntry(kind)) {
        case TrackEntry::snapshot:
            return read_snapshot(in);
        case TrackEntry::object:
            return read_object(in);
        case TrackEntry::removed: {
            const auto gone = objects_.find(ObjectId(get_varint(in)));
            if (gone == objects_.end())
                return Status::malformed;
            property_bytes_ -= gone->second.properties.size();
            objects_.erase(gone);
            return Status::ok;
        }
        case TrackEntry::moved:
            return read_moved(in);
        case TrackEntry::pose:
            return read_pose(in);
        case TrackEntry::left:
            poses_.erase(ParticipantId(get_varint(in)));
            return Status::ok;
    }
    return Status::malformed;
}

Status RoomTrackReader::read_object(ByteReader& in) {
    const auto one = decode_objects(in.get_bytes(get_varint(in)), 1);
    if (!one || one->size() != 1)
        return Status::malformed;
    const auto& [id, decoded] = *one->begin();
    RoomObject& object = objects_[id];
    property_bytes_ += decoded.properties.size();
    property_bytes_ -= object.properties.size();
    object = decoded;
    const bool fits =
        objects_.size() <= max_recorded_objects && property_bytes_ <= max_recorded_property_bytes;
    return fits ? Status::ok : Status::too_large;
}

Status RoomTrackReader::read_snapshot(ByteReader& in) {
    auto objects = decode_objects(in.get_bytes(get_varint(in)), max_recorded_objects);
    const std::uint64_t count = get_varint(in);
    if (!objects || count > max_recorded_poses)
        return Status::malformed;
    PoseBodies poses;
    for (std::uint64_t i = 0; i < count && in.ok(); ++i) {
        const auto person = ParticipantId(get_varint(in));
        const ByteView body = in.get_bytes(get_varint(in));
        if (in.ok() && !wire::decode_person_pose(body))
            return Status::malformed;
        poses[person].assign(body.begin(), body.end());
    }
    if (!in.ok())
        return Status::truncated;
    std::size_t property_bytes = 0;
    for (const auto& [id, object] : *objects)
        property_bytes += object.properties.size();
    if (property_bytes > max_recorded_property_bytes)
        return Status::too_large;
    property_bytes_ = property_bytes;
    objects_ = std::move(*objects);
    poses_ = std::move(poses);
    return Status::ok;
}

Status RoomTrackReader::read_moved(ByteReader& in) {
    const auto found = objects_.find(ObjectId(get_varint(in)));
    if (found == objects_.end())
        return Status::malformed;
    // The object's bytes with the new place, so that decode_objects() checks it.
    Bytes place = place_bytes(found->second);
    add_words<std::uint64_t>(in, place);
    if (!in.ok())
        return Status::truncated;
    constexpr std::size_t moved_at = 17;
    Bytes bytes;
    append_object(found->first, found->second, bytes);
    std::copy(place.begin(), place.end(), bytes.begin() + moved_at);
    const auto moved = decode_objects(bytes, 1);
    if (!moved)
        return Status::malformed;
    found->second = moved->begin()->second;
    return Status::ok;
}

Status RoomTrackReader::read_pose(ByteReader& in) {
    const auto person = ParticipantId(get_varint(in));
    const auto parts = in.get<std::uint8_t>();
    if (!in.ok() || (parts & part_bits) == 0 || parts > known_bits ||
        (poses_.size() == max_recorded_poses && !poses_.contains(person)))
        return Status::malformed;
    Bytes body = poses_[person];
    if (body.size() < pose_head || body[parts_at] != std::byte(parts))
        body = empty_pose(parts);
    const std::span<std::byte> words(body);
    add_words<std::uint64_t>(in, words.first(time_bytes));
    for_each_part(body.size(), [&](std::size_t at) {
        add_words<std::uint32_t>(in, words.subspan(at, part_position));
        add_words<std::uint16_t>(in, words.subspan(at + part_position, part_bytes - part_position));
    });
    if (!in.ok() || !wire::decode_person_pose(body)) {
        poses_.erase(person);
        return Status::malformed;
    }
    poses_[person] = std::move(body);
    return Status::ok;
}

}  // namespace theatron::session
