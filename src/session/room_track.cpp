// SPDX-License-Identifier: Apache-2.0
#include "session/room_track.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "session/room_bytes.h"

namespace theatron::session {
namespace {

enum class Entry : std::uint8_t {
    snapshot = 1,
    object,   // a new or changed object, whole
    removed,  // an object that is gone
    moved,    // time and place of an object, as differences
    pose,     // a person's pose, as differences
    left,     // a person without a pose from now on
};

// A part's entries are within this time.
constexpr Duration max_span = std::chrono::seconds(60);
constexpr std::size_t max_poses = 1024;

void put_varint(ByteWriter& out, std::uint64_t value) {
    for (; value >= 0x80; value >>= 7)
        out.put(std::uint8_t(value | 0x80));
    out.put(std::uint8_t(value));
}

// Marks `in` as failed after ten bytes.
std::uint64_t get_varint(ByteReader& in) {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 70; shift += 7) {
        const auto byte = in.get<std::uint8_t>();
        value |= shift < 64 ? std::uint64_t(byte & 0x7f) << shift : 0;
        if (!(byte & 0x80))
            return value;
    }
    (void)in.get_bytes(in.rest().size() + 1);
    return 0;
}

constexpr std::uint64_t zigzag(std::int64_t difference) {
    return (std::uint64_t(difference) << 1) ^ std::uint64_t(difference >> 63);
}
constexpr std::int64_t unzigzag(std::uint64_t code) {
    return std::int64_t(code >> 1) ^ -std::int64_t(code & 1);
}

// Words of `Word` as differences to those at the same place in `before`. The bits of numbers that
// differ little differ little as integers.
template <class Word>
void put_words(ByteWriter& out, ByteView before, ByteView now) {
    for (std::size_t at = 0; at < now.size(); at += sizeof(Word))
        put_varint(out, zigzag(std::make_signed_t<Word>(Word(load_le<Word>(now.data() + at) -
                                                             load_le<Word>(before.data() + at)))));
}
template <class Word>
void add_words(ByteReader& in, std::span<std::byte> words) {
    for (std::size_t at = 0; at < words.size(); at += sizeof(Word)) {
        std::byte* const word = words.data() + at;
        store_le(word, Word(load_le<Word>(word) + Word(unzigzag(get_varint(in)))));
    }
}

// Layout of an encoded pose (docs/formats/person_pose.md): i64 time, u8 parts; for each part three
// f32 and four i16.
constexpr std::size_t time_bytes = 8, parts_at = 8, pose_head = 9, part_position = 12,
                      part_bytes = 20;

// The lower bits of `parts` say which parts there are, the others something of the person.
constexpr unsigned part_bits = 7, known_bits = 31;

// An encoded pose with these parts, all zero.
Bytes empty_pose(std::uint8_t parts) {
    Bytes body(pose_head + part_bytes * std::size_t(std::popcount(parts & part_bits)));
    body[parts_at] = std::byte(parts);
    return body;
}

template <class Part>
void for_each_part(std::size_t size, Part part) {
    for (std::size_t at = pose_head; at < size; at += part_bytes)
        part(at);
}

// Time, pose and scale.
Bytes place_bytes(const RoomObject& object) {
    const Quat& q = object.room_from_object.rotation;
    const Vec3& p = object.room_from_object.translation;
    Bytes bytes;
    ByteWriter out(bytes);
    out.put(to_us(object.moved_at));
    for (const double value : {q.w, q.x, q.y, q.z, p.x, p.y, p.z, object.scale})
        out.put_f64(value);
    return bytes;
}

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
    ByteWriter out = entry(std::uint8_t(Entry::snapshot), now);
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
            ByteWriter out = entry(std::uint8_t(Entry::removed), now);
            put_varint(out, std::uint32_t(id));
            changed_ = true;
        }
    for (const auto& [id, object] : objects) {
        const auto before = objects_.find(id);
        if (before != objects_.end() && before->second == object)
            continue;
        changed_ = true;
        if (before != objects_.end() && is_only_moved(before->second, object)) {
            ByteWriter out = entry(std::uint8_t(Entry::moved), now);
            put_varint(out, std::uint32_t(id));
            put_words<std::uint64_t>(out, place_bytes(before->second), place_bytes(object));
            continue;
        }
        ByteWriter out = entry(std::uint8_t(Entry::object), now);
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
        ByteWriter out = entry(std::uint8_t(Entry::left), now);
        put_varint(out, std::uint32_t(person));
        changed_ = true;
    }
    if (has_left || (poses_.size() == max_poses && !poses_.contains(person)))
        return;
    Bytes body = wire::encode_person_pose(pose);
    Bytes& before = poses_[person];
    if (writes) {
        const auto parts = std::to_integer<std::uint8_t>(body[parts_at]);
        if (before.size() != body.size() || before[parts_at] != body[parts_at])
            before = empty_pose(parts);
        ByteWriter out = entry(std::uint8_t(Entry::pose), now);
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

Status RoomTrackReader::begin(Bytes part, TimePoint begin, bool key) {
    part_.clear();
    next_.reset();
    at_ = 0;
    if (!key && !known_)
        return Status::missing_reference;
    known_ = false;
    if (part.size() > max_room_part_bytes)
        return Status::too_large;
    if (part.empty() || (key != (part[0] == std::byte(Entry::snapshot))))
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
    switch (Entry(kind)) {
        case Entry::snapshot:
            return read_snapshot(in);
        case Entry::object:
            return read_object(in);
        case Entry::removed: {
            const auto gone = objects_.find(ObjectId(get_varint(in)));
            if (gone == objects_.end())
                return Status::malformed;
            property_bytes_ -= gone->second.properties.size();
            objects_.erase(gone);
            return Status::ok;
        }
        case Entry::moved:
            return read_moved(in);
        case Entry::pose:
            return read_pose(in);
        case Entry::left:
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
    if (!objects || count > max_poses)
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
        (poses_.size() == max_poses && !poses_.contains(person)))
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
