// SPDX-License-Identifier: Apache-2.0
// The bytes of entries in the parts of a recorded room (docs/formats/room.md), for RoomTrackWriter
// and RoomTrackReader.
#pragma once

#include <bit>
#include <span>
#include <type_traits>

#include "session/room_object.h"

namespace theatron::session {

enum class TrackEntry : std::uint8_t {
    snapshot = 1,
    object,   // a new or changed object, whole
    removed,  // an object that is gone
    moved,    // time and place of an object, as differences
    pose,     // a person's pose, as differences
    left,     // a person without a pose from now on
};

inline constexpr std::size_t max_recorded_poses = 1024;

inline void put_varint(ByteWriter& out, std::uint64_t value) {
    for (; value >= 0x80; value >>= 7)
        out.put(std::uint8_t(value | 0x80));
    out.put(std::uint8_t(value));
}

// Marks `in` as failed after ten bytes.
inline std::uint64_t get_varint(ByteReader& in) {
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
inline constexpr std::size_t time_bytes = 8, parts_at = 8, pose_head = 9, part_position = 12,
                             part_bytes = 20;

// The lower bits of `parts` say which parts there are, the others something of the person.
inline constexpr unsigned part_bits = 7, known_bits = 31;

// An encoded pose with these parts, all zero.
inline Bytes empty_pose(std::uint8_t parts) {
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
inline Bytes place_bytes(const RoomObject& object) {
    const Quat& q = object.room_from_object.rotation;
    const Vec3& p = object.room_from_object.translation;
    Bytes bytes;
    ByteWriter out(bytes);
    out.put(to_us(object.moved_at));
    for (const double value : {q.w, q.x, q.y, q.z, p.x, p.y, p.z, object.scale})
        out.put_f64(value);
    return bytes;
}

}  // namespace theatron::session
