// SPDX-License-Identifier: Apache-2.0
// Watches in the background whether the host's cameras stay where they were registered
// (registration/rig_watch.h), on a thread of low priority.
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
#include "capture/camera.h"
#include "registration/rig_watch.h"
#include "wire/text.h"

namespace theatron::host {

class PlaceWatch {
public:
    // The problem of a camera that raised the alarm, again when its size has doubled or halved;
    // empty: it is over. From the thread of the watch.
    using Alarm = std::function<void(CameraId camera, const wire::Text& problem)>;

    // Screens and cameras without a known place are not watched.
    PlaceWatch(const std::vector<capture::CameraInfo>& cameras, Alarm alarm);
    ~PlaceWatch();

    // From any thread, for each frame as it was captured; returns at once.
    void offer(std::size_t camera, const FramePtr& frame);

    // From any thread: somebody has corrected the camera's place.
    void correct_place(std::size_t camera, const Pose& room_from_camera);
    // From any thread: somebody has said that the camera is where it should be. If it has the alarm
    // of a motion, that ends, and it is compared with what it sees from now on.
    void accept_place(std::size_t camera);

    struct Figures {
        struct Camera {
            bool has_place = false;   // is known, of a camera that can be watched
            bool is_watched = false;  // enough of its picture stands still, or it has the alarm
            bool is_alarm = false;
            bool is_covered = false;              // so that it cannot be compared
            bool is_far = false;                  // moved_mm is the least that it moved
            double moved_mm = 0, turned_deg = 0;  // since the host began
            wire::Text problem;                   // as in Alarm
        };
        std::vector<Camera> cameras;  // all of the host's
        struct Pair {
            std::size_t a = 0, b = 0;
            double apart_mm = 0;
            bool is_alarm = false;
        };
        std::vector<Pair> pairs;  // that share a view
    };
    Figures figures() const;

private:
    void run();
    void look_at(std::size_t camera, const Frame& frame);
    void tell();
    wire::Text problem(std::size_t number) const;
    double size_m(std::size_t number) const;
    std::optional<std::size_t> number_of(std::size_t camera) const;

    const std::vector<capture::CameraInfo> cameras_;
    const Alarm alarm_;
    std::vector<std::size_t> watched_;  // the host's cameras, by the watch's numbers
    registration::RigWatch watch_;      // the thread's only
    struct Told {
        wire::Text problem;
        double size_m = 0;
        int images_of_another = 0;  // size, in a row
    };
    std::vector<Told> told_;     // the thread's only; by the watch's numbers
    std::vector<int> renewals_;  // the thread's only; that the log has
    mutable std::mutex mutex_;   // guards all below
    std::condition_variable changed_;
    std::map<std::size_t, FramePtr> waiting_;  // by the watch's numbers
    std::map<std::size_t, Pose> corrected_;    // by the watch's numbers
    std::set<std::size_t> accepted_;           // the watch's numbers
    std::vector<TimePoint> taken_;             // captured times of frames taken last
    Figures figures_;
    bool stopping_ = false;
    std::thread thread_;
};

}  // namespace theatron::host
