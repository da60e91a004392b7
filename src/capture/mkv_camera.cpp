// SPDX-License-Identifier: Apache-2.0
#include "capture/mkv_camera.h"

#include <filesystem>

#include "base/error.h"
#include "base/lasting_error.h"
#include "base/log.h"
#include "capture/azure_calibration.h"
#include "capture/folder_calibration.h"
#include "capture/mkv_file.h"
#include "capture/playback.h"
#include "capture/steady_times.h"
#include "capture/time_pairing.h"
#include "video/jpeg_header.h"

namespace theatron::capture {
namespace {

namespace fs = std::filesystem;
using Track = MkvFile::Packet::Track;

constexpr std::uintmax_t usual_preload_bytes = std::uintmax_t(1) << 28;
constexpr double usual_frames_per_second = 30;

class MkvRecording final : public Recording {
public:
    explicit MkvRecording(const fs::path& path)
        : path_(path), file_(path), pairing_(tolerance(), most_colors()) {
        if (!upcoming())
            throw Error("'" + path.string() +
                        (file_.is_cut_off() ? "' is cut off before its first depth picture."
                                            : "' holds no whole depth picture."));
        if (file_.is_cut_off())
            log::warning("capture", "the recording is cut off and plays as far as it goes",
                         {{"file", path.string()}});
    }

    const MkvFile& file() const { return file_; }
    double frames_per_second() const {
        const double fps = file_.frames_per_second();
        return fps >= 0.1 && fps <= 240 ? fps : usual_frames_per_second;
    }

    std::optional<Duration> offset() override {
        if (!upcoming())
            return std::nullopt;
        return due_;
    }

    void skip() override { pair_.reset(); }

    bool read(Frame& out) override {
        const Size size = file_.depth_size();
        out.depth.resize(size);
        const Bytes& depth = pair_->depth.payload;
        for (std::size_t i = 0; i < size.area(); ++i)
            out.depth.pixels[i] = std::uint16_t(std::to_integer<unsigned>(depth[2 * i]) << 8 |
                                                std::to_integer<unsigned>(depth[2 * i + 1]));
        out.color.pixels.pixels.clear();
        out.color.jpeg.clear();
        out.color.size = {};
        if (pair_->color) {
            out.color.jpeg = std::move(pair_->color->payload);
            out.color.size = file_.color_size();
        }
        pair_.reset();
        return true;
    }

    // Reads from the beginning: seeking needs an index, which a truncated recording lacks.
    void rewind() override {
        file_.rewind();
        lost_before_ = lost_pictures();
        damaged_ = 0;
        pairing_ = TimePairing<Bytes>(tolerance(), most_colors());
        pair_.reset();
        times_ = {};
    }

    std::uint64_t lost_pictures() const override {
        const auto& left_out = pairing_.left_out();
        return std::max(lost_before_, damaged_ + left_out.backward + left_out.apart);
    }

    std::string problem_at_end() const override {
        return file_.is_cut_off() ? "The recording '" + path_.string() + "' is cut off." : "";
    }

private:
    Duration tolerance() const { return seconds_to_duration(0.5 / frames_per_second()); }

    // In files that were put together again colour may stand seconds before its depth.
    std::size_t most_colors() const {
        constexpr std::size_t most_bytes = std::size_t(128) << 20, pixels_per_byte = 4;
        const std::size_t usual_bytes = file_.color_size().area() / pixels_per_byte + 1;
        return std::clamp(most_bytes / usual_bytes, TimePairing<Bytes>::usual_max_waiting,
                          10 * TimePairing<Bytes>::usual_max_waiting);
    }

    // Sets pair_ to the next frame; false at the end.
    bool upcoming() {
        while (!pair_) {
            if (take_pair())
                break;
            std::optional<MkvFile::Packet> packet = file_.read();
            if (!packet) {
                pairing_.finish();
                note_left_out();
                const bool is_pair = take_pair();
                if (!is_pair)
                    note_colors_alone();
                return is_pair;
            }
            add(std::move(*packet));
        }
        note_left_out();
        return true;
    }

    bool take_pair() {
        pair_ = pairing_.take();
        if (!pair_)
            return false;
        due_ = times_.due(pair_->depth.time, seconds_to_duration(1 / frames_per_second()));
        if (times_.jumped())
            note(jump_noted_, jump_remark);
        return true;
    }

    void note_left_out() {
        const auto& left_out = pairing_.left_out();
        if (left_out.backward > 0)
            note(backward_noted_,
                 "pictures have earlier times than those before them and are left out");
        if (left_out.apart > 0)
            note(apart_noted_, "colour is too far from its depth in the file and is left out");
    }

    void note_colors_alone() {
        const std::uint64_t alone = pairing_.colors_alone();
        if (alone > 0 && !std::exchange(alone_noted_, true))
            log::warning("capture", "colour pictures have no depth and are left out",
                         {{"file", path_.string()}, {"pictures", alone}});
    }

    void add(MkvFile::Packet packet) {
        if (packet.track == Track::depth) {
            if (packet.bytes.size() == file_.depth_size().area() * sizeof(std::uint16_t))
                pairing_.add_depth({packet.time, std::move(packet.bytes)});
            else
                note_damage(packet.bytes.empty() ? "a part of the recording is damaged and left out"
                                                 : "a depth picture is damaged and left out");
            return;
        }
        const Result<Size> size = video::read_jpeg_size(packet.bytes);
        if (size && *size == file_.color_size())
            pairing_.add_color({packet.time, std::move(packet.bytes)});
        else
            note_damage("a colour picture is damaged and left out");
    }

    void note_damage(std::string_view what) {
        ++damaged_;
        note(damage_noted_, what);
    }

    // Logs once per recording, even if it loops.
    void note(bool& noted, std::string_view what) const {
        if (!std::exchange(noted, true))
            log::warning("capture", what, {{"file", path_.string()}});
    }

    fs::path path_;
    MkvFile file_;
    TimePairing<Bytes> pairing_;
    std::optional<TimePairing<Bytes>::Pair> pair_;
    SteadyTimes times_;
    Duration due_{};
    std::uint64_t damaged_ = 0, lost_before_ = 0;  // in this round, in those before it
    bool damage_noted_ = false, backward_noted_ = false, apart_noted_ = false, jump_noted_ = false,
         alone_noted_ = false;
};

Calibration read_calibration(const fs::path& path, const MkvFile& file) {
    if (!file.other_color().empty())
        log::warning("capture",
                     "colour is not recorded as MJPEG, or in a track that is not called COLOR, and "
                     "is left out",
                     {{"file", path.string()}, {"colour", file.other_color()}});
    if (file.calibration().empty()) {
        log::warning("capture", "the recording has no calibration and a usual lens is assumed",
                     {{"file", path.string()}});
        return default_calibration(file.depth_size(), file.color_size());
    }
    ParsedCalibration parsed =
        parse_azure_calibration(file.calibration(), file.depth_size(), file.color_size());
    if (!parsed.problem.empty())
        throw Error("The calibration in '" + path.string() + "' " + parsed.problem + ".");
    return parsed.calibration;
}

}  // namespace

std::unique_ptr<Camera> open_mkv_camera(Options& options, const Progress& progress) {
    const PlaybackOptions playback = take_playback_options(options);
    options.require_no_problem();
    if (options.value().empty())
        throw LastingError("The camera 'mkv' needs a file, as in mkv:FILE.");

    const fs::path path = options.value();
    auto file = std::make_unique<MkvRecording>(path);
    CameraInfo info;
    info.name = path.stem().string();
    info.calibration = read_calibration(path, file->file());
    info.frames_per_second = file->frames_per_second();

    int frames = 0;
    for (; frames <= playback.start && playback.start > 0 && file->offset(); ++frames)
        file->skip();
    if (frames <= playback.start && playback.start > 0)
        throw Error("'" + path.string() + "' has " + std::to_string(frames) +
                    " frames, so start=" + std::to_string(playback.start) + " is too far.");
    if (frames > 0)
        file->rewind();

    std::unique_ptr<Recording> recording;
    if (playback.preload.value_or(fs::file_size(path) <= usual_preload_bytes)) {
        const std::size_t bytes_per_frame = file->file().depth_size().area() * 2;
        recording = std::make_unique<MemoryRecording>(
            *file, std::size_t(fs::file_size(path)) / bytes_per_frame, progress);
    } else {
        recording = std::move(file);
    }
    return make_recorded_camera(std::move(info), std::move(recording), playback);
}

}  // namespace theatron::capture
