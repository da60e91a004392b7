// SPDX-License-Identifier: Apache-2.0
#include "medical/shared_case.h"

#include <algorithm>
#include <cmath>

#include "base/outside_text.h"
#include "medical/volume.h"

namespace theatron::medical {
namespace {

constexpr std::uint32_t magic = 0x53434854;  // "THCS"
constexpr std::uint8_t version = 2, version_without_pictures = 1;
constexpr std::size_t shown_name = 64, shown_text = 500;  // characters

void put_text(ByteWriter& out, const std::string& text) {
    const std::size_t size = std::min(text.size(), max_shared_text);
    out.put(std::uint16_t(size));
    out.put_bytes(as_bytes(text).first(size));
}

std::string get_text(ByteReader& in, std::size_t characters) {
    const ByteView bytes = in.get_bytes(in.get<std::uint16_t>());
    return clean_text({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, characters);
}

void put_content(ByteWriter& out, const SharedContent& content) {
    out.put_bytes(content.hash.bytes);
    out.put(content.size);
}

SharedContent get_content(ByteReader& in) {
    SharedContent content;
    content.hash = to_content_hash(in.get_bytes(ContentHash::size)).value_or(ContentHash{});
    content.size = in.get<std::uint64_t>();
    return content;
}

}  // namespace

std::uint64_t SharedCase::content_bytes() const {
    std::uint64_t bytes = 0;
    for (const SharedPart& part : parts)
        bytes += part.mesh.size;
    for (const SharedSeries& one : series)
        bytes += one.volume.size;
    for (const SharedPicture& one : pictures)
        bytes += one.picture.size;
    return bytes;
}

Bytes encode_shared_case(const SharedCase& shared) {
    Bytes bytes;
    ByteWriter out(bytes);
    out.put(magic);
    out.put(shared.pictures.empty() ? version_without_pictures : version);
    out.put(std::uint8_t(shared.deidentified));
    for (const std::string* text : {&shared.name, &shared.license, &shared.credit})
        put_text(out, *text);
    for (const double value : {shared.middle_mm.x, shared.middle_mm.y, shared.middle_mm.z})
        out.put_f64(value);
    out.put(std::uint16_t(shared.parts.size()));
    for (const SharedPart& part : shared.parts) {
        put_text(out, part.name);
        out.put(std::uint8_t(part.role));
        for (const std::uint8_t value : {part.color.r, part.color.g, part.color.b, part.opacity})
            out.put(value);
        put_content(out, part.mesh);
    }
    out.put(std::uint16_t(shared.series.size()));
    for (const SharedSeries& series : shared.series) {
        put_text(out, series.name);
        put_text(out, series.modality);
        out.put(series.missing_slices);
        put_content(out, series.volume);
    }
    if (shared.pictures.empty())
        return bytes;
    out.put(std::uint16_t(shared.pictures.size()));
    for (const SharedPicture& picture : shared.pictures) {
        put_text(out, picture.name);
        put_content(out, picture.picture);
    }
    return bytes;
}

Result<SharedCase> decode_shared_case(ByteView bytes) {
    ByteReader in(bytes);
    SharedCase shared;
    if (in.get<std::uint32_t>() != magic)
        return Status::malformed;
    const auto of_version = in.get<std::uint8_t>();
    if (of_version != version && of_version != version_without_pictures)
        return Status::unsupported_version;
    const auto deidentified = in.get<std::uint8_t>();
    shared.deidentified = deidentified == 1;
    shared.name = get_text(in, shown_name);
    shared.license = get_text(in, shown_text);
    shared.credit = get_text(in, shown_text);
    bool sound = deidentified <= 1;
    for (double* value : {&shared.middle_mm.x, &shared.middle_mm.y, &shared.middle_mm.z}) {
        *value = in.get_f64();
        sound = sound && std::abs(*value) <= max_coordinate_mm;
    }
    const auto parts = in.get<std::uint16_t>();
    if (!in.ok() || parts > max_shared_parts)
        return Status::malformed;
    for (int i = 0; i < parts && in.ok(); ++i) {
        SharedPart part;
        part.name = get_text(in, shown_name);
        const auto role = in.get<std::uint8_t>();
        sound = sound && role < role_names.size();
        part.role = Role(std::min<std::size_t>(role, role_names.size() - 1));
        for (std::uint8_t* value : {&part.color.r, &part.color.g, &part.color.b, &part.opacity})
            *value = in.get<std::uint8_t>();
        part.mesh = get_content(in);
        sound = sound && part.mesh.size > 0;
        shared.parts.push_back(std::move(part));
    }
    const auto series = in.get<std::uint16_t>();
    if (!in.ok() || series > max_shared_series)
        return Status::malformed;
    for (int i = 0; i < series && in.ok(); ++i) {
        SharedSeries one;
        one.name = get_text(in, shown_name);
        one.modality = get_text(in, shown_name);
        one.missing_slices = in.get<std::uint16_t>();
        one.volume = get_content(in);
        sound = sound && one.volume.size > 0;
        shared.series.push_back(std::move(one));
    }
    // A description has one form: without pictures it is of version 1.
    const auto pictures = of_version == version ? in.get<std::uint16_t>() : std::uint16_t(0);
    if (!in.ok() || pictures > max_shared_pictures || (of_version == version && pictures == 0))
        return Status::malformed;
    for (int i = 0; i < pictures && in.ok(); ++i) {
        SharedPicture one;
        one.name = get_text(in, shown_name);
        one.picture = get_content(in);
        sound = sound && one.picture.size > 0;
        shared.pictures.push_back(std::move(one));
    }
    if (!in.ok() || !in.rest().empty() || !sound)
        return Status::malformed;
    return shared;
}

}  // namespace theatron::medical
