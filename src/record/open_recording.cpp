// SPDX-License-Identifier: Apache-2.0
// Opening a recording by the name of a file: finds the files of its other segments.
#include <set>
#include <tuple>

#include "base/error.h"
#include "record/recording_file.h"
#include "record/segment_files.h"

namespace theatron::record {
namespace {

struct NamedSegment {
    std::uint32_t number = 0;
    std::filesystem::path file;
};

// Files beside `path` that hold segments of the same recording under other names. Where there are
// several of one, as after copying, the best is first: one that was not recovered, then the
// largest.
std::vector<NamedSegment> renamed_segments(const std::filesystem::path& path,
                                           const SegmentInfo& own) {
    std::set<std::tuple<std::uint32_t, bool, std::int64_t, std::filesystem::path>> found;
    for (const std::filesystem::path& file : files_of_other_names(path)) {
        try {
            // Another program's file may be large: it is not searched for a copy of a head.
            const auto source = open_file_source(file);
            const auto head = read_head(*source, CopySearch::at_the_beginning);
            const auto info = head ? segment_info_of(*head) : std::nullopt;
            if (info && info->recording == own.recording && info->number != own.number)
                found.emplace(info->number, !head->recovered.empty(), -std::int64_t(source->size()),
                              file);
        } catch (const Error&) {  // not to be read: unknown
        }
    }
    std::vector<NamedSegment> segments;
    for (const auto& [number, is_recovered, size, file] : found)
        segments.push_back({number, file});
    return segments;
}

// Null if it may not be read, or is gone meanwhile.
std::unique_ptr<ByteSource> try_to_open(const std::filesystem::path& file) {
    try {
        return open_file_source(file);
    } catch (const Error&) {
        return nullptr;
    }
}

}  // namespace

std::unique_ptr<RecordingFile> RecordingFile::open(const std::filesystem::path& path) {
    std::vector<std::unique_ptr<ByteSource>> sources;
    std::vector<std::string> files;
    const auto add = [&](const std::filesystem::path& file, std::unique_ptr<ByteSource> source) {
        sources.push_back(std::move(source));
        files.push_back(file.string());
    };
    add(path, open_file_source(path));
    for (const std::filesystem::path& other : files_of_later_segments(path))
        add(other, try_to_open(other));
    std::vector<std::filesystem::path> earlier = files_of_earlier_segments(path);
    if (const auto own = read_segment_info(path, CopySearch::at_the_beginning)) {
        for (const NamedSegment& renamed : renamed_segments(path, *own)) {
            if (renamed.number > own->number)
                add(renamed.file, try_to_open(renamed.file));
            else
                earlier.push_back(renamed.file);
        }
    }
    auto recording = read(std::move(sources), std::move(files));
    if (recording) {
        (*recording)->note_earlier(earlier);
        return std::move(*recording);
    }
    const std::string name = "'" + path.string() + "'";
    switch (recording.error()) {
        case Status::malformed:
            throw Error(name + " is not a recording: it is no Matroska file.");
        case Status::truncated:
            throw Error(name + " ends before its first frame.");
        case Status::unsupported:
            throw Error(name +
                        " is a Matroska file, but not one that Theatron recorded; for an Azure "
                        "Kinect's recording, use mkv:FILE.");
        default:
            throw Error(name + " cannot be read as a recording: it is " +
                        std::string(to_text(recording.error())) + ".");
    }
}

// Segments before the first one that was opened are missing, unless they are among `earlier`.
void RecordingFile::note_earlier(const std::vector<std::filesystem::path>& earlier) {
    const SegmentInfo& own = segments_.front().info;
    if (!segments_.front().has_info || own.number == 1)
        return;
    std::set<std::uint32_t> found;
    for (const std::filesystem::path& file : earlier) {
        const auto info = read_segment_info(file);
        if (!info || info->recording != own.recording || info->number >= own.number)
            continue;
        if (found.insert(info->number).second && info->number == 1)
            begins_in_ = file.string();
    }
    missing_segments_ += own.number - 1 - found.size();
}

}  // namespace theatron::record
