// SPDX-License-Identifier: Apache-2.0
#include "record/matroska_writer.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <chrono>
#include <cstring>

#include "base/error.h"
#include "record/recording_layout.h"

namespace theatron::record {
namespace {

// A block's time is 16 bits relative to its cluster's.
constexpr std::int64_t max_cluster_us = 32'000;
constexpr std::int64_t cue_distance_us = 500'000;

constexpr std::uint64_t unknown_size = 0xff'ffff'ffff'ffff;

// Writes all bytes at `offset`. Returns 0 or errno.
int write_at(int file, ByteView bytes, std::uint64_t offset) {
    while (!bytes.empty()) {
        const ssize_t n = pwrite(file, bytes.data(), bytes.size(), off_t(offset));
        if (n < 0 && errno == EINTR)
            continue;
        if (n <= 0)
            return n < 0 ? errno : ENOSPC;
        bytes = bytes.subspan(std::size_t(n));
        offset += std::uint64_t(n);
    }
    return 0;
}

// Creates a file that only its owner may read, as patients may be seen in it, locked against other
// writers and readers; its old content is cut after locking.
int create(const std::filesystem::path& path, bool replace) {
    const std::string name = "'" + path.string() + "'";
    const int file = open(path.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0600);
    if (file < 0)
        throw Error("Cannot create " + name + ": " + std::strerror(errno) + ".");
    const auto refuse = [&](const std::string& why) {
        close(file);
        throw Error(why);
    };
    // Some network file systems have no locks.
    if (flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
        refuse(name + " is being recorded or played; name another file, or end that first.");
    struct stat found {};
    if (fstat(file, &found) != 0)
        refuse("Cannot create " + name + ": " + std::strerror(errno) + ".");
    if (!replace && found.st_size > 0)
        refuse(name + " exists already; name another file, or give --overwrite.");
    if (ftruncate(file, 0) != 0)
        refuse("Cannot create " + name + ": " + std::strerror(errno) + ".");
    return file;
}

}  // namespace

MatroskaWriter::MatroskaWriter(const std::filesystem::path& path, const Layout& layout)
    : path_(path),
      info_{layout.uid, layout.family_uid,
            layout.utc.value_or(
                std::chrono::floor<std::chrono::microseconds>(std::chrono::system_clock::now()))} {
    Bytes bytes;
    render_ebml_head(bytes);
    for (const std::uint8_t b : {0x18, 0x53, 0x80, 0x67})
        bytes.push_back(std::byte{b});
    places_["segment_size"] = bytes.size();
    const Bytes size = render_segment_size(unknown_size);
    bytes.insert(bytes.end(), size.begin(), size.end());
    segment_ = bytes.size();
    render_void(seek_head_space, bytes);
    assert(bytes.size() == bytes_before_info);
    places_["info"] = bytes.size();
    render_info(info_, 0, bytes);
    places_["tracks"] = bytes.size();
    render_tracks(layout, bytes);
    if (!layout.attachments.empty())
        places_["attachments"] = bytes.size();
    render_attachments(layout.attachments, bytes);
    if (!layout.tags.empty())
        places_["tags"] = bytes.size();
    render_tags(layout.tags, bytes);
    if (layout.repeat_head) {
        head_copy_ = make_head_copy(ByteView(bytes).subspan(places_["info"]));
        bytes.insert(bytes.end(), head_copy_.begin(), head_copy_.end());
    }

    file_ = create(path, layout.replace);
    if (const std::string problem = append(bytes); !problem.empty()) {
        // It has no content: it was empty, or is replaced.
        struct stat at_name {};
        struct stat own {};
        if (lstat(path.c_str(), &at_name) == 0 && fstat(file_, &own) == 0 &&
            at_name.st_dev == own.st_dev && at_name.st_ino == own.st_ino)
            unlink(path.c_str());
        close(file_);
        throw Error(problem);
    }
}

MatroskaWriter::~MatroskaWriter() {
    close(file_);
}

std::string MatroskaWriter::fate() const {
    struct stat found {};
    if (fstat(file_, &found) == 0 && found.st_nlink == 0)
        return "what came before in '" + path_.string() + "' was deleted by another program";
    return "what came before is kept";
}

std::string MatroskaWriter::problem(int error) const {
    const std::string how = end_ == 0 ? "cannot begin" : "ends here; " + fate();
    if (error == ENOSPC || error == EDQUOT)
        return "The disk is full, so the recording '" + path_.string() + "' " + how + ".";
    if (error == EFBIG)
        return "The recording '" + path_.string() +
               "' has reached the size that the system allows for a file and " + how + ".";
    return "Cannot write to '" + path_.string() + "': " + std::strerror(error) +
           "; the recording " + how + ".";
}

std::string MatroskaWriter::fail(int error) {
    failed_ = true;
    if (early_end_.empty())
        early_end_ = error == ENOSPC || error == EDQUOT ? disk_full
                     : error == EFBIG                   ? file_too_large
                                                        : disk_failed;
    return problem(error);
}

// All or nothing.
std::string MatroskaWriter::append(const Bytes& bytes) {
    // Once written to, a file that was cut is as long as before, with zeros where it was cut.
    if (struct stat found{}; fstat(file_, &found) == 0 && std::uint64_t(found.st_size) < end_)
        cut_bytes_ += end_ - std::uint64_t(found.st_size);
    if (const int error = write_at(file_, bytes, end_); error != 0) {
        // If even that fails, the reader still stops at the last whole cluster.
        [[maybe_unused]] const int ignored = ftruncate(file_, off_t(end_));
        return fail(error);
    }
    end_ += bytes.size();
    return "";
}

std::string MatroskaWriter::write(std::vector<Block> blocks) {
    if (failed_)
        return "The recording '" + path_.string() + "' has ended already.";
    std::stable_sort(blocks.begin(), blocks.end(),
                     [](const Block& a, const Block& b) { return a.time_us < b.time_us; });
    const std::size_t cues_before = cues_.size();
    Bytes bytes;
    for (auto begin = blocks.begin(); begin != blocks.end();) {
        const auto end = std::find_if(begin, blocks.end(), [&](const Block& block) {
            return block.time_us - begin->time_us > max_cluster_us;
        });
        // Between clusters, however many are written at once.
        if (const std::uint64_t at = end_ + bytes.size(); at >= next_copy_) {
            bytes.insert(bytes.end(), head_copy_.begin(), head_copy_.end());
            next_copy_ = 2 * at;
        }
        append_cluster({&*begin, std::size_t(end - begin)}, bytes);
        begin = end;
    }
    const std::string problem = append(bytes);
    if (!problem.empty()) {
        cues_.resize(cues_before);
        return problem;
    }
    if (!blocks.empty())
        duration_us_ = std::max(duration_us_, blocks.back().time_us);
    return "";
}

// The cluster goes to the end of `out`, which goes to the end of the file.
void MatroskaWriter::append_cluster(std::span<const Block> blocks, Bytes& out) {
    for (const Block& block : blocks) {
        const auto last = last_cue_us_.find(block.track);
        if (block.key && block.indexed &&
            (last == last_cue_us_.end() || block.time_us - last->second >= cue_distance_us)) {
            last_cue_us_[block.track] = block.time_us;
            cues_.push_back({block.time_us, block.track, end_ + out.size() - segment_});
        }
    }
    render_cluster(blocks, out);
}

std::string MatroskaWriter::sync() {
    // Some file systems know of no such thing.
    int error = fdatasync(file_) == 0 || errno == EINVAL || errno == ENOSYS ? 0 : errno;
    if (error == 0)
        error = write_duration();
    return error == 0 ? "" : fail(error);
}

// It has its room in the file, on a full disk too. Returns 0 or errno.
int MatroskaWriter::write_duration() {
    Bytes info;
    render_info(info_, duration_us_, info);
    return write_at(file_, info, places_["info"]);
}

Bytes MatroskaWriter::render_cues() const {
    Bytes points;
    for (const MatroskaCue& cue : cues_)
        render_cue(cue, points);
    Bytes bytes;
    for (const std::uint8_t b : {0x1c, 0x53, 0xbb, 0x6b})
        bytes.push_back(std::byte{b});
    const Bytes size = render_segment_size(points.size());
    bytes.insert(bytes.end(), size.begin(), size.end());
    bytes.insert(bytes.end(), points.begin(), points.end());
    return bytes;
}

// It has its room in the file, with one tag, on a full disk too. Returns 0 or errno.
int MatroskaWriter::write_seek_head(const std::vector<Tag>& tags) {
    Bytes seek_head;
    render_seek_head(places_, segment_, seek_head);
    render_tags(tags, seek_head);
    assert(seek_head.size() + void_head_size <= seek_head_space);
    render_void(seek_head_space - seek_head.size(), seek_head);
    return write_at(file_, seek_head, segment_);
}

void MatroskaWriter::name_next(std::uint32_t number) {
    if (early_end_.empty() && write_seek_head({{next_segment_tag, std::to_string(number)}}) == 0)
        (void)fdatasync(file_);
}

void MatroskaWriter::note_lacks(const std::string& letters) {
    if (!notes_early_end_ && write_seek_head({{lacks_tag, letters}}) == 0)
        (void)fdatasync(file_);
}

std::string MatroskaWriter::finish() {
    const bool was_cut_back = failed_;
    std::string trouble;
    Bytes bytes = cues_.empty() ? Bytes{} : render_cues();
    bytes.insert(bytes.end(), head_copy_.begin(), head_copy_.end());
    if (!bytes.empty()) {
        const std::uint64_t place = end_;
        trouble = append(bytes);
        if (trouble.empty() && !cues_.empty())
            places_["cues"] = place;
        // The full disk has been reported already.
        if (was_cut_back)
            trouble.clear();
    }

    // These parts have their room in the file, on a full disk too.
    std::vector<Tag> tags;
    notes_early_end_ = was_cut_back && !early_end_.empty();
    if (notes_early_end_)
        tags.push_back({early_end_tag, early_end_});
    int error = write_seek_head(tags);
    if (error == 0)
        error = write_duration();
    if (error == 0)
        error = write_at(file_, render_segment_size(end_ - segment_), places_["segment_size"]);
    if (error == 0 && fsync(file_) != 0 && errno != EINVAL)
        error = errno;
    failed_ = true;
    return trouble.empty() && error != 0 ? problem(error) : trouble;
}

}  // namespace theatron::record
