// SPDX-License-Identifier: Apache-2.0
// The common interface of all cameras: synthetic, recorded, remote or live.
//
// A camera is opened from its specification, for example "folder:DIR,fps=30". Opening may
// throw Error; after that nothing throws, and next() returns problems.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/time.h"
#include "geometry/calibration.h"
#include "image/frame.h"
#include "image/frame_pool.h"

namespace theatron::capture {

class Transport;

struct CameraInfo {
    std::string name;  // short, for display: "table-person_640x360"
    Calibration calibration;
    double frames_per_second = 30;
    // True for a device: noise makes all pictures different, and a failed device may come
    // back. False for recordings.
    bool live = false;
};

// The result of next().
struct Capture {
    enum class Kind {
        frame,    // `frame` is the next one
        nothing,  // no frame came within the timeout; call again
        end,      // the recording is over; no more frames will come
        failed,   // the camera is gone or its data is damaged; `problem` says so
    };
    Kind kind = Kind::nothing;
    FramePtr frame;
    std::string problem;  // one sentence for the user; with an end: what is missing there
    // With an end: the recording may be played again, and more frames come then.
    bool may_go_on = false;
};

// One camera. One thread at a time.
class Camera {
public:
    virtual ~Camera() = default;

    virtual const CameraInfo& info() const = 0;

    // Waits at most `timeout` for the next frame and returns it, with times.captured and
    // times.delivered set in steady_now()'s clock. Recorded and generated cameras return each
    // frame when it is due, and skip frames that are more than one period late. While its recording
    // is paused, a camera sees a still scene. After failed, and after an end for good, all calls
    // return the same.
    virtual Capture next(Duration timeout) = 0;

    // Before the first next(): a recording is played as `transport` says. Other cameras ignore it.
    virtual void follow(std::shared_ptr<Transport> transport) { (void)transport; }

    // Before the first next(): each picture is delivered from now on, however late, instead of
    // being skipped. False: this camera cannot wait, as no device can.
    virtual bool skip_none() { return false; }

    // Pictures, depth and colour counted each, that its recording had and that are not delivered:
    // they are damaged, refer to damaged ones, or are not in their place, as far as it was played.
    // In further rounds they count no more.
    virtual std::uint64_t lost_pictures() const { return 0; }
};

// Reports the progress of long preparations: the current activity, and its share done (0 to 1).
using Progress = std::function<void(std::string_view what, double done)>;

// Opens a camera from its specification. Throws Error with one clear sentence for an unknown
// kind, a wrong option, or missing or damaged data.
std::unique_ptr<Camera> open_camera(std::string_view specification, const Progress& progress = {});

// The kinds of camera with their options, one line each, for help texts.
std::vector<std::string> camera_kinds();

}  // namespace theatron::capture
