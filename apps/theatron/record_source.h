// SPDX-License-Identifier: Apache-2.0
// What a recording is made of: a session that was joined, or cameras of one's own.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "capture/camera.h"
#include "net/link.h"
#include "record/recorder.h"

namespace theatron::app {

// Read at the same instant as the session's clock, it tells when a recording was made.
inline record::UtcTime utc_now() {
    return std::chrono::floor<std::chrono::microseconds>(std::chrono::system_clock::now());
}

class RecordSource {
public:
    virtual ~RecordSource() = default;

    // Does what is to be done between frames. Throws Error if there will be no
    // recording. From one thread.
    virtual void tick() = 0;
    // Null before the first frames have come.
    virtual record::Recorder* recorder() = 0;
    // True if nothing more will come; `remark` then says why, if that is of interest.
    virtual bool ended(std::string& remark) = 0;
    // Frames that were lost before the recorder got them.
    virtual std::uint64_t lost() const = 0;
    // No more frames from now on.
    virtual void stop() = 0;
};

struct RecordCodecs {
    std::string depth, color;  // checked, in their one spelling
};

// Joins the session and records what comes as it comes.
std::unique_ptr<RecordSource> record_session(const net::Link& link, const std::string& file,
                                             const RecordCodecs& codecs);

// Opens the cameras, waits for all of them, and begins with all at once.
std::unique_ptr<RecordSource> record_cameras(const std::vector<std::string>& specifications,
                                             const std::string& file, const RecordCodecs& codecs,
                                             const capture::Progress& progress);

}  // namespace theatron::app
