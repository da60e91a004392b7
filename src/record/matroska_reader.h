// SPDX-License-Identifier: Apache-2.0
// Reads the Matroska files that MatroskaWriter writes: whole, cut short or
// damaged.
//
// First the head: everything before the first block, from the first of its
// copies that is intact. Then the clusters, one after the other; damage is
// skipped up to the next cluster. Images stay in the file. Safe for untrusted
// input: time is proportional to the file's size, and memory is bounded.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/bytes.h"
#include "base/status.h"
#include "record/byte_source.h"
#include "record/picture_check.h"
#include "wire/media_header.h"

namespace theatron::record {

struct FoundTrack {
    int number = 0;
    std::string name;
    std::string codec_id;
    Bytes codec_private;
    int width = 0, height = 0;
    std::uint64_t default_duration_ns = 0;  // 0: unknown
    bool operator==(const FoundTrack&) const = default;
};

struct FoundAttachment {
    std::string name;
    std::string mime_type;
    Bytes bytes;
    bool operator==(const FoundAttachment&) const = default;
};

struct FoundHead {
    std::vector<FoundTrack> tracks;
    std::vector<FoundAttachment> attachments;
    std::int64_t date_ns = 0;  // since 2001 in UTC, of time 0; 0: unknown
    // A copy of the head, or the head that players read, is damaged; nothing of it is missing.
    bool damaged = false;
    std::string recovered;  // a recovered file: its tag about the missing parts of the original
    // From the beginning of the file, not from copies: the cause of an early end (early_end_tag;
    // empty: none), the time of the last block that was
    // certainly on the disk (0: unknown), and the end of the segment (0: it was never closed).
    std::string early_end;
    std::string lacks;               // from there, too: letters of lacks.h
    std::uint32_t next_segment = 0;  // from there, too: the number of the next segment; 0: none
    std::int64_t duration_us = 0;
    std::uint64_t segment_end = 0;
    bool closed = false;            // the segment has a size, and ends within the file
    std::uint64_t clusters_at = 0;  // position at which the search for them begins
    // Where the first cluster was written, according to the size of a copy; 0: unknown.
    std::uint64_t front_end = 0;
};

// Most bytes before the first block. Copies of the head are searched within this distance of both
// ends of the file first, then in all of a file that has clusters.
inline constexpr std::size_t max_front_bytes = std::size_t(16) << 20;

enum class CopySearch { everywhere, at_the_beginning };
// malformed: no Matroska file, or its head cannot be found; truncated: it ends in its head.
Result<FoundHead> read_head(ByteSource& source, CopySearch search = CopySearch::everywhere);

using EncodedHeader = std::array<std::byte, wire::media_header_size>;

struct FoundBlock {
    int track = 0;
    std::int64_t time_us = 0;
    std::uint64_t payload_at = 0;
    std::uint32_t payload_size = 0;
    std::uint64_t side_at = 0;
    std::optional<EncodedHeader> side;
    std::optional<EncodedCheck> check;
    std::string note;  // at most max_note bytes; a longer one is left out
};
inline constexpr std::size_t max_note = 4096;

struct FoundClusters {
    std::uint64_t damaged_places = 0;  // skipped: each up to the next intact cluster
    std::uint64_t damaged_bytes = 0;   // in them
    std::uint64_t cut_bytes = 0;       // after the last whole cluster of a file that was not closed
    bool cut_in_clusters = false;      // pictures may be in those; false: they are of the index
    bool has_end = false;              // the file ends as one of version 2 that was closed
    // Position of another Matroska file behind this one; reading ends there.
    std::optional<std::uint64_t> next_file_at;
};

// Calls `visit` for each block of the clusters from head.clusters_at on, in the order of the file,
// up to its end or to where another file begins.
FoundClusters read_clusters(ByteSource& source, const FoundHead& head,
                            const std::function<void(const FoundBlock&)>& visit);

}  // namespace theatron::record
