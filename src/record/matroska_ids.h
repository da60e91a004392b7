// SPDX-License-Identifier: Apache-2.0
// The Matroska elements that the reader knows; it passes over all others.
#pragma once

#include <cstdint>

namespace theatron::record::ids {

enum : std::uint32_t {
    ebml = 0x1a45dfa3,
    doc_type = 0x4282,
    segment = 0x18538067,
    info = 0x1549a966,
    timestamp_scale = 0x2ad7b1,
    tracks = 0x1654ae6b,
    track_entry = 0xae,
    track_number = 0xd7,
    codec_id = 0x86,
    codec_private = 0x63a2,
    track_name = 0x536e,
    default_duration = 0x23e383,
    video = 0xe0,
    pixel_width = 0xb0,
    pixel_height = 0xba,
    attachments = 0x1941a469,
    attached_file = 0x61a7,
    file_name = 0x466e,
    file_mime_type = 0x4660,
    file_data = 0x465c,
    cluster = 0x1f43b675,
    cluster_timestamp = 0xe7,
    block_group = 0xa0,
    block = 0xa1,
    simple_block = 0xa3,
    reference_block = 0xfb,
    block_additions = 0x75a1,
    block_more = 0xa6,
    block_add_id = 0xee,
    block_additional = 0xa5,
};

}  // namespace theatron::record::ids
