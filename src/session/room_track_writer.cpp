// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include "session/room_bytes.h"
#include "session/room_track.h"
#include "session/room_track_entries.h"

namespace theatron::session {
namespace {

bool is_only_moved(RoomObject before, const RoomObject& now) {
    before.moved_at = now.moved_at;
    before.room_from_object = now.room_from_object;
    before.scale = now.scale;
    return before == now;
}

}  // namespace

ByteWriter RoomTrackWriter::entry(std::uint8_t kind, TimePoint now) {
    if (!part_)
        part_ = Part{now, false, {}};
    ByteWriter out(part_->bytes);
    out.put(kind);
    put_varint(out, std::uint64_t(std::max((now - part_->begin).count(), std::int64_t(0))));
    return out;
}

void RoomTrackWriter::put_snapshot(TimePoint now) {
    part_ = Part{now, true, {}};
    ByteWriter out = entry(std::uint8_t(TrackEntry::snapshot), now);
    const Bytes objects = encode_objects(objects_);
    put_varint(out, objects.size());
    out.put_bytes(objects);
    put_varint(out, poses_.size());
    for (const auto& [person, body] : poses_) {
        put_varint(out, std::uint32_t(person));
        put_varint(out, body.size());
        out.put_bytes(body);
    }
    wants_key_ = changed_ = false;
    last_key_ = now;
}

void RoomTrackWriter::note_objects(const RoomObjects& objects, TimePoint now) {
    const bool was_known = std::exchange(known_, true);
    if (!was_known || wants_key_) {
        objects_ = objects;
        return;
    }
    for (const auto& [id, before] : objects_)
        if (!objects.contains(id)) {
            ByteWriter out = entry(std::uint8_t(TrackEntry::removed), now);
            put_varint(out, std::uint32_t(id));
            changed_ = true;
        }
    for (const auto& [id, object] : objects) {
        const auto before = objects_.find(id);
        if (before != objects_.end() && before->second == object)
            continue;
        changed_ = true;
        if (before != objects_.end() && is_only_moved(before->second, object)) {
            ByteWriter out = entry(std::uint8_t(TrackEntry::moved), now);
            put_varint(out, std::uint32_t(id));
            put_words<std::uint64_t>(out, place_bytes(before->second), place_bytes(object));
            continue;
        }
        ByteWriter out = entry(std::uint8_t(TrackEntry::object), now);
        Bytes bytes;
        append_object(id, object, bytes);
        put_varint(out, bytes.size());
        out.put_bytes(bytes);
    }
    objects_ = objects;
}

void RoomTrackWriter::note_pose(ParticipantId person, const wire::PersonPose& pose, TimePoint now) {
    const bool has_left = !pose.head && !pose.left_hand && !pose.right_hand;
    const bool writes = known_ && !wants_key_;
    if (has_left && poses_.erase(person) > 0 && writes) {
        ByteWriter out = entry(std::uint8_t(TrackEntry::left), now);
        put_varint(out, std::uint32_t(person));
        changed_ = true;
    }
    if (has_left || (poses_.size() == max_recorded_poses && !poses_.contains(person)))
        return;
    Bytes body = wire::encode_person_pose(pose);
    Bytes& before = poses_[person];
    if (writes) {
        const auto parts = std::to_integer<std::uint8_t>(body[parts_at]);
        if (before.size() != body.size() || before[parts_at] != body[parts_at])
            before = empty_pose(parts);
        ByteWriter out = entry(std::uint8_t(TrackEntry::pose), now);
        put_varint(out, std::uint32_t(person));
        out.put(parts);
        const ByteView old(before), words(body);
        put_words<std::uint64_t>(out, old.first(time_bytes), words.first(time_bytes));
        for_each_part(body.size(), [&](std::size_t at) {
            put_words<std::uint32_t>(out, old.subspan(at, part_position),
                                     words.subspan(at, part_position));
            put_words<std::uint16_t>(out,
                                     old.subspan(at + part_position, part_bytes - part_position),
                                     words.subspan(at + part_position, part_bytes - part_position));
        });
        changed_ = true;
    }
    before = std::move(body);
}

std::optional<RoomTrackWriter::Part> RoomTrackWriter::take(TimePoint now) {
    if (!known_)
        return std::nullopt;
    const bool key_is_due = changed_ && now - last_key_ >= key_interval;
    if (wants_key_ || (!part_ && key_is_due))
        put_snapshot(now);
    auto part = std::exchange(part_, std::nullopt);
    if (part && !part->key && key_is_due)
        put_snapshot(now);
    return part;
}

void RoomTrackWriter::want_key() {
    wants_key_ = true;
    part_.reset();
}

void RoomTrackWriter::forget() {
    *this = RoomTrackWriter();
}

}  // namespace theatron::session
