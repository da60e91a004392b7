// SPDX-License-Identifier: Apache-2.0
#include "capture/folder_camera.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>

#include "base/error.h"
#include "base/log.h"
#include "capture/folder_calibration.h"
#include "capture/playback.h"
#include "capture/tiled_recording.h"
#include "files/file_bytes.h"
#include "files/png_file.h"
#include "video/jpeg_header.h"

namespace theatron::capture {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t usual_preload_bytes = std::size_t(1) << 30;
constexpr std::size_t max_calibration_bytes = std::size_t(1) << 20;

// The files of one frame. `color` may be empty.
struct FramePaths {
    fs::path depth;
    fs::path color;
};

// Compares numbers by value, so that 10.png follows 9.png.
bool precedes(const std::string& a, const std::string& b) {
    const auto is_number = [](const std::string& s) {
        return !s.empty() && s.find_first_not_of("0123456789") == std::string::npos;
    };
    if (!is_number(a) || !is_number(b))
        return a < b;
    const auto significant = [](const std::string& s) {
        return s.substr(std::min(s.find_first_not_of('0'), s.size()));
    };
    const std::string x = significant(a), y = significant(b);
    return std::pair(x.size(), x) < std::pair(y.size(), y);
}

std::map<std::string, fs::path, decltype(&precedes)> pictures(
    const fs::path& folder, std::initializer_list<std::string_view> endings) {
    std::map<std::string, fs::path, decltype(&precedes)> found(&precedes);
    std::error_code problem;
    for (const auto& entry : fs::directory_iterator(folder, problem)) {
        std::string ending = entry.path().extension().string();
        std::transform(ending.begin(), ending.end(), ending.begin(),
                       [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
        if (std::find(endings.begin(), endings.end(), ending) != endings.end())
            found.emplace(entry.path().stem().string(), entry.path());
    }
    if (problem)
        throw Error("Cannot read the folder '" + folder.string() + "': " + problem.message() + ".");
    return found;
}

std::vector<FramePaths> find_frames(const fs::path& folder) {
    if (!fs::is_directory(folder))
        throw Error("There is no folder '" + folder.string() + "'.");
    if (!fs::is_directory(folder / "depth"))
        throw Error("'" + folder.string() + "' holds no folder 'depth' with 16-bit PNG pictures.");
    const auto depth = pictures(folder / "depth", {".png"});
    if (depth.empty())
        throw Error("'" + (folder / "depth").string() + "' holds no PNG pictures.");

    std::vector<FramePaths> frames;
    if (!fs::is_directory(folder / "color")) {
        for (const auto& [number, path] : depth)
            frames.push_back({path, {}});
        return frames;
    }
    const auto color = pictures(folder / "color", {".jpg", ".jpeg", ".png"});
    std::size_t without_color = 0;
    for (const auto& [number, path] : depth) {
        const auto same = color.find(number);
        frames.push_back({path, same == color.end() ? fs::path() : same->second});
        without_color += same == color.end();
    }
    if (without_color > 0)
        log::warning(
            "capture", "frames have no colour picture of the same number",
            {{"folder", folder.string()}, {"without", without_color}, {"frames", frames.size()}});
    return frames;
}

// Reads a colour picture: JPEG is kept, PNG is decoded to pixels.
void read_color(const fs::path& path, ColorData& out) {
    out.jpeg.clear();
    out.pixels.pixels.clear();
    out.size = {};
    if (path.empty())
        return;
    const Bytes bytes = files::read_file(path);
    constexpr std::byte png_begins{0x89};
    if (!bytes.empty() && bytes[0] == png_begins) {
        if (const std::string problem = files::decode_png(bytes, out.pixels); !problem.empty())
            throw Error("'" + path.string() + "' " + problem + ".");
        out.size = out.pixels.size;
        return;
    }
    const Result<Size> size = video::read_jpeg_size(bytes);
    if (!size && size.error() == Status::unsupported)
        throw Error("'" + path.string() +
                    "' is a JPEG picture of an unusual kind; save it as baseline JPEG or PNG.");
    if (!size)
        throw Error("'" + path.string() + "' is not a whole JPEG or PNG picture.");
    out.size = *size;
    out.jpeg.assign(bytes.begin(), bytes.end());
}

class FolderRecording final : public Recording {
public:
    FolderRecording(std::vector<FramePaths> frames, double fps, std::uint16_t invalid)
        : frames_(std::move(frames)), fps_(fps), invalid_(invalid) {
        Frame first;
        first.depth = files::read_depth_png(frames_[0].depth);
        depth_size_ = first.depth.size;
        for (const FramePaths& paths : frames_)
            if (!paths.color.empty()) {
                read_color(paths.color, first.color);
                color_size_ = first.color.size;
                bytes_per_frame_ +=
                    first.color.jpeg.size() + first.color.pixels.pixels.size() * sizeof(Rgb);
                break;
            }
        bytes_per_frame_ += depth_size_.area() * sizeof(std::uint16_t);
    }

    Size depth_size() const { return depth_size_; }
    Size color_size() const { return color_size_; }
    std::size_t frames() const { return frames_.size(); }
    std::size_t bytes() const { return frames_.size() * bytes_per_frame_; }

    std::optional<Duration> offset() override {
        if (next_ == frames_.size())
            return std::nullopt;
        return seconds_to_duration(double(next_) / fps_);
    }
    void skip() override { ++next_; }
    void rewind() override { next_ = 0; }

    void read(Frame& out) override {
        const FramePaths& paths = frames_[next_++];
        const Bytes png = files::read_file(paths.depth);
        if (const std::string problem = files::decode_png(png, out.depth); !problem.empty())
            throw Error("'" + paths.depth.string() + "' " + problem + ".");
        require_size(paths.depth, out.depth.size, depth_size_);
        if (invalid_ != 0)
            std::replace(out.depth.pixels.begin(), out.depth.pixels.end(), invalid_,
                         std::uint16_t(0));
        read_color(paths.color, out.color);
        if (!paths.color.empty())
            require_size(paths.color, out.color.size, color_size_);
    }

private:
    static void require_size(const fs::path& path, Size found, Size expected) {
        if (found != expected)
            throw Error("'" + path.string() + "' is " + to_text(found) +
                        ", but the first picture of its folder is " + to_text(expected) + ".");
    }

    std::vector<FramePaths> frames_;
    double fps_;
    std::uint16_t invalid_;
    Size depth_size_, color_size_;
    std::size_t bytes_per_frame_ = 0;
    std::size_t next_ = 0;
};

Calibration read_calibration(const fs::path& folder, Size depth, Size color) {
    const auto parse_file = [&](const fs::path& path, auto parse) {
        const Bytes bytes = files::read_file(path, max_calibration_bytes);
        const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        ParsedCalibration parsed = parse(text, depth, color);
        if (!parsed.problem.empty())
            throw Error("'" + path.string() + "' " + parsed.problem + ".");
        return parsed.calibration;
    };
    if (fs::exists(folder / "calibration.json"))
        return parse_file(folder / "calibration.json", parse_folder_calibration);
    if (fs::exists(folder / "camera-intrinsics.txt"))
        return parse_file(folder / "camera-intrinsics.txt", parse_intrinsics_matrix);
    log::warning("capture",
                 "the camera's lens is unknown and a usual one is assumed; add calibration.json",
                 {{"folder", folder.string()}});
    return default_calibration(depth, color);
}

Size parse_tile_size(const std::string& text) {
    Size size;
    char rest = 0;
    if (std::sscanf(text.c_str(), "%dx%d%c", &size.width, &size.height, &rest) != 2 ||
        !is_valid(size))
        throw Error("tile=" + text + " is not WIDTHxHEIGHT, for example tile=640x576.");
    return size;
}

}  // namespace

std::unique_ptr<Camera> open_folder_camera(Options& options, const Progress& progress) {
    const double fps = options.take_number("fps", 30, 0.1, 240);
    const int invalid = options.take_int("invalid", 0, 0, 65535);
    const std::string tile = options.take("tile");
    const PlaybackOptions playback = take_playback_options(options);
    options.require_no_problem();
    if (options.value().empty())
        throw Error("The camera 'folder' needs a folder, as in folder:DIR.");

    // Removes a trailing slash, which would leave no name.
    fs::path folder = fs::path(options.value()).lexically_normal();
    if (!folder.has_filename())
        folder = folder.parent_path();
    auto frames =
        std::make_unique<FolderRecording>(find_frames(folder), fps, std::uint16_t(invalid));
    if (std::size_t(playback.start) >= frames->frames())
        throw Error("'" + folder.string() + "' has " + std::to_string(frames->frames()) +
                    " frames, so start=" + std::to_string(playback.start) + " is too far.");

    CameraInfo info;
    info.name = fs::absolute(folder).filename().string();
    info.calibration = read_calibration(folder, frames->depth_size(), frames->color_size());
    info.frames_per_second = fps;
    const std::size_t count = frames->frames();
    std::size_t bytes = frames->bytes();
    std::unique_ptr<Recording> recording = std::move(frames);
    if (!tile.empty()) {
        const Size size = parse_tile_size(tile);
        recording = std::make_unique<TiledRecording>(std::move(recording), size);
        info.calibration.depth = tiled(info.calibration.depth, size);
        info.calibration.color = tiled(info.calibration.color, size);
        bytes = count * size.area() * (sizeof(std::uint16_t) + sizeof(Rgb));
    }
    if (playback.preload.value_or(bytes <= usual_preload_bytes))
        recording = std::make_unique<MemoryRecording>(*recording, count, progress);
    return make_recorded_camera(std::move(info), std::move(recording), playback);
}

}  // namespace theatron::capture
