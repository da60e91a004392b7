// SPDX-License-Identifier: Apache-2.0
// The source of a recording: a joined session, or cameras of this machine.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/steady_clock.h"
#include "record/intake.h"

namespace theatron::record {

class RecordSource {
public:
    virtual ~RecordSource() = default;

    // Does the work between frames; call it often. Throws Error if there will be
    // no recording. From one thread.
    virtual void tick() = 0;
    virtual Intake& intake() = 0;
    virtual Intake::Now now() const = 0;

    // Nothing more will come.
    struct End {
        std::string remark;        // why, if that is of interest
        std::optional<Lack> lack;  // more was to be expected
    };
    virtual std::optional<End> ended() = 0;

    // Pictures can come now: the connection stands.
    virtual bool is_connected() const { return true; }
    // Nothing has come from the host for some time, not even an answer, although it is connected.
    virtual bool is_silent() const { return false; }

    // Frames that a camera gave but that were never encoded.
    virtual std::uint64_t not_encoded(CameraId camera) const = 0;
    // Pictures that were lost in the recording that a camera plays.
    virtual std::uint64_t lost_in_source(CameraId camera) const = 0;
    // Names of cameras that may not be recorded, in the order of their coming.
    virtual std::vector<std::string> not_agreed() const { return {}; }
    // Names of people who were there and had not agreed that their voices are recorded.
    virtual std::vector<std::string> voices_not_agreed() const { return {}; }
    // A camera was gone for a while.
    virtual bool was_gone(CameraId camera) const = 0;
    // No more frames from now on.
    virtual void stop() = 0;
};

struct RecordCodecs {
    std::string depth, color;  // checked, in their one spelling
};

}  // namespace theatron::record
