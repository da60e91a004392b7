// SPDX-License-Identifier: Apache-2.0
// Exports into folders: PLY points, and the pictures of folder:DIR.
#include <algorithm>
#include <cstdio>
#include <deque>
#include <map>
#include <optional>

#include "base/error.h"
#include "base/utc.h"
#include "capture/folder_calibration.h"
#include "export/colored_points.h"
#include "export/export_formats.h"
#include "export/export_places.h"
#include "files/file_bytes.h"
#include "files/png_file.h"
#include "filter/undistort.h"
#include "geometry/ply.h"
#include "video/jpeg_native.h"

namespace theatron::exporting {
namespace {

namespace fs = std::filesystem;

std::string numbered(std::size_t number, const char* ending) {
    char text[32];
    std::snprintf(text, sizeof(text), "%05zu%s", number, ending);
    return text;
}

fs::path make_folder(const fs::path& folder) {
    std::error_code problem;
    fs::create_directories(folder, problem);
    if (problem)
        throw Error("Cannot make the folder '" + folder.string() + "': " + problem.message() + ".");
    return folder;
}

// The folder of a camera; the export folder itself if there is only one camera.
fs::path folder_of(const ExportSource& source, const fs::path& folder, std::size_t camera) {
    return source.one_camera ? folder
                             : folder / ("camera-" + std::to_string(source.numbers[camera]));
}

// One camera's pictures without the distortion of its lenses.
class Straightener {
public:
    explicit Straightener(const Calibration& calibration)
        : straight_(without_distortion(calibration)),
          depth_lens_(calibration.depth, straight_.depth),
          color_lens_(calibration.color, straight_.color),
          depth_(calibration.depth.size),
          color_(calibration.color.size) {}

    const Calibration& calibration() const { return straight_; }

    // Valid until the next call.
    DepthView depth(const Frame& frame) {
        depth_lens_.apply(frame.depth.view(), depth_.view());
        return std::as_const(depth_).view();
    }
    // Empty if it cannot be decoded.
    std::optional<ColorView> color(const Frame& frame) {
        if (frame.color.is_jpeg() && jpeg_.decompress(frame.color.jpeg, decoded_) != Status::ok)
            return std::nullopt;
        const ColorImage& from = frame.color.is_jpeg() ? decoded_ : frame.color.pixels;
        if (from.size != color_.size)
            return std::nullopt;
        color_lens_.apply(from.view(), color_.view());
        return std::as_const(color_).view();
    }

private:
    static Calibration without_distortion(Calibration calibration) {
        calibration.depth = filter::without_distortion(calibration.depth);
        calibration.color = filter::without_distortion(calibration.color);
        return calibration;
    }

    Calibration straight_;
    filter::Undistortion depth_lens_, color_lens_;
    video::JpegDecompressor jpeg_;
    DepthImage depth_;
    ColorImage color_, decoded_;
};

class ProgressOfAll {
public:
    explicit ProgressOfAll(const ExportSource& source) : report_(source.progress) {
        for (const auto& camera : source.cameras)
            frames_ += camera->frames();
    }
    void frame_done() {
        ++done_;
        if (report_)
            report_("exporting", double(done_) / double(frames_));
    }

private:
    const capture::Progress& report_;
    std::size_t frames_ = 0, done_ = 0;
};

// As in the files that a window saves. Empty: not known.
std::string captured_text(UtcTime time) {
    return time == UtcTime{} ? "" : "captured " + utc_text(time);
}

// times.csv of a folder.
class FrameTimes {
public:
    void add(Duration time, UtcTime captured) {
        char seconds[32];
        std::snprintf(seconds, sizeof(seconds), "%.6f", to_seconds(time));
        text_ += std::to_string(frames_++) + "," + seconds + "," +
                 (captured == UtcTime{} ? "" : utc_text(captured)) + "\n";
    }
    void save(const fs::path& folder) const {
        files::write_file(folder / times_name, as_bytes(text_));
    }

private:
    std::size_t frames_ = 0;
    std::string text_ = "frame,seconds,captured\n";
};

// Its points are not in the room: they move with the person.
bool sees_a_person(const capture::RecordedFrames& camera) {
    return camera.info().calibration.person != 0;
}

// One file for each moment, with all cameras of the room that have a frame of it.
std::size_t export_merged_ply(ExportSource& source, const fs::path& folder) {
    std::erase_if(source.cameras, [](const auto& camera) { return sees_a_person(*camera); });
    std::deque<PointMaker> makers;  // they stay where they are
    for (const auto& camera : source.cameras)
        makers.emplace_back(camera->info().calibration, source.undecoded_color);
    make_folder(folder);
    ProgressOfAll progress(source);
    Frame frame;
    std::vector<ColoredPoint> points;
    FrameTimes times;
    for (std::size_t written = 0, seen = 0;; ++seen) {
        std::map<std::size_t, TimePoint> moments;  // of each camera's upcoming frame
        Duration time = Duration::max();
        for (std::size_t i = 0; i < source.cameras.size(); ++i)
            if (const auto next = source.next(i)) {
                moments[i] = source.cameras[i]->upcoming().moment;
                time = std::min(time, *next);
            }
        if (moments.empty()) {
            times.save(folder);
            return written;
        }
        const bool is_selected = seen % source.selection.every == 0;
        TimePoint moment = moments.begin()->second;
        for (const auto& [camera, other] : moments)
            moment = std::min(moment, other);
        points.clear();
        UtcTime captured{};  // the first of them
        for (const auto& [camera, other] : moments) {
            if (other != moment)
                continue;
            progress.frame_done();
            if (!is_selected) {
                source.cameras[camera]->skip();
                continue;
            }
            const std::size_t first = points.size();
            const UtcTime utc = source.cameras[camera]->upcoming_utc();
            captured = captured == UtcTime{} ? utc : std::min(captured, utc);
            source.cameras[camera]->read(frame);
            makers[camera].append(frame, points);
            transform_points(makers[camera].calibration().room_from_camera,
                             std::span(points).subspan(first));
        }
        if (!is_selected)
            continue;
        const std::string comments[] = {points_in_room, captured_text(captured)};
        files::write_file(folder / numbered(written++, ".ply"), encode_ply(points, comments));
        times.add(time, captured);
    }
}

}  // namespace

std::optional<Duration> ExportSource::next(std::size_t camera) {
    capture::RecordedFrames& frames = *cameras[camera];
    auto time = frames.offset();
    for (; time && *time < selection.from; time = frames.offset())
        frames.skip();
    return time && *time < selection.to ? time : std::nullopt;
}

std::optional<Duration> ExportSource::next_selected(std::size_t camera, std::size_t& seen) {
    auto time = next(camera);
    for (; time && seen++ % selection.every != 0; time = next(camera))
        cameras[camera]->skip();
    return time;
}

std::size_t export_ply(ExportSource& source, const fs::path& folder, bool merged) {
    if (merged)
        return export_merged_ply(source, folder);
    ProgressOfAll progress(source);
    Frame frame;
    std::vector<ColoredPoint> points;
    std::size_t files = 0;
    for (std::size_t i = 0; i < source.cameras.size(); ++i) {
        capture::RecordedFrames& camera = *source.cameras[i];
        const fs::path own = make_folder(folder_of(source, folder, i));
        PointMaker maker(camera.info().calibration, source.undecoded_color);
        FrameTimes times;
        std::size_t seen = 0;
        for (std::size_t n = 0; const auto time = source.next_selected(i, seen); ++n, ++files) {
            const UtcTime captured = camera.upcoming_utc();
            times.add(*time, captured);
            const std::string comments[] = {points_in_camera, captured_text(captured)};
            camera.read(frame);
            points.clear();
            maker.append(frame, points);
            files::write_file(own / numbered(n, ".ply"), encode_ply(points, comments));
            progress.frame_done();
        }
        times.save(own);
    }
    return files;
}

std::size_t export_png(ExportSource& source, const fs::path& folder, Pictures pictures) {
    ProgressOfAll progress(source);
    Frame frame;
    std::size_t frames = 0;
    for (std::size_t i = 0; i < source.cameras.size(); ++i) {
        capture::RecordedFrames& camera = *source.cameras[i];
        const fs::path own = folder_of(source, folder, i);
        const fs::path depth = make_folder(own / "depth");
        const Calibration& calibration = camera.info().calibration;
        const bool has_color = calibration.color.size != Size{};
        const fs::path color = has_color ? make_folder(own / "color") : fs::path();
        std::optional<Straightener> straight;
        std::optional<ColorOfDepth> registered;
        Calibration written = calibration;
        if (pictures == Pictures::undistorted) {
            straight.emplace(calibration);
            written = straight->calibration();
        } else if (pictures == Pictures::registered && has_color) {
            registered.emplace(calibration, source.undecoded_color);
            written.color = calibration.depth;
            written.color_from_depth = {};
        }
        files::write_file(own / "calibration.json",
                          as_bytes(capture::write_folder_calibration(written)));
        FrameTimes times;
        std::size_t seen = 0;
        for (std::size_t n = 0; const auto time = source.next_selected(i, seen); ++n, ++frames) {
            times.add(*time, camera.upcoming_utc());
            camera.read(frame);
            files::write_png(depth / numbered(n, ".png"),
                             straight ? straight->depth(frame) : frame.depth.view());
            if (registered) {
                if (registered->apply(frame))
                    files::write_png(color / numbered(n, ".png"), registered->color());
            } else if (straight && !frame.color.empty()) {
                if (const auto picture = straight->color(frame))
                    files::write_png(color / numbered(n, ".png"), *picture);
                else
                    ++source.undecoded_color;
            } else if (frame.color.is_jpeg())
                files::write_file(color / numbered(n, ".jpg"), frame.color.jpeg);
            else if (!frame.color.empty())
                files::write_png(color / numbered(n, ".png"), frame.color.pixels.view());
            progress.frame_done();
        }
        times.save(own);
    }
    return frames;
}

}  // namespace theatron::exporting
