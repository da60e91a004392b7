// SPDX-License-Identifier: Apache-2.0
// The checksums beside each picture of a recording (docs/formats/recording.md).
#pragma once

#include <array>

#include "record/crc32c.h"

namespace theatron::record {

// Two, so that an index can be trusted before any picture is read.
struct PictureCheck {
    std::uint32_t head = 0;     // of track, time, media header and filters
    std::uint32_t payload = 0;  // of the encoded picture
    bool operator==(const PictureCheck&) const = default;
};

inline constexpr std::size_t picture_check_size = 8;
using EncodedCheck = std::array<std::byte, picture_check_size>;

inline std::uint32_t head_check(int track, std::int64_t time_us, ByteView side, ByteView note) {
    std::array<std::byte, 12> place;
    store_le(place.data(), std::uint32_t(track));
    store_le(place.data() + 4, time_us);
    return crc32c(note, crc32c(side, crc32c(place)));
}

inline PictureCheck check_of(int track, std::int64_t time_us, ByteView side, std::string_view note,
                             ByteView payload) {
    return {head_check(track, time_us, side, as_bytes(note)), crc32c(payload)};
}

inline EncodedCheck encode_check(const PictureCheck& check) {
    EncodedCheck bytes;
    store_le(bytes.data(), check.head);
    store_le(bytes.data() + 4, check.payload);
    return bytes;
}

inline PictureCheck decode_check(const EncodedCheck& bytes) {
    return {load_le<std::uint32_t>(bytes.data()), load_le<std::uint32_t>(bytes.data() + 4)};
}

}  // namespace theatron::record
