// SPDX-License-Identifier: Apache-2.0
// A camera of a host that was missing when the host began: a thread tries to open it until it is
// there, with growing pauses, as one that is unplugged later (capture/camera_care.h).
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "base/time.h"
#include "capture/camera.h"
#include "capture/camera_care.h"

namespace theatron::host {

// True for a camera whose device, stream or window may come at any time, unlike a file.
bool is_live_kind(const std::string& specification);

// True for a camera that a host can begin without: all but the recording that it plays, and
// generated ones.
bool may_come_later(const std::string& specification);

// The name that the camera will have where its specification says it, else the specification
// without secrets.
std::string expected_name(const std::string& specification);

class MissingCamera {
public:
    // May throw Error.
    using Open = std::function<std::unique_ptr<capture::Camera>()>;
    // From the thread, once: the camera is there.
    using Found = std::function<void(std::unique_ptr<capture::Camera>)>;
    struct Pauses {
        Duration first = capture::CameraCare::first_wait;
        Duration longest = capture::CameraCare::longest_wait;
    };

    // `problem`: why it could not be opened until now. All that `open` uses must live as long as it
    // runs, which may be longer than this object where a driver hangs.
    MissingCamera(std::string problem, Open open, Found found, Pauses pauses);
    MissingCamera(std::string problem, Open open, Found found)
        : MissingCamera(std::move(problem), std::move(open), std::move(found), Pauses()) {}
    // Afterwards `found` is not called any more.
    ~MissingCamera();
    // It ends soon: the destructor then waits less for an `open` that hangs.
    void stop();

    // Why it could not be opened the last time, one sentence, and how often it was tried here.
    struct Figures {
        std::string problem;
        std::uint64_t failed = 0;
    };
    Figures figures() const;  // from any thread

private:
    struct Shared;
    static void run(Shared& shared, const Open& open, Pauses pauses);

    const std::shared_ptr<Shared> shared_;
    TimePoint wait_until_{};  // for `open`, from stop() on
    std::thread thread_;
};

}  // namespace theatron::host
