// SPDX-License-Identifier: Apache-2.0
// Writes Matroska files of encoded images, so that they open again however the
// writing ended.
//
// A file grows by whole clusters, each handed to the system in one go: after a
// crash it holds all but the last call's blocks. Does not interpret the
// blocks' bytes. One thread at a time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "base/bytes.h"
#include "record/matroska_elements.h"

namespace theatron::record {

// The first copy of the head is directly behind it; further ones follow at this size, each time
// that the size has doubled, and at the end of the file: damage at one place never destroys all.
inline constexpr std::uint64_t second_copy_at = std::uint64_t(512) << 10;

class MatroskaWriter {
public:
    using Layout = MatroskaLayout;

    // Creates `path` and writes everything before the first block. The file is locked until the
    // destructor. Throws Error, also if another program records into the file or plays it.
    MatroskaWriter(const std::filesystem::path& path, const Layout& layout);
    MatroskaWriter(const MatroskaWriter&) = delete;
    // Does not finish the file: call finish() before.
    ~MatroskaWriter();

    // Appends blocks, ordered by time within a call. Returns one sentence if it failed, as on a
    // full disk; the file is then cut back to its last whole state and takes no more blocks.
    std::string write(std::vector<Block> blocks);

    // Waits until the disk has all written data, then writes the time of the last block into the
    // file, so that a later cut can be detected. Returns one sentence if it failed.
    std::string sync();

    // Writes the index, the duration and the size; on a full disk as much of these as fits. Returns
    // one sentence if it failed; the file can be opened nevertheless.
    std::string finish();

    // After finish(), unless writing failed: notes in the file that segment `number` follows, so
    // that its absence is noticed. A failure changes nothing else.
    void name_next(std::uint32_t number);

    // After finish(), unless the cause of an early end is noted: notes what the recording lacks. A
    // failure changes nothing else.
    void note_lacks(const std::string& letters);

    std::uint64_t bytes() const { return end_; }
    // Bytes that another program has cut off the file meanwhile, as of the last write.
    std::uint64_t cut_bytes() const { return cut_bytes_; }
    // The fate of the file when writing ends: "what came before is kept", unless it was
    // deleted.
    std::string fate() const;

private:
    Bytes render_cues() const;
    void append_cluster(std::span<const Block> blocks, Bytes& out);
    std::string append(const Bytes& bytes);
    int write_duration();
    int write_seek_head(const std::vector<Tag>& tags);
    std::string problem(int error) const;
    std::string fail(int error);

    std::filesystem::path path_;
    MatroskaInfo info_;
    int file_ = -1;
    bool failed_ = false;
    std::string early_end_;  // the cause of the first failure, for its tag
    bool notes_early_end_ = false;
    std::uint64_t end_ = 0;  // of the file
    std::uint64_t cut_bytes_ = 0;
    std::uint64_t segment_ = 0;                    // position of the segment's content
    std::map<std::string, std::uint64_t> places_;  // of the parts that finish() fills in or names
    std::int64_t duration_us_ = 0;
    Bytes head_copy_;  // empty: none are written
    std::uint64_t next_copy_ = second_copy_at;
    std::vector<MatroskaCue> cues_;
    std::map<int, std::int64_t> last_cue_us_;  // by track
};

}  // namespace theatron::record
