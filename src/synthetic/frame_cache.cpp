// SPDX-License-Identifier: Apache-2.0
// File format: magic, key, number of frames; for each frame two lengths, the RVL depth and
// the JPEG colour; at the end a checksum of all bytes before it.
#include "synthetic/frame_cache.h"

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <map>
#include <mutex>
#include <thread>

#include "base/error.h"
#include "codec/rvl.h"
#include "synthetic/frame_maker.h"
#include "video/jpeg_header.h"

namespace theatron::synthetic {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view magic = "THEATRON-LOOP-1\n";

// Detects accidental damage, not manipulation.
class Checksum {
public:
    void add(ByteView bytes) {
        for (; bytes.size() >= 8; bytes = bytes.subspan(8))
            step(load_le<std::uint64_t>(bytes.data()));
        for (const std::byte b : bytes)
            step(std::to_integer<std::uint64_t>(b) + 0x100);
    }
    std::uint64_t value() const { return sum_; }

private:
    void step(std::uint64_t v) {
        sum_ = (sum_ ^ v) * 0x9e3779b97f4a7c15u;
        sum_ ^= sum_ >> 29;
    }
    std::uint64_t sum_ = 0x243f6a8885a308d3u;
};

std::size_t frames_of(const LoopOptions& o) {
    const double frames = double(o.scene.loop.count()) * 1e-6 * o.frames_per_second;
    return std::size_t(std::max<std::int64_t>(1, std::llround(frames)));
}

std::string key_of(const LoopOptions& o) {
    std::string key = "scene=" + std::to_string(scene_version);
    const auto add = [&](const char* name, auto value) {
        key += std::string(" ") + name + "=" + std::to_string(value);
    };
    add("variant", int(o.variant));
    add("seed", o.scene.seed);
    add("loop_us", o.scene.loop.count());
    add("detail_permille", std::lround(o.scene.detail * 1000));
    add("camera", o.camera);
    add("cameras", o.cameras);
    add("color_width", o.color.width);
    add("color_height", o.color.height);
    add("depth_divisor", o.depth_divisor);
    add("frames", frames_of(o));
    add("noise", int(o.noise));
    if (!o.scene.people)
        key += " people=0";
    return key;
}

std::string file_name(const std::string& key) {
    Checksum sum;
    sum.add(as_bytes(key));
    static constexpr char digits[] = "0123456789abcdef";
    std::string name = "synthetic-";
    for (int shift = 60; shift >= 0; shift -= 4)
        name += digits[(sum.value() >> shift) & 15];
    return name + ".loop";
}

// Writes byte ranges, and finally their checksum.
class Writer {
public:
    explicit Writer(const fs::path& path) : path_(path), out_(path, std::ios::binary) {}

    void add(ByteView bytes) {
        sum_.add(bytes);
        out_.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
    }
    void add_number(std::uint32_t value) {
        std::byte four[4];
        store_le(four, value);
        add(four);
    }
    void finish() {
        std::byte eight[8];
        store_le(eight, sum_.value());
        out_.write(reinterpret_cast<const char*>(eight), 8);
        out_.close();
        require_good();
    }
    void require_good() const {
        if (!out_)
            throw Error("Cannot write the synthetic room's cache '" + path_.string() +
                        "'; is there space on the disk?");
    }

private:
    fs::path path_;
    std::ofstream out_;
    Checksum sum_;
};

// Renders all frames with two threads and delivers them in order.
class LoopRenderer {
public:
    LoopRenderer(const LoopOptions& options, std::size_t frames, const Progress& progress)
        : options_(options), frames_(frames), progress_(progress) {}

    void render(Writer& out) {
        tell("building the synthetic operating room", 0);
        const OperatingRoom room(options_.scene);
        tell("drawing what does not move", 0.02);
        RenderOptions wanted;
        wanted.surface = options_.noise;
        wanted.color = options_.color.area() > 0;
        const auto view = room.look_from(loop_calibration(options_), wanted);
        const auto twin = view->share();
        std::thread second([&] { work(room, *twin); });
        work(room, *view, &out);
        second.join();
        write_ready(out);
        if (failure_)
            std::rethrow_exception(failure_);
        out.require_good();
        // Progress of the last frames may come from the second thread, which does not report.
        tell("rendering the synthetic operating room", 1);
    }

private:
    void tell(std::string_view what, double done) {
        if (progress_)
            progress_(what, done);
    }

    void work(const OperatingRoom& room, RoomView& view, Writer* out = nullptr) {
        try {
            FrameMaker maker(options_);
            while (!failed_) {
                const std::size_t i = next_++;
                if (i >= frames_)
                    break;
                const auto time =
                    Duration(options_.scene.loop.count() * std::int64_t(i) / std::int64_t(frames_));
                EncodedFrame frame = maker.encode(view.render(*room.at(time)), std::uint32_t(i));
                {
                    const std::lock_guard lock(mutex_);
                    ready_.emplace(i, std::move(frame));
                }
                if (out) {  // only the caller's thread writes and reports
                    write_ready(*out);
                    tell("rendering the synthetic operating room",
                         0.05 + 0.95 * double(written_) / double(frames_));
                }
            }
        } catch (...) {
            const std::lock_guard lock(mutex_);
            failure_ = std::current_exception();
            failed_ = true;
        }
    }

    void write_ready(Writer& out) {
        const std::lock_guard lock(mutex_);
        for (auto at = ready_.find(written_); at != ready_.end(); at = ready_.find(written_)) {
            out.add_number(std::uint32_t(at->second.depth.size()));
            out.add_number(std::uint32_t(at->second.color.size()));
            out.add(at->second.depth);
            out.add(at->second.color);
            ready_.erase(at);
            ++written_;
        }
    }

    const LoopOptions& options_;
    std::size_t frames_;
    const Progress& progress_;
    std::atomic<std::size_t> next_ = 0;
    std::atomic<bool> failed_ = false;
    std::mutex mutex_;  // guards the members below
    std::map<std::size_t, EncodedFrame> ready_;
    std::exception_ptr failure_;
    std::size_t written_ = 0;  // used by the caller's thread only
};

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

}  // namespace

fs::path default_cache_folder() {
    if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && *cache)
        return fs::path(cache) / "theatron";
    if (const char* home = std::getenv("HOME"); home && *home)
        return fs::path(home) / ".cache" / "theatron";
    return fs::temp_directory_path() / "theatron-cache";
}

Calibration loop_calibration(const LoopOptions& options) {
    Calibration c =
        synthetic_camera(options.variant, options.camera, options.cameras, options.color);
    if (options.depth_divisor > 1)
        c.depth = scaled(c.depth, {c.depth.size.width / options.depth_divisor,
                                   c.depth.size.height / options.depth_divisor});
    return c;
}

fs::path loop_path(const LoopOptions& options) {
    return (options.folder.empty() ? default_cache_folder() : options.folder) /
           file_name(key_of(options));
}

FrameLoop::FrameLoop(const LoopOptions& options, const Progress& progress)
    : calibration_(loop_calibration(options)) {
    const std::size_t frames = frames_of(options);
    const std::string key = key_of(options);
    path_ = loop_path(options);
    const fs::path folder = path_.parent_path();
    was_cached_ = open(key);
    if (was_cached_ && frames == index_.size())
        return;

    std::error_code problem;
    fs::create_directories(folder, problem);
    if (problem)
        throw Error("Cannot make the cache folder '" + folder.string() + "': " + problem.message() +
                    ".");
    remove_abandoned_drafts(path_);
    // Another process may render the same loop: each writes a draft, the last rename wins.
    const fs::path unfinished =
        path_.string() + "." +
        std::to_string(std::hash<std::thread::id>()(std::this_thread::get_id()) ^
                       std::size_t(reinterpret_cast<std::uintptr_t>(this))) +
        ".part";
    try {
        Writer out(unfinished);
        out.add(as_bytes(magic));
        out.add_number(std::uint32_t(key.size()));
        out.add(as_bytes(key));
        out.add_number(std::uint32_t(frames));
        LoopRenderer(options, frames, progress).render(out);
        out.finish();
        fs::rename(unfinished, path_);
    } catch (...) {
        fs::remove(unfinished, problem);
        throw;
    }
    was_cached_ = false;
    if (!open(key))
        throw Error("The synthetic room's cache '" + path_.string() + "' cannot be read back.");
}

bool FrameLoop::open(const std::string& key) {
    index_.clear();
    file_.close();
    file_.clear();
    file_.open(path_, std::ios::binary);
    if (!file_)
        return false;
    std::error_code problem;
    const std::uint64_t size = fs::file_size(path_, problem);
    if (problem)
        return false;
    std::uint64_t left = size;
    Checksum sum;
    const auto take = [&](std::uint64_t count) {
        if (count > left)
            return false;
        buffer_.resize(std::size_t(count));
        file_.read(reinterpret_cast<char*>(buffer_.data()), std::streamsize(count));
        left -= count;
        sum.add(buffer_);
        return bool(file_);
    };
    const auto take_number = [&](std::uint32_t& value) {
        if (!take(4))
            return false;
        value = load_le<std::uint32_t>(buffer_.data());
        return true;
    };
    const auto take_text = [&](std::string_view expected) {
        return take(expected.size()) &&
               std::equal(buffer_.begin(), buffer_.end(), as_bytes(expected).begin());
    };
    std::uint32_t key_size = 0, frames = 0;
    if (!take_text(magic) || !take_number(key_size) || key_size != key.size() || !take_text(key) ||
        !take_number(frames))
        return false;
    for (std::uint32_t i = 0; i < frames; ++i) {
        Entry entry;
        if (!take_number(entry.depth_bytes) || !take_number(entry.color_bytes))
            return false;
        entry.at = size - left;
        // Two pieces as in the writer: the checksum runs in words from the start of each.
        if (!take(entry.depth_bytes) || !take(entry.color_bytes))
            return false;
        index_.push_back(entry);
    }
    const std::uint64_t expected = sum.value();
    return take(8) && left == 0 && load_le<std::uint64_t>(buffer_.data()) == expected;
}

void FrameLoop::read(std::size_t number, Frame& out) {
    const Entry& entry = index_.at(number);
    buffer_.resize(std::size_t(entry.depth_bytes) + entry.color_bytes);
    file_.clear();
    file_.seekg(std::streamoff(entry.at));
    file_.read(reinterpret_cast<char*>(buffer_.data()), std::streamsize(buffer_.size()));
    const ByteView depth = ByteView(buffer_).first(entry.depth_bytes);
    const ByteView color = ByteView(buffer_).subspan(entry.depth_bytes);
    out.depth.resize(calibration_.depth.size);
    out.color.pixels = {};
    out.color.jpeg.assign(color.begin(), color.end());
    out.color.size = color.empty() ? Size{} : calibration_.color.size;
    if (!file_ || codec::rvl::decode(depth, out.depth.view()) != Status::ok)
        throw Error("The synthetic room's cache '" + path_.string() +
                    "' has been damaged; it will be rendered again at the next start.");
}

}  // namespace theatron::synthetic
