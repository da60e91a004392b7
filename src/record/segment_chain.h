// SPDX-License-Identifier: Apache-2.0
// The segments of a recording, in their order: finds the files that belong to it, and the parts of
// files that were joined one behind another. Safe for untrusted input.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "record/byte_source.h"
#include "record/matroska_reader.h"
#include "record/segment_info.h"

namespace theatron::record {

// The segment info of a head; empty for files of version 1.
std::optional<SegmentInfo> segment_info_of(const FoundHead& head);
// The segment info of a file; empty also if it is no recording or cannot be read.
std::optional<SegmentInfo> read_segment_info(const std::filesystem::path& file,
                                             CopySearch search = CopySearch::everywhere);

class SegmentChain {
public:
    struct Member {
        std::shared_ptr<ByteSource> source;
        FoundHead head;
        std::optional<SegmentInfo> info;
        std::string file;
        std::uint64_t begin = 0;  // of `source` in its file
    };

    // Reads the heads of `sources`, named `files`; the first one identifies the recording. Files of
    // another recording, those with a smaller number, and second copies are left out. Null, but not
    // as the first: a file that cannot be opened.
    static Result<SegmentChain> read(std::vector<std::unique_ptr<ByteSource>> sources,
                                     std::vector<std::string> files);

    // The next segment; nothing after the last one.
    std::optional<Member> take();

    // Other files in a segment's file, behind the segment, that do not follow it in the recording.
    struct Foreign {
        std::uint64_t files = 0, bytes = 0;
        // The first of them in the order of the file; its place is counted from the file's begin.
        std::uint64_t first_at = 0, first_bytes = 0;
        bool first_is_recording = false;

        void add(const Foreign& more) {
            if (files == 0)
                *this = more;
            else
                files += more.files, bytes += more.bytes;
        }
    };
    struct Behind {
        Foreign foreign;
        // Another file is in the middle of the member's file: the member continues here.
        std::optional<std::uint64_t> goes_on_at;
        // Bytes of the member's own head, which stands there once more: damage.
        std::uint64_t repeated_head_bytes = 0;
    };
    // Reads the files behind the member that was taken last, from `at` on. Those that follow in the
    // recording become members.
    Behind add_behind(const Member& taken, std::uint64_t at);

    // After the last one was taken: the number of missing segments between the first and the last,
    // one more if the last one says that another follows. Where none says so, as in old files, at
    // least the number of unreadable() files.
    std::uint64_t missing() const;
    const std::vector<std::string>& unreadable() const { return unreadable_; }
    // Files that can be read, and do not continue the recording.
    const std::vector<std::string>& foreign() const { return foreign_; }

private:
    bool follows(const std::optional<SegmentInfo>& info, std::uint32_t number) const;

    std::optional<SegmentInfo> first_;
    std::map<std::uint32_t, Member> waiting_;
    std::uint32_t last_ = 0;  // number of the segment that was taken last
    std::uint64_t taken_ = 0;
    bool has_next_ = false;      // that segment says that another one follows
    bool knows_extent_ = false;  // segments say which one follows them
    std::vector<std::string> unreadable_, foreign_;
};

}  // namespace theatron::record
