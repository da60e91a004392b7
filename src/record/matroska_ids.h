// SPDX-License-Identifier: Apache-2.0
// The Matroska elements that the reader knows; it passes over all others.
#pragma once

#include <cstdint>

namespace theatron::record::ids {

enum : std::uint32_t {
    ebml = 0x1a45dfa3,
    doc_type = 0x4282,
    segment = 0x18538067,
    seek_head = 0x114d9b74,
    cues = 0x1c53bb6b,
    chapters = 0x1043a770,
    tags = 0x1254c367,
    tag = 0x7373,
    simple_tag = 0x67c8,
    tag_name = 0x45a3,
    tag_string = 0x4487,
    void_element = 0xec,
    crc_32 = 0xbf,
    info = 0x1549a966,
    date_utc = 0x4461,
    timestamp_scale = 0x2ad7b1,
    duration = 0x4489,
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
    cluster_position = 0xa7,
    previous_size = 0xab,
    silent_tracks = 0x5854,
    block_group = 0xa0,
    block_duration = 0x9b,
    reference_priority = 0xfa,
    codec_state = 0xa4,
    discard_padding = 0x75a2,
    slices = 0x8e,
    block = 0xa1,
    simple_block = 0xa3,
    reference_block = 0xfb,
    block_additions = 0x75a1,
    block_more = 0xa6,
    block_add_id = 0xee,
    block_additional = 0xa5,
};

}  // namespace theatron::record::ids
