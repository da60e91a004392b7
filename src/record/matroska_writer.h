// SPDX-License-Identifier: Apache-2.0
// Writes Matroska files of encoded images, so that they open again however the
// writing ended.
//
// A file grows by whole clusters, each handed to the system in one go: after a
// crash it holds all but the last call's blocks. Knows nothing of what the
// bytes mean. One thread at a time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/bytes.h"
#include "record/picture_check.h"
#include "record/segment_info.h"

namespace theatron::record {

struct Track {
    int number = 1;  // 1 to 126, each once
    std::string name;
    std::string codec_id;
    Bytes codec_private;
    int width = 0, height = 0;
    double frames_per_second = 0;  // 0: not said
    bool shown = true;             // a player that plays one track may choose this one
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
    std::int64_t reference_us = 0;  // unless key: the time of the frame referred to
    ByteView payload;
    ByteView side;     // stored beside the payload, unseen by players; may be empty
    std::string note;  // likewise
    std::optional<EncodedCheck> check;  // likewise
};

// Block additions with these numbers hold a block's `side`, `note` and `check`.
inline constexpr int side_id = 2, note_id = 3, check_id = 4;

// A copy of the head is an element that players pass over; its content begins with this.
inline constexpr std::string_view head_copy_magic = "theatron head 2\n";
// The first copy stands right behind the head, the others each time that the file has doubled its
// size since this, and at its end: damage of any one place leaves one.
inline constexpr std::uint64_t second_copy_at = std::uint64_t(512) << 10;

class MatroskaWriter {
public:
    struct Layout {
        std::vector<Track> tracks;
        std::vector<Attachment> attachments;
        std::vector<Tag> tags;
        // What `side`, `note` and `check` are, for people who look into the file; empty: there are
        // none.
        std::string side_name, note_name, check_name;
        // Of this file, and of those that belong together; not given: none.
        std::optional<Uid> uid, family_uid;
        std::optional<UtcTime> utc;  // of time 0; not given: now
        bool repeat_head = false;    // write copies of the head
        bool replace = true;         // a file that is there and not empty; else it is refused
    };

    // Creates `path` and writes everything before the first block. The file is locked as long as
    // this lives. Throws Error, also where another program records into the file or plays it.
    MatroskaWriter(const std::filesystem::path& path, const Layout& layout);
    MatroskaWriter(const MatroskaWriter&) = delete;
    // Leaves the file as it is: call finish() first.
    ~MatroskaWriter();

    // Appends blocks, ordered by time within a call. Returns one sentence if that failed, as on a
    // full disk; the file is then cut back to what was whole before, and takes no more blocks.
    std::string write(std::vector<Block> blocks);

    // Waits until the disk has what was written. Returns one sentence if it cannot.
    std::string sync();

    // Writes the index, the duration and the size. After a full disk, as much of that as there is
    // room for. Returns one sentence if that failed; the file opens nevertheless.
    std::string finish();

    std::uint64_t bytes() const { return end_; }

private:
    struct Cue {
        std::int64_t time_us;
        int track;
        std::uint64_t cluster;  // position in the segment
    };

    void render_info(std::int64_t duration_us, Bytes& out) const;
    Bytes render_cues() const;
    void append_cluster(std::span<const Block> blocks, Bytes& out);
    std::string append(const Bytes& bytes);
    std::string problem(int error) const;

    std::filesystem::path path_;
    int file_ = -1;
    bool failed_ = false;
    std::uint64_t end_ = 0;                        // of the file
    std::uint64_t segment_ = 0;                    // where the segment's content begins
    std::map<std::string, std::uint64_t> places_;  // of the parts that finish() fills in or names
    std::int64_t duration_us_ = 0;
    UtcTime utc_;
    std::optional<Uid> uid_, family_uid_;
    Bytes head_copy_;  // empty: none are written
    std::uint64_t next_copy_ = second_copy_at;
    std::vector<Cue> cues_;
    std::map<int, std::int64_t> last_cue_us_;  // by track
};

}  // namespace theatron::record
