// SPDX-License-Identifier: Apache-2.0
#include "capture/folder_camera.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "base/error.h"
#include "base/lasting_error.h"
#include "base/log.h"
#include "capture/folder_calibration.h"
#include "capture/folder_files.h"
#include "capture/tiled_recording.h"
#include "files/file_bytes.h"
#include "files/png_file.h"
#include "video/jpeg_file_native.h"
#include "video/jpeg_header.h"

namespace theatron::capture {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t usual_preload_bytes = std::size_t(1) << 30;
constexpr std::size_t max_calibration_bytes = std::size_t(1) << 20;

// Reads a colour picture: JPEG of a kind that cameras give is kept, all else is decoded to pixels.
// Returns an empty text, or what is wrong with it, as the end of a sentence.
std::string decode_color(const Bytes& bytes, ColorData& out) {
    constexpr std::byte png_begins{0x89};
    if (!bytes.empty() && bytes[0] == png_begins) {
        std::string problem = files::decode_png(bytes, out.pixels);
        out.size = out.pixels.size;
        return problem;
    }
    const Result<Size> size = video::read_jpeg_size(bytes);
    if (!size && size.error() == Status::unsupported) {
        if (video::decode_jpeg_file(bytes, out.pixels) != Status::ok)
            return "is a damaged JPEG picture, or one of an unusual kind; save it as baseline JPEG "
                   "or PNG";
        out.size = out.pixels.size;
        return "";
    }
    if (!size)
        return "is not a whole JPEG or PNG picture";
    out.size = *size;
    out.jpeg.assign(bytes.begin(), bytes.end());
    return "";
}

void clear(ColorData& color) {
    color.jpeg.clear();
    color.pixels.pixels.clear();
    color.pixels.size = color.size = {};
}

class FolderRecording final : public Recording {
public:
    // Throws Error if none of the depth pictures can be read, or none of the colour pictures.
    FolderRecording(std::vector<FramePaths> frames, double fps, std::uint16_t invalid)
        : frames_(std::move(frames)), fps_(fps), invalid_(invalid) {
        Frame first;
        require_one(&FramePaths::depth,
                    [&](const fs::path& path) { return read_depth(path, first.depth); });
        depth_size_ = first.depth.size;
        if (std::any_of(frames_.begin(), frames_.end(),
                        [](const FramePaths& paths) { return !paths.color.empty(); }))
            require_one(&FramePaths::color,
                        [&](const fs::path& path) { return read_color(path, first.color); });
        color_size_ = first.color.size;
        bytes_per_frame_ = depth_size_.area() * sizeof(std::uint16_t) + first.color.jpeg.size() +
                           first.color.pixels.pixels.size() * sizeof(Rgb);
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

    bool read(Frame& out) override {
        const FramePaths& paths = frames_[next_++];
        if (const std::string problem = read_depth(paths.depth, out.depth); !problem.empty()) {
            note_damage(paths.depth, problem);
            return false;
        }
        any_read_ = true;
        clear(out.color);
        if (paths.color.empty())
            return true;
        if (const std::string problem = read_color(paths.color, out.color); !problem.empty()) {
            clear(out.color);
            note_damage(paths.color, problem);
        }
        return true;
    }

    void rewind() override {
        if (!any_read_ && next_ == frames_.size() && damaged_ > 0)
            throw Error("None of the depth pictures can be read any more, for example '" +
                        frames_.front().depth.string() + "'.");
        next_ = 0;
        any_read_ = false;
        lost_before_ = lost_pictures();
        damaged_ = 0;
    }

    std::uint64_t lost_pictures() const override { return std::max(lost_before_, damaged_); }

private:
    // Reads the first picture that can be read.
    template <class Read>
    void require_one(fs::path FramePaths::*which, Read read) {
        std::string first_problem;
        for (const FramePaths& paths : frames_) {
            const fs::path& path = paths.*which;
            if (path.empty())
                continue;
            const std::string problem = read(path);
            if (problem.empty())
                return;
            if (first_problem.empty())
                first_problem = "'" + path.string() + "' " + problem + ".";
        }
        throw Error(first_problem);
    }

    // Both return an empty text, or what is wrong with the picture, as the end of a sentence.
    std::string read_depth(const fs::path& path, DepthImage& out) const {
        const std::optional<Bytes> png = read_bytes(path);
        if (!png)
            return unreadable;
        if (std::string problem = files::decode_png(*png, out); !problem.empty())
            return problem;
        if (invalid_ != 0)
            std::replace(out.pixels.begin(), out.pixels.end(), invalid_, std::uint16_t(0));
        return size_problem(out.size, depth_size_);
    }
    std::string read_color(const fs::path& path, ColorData& out) const {
        const std::optional<Bytes> bytes = read_bytes(path);
        if (!bytes)
            return unreadable;
        clear(out);
        if (std::string problem = decode_color(*bytes, out); !problem.empty())
            return problem;
        return size_problem(out.size, color_size_);
    }

    static constexpr const char* unreadable = "cannot be read";
    static std::optional<Bytes> read_bytes(const fs::path& path) {
        try {
            return files::read_file(path);
        } catch (const Error&) {
            return std::nullopt;
        }
    }
    static std::string size_problem(Size found, Size expected) {
        if (found == expected || expected == Size{})
            return "";
        return "is " + to_text(found) + ", but the first picture of its folder is " +
               to_text(expected);
    }

    // Warns once, even in a loop.
    void note_damage(const fs::path& path, const std::string& problem) {
        ++damaged_;
        if (!std::exchange(damage_noted_, true))
            log::warning("capture", "a picture is damaged and left out",
                         {{"file", path.string()}, {"problem", problem}});
    }

    std::vector<FramePaths> frames_;
    double fps_;
    std::uint16_t invalid_;
    Size depth_size_, color_size_;
    std::size_t bytes_per_frame_ = 0;
    std::size_t next_ = 0;
    std::uint64_t damaged_ = 0, lost_before_ = 0;  // in this round, in those before it
    bool any_read_ = false, damage_noted_ = false;
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
                 "the camera's lens is unknown and a usual one is assumed, with depth in "
                 "millimetres; add calibration.json",
                 {{"folder", folder.string()}});
    return default_calibration(depth, color);
}

Size parse_tile_size(const std::string& text) {
    Size size;
    char rest = 0;
    if (std::sscanf(text.c_str(), "%dx%d%c", &size.width, &size.height, &rest) != 2 ||
        !is_valid(size))
        throw LastingError("tile=" + text + " is not WIDTHxHEIGHT, for example tile=640x576.");
    return size;
}

}  // namespace

FolderPictures open_folder_pictures(Options& options) {
    const double fps = options.take_number("fps", 30, 0.1, 240);
    const int invalid = options.take_int("invalid", 0, 0, 65535);
    const std::string tile = options.take("tile");
    options.require_no_problem();
    if (options.value().empty())
        throw LastingError("The camera 'folder' needs a folder, as in folder:DIR.");

    const Size tile_size = tile.empty() ? Size{} : parse_tile_size(tile);
    // Removes a trailing slash, which would leave no name.
    fs::path folder = fs::path(options.value()).lexically_normal();
    if (!folder.has_filename())
        folder = folder.parent_path();
    auto frames =
        std::make_unique<FolderRecording>(folder_frames(folder), fps, std::uint16_t(invalid));

    FolderPictures pictures;
    CameraInfo& info = pictures.info;
    info.name = fs::absolute(folder).filename().string();
    info.calibration = read_calibration(folder, frames->depth_size(), frames->color_size());
    info.frames_per_second = fps;
    pictures.frames = frames->frames();
    pictures.bytes = frames->bytes();
    pictures.recording = std::move(frames);
    if (!tile.empty()) {
        pictures.recording =
            std::make_unique<TiledRecording>(std::move(pictures.recording), tile_size);
        info.calibration.depth = tiled(info.calibration.depth, tile_size);
        info.calibration.color = tiled(info.calibration.color, tile_size);
        pictures.bytes = pictures.frames * tile_size.area() * (sizeof(std::uint16_t) + sizeof(Rgb));
    }
    return pictures;
}

std::unique_ptr<Camera> open_folder_camera(Options& options, const Progress& progress) {
    const PlaybackOptions playback = take_playback_options(options);
    FolderPictures pictures = open_folder_pictures(options);
    if (std::size_t(playback.start) >= pictures.frames)
        throw Error("'" + options.value() + "' has " + std::to_string(pictures.frames) +
                    " frames, so start=" + std::to_string(playback.start) + " is too far.");
    std::unique_ptr<Recording> recording = std::move(pictures.recording);
    if (playback.preload.value_or(pictures.bytes <= usual_preload_bytes))
        recording = std::make_unique<MemoryRecording>(*recording, pictures.frames, progress);
    return make_recorded_camera(std::move(pictures.info), std::move(recording), playback);
}

}  // namespace theatron::capture
