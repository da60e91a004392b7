// SPDX-License-Identifier: Apache-2.0
#include "cases/dicom_slice.h"

#include <algorithm>
#include <cmath>

#include "base/outside_text.h"
#include "cases/dicom_text.h"

namespace theatron::cases {
namespace {

enum Flag : std::uint8_t {
    has_place = 1,
    has_window = 2,
    inverted = 4,
    deidentified = 8,
    lowered = 16,
    has_padding = 32,
    has_wrong_window = 64,
    all_flags = 127
};

void put_text(ByteWriter& writer, const std::string& text) {
    const std::size_t size = std::min(text.size(), max_dicom_text);
    writer.put(std::uint8_t(size));
    writer.put_bytes(as_bytes(std::string_view(text).substr(0, size)));
}

std::string_view get_raw_text(ByteReader& reader, bool& good) {
    const std::size_t size = reader.get<std::uint8_t>();
    good = good && size <= max_dicom_text;
    const ByteView bytes = reader.get_bytes(size);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string get_text(ByteReader& reader, bool& good) {
    return clean_text(get_raw_text(reader, good), max_dicom_text);
}

void put_vec3(ByteWriter& writer, Vec3 v) {
    writer.put_f64(v.x);
    writer.put_f64(v.y);
    writer.put_f64(v.z);
}

Vec3 get_vec3(ByteReader& reader) {
    const double x = reader.get_f64(), y = reader.get_f64(), z = reader.get_f64();
    return {x, y, z};
}

void put_identifiers(ByteWriter& writer, const DicomSlice& slice) {
    put_text(writer, slice.charset);
    const std::size_t count = std::min(slice.identifiers.size(), max_identifiers);
    writer.put(std::uint8_t(count));
    for (std::size_t i = 0; i < count; ++i) {
        put_text(writer, slice.identifiers[i].name);
        put_text(writer, slice.identifiers[i].value);
    }
}

void get_identifiers(ByteReader& reader, DicomSlice& slice, bool& good) {
    slice.charset = get_text(reader, good);
    const std::size_t count = reader.get<std::uint8_t>();
    for (std::size_t i = 0; i < count && reader.ok(); ++i) {
        Identifier identifier;
        identifier.name = get_text(reader, good);
        identifier.value =
            clean_text(utf8_of_dicom(get_raw_text(reader, good), slice.charset), max_dicom_text);
        slice.identifiers.push_back(std::move(identifier));
    }
}

bool is_within(double value, double low, double high) {
    return value >= low && value <= high;
}

// Directions that are orthogonal unit vectors, and a place near the patient.
bool is_place(const DicomSlice& s) {
    const double limit = medical::max_coordinate_mm;
    const auto is_unit = [](Vec3 v) { return std::abs(dot(v, v) - 1) < 1e-3; };
    return is_unit(s.right) && is_unit(s.down) && std::abs(dot(s.right, s.down)) < 1e-3 &&
           is_within(s.position_mm.x, -limit, limit) && is_within(s.position_mm.y, -limit, limit) &&
           is_within(s.position_mm.z, -limit, limit) && is_within(s.column_spacing_mm, 1e-3, 100) &&
           is_within(s.row_spacing_mm, 1e-3, 100);
}

}  // namespace

Bytes encode(const DicomSlice& slice) {
    Bytes out;
    out.reserve(max_slice_head + 2 * slice.samples.size());
    ByteWriter writer(out);
    put_text(writer, slice.series_uid);
    put_text(writer, slice.frame_uid);
    put_text(writer, slice.modality);
    writer.put(std::uint16_t(slice.columns));
    writer.put(std::uint16_t(slice.rows));
    writer.put(std::uint8_t((slice.has_place ? has_place : 0) |
                            (slice.has_window ? has_window : 0) | (slice.inverted ? inverted : 0) |
                            (slice.deidentified ? deidentified : 0) |
                            (slice.lowered ? lowered : 0) | (slice.has_padding ? has_padding : 0) |
                            (slice.has_wrong_window ? has_wrong_window : 0)));
    put_text(writer, slice.problem);
    for (const std::string& key : slice.keys)
        put_text(writer, key);
    writer.put(std::uint32_t(slice.instance));
    writer.put(std::uint32_t(slice.padding_low));
    writer.put(std::uint32_t(slice.padding_high));
    for (const Vec3 v : {slice.right, slice.down, slice.position_mm})
        put_vec3(writer, v);
    for (const double v : {slice.column_spacing_mm, slice.row_spacing_mm, slice.slope,
                           slice.intercept, slice.window.center, slice.window.width})
        writer.put_f64(v);
    put_identifiers(writer, slice);
    const std::size_t head = out.size();
    out.resize(head + 2 * slice.samples.size());
    for (std::size_t i = 0; i < slice.samples.size(); ++i)
        store_le(out.data() + head + 2 * i, slice.samples[i]);
    return out;
}

Result<DicomSlice> decode_dicom_slice(ByteView bytes) {
    ByteReader reader(bytes);
    DicomSlice slice;
    bool good = true;
    slice.series_uid = get_text(reader, good);
    slice.frame_uid = get_text(reader, good);
    slice.modality = get_text(reader, good);
    slice.columns = reader.get<std::uint16_t>();
    slice.rows = reader.get<std::uint16_t>();
    const auto flags = reader.get<std::uint8_t>();
    slice.has_place = flags & has_place;
    slice.has_window = flags & has_window;
    slice.inverted = flags & inverted;
    slice.deidentified = flags & deidentified;
    slice.lowered = flags & lowered;
    slice.has_padding = flags & has_padding;
    slice.has_wrong_window = flags & has_wrong_window;
    slice.problem = get_text(reader, good);
    for (std::string& key : slice.keys)
        key = get_text(reader, good);
    slice.instance = std::int32_t(reader.get<std::uint32_t>());
    slice.padding_low = std::int32_t(reader.get<std::uint32_t>());
    slice.padding_high = std::int32_t(reader.get<std::uint32_t>());
    for (Vec3* v : {&slice.right, &slice.down, &slice.position_mm})
        *v = get_vec3(reader);
    for (double* v : {&slice.column_spacing_mm, &slice.row_spacing_mm, &slice.slope,
                      &slice.intercept, &slice.window.center, &slice.window.width})
        *v = reader.get_f64();
    get_identifiers(reader, slice, good);
    if (!reader.ok())
        return Status::truncated;
    const bool is_side = slice.columns >= 1 && slice.columns <= medical::max_volume_side &&
                         slice.rows >= 1 && slice.rows <= medical::max_volume_side;
    const bool is_scale = slice.slope != 0 && is_within(slice.slope, -1e9, 1e9) &&
                          is_within(slice.intercept, -1e9, 1e9);
    const bool is_window = is_within(slice.window.center, -1e9, 1e9) && slice.window.width > 0 &&
                           slice.window.width <= 1e9;
    if (!reader.ok())
        return Status::truncated;
    if (good && !slice.problem.empty()) {
        // It comes without samples, whatever size it announces.
        slice.columns = slice.rows = 0;
        return slice;
    }
    if (!good || flags > all_flags || !is_side || !is_scale || !is_window ||
        (slice.has_place && !is_place(slice)))
        return Status::malformed;
    const std::size_t count = std::size_t(slice.columns) * std::size_t(slice.rows);
    if (reader.rest().size() != 2 * count)
        return reader.rest().size() < 2 * count ? Status::truncated : Status::trailing_bytes;
    slice.samples.resize(count);
    for (std::size_t i = 0; i < count; ++i)
        slice.samples[i] = load_le<std::int16_t>(reader.rest().data() + 2 * i);
    return slice;
}

Bytes encode_identifiers(const DicomSlice& slice) {
    Bytes out;
    ByteWriter writer(out);
    put_identifiers(writer, slice);
    return out;
}

Result<std::vector<Identifier>> decode_identifiers(ByteView bytes) {
    ByteReader reader(bytes);
    DicomSlice slice;
    bool good = true;
    get_identifiers(reader, slice, good);
    if (!reader.ok())
        return Status::truncated;
    if (!good)
        return Status::malformed;
    return reader.rest().empty() ? Result(std::move(slice.identifiers)) : Status::trailing_bytes;
}

}  // namespace theatron::cases
