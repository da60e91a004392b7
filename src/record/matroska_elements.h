// SPDX-License-Identifier: Apache-2.0
// The elements of a Matroska file as bytes (docs/formats/recording.md). Pure: no files. Each
// function appends to `out`.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/bytes.h"
#include "record/picture_check.h"
#include "record/segment_info.h"

namespace theatron::record {

enum class TrackKind {
    video,
    metadata,  // which players ignore
    opus,      // one channel, 48 kHz (RFC 7845); `codec_private` is the OpusHead
};

struct Track {
    int number = 1;  // 1 to 256, each once
    TrackKind kind = TrackKind::video;
    std::string name;
    std::string codec_id;
    Bytes codec_private;
    int width = 0, height = 0;
    double frames_per_second = 0;  // 0: unknown
    bool shown = true;             // a player that plays one track may choose this one
    std::string note_name;         // in place of that of the layout; empty: that
};

struct Attachment {
    std::string name;
    std::string mime_type;
    Bytes bytes;
    std::uint64_t uid = 0;  // 0: chosen by the writer
};

// One named text about the whole file, a track or an attachment.
struct Tag {
    std::string name, value;
    int track = 0;                     // 0: not about a track
    std::uint64_t attachment_uid = 0;  // 0: not about an attachment
};

struct Block {
    int track = 1;
    std::int64_t time_us = 0;  // since the file's beginning, not negative
    bool key = true;
    bool indexed = true;            // if key: players find it by the index
    std::int64_t reference_us = 0;  // unless key: the time of the frame referred to
    ByteView payload;
    ByteView side;     // stored beside the payload, unseen by players; may be empty
    std::string note;  // stored beside the payload; may be empty
    std::optional<EncodedCheck> check;  // stored beside the payload
};

// Block additions with these numbers hold a block's `side`, `note` and `check`.
inline constexpr int side_id = 2, note_id = 3, check_id = 4;

// A copy of the head is an element that players skip; its content begins with this.
inline constexpr std::string_view head_copy_magic = "theatron head 2\n";

struct MatroskaLayout {
    std::vector<Track> tracks;
    std::vector<Attachment> attachments;
    std::vector<Tag> tags;
    // Names of `side`, `note` and `check` for people who inspect the file; empty: there are
    // none.
    std::string side_name, note_name, check_name;
    // The identifiers of this file and of its family; empty: none.
    std::optional<Uid> uid, family_uid;
    std::optional<UtcTime> utc;  // of time 0; not given: now
    bool repeat_head = false;    // write copies of the head
    bool replace = true;         // false: a file that exists and is not empty is refused
};

// The content of the Info element.
struct MatroskaInfo {
    // The identifiers of this file and of its family; empty: none.
    std::optional<Uid> uid, family_uid;
    UtcTime utc;  // of time 0
};

// A key frame that players find by the index.
struct MatroskaCue {
    std::int64_t time_us;
    int track;
    std::uint64_t cluster;  // position in the segment
};

void render_ebml_head(Bytes& out);
// Appends the same number of bytes for every duration.
void render_info(const MatroskaInfo& about, std::int64_t duration_us, Bytes& out);
void render_tracks(const MatroskaLayout& layout, Bytes& out);
// Both append nothing for an empty list.
void render_attachments(const std::vector<Attachment>& attachments, Bytes& out);
void render_tags(const std::vector<Tag>& tags, Bytes& out);

// An element without content that takes exactly `size` bytes, at least void_head_size.
void render_void(std::size_t size, Bytes& out);
inline constexpr std::size_t void_head_size = 9;
// Room for the SeekHead, and what a file has before its Info: the EBML head, the segment's id and
// size, and that room.
inline constexpr std::size_t seek_head_space = 160;
inline constexpr std::size_t bytes_before_info = 40 + 12 + seek_head_space;
// A copy of the head in an element that players skip.
Bytes make_head_copy(ByteView head);

// The size of a segment or of cues, always in eight bytes.
Bytes render_segment_size(std::uint64_t size);
// Refers to the elements with these names: info, tracks, attachments, tags, cues. `segment`: start
// of the segment's content.
void render_seek_head(const std::map<std::string, std::uint64_t>& places, std::uint64_t segment,
                      Bytes& out);

// `blocks`: at least one, ordered by time, within the time span of a cluster.
void render_cluster(std::span<const Block> blocks, Bytes& out);
void render_cue(const MatroskaCue& cue, Bytes& out);

}  // namespace theatron::record
