// SPDX-License-Identifier: Apache-2.0
#include "synthetic/loop_file.h"

#include <unistd.h>

#include <chrono>
#include <utility>

#include "base/error.h"
#include "codec/rvl.h"

namespace theatron::synthetic {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view magic = "THEATRON-LOOP-1\n";

// Drafts of `path` that a process which was killed has left: a living one writes more often.
void remove_abandoned_drafts(const fs::path& path) {
    constexpr auto abandoned_after = std::chrono::hours(1);
    const std::string begin = path.filename().string() + ".";
    std::error_code problem, ignored;
    for (fs::directory_iterator at(path.parent_path(), problem), end; !problem && at != end;
         at.increment(problem)) {
        const std::string name = at->path().filename().string();
        if (!name.starts_with(begin) || !name.ends_with(".part"))
            continue;
        const auto written = fs::last_write_time(at->path(), ignored);
        if (!ignored && fs::file_time_type::clock::now() - written > abandoned_after)
            fs::remove(at->path(), ignored);
    }
}

// Reads a file from its beginning, and sums what it reads.
class LoopReader {
public:
    explicit LoopReader(const fs::path& path) : file_(path, std::ios::binary) {
        std::error_code problem;
        size_ = file_ ? fs::file_size(path, problem) : 0;
        left_ = problem ? 0 : size_;
    }

    std::uint64_t at() const { return size_ - left_; }
    std::uint64_t sum() const { return sum_.value(); }

    bool take(std::uint64_t count) {
        if (count > left_)
            return false;
        buffer_.resize(std::size_t(count));
        file_.read(reinterpret_cast<char*>(buffer_.data()), std::streamsize(count));
        left_ -= count;
        sum_.add(buffer_);
        return bool(file_);
    }
    bool take_number(std::uint32_t& value) {
        if (!take(sizeof(value)))
            return false;
        value = load_le<std::uint32_t>(buffer_.data());
        return true;
    }
    bool take_text(std::string_view expected) {
        return take(expected.size()) &&
               std::equal(buffer_.begin(), buffer_.end(), as_bytes(expected).begin());
    }
    bool ends_with_its_sum() {
        const std::uint64_t expected = sum();
        return take(sizeof(expected)) && left_ == 0 &&
               load_le<std::uint64_t>(buffer_.data()) == expected;
    }

private:
    std::ifstream file_;
    std::uint64_t size_ = 0, left_ = 0;
    Checksum sum_;
    Bytes buffer_;
};

}  // namespace

void Checksum::add(ByteView bytes) {
    for (; bytes.size() >= 8; bytes = bytes.subspan(8))
        step(load_le<std::uint64_t>(bytes.data()));
    for (const std::byte b : bytes)
        step(std::to_integer<std::uint64_t>(b) + 0x100);
}

void Checksum::step(std::uint64_t v) {
    sum_ = (sum_ ^ v) * 0x9e3779b97f4a7c15u;
    sum_ ^= sum_ >> 29;
}

LoopWriter::LoopWriter(fs::path path, const std::string& key, std::size_t frames)
    : path_(std::move(path)) {
    const fs::path folder = path_.parent_path();
    std::error_code problem;
    fs::create_directories(folder, problem);
    if (problem)
        throw Error("Cannot make the cache folder '" + folder.string() + "': " + problem.message() +
                    ".");
    remove_abandoned_drafts(path_);
    draft_ = path_.string() + "." + std::to_string(getpid()) + "-" +
             std::to_string(reinterpret_cast<std::uintptr_t>(this)) + ".part";
    out_.open(draft_, std::ios::binary);
    add_bytes(as_bytes(magic));
    add_number(std::uint32_t(key.size()));
    add_bytes(as_bytes(key));
    add_number(std::uint32_t(frames));
    require_good();
}

LoopWriter::~LoopWriter() {
    std::error_code ignored;
    if (!draft_.empty())
        fs::remove(draft_, ignored);
}

void LoopWriter::add_bytes(ByteView bytes) {
    sum_.add(bytes);
    out_.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
    written_ += bytes.size();
}

void LoopWriter::add_number(std::uint32_t value) {
    std::byte four[sizeof(value)];
    store_le(four, value);
    add_bytes(four);
}

LoopEntry LoopWriter::add(const EncodedFrame& frame) {
    add_number(std::uint32_t(frame.depth.size()));
    add_number(std::uint32_t(frame.color.size()));
    const LoopEntry entry{written_, std::uint32_t(frame.depth.size()),
                          std::uint32_t(frame.color.size())};
    add_bytes(frame.depth);
    add_bytes(frame.color);
    out_.flush();
    require_good();
    return entry;
}

void LoopWriter::finish() {
    std::byte eight[sizeof(std::uint64_t)];
    store_le(eight, sum_.value());
    out_.write(reinterpret_cast<const char*>(eight), sizeof(eight));
    out_.close();
    require_good();
    fs::rename(draft_, path_);
    draft_.clear();
}

void LoopWriter::require_good() const {
    if (!out_)
        throw Error("Cannot write the synthetic room's cache '" + draft_.string() +
                    "'; is there space on the disk?");
}

std::optional<std::vector<LoopEntry>> read_loop_index(const fs::path& path,
                                                      const std::string& key) {
    LoopReader in(path);
    std::uint32_t key_size = 0, frames = 0;
    if (!in.take_text(magic) || !in.take_number(key_size) || key_size != key.size() ||
        !in.take_text(key) || !in.take_number(frames))
        return std::nullopt;
    std::vector<LoopEntry> index;
    for (std::uint32_t i = 0; i < frames; ++i) {
        LoopEntry entry;
        if (!in.take_number(entry.depth_bytes) || !in.take_number(entry.color_bytes))
            return std::nullopt;
        entry.at = in.at();
        // Two pieces as in the writer: the checksum runs in words from the start of each.
        if (!in.take(entry.depth_bytes) || !in.take(entry.color_bytes))
            return std::nullopt;
        index.push_back(entry);
    }
    if (!in.ends_with_its_sum())
        return std::nullopt;
    return index;
}

bool read_loop_frame(std::ifstream& file, const LoopEntry& entry, Size depth, Size color,
                     Bytes& buffer, Frame& out) {
    buffer.resize(std::size_t(entry.depth_bytes) + entry.color_bytes);
    file.clear();
    file.seekg(std::streamoff(entry.at));
    file.read(reinterpret_cast<char*>(buffer.data()), std::streamsize(buffer.size()));
    const ByteView depth_bytes = ByteView(buffer).first(entry.depth_bytes);
    const ByteView color_bytes = ByteView(buffer).subspan(entry.depth_bytes);
    out.depth.resize(depth);
    out.color.pixels = {};
    out.color.jpeg.assign(color_bytes.begin(), color_bytes.end());
    out.color.size = color_bytes.empty() ? Size{} : color;
    return file && codec::rvl::decode(depth_bytes, out.depth.view()) == Status::ok;
}

}  // namespace theatron::synthetic
