// SPDX-License-Identifier: Apache-2.0
// The frames of a recording, a folder or a camera in order, for a loop over them. No function needs
// Python's lock. One thread at a time.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "base/options.h"
#include "capture/camera.h"
#include "capture/recording_camera.h"
#include "record/recording_file.h"
#include "taken_frame.h"

namespace theatron::python {

class FrameReader {
public:
    virtual ~FrameReader() = default;

    enum class Answer {
        frame,
        nothing,  // none came within a tenth of a second; ask again
        end,      // no further frame comes
    };
    // The next frame. Throws Error with one sentence if the source fails.
    virtual Answer next(TakenFrame& out) = 0;

    // The next frame is the first one that is not before this time. Throws Error if the source
    // cannot be sought in.
    virtual void seek(Duration time) = 0;

    // Pictures that were left out since the beginning, as `inspect --verify` counts them.
    virtual capture::PictureLosses losses() const = 0;

    // One sentence on the part that is missing at the end; empty: nothing is.
    virtual std::string problem_at_end() const { return ""; }
};

// Through all calibrations of a camera, which counts from 0. Throws Error if there is no such
// camera, or if this build cannot decode it. `file` is its name in messages.
std::unique_ptr<FrameReader> read_recording(std::shared_ptr<const record::RecordingFile> recording,
                                            std::size_t camera, const std::string& file);

// As fast as the pictures can be read. Options as for the camera folder:DIR. Throws Error.
std::unique_ptr<FrameReader> read_folder(Options options);

// At the pace of the camera; `every`: without skipping late frames, where the camera can wait.
std::unique_ptr<FrameReader> read_camera(std::unique_ptr<capture::Camera> camera, bool every);

}  // namespace theatron::python
