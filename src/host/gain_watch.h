// SPDX-License-Identifier: Apache-2.0
// Estimates the colour gains of the host's cameras (geometry/color_balance.h) in the background, on
// a thread of low priority, from a few pictures now and then: so each viewer need not, and all see
// the same colours.
#pragma once

#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <thread>
#include <vector>

#include "base/ids.h"
#include "base/steady_clock.h"
#include "capture/camera.h"
#include "geometry/color_balance.h"
#include "host/settled_gains.h"
#include "video/jpeg_native.h"

namespace theatron::host {

class GainWatch {
public:
    // Gains that have settled, or changed visibly and for long, by camera of the host; nullopt: as
    // before. From the thread of the watch.
    using Publish = std::function<void(const SettledGains::Gains& gains)>;

    // Cameras without colour or a known place are left out, and so are screens and cameras that see
    // a person. Those whose calibration has gains keep them. Nothing runs unless another camera is
    // beside one without gains.
    GainWatch(const std::vector<capture::CameraInfo>& cameras, Publish publish,
              std::function<TimePoint()> now = steady_now);
    ~GainWatch();

    // From any thread, for each frame as it was captured; returns at once.
    void offer(std::size_t camera, const FramePtr& frame);

    // From any thread: somebody has corrected the camera's place.
    void correct_place(std::size_t camera, const Pose& room_from_camera);

    // The gains in effect, by camera of the host; nullopt: viewers estimate their own.
    struct Gain {
        Vec3 factors;  // of sRGB values
        bool is_estimated = false;
    };
    using Gains = std::vector<std::optional<Gain>>;
    Gains gains() const;

private:
    void run();
    void look_at(std::size_t camera, const Frame& frame, const Pose& room_from_camera);
    void end_round();
    void estimate();
    void begin_round(TimePoint begin);

    const Publish publish_;
    const std::function<TimePoint()> now_;        // the clock of frames' captured times
    std::map<std::size_t, Calibration> watched_;  // by camera
    // Up to the mutex: the thread's only.
    ColorBalance balance_{1};
    SettledGains settled_;
    video::JpegDecompressor jpeg_;
    ColorImage decoded_;
    std::set<std::size_t> seen_;  // cameras, in this round
    Duration round_cpu_{0};       // of the thread
    int rounds_ = 0;
    mutable std::mutex mutex_;  // guards all below
    std::condition_variable changed_;
    // In a round a frame of each camera is taken, all of about the same moment.
    TimePoint round_begin_;
    std::set<std::size_t> wanted_;  // cameras whose frame has not come yet
    std::map<std::size_t, FramePtr> waiting_;
    std::map<std::size_t, Pose> places_;
    Gains gains_;
    bool stopping_ = false;
    std::thread thread_;
};

}  // namespace theatron::host
