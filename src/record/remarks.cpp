// SPDX-License-Identifier: Apache-2.0
#include "record/remarks.h"

#include <cmath>
#include <cstdio>

#include "record/recording_layout.h"

namespace theatron::record {
namespace {

// "1 picture", "2 pictures".
std::string count_of(std::uint64_t count, const std::string& what) {
    return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

std::string megabytes(std::uint64_t bytes) {
    char text[32];
    std::snprintf(text, sizeof(text), "%.1f MB", double(bytes) * 1e-6);
    return text;
}

// As one argument of a shell's command.
std::string quoted(const std::string& text) {
    std::string out = "'";
    for (const char c : text)
        out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
}

std::string remark_on_foreign(const Segment& segment) {
    const SegmentChain::Foreign& foreign = segment.foreign;
    const std::string what =
        foreign.first_is_recording ? "another recording" : "a file that is no part of it";
    std::string text = what + " begins at byte " + std::to_string(foreign.first_at) +
                       " of its file, and is left out";
    if (foreign.first_is_recording && !segment.file.empty())
        text += "; to get it: tail -c +" + std::to_string(foreign.first_at + 1) + " " +
                quoted(segment.file) + " | head -c " + std::to_string(foreign.first_bytes) +
                " > other.mkv";
    if (foreign.files > 1)
        text += "; " + count_of(foreign.files - 1, "more file") + " behind it, " +
                megabytes(foreign.bytes - foreign.first_bytes) + ", " +
                (foreign.files == 2 ? "is" : "are") + " left out too";
    return text;
}

}  // namespace

std::string end_of(const Segment& segment) {
    if (segment.closed)
        return "";
    const std::string begin = "it was not closed: ";
    if (!segment.missing_end)
        return begin + "nobody knows how much is missing";
    if (segment.unread_end > 0)
        return begin + "its last " + std::to_string(segment.unread_end) +
               " bytes cannot be read, and may hold pictures";
    if (*segment.missing_end <= Duration(0))
        return begin + "only its index is missing";
    char text[64];
    std::snprintf(text, sizeof(text), "%.1f s may be missing",
                  std::ceil(to_seconds(*segment.missing_end) * 10) / 10);
    return begin + text;
}

std::string early_end_of(const Segment& segment) {
    const std::string begin = "it stopped early: ";
    if (segment.early_end == disk_full)
        return begin + "the disk was full";
    if (segment.early_end == file_too_large)
        return begin + "the system allowed no larger file";
    return segment.early_end.empty() ? "" : begin + "the disk failed";
}

std::string lacks_of(const Segment& segment) {
    std::string all;
    for (const Lack lack : segment.lacks)
        all += (all.empty() ? "it is not complete: " : ", ") + text_of(lack);
    return all;
}

std::string losses_of(const Segment& segment) {
    std::string losses = segment.recovered;
    const auto add = [&](const std::string& more) {
        losses += (losses.empty() || more.empty() ? "" : "; ") + more;
    };
    add(end_of(segment));
    add(early_end_of(segment));
    add(lacks_of(segment));
    if (segment.damaged_places > 0)
        add(count_of(segment.damaged_places, "damaged place"));
    if (segment.refused > 0)
        add(count_of(segment.refused, "damaged picture"));
    return losses;
}

std::vector<std::string> remarks_on(const Segment& segment) {
    std::vector<std::string> remarks;
    if (std::string end = end_of(segment); !end.empty())
        remarks.push_back(std::move(end));
    if (std::string early = early_end_of(segment); !early.empty())
        remarks.push_back(std::move(early));
    if (std::string lacks = lacks_of(segment); !lacks.empty())
        remarks.push_back(std::move(lacks));
    if (segment.head_damaged)
        remarks.emplace_back(
            "its beginning or a copy of that is damaged; an intact one was read, and no picture "
            "is lost by this");
    if (segment.damaged_places > 0)
        remarks.push_back("it is damaged in " + count_of(segment.damaged_places, "place") + ", " +
                          megabytes(segment.damaged_bytes) + " together");
    if (segment.refused > 0)
        remarks.push_back(count_of(segment.refused, "picture") + " in it " +
                          (segment.refused == 1 ? "is" : "are") + " damaged and left out");
    if (segment.repeated > 0)
        remarks.push_back(count_of(segment.repeated, "picture") +
                          (segment.repeated == 1 ? " stands" : " stand") + " in it twice, and " +
                          (segment.repeated == 1 ? "counts" : "count") + " once");
    if (segment.foreign.files > 0)
        remarks.push_back(remark_on_foreign(segment));
    return remarks;
}

std::vector<std::string> remarks_on_files(const RecordingFile& recording) {
    std::vector<std::string> remarks;
    for (const std::string& file : recording.unreadable_files())
        remarks.push_back(quoted(file) +
                          " follows by its name, but cannot be read: it may not be opened, is no "
                          "recording, or its beginning and all copies of that are damaged");
    for (const std::string& file : recording.foreign_files())
        remarks.push_back(quoted(file) +
                          " lies beside it, but does not continue this recording, and is left out");
    if (const std::uint64_t missing = recording.missing_segments(); missing > 0)
        remarks.push_back((recording.segments().back().next != 0 ? "at least " : "") +
                          count_of(missing, "segment") + (missing == 1 ? " is" : " are") +
                          " missing");
    if (!recording.begins_in().empty())
        remarks.push_back("earlier segments are left out: the recording begins in " +
                          recording.begins_in());
    return remarks;
}

}  // namespace theatron::record
