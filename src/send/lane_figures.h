// SPDX-License-Identifier: Apache-2.0
// Counters and times of a camera's lane since its start, for status lines and monitoring.
#pragma once

#include <array>
#include <mutex>
#include <string>
#include <vector>

#include "base/ids.h"
#include "base/statistics.h"
#include "capture/watched_camera.h"

namespace theatron::send {

enum class Stage : std::uint8_t {
    capture,       // from exposure to hand-over by the driver
    queue,         // waiting for the work to begin
    filter,        // where there is a filter
    depth_encode,  // all settings together
    color_encode,
    lane,  // from hand-over to the last message of the frame
};
inline constexpr int stage_count = 6;
const char* text_of(Stage stage);

// The reason why a frame of the camera was not encoded.
enum class DropReason : std::uint8_t {
    newer,      // a newer one came before the work on it began
    moment,     // the second of one moment
    repeated,   // equal to the frame before
    time_jump,  // with an impossible time
};
inline constexpr int drop_reasons = 4;
const char* text_of(DropReason reason);

// How one setting is encoded.
struct EncoderFigures {
    StreamId stream{};
    SettingId setting{};
    std::string codec;
    double cpu_ms = 0;           // of a picture
    bool behind = false;         // not at once with each frame: see send/lane_encoders.h
    std::uint64_t left_out = 0;  // pictures that came while it was busy
};

struct LaneFigures {
    std::string name;
    double frames_per_second = 0;
    std::uint64_t frames = 0;          // good ones from the camera
    std::uint64_t dropped_newest = 0;  // DropReason::newer, which means that the work is too slow
    std::array<std::uint64_t, drop_reasons> dropped{};
    std::uint64_t damaged_colors = 0;
    std::uint64_t bytes = 0, depth_bytes = 0, color_bytes = 0;  // encoded, all settings together
    struct StageFigures {
        std::string name;
        double p50_ms = 0, p99_ms = 0;  // of the last minute
        Histogram seconds;
    };
    std::vector<StageFigures> stages;
    double age_seconds = 0;          // since the newest frame was captured
    double sync_offset_seconds = 0;  // of the newest frame to its moment
    capture::WatchedCamera::Status camera;
    std::string filter;         // which ran, empty: none
    std::string filter_device;  // "cpu" or the GPU's name; empty before the first filtered frame
    std::vector<EncoderFigures> encoders;
};

// Gathers them. Thread safe.
class LaneMeter {
public:
    LaneMeter();

    void on_frame(TimePoint now, TimePoint captured, TimePoint delivered, Duration sync_offset);
    void on_drop(DropReason reason);
    void on_damaged_color();
    void on_stage(Stage stage, Duration took);
    void on_bytes(bool depth, std::size_t bytes);
    void on_filter(const std::string& spelling);
    void on_filter_device(const std::string& device);
    std::string filter() const;
    std::string filter_device() const;
    std::uint64_t dropped(DropReason reason) const;

    // Fills in all but name, camera and encoders.
    LaneFigures figures(TimePoint now) const;

private:
    static constexpr std::size_t kept_samples = 1800;

    mutable std::mutex mutex_;
    mutable RateWindow rate_;
    LaneFigures counts_;
    TimePoint newest_captured_;
    std::vector<SampleWindow> recent_;
    std::vector<Histogram> histograms_;
};

}  // namespace theatron::send
