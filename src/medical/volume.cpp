// SPDX-License-Identifier: Apache-2.0
#include "medical/volume.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace theatron::medical {
namespace {

constexpr char magic[] = {'T', 'H', 'V', 'O'};
constexpr std::uint8_t version = 1;
constexpr double min_step_mm = 1e-3;

bool is_within(Vec3 v, double limit) {
    // Comparisons with NaN are false.
    return std::abs(v.x) <= limit && std::abs(v.y) <= limit && std::abs(v.z) <= limit;
}

bool is_side(int n) {
    return n >= 1 && n <= max_volume_side;
}

double determinant(const VolumeGrid& grid) {
    return dot(grid.column_step_mm, cross(grid.row_step_mm, grid.slice_step_mm));
}

void put(ByteWriter& writer, Vec3 v) {
    writer.put_f64(v.x);
    writer.put_f64(v.y);
    writer.put_f64(v.z);
}

Vec3 get_vec3(ByteReader& reader) {
    const double x = reader.get_f64(), y = reader.get_f64(), z = reader.get_f64();
    return {x, y, z};
}

bool is_scale(double slope, double intercept, Window window) {
    constexpr double limit = 1e9;
    return slope != 0 && std::abs(slope) <= limit && std::abs(intercept) <= limit &&
           std::abs(window.center) <= limit && window.width > 0 && window.width <= limit;
}

}  // namespace

bool is_valid(const VolumeGrid& grid) {
    if (!is_side(grid.columns) || !is_side(grid.rows) || !is_side(grid.slices) ||
        grid.size() > max_volume_samples || !is_within(grid.origin_mm, max_coordinate_mm))
        return false;
    const Vec3 steps[] = {grid.column_step_mm, grid.row_step_mm, grid.slice_step_mm};
    double product = 1;
    for (const Vec3 step : steps) {
        if (!is_within(step, max_coordinate_mm) || !(length(step) >= min_step_mm))
            return false;
        product *= length(step);
    }
    const Vec3 last =
        grid.point_at(grid.columns - 1.0, grid.rows - 1.0, grid.slices - 1.0) - grid.origin_mm;
    return std::abs(determinant(grid)) > 0.01 * product && is_within(last, max_coordinate_mm);
}

SamplesFromPatient::SamplesFromPatient(const VolumeGrid& grid) : origin_(grid.origin_mm) {
    assert(is_valid(grid));
    const double d = determinant(grid);
    rows_[0] = cross(grid.row_step_mm, grid.slice_step_mm) * (1 / d);
    rows_[1] = cross(grid.slice_step_mm, grid.column_step_mm) * (1 / d);
    rows_[2] = cross(grid.column_step_mm, grid.row_step_mm) * (1 / d);
}

Box box_of(const VolumeGrid& grid) {
    Box box{grid.origin_mm, grid.origin_mm};
    for (int corner = 1; corner < 8; ++corner) {
        const Vec3 p =
            grid.point_at(corner & 1 ? grid.columns - 1 : 0, corner & 2 ? grid.rows - 1 : 0,
                          corner & 4 ? grid.slices - 1 : 0);
        box.low_mm = {std::min(box.low_mm.x, p.x), std::min(box.low_mm.y, p.y),
                      std::min(box.low_mm.z, p.z)};
        box.high_mm = {std::max(box.high_mm.x, p.x), std::max(box.high_mm.y, p.y),
                       std::max(box.high_mm.z, p.z)};
    }
    return box;
}

Bytes encode_volume(const Volume& volume) {
    assert(is_valid(volume.grid) && volume.samples.size() == volume.grid.size());
    Bytes out;
    out.reserve(volume_header_size + 2 * volume.samples.size());
    ByteWriter writer(out);
    for (const char letter : magic)
        writer.put(std::uint8_t(letter));
    writer.put(version);
    writer.put(std::uint8_t(volume.inverted));
    writer.put(std::uint16_t(0));
    for (const int side : {volume.grid.columns, volume.grid.rows, volume.grid.slices})
        writer.put(std::uint32_t(side));
    for (const Vec3 v : {volume.grid.origin_mm, volume.grid.column_step_mm, volume.grid.row_step_mm,
                         volume.grid.slice_step_mm})
        put(writer, v);
    for (const double v :
         {volume.slope, volume.intercept, volume.window.center, volume.window.width})
        writer.put_f64(v);
    assert(out.size() == volume_header_size);
    out.resize(volume_header_size + 2 * volume.samples.size());
    std::byte* at = out.data() + volume_header_size;
    for (const std::int16_t sample : volume.samples) {
        store_le(at, sample);
        at += 2;
    }
    return out;
}

Result<Volume> decode_volume(ByteView bytes) {
    ByteReader reader(bytes);
    const ByteView name = reader.get_bytes(4);
    const auto found_version = reader.get<std::uint8_t>();
    const auto flags = reader.get<std::uint8_t>();
    const auto zero = reader.get<std::uint16_t>();
    if (!reader.ok())
        return Status::truncated;
    if (!std::equal(name.begin(), name.end(), std::as_bytes(std::span(magic)).begin()))
        return Status::malformed;
    if (found_version != version)
        return found_version > version ? Status::unsupported_version : Status::malformed;
    std::uint32_t sides[3];
    for (std::uint32_t& side : sides)
        side = reader.get<std::uint32_t>();
    Volume volume;
    volume.inverted = flags & 1;
    volume.grid.origin_mm = get_vec3(reader);
    volume.grid.column_step_mm = get_vec3(reader);
    volume.grid.row_step_mm = get_vec3(reader);
    volume.grid.slice_step_mm = get_vec3(reader);
    volume.slope = reader.get_f64();
    volume.intercept = reader.get_f64();
    volume.window.center = reader.get_f64();
    volume.window.width = reader.get_f64();
    if (!reader.ok())
        return Status::truncated;
    for (const std::uint32_t side : sides)
        if (side > std::uint32_t(max_volume_side))
            return Status::too_large;
    volume.grid.columns = int(sides[0]);
    volume.grid.rows = int(sides[1]);
    volume.grid.slices = int(sides[2]);
    if (volume.grid.size() > max_volume_samples)
        return Status::too_large;
    if (flags > 1 || zero != 0 || !is_valid(volume.grid) ||
        !is_scale(volume.slope, volume.intercept, volume.window))
        return Status::malformed;
    const std::size_t needed = 2 * volume.grid.size();
    if (reader.rest().size() != needed)
        return reader.rest().size() < needed ? Status::truncated : Status::trailing_bytes;
    volume.samples.resize(volume.grid.size());
    const std::byte* at = reader.rest().data();
    for (std::int16_t& sample : volume.samples) {
        sample = load_le<std::int16_t>(at);
        at += 2;
    }
    return volume;
}

}  // namespace theatron::medical
