// SPDX-License-Identifier: Apache-2.0
// Reads the Matroska files that MatroskaWriter writes, whole or cut short.
//
// Passes once over the file, from block to block, and notes where the images
// are; their bytes stay in the file. Safe for untrusted input: what is not
// understood ends the reading there, memory and work are bounded by the file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/bytes.h"
#include "base/status.h"
#include "record/byte_source.h"

namespace theatron::record {

struct FoundTrack {
    int number = 0;
    std::string name;
    std::string codec_id;
    Bytes codec_private;
    int width = 0, height = 0;
    std::uint64_t default_duration_ns = 0;  // 0: not said
};

struct FoundAttachment {
    std::string name;
    std::string mime_type;
    Bytes bytes;
};

struct FoundBlock {
    int track = 0;
    std::int64_t time_us = 0;
    bool key = true;
    std::uint64_t payload_at = 0;
    std::uint32_t payload_size = 0;
    std::uint64_t side_at = 0;
    std::uint32_t side_size = 0;  // 0: none
    std::uint64_t note_at = 0;
    std::uint32_t note_size = 0;  // 0: none
};

struct FoundFile {
    std::vector<FoundTrack> tracks;
    std::vector<FoundAttachment> attachments;
    std::vector<FoundBlock> blocks;  // in the order of the file, of whole clusters only
    // False if the file was not closed, was cut off or is damaged: `read_bytes` of it are whole.
    bool complete = false;
    std::uint64_t read_bytes = 0;
};

// Everything before the first block may take this much.
inline constexpr std::size_t max_front_bytes = std::size_t(16) << 20;
// Four cameras at 30 frames a second for nineteen hours.
inline constexpr std::size_t max_blocks = std::size_t(1) << 24;

// malformed: not a Matroska file at all, or without tracks.
Result<FoundFile> read_matroska(ByteSource& source);

}  // namespace theatron::record
