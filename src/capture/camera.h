// SPDX-License-Identifier: Apache-2.0
// The one interface of all cameras: synthetic, recorded, remote or live.
//
// A camera is opened from its specification, for example "folder:DIR,fps=30".
// Opening may throw Error; after that nothing throws, and trouble is an answer.
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

struct CameraInfo {
    std::string name;  // short, for people: "table-person_640x360"
    Calibration calibration;
    double frames_per_second = 30;
    // A device: noise makes every picture differ, and what failed may come back. A
    // recording is neither.
    bool live = false;
};

// What next() answers.
struct Capture {
    enum class Kind {
        frame,    // `frame` is the next one
        nothing,  // none came within the time given; ask again
        end,      // the recording is over; there will be no more
        failed,   // the camera is gone or its data is damaged; `problem` says so
    };
    Kind kind = Kind::nothing;
    FramePtr frame;
    std::string problem;  // one sentence for a person
};

// One camera. Used by one thread at a time.
class Camera {
public:
    virtual ~Camera() = default;

    virtual const CameraInfo& info() const = 0;

    // Waits at most `timeout` for the next frame and hands it over, with
    // times.captured and times.delivered set in steady_now()'s clock. Recorded
    // and generated cameras deliver each frame when it is due, and skip frames
    // that are more than one period late. After end or failed, the same answer
    // comes again.
    virtual Capture next(Duration timeout) = 0;
};

// Told about long preparations: what is being done, and how far (0 to 1).
using Progress = std::function<void(std::string_view what, double done)>;

// Opens a camera from its specification. Throws Error with one clear sentence
// for an unknown kind, a wrong option, or anything missing or damaged.
std::unique_ptr<Camera> open_camera(std::string_view specification, const Progress& progress = {});

// The kinds of camera with their options, one line each, for help texts.
std::vector<std::string> camera_kinds();

}  // namespace theatron::capture
