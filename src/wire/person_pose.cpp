// SPDX-License-Identifier: Apache-2.0
#include "wire/person_pose.h"

#include <bit>
#include <cassert>
#include <cmath>

#include "base/float_bytes.h"

namespace theatron::wire {
namespace {

constexpr std::size_t part_size = 20;
constexpr std::size_t pose_header_size = 9;  // time, parts
constexpr unsigned all_parts = 7, calls_bit = 8, points_bit = 16;
constexpr float rotation_unit = 32767;
constexpr std::int64_t max_pose_us = std::int64_t(1) << 60;
// A quaternion whose length is further from 1 is no rotation that was rounded.
constexpr double length_tolerance = 0.01;

double length_of(const std::array<float, 4>& q) {
    double sum = 0;
    for (const float v : q)
        sum += double(v) * double(v);
    return std::sqrt(sum);
}

void put_part(const PartPose& part, ByteWriter& out) {
    for (const float v : part.position) {
        assert(std::abs(v) <= max_pose_distance);
        put_f32(out, v);
    }
    const double length = length_of(part.rotation);
    assert(length > 0);
    for (const float v : part.rotation)
        out.put(std::int16_t(std::lround(double(v) / length * double(rotation_unit))));
}

bool get_part(ByteReader& in, PartPose& part) {
    for (float& v : part.position) {
        v = get_f32(in);
        if (!(std::abs(v) <= max_pose_distance))
            return false;
    }
    for (float& v : part.rotation)
        v = float(in.get<std::int16_t>()) / rotation_unit;
    const double length = length_of(part.rotation);
    if (!(std::abs(length - 1) <= length_tolerance))
        return false;
    for (float& v : part.rotation)
        v = float(double(v) / length);
    return true;
}

}  // namespace

Bytes encode_person_pose(const PersonPose& pose) {
    Bytes bytes;
    bytes.reserve(pose_header_size + 3 * part_size);
    ByteWriter out(bytes);
    out.put(to_us(pose.time));
    const auto parts = {&pose.head, &pose.left_hand, &pose.right_hand};
    unsigned present = 0, bit = 1;
    for (const auto* part : parts) {
        present |= *part ? bit : 0;
        bit <<= 1;
    }
    out.put(std::uint8_t(present | (pose.calls ? calls_bit : 0) | (pose.points ? points_bit : 0)));
    for (const auto* part : parts)
        if (*part)
            put_part(**part, out);
    return bytes;
}

Result<PersonPose> decode_person_pose(ByteView bytes) {
    if (bytes.size() < pose_header_size)
        return Status::truncated;
    ByteReader in(bytes);
    const auto us = in.get<std::int64_t>();
    const unsigned flags = in.get<std::uint8_t>(), present = flags & all_parts;
    if (us > max_pose_us || us < -max_pose_us || flags > (all_parts | calls_bit | points_bit))
        return Status::malformed;
    const std::size_t size = pose_header_size + part_size * std::size_t(std::popcount(present));
    if (bytes.size() != size)
        return bytes.size() < size ? Status::truncated : Status::trailing_bytes;
    PersonPose pose;
    pose.time = from_us(us);
    pose.calls = (flags & calls_bit) != 0;
    pose.points = (flags & points_bit) != 0;
    unsigned bit = 1;
    for (auto* part : {&pose.head, &pose.left_hand, &pose.right_hand}) {
        if (present & bit && !get_part(in, part->emplace()))
            return Status::malformed;
        bit <<= 1;
    }
    return pose;
}

}  // namespace theatron::wire
