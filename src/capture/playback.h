// SPDX-License-Identifier: Apache-2.0
// How a recording becomes a camera: when each frame is due, and which are
// skipped because they came too late. The time is passed in.
#pragma once

#include <optional>

#include "base/options.h"
#include "base/time.h"
#include "capture/camera.h"
#include "image/frame.h"

namespace theatron::capture {

// The frames of a recording in order. Functions throw Error, with one sentence,
// where the recording is damaged.
class Recording {
public:
    virtual ~Recording() = default;

    // When the upcoming frame was taken, counted from the recording's first
    // frame and never falling. Nothing at the end.
    virtual std::optional<Duration> offset() = 0;
    // Passes over the upcoming frame, cheaply where that is possible.
    virtual void skip() = 0;
    // Reads the upcoming frame's images into `out`, whose old content is stale.
    virtual void read(Frame& out) = 0;
    // The same without a copy, where the recording holds the frame and nobody else uses
    // it: its times may be set. Null: read() it.
    virtual std::shared_ptr<Frame> share() { return nullptr; }
    virtual void rewind() = 0;
    // How long a round takes when it loops, so that cameras of one recording stay in step. Nothing:
    // until one period after the last frame.
    virtual std::optional<Duration> round() const { return std::nullopt; }
};

// The keys that all recorded cameras understand.
struct PlaybackOptions {
    bool loop = false;                 // from the end back to the beginning
    int start = 0;                     // frames to pass over at the beginning
    std::optional<bool> preload = {};  // read everything at opening; not given: if it is small
};
PlaybackOptions take_playback_options(Options& options);

class Playback {
public:
    // `period`: the usual time from one frame to the next.
    Playback(Recording& recording, Duration period, bool loop, int start)
        : recording_(recording), period_(period), loop_(loop), to_pass_over_(start) {}

    struct Upcoming {
        FrameNumber number = 0;  // counts skipped frames too
        TimePoint due;
    };

    // The next frame to deliver, after passing over those more than one period
    // late at `now`. The first call is the beginning. Nothing at the end.
    std::optional<Upcoming> upcoming(TimePoint now);

    // Reads the upcoming frame's images. Only after upcoming() named one.
    void read(Frame& out);
    // The upcoming frame without a copy, or null (Recording::share).
    std::shared_ptr<Frame> share();

private:
    bool rewind();

    Recording& recording_;
    Duration period_;
    bool loop_;
    int to_pass_over_;
    FrameNumber number_ = 0;
    bool begun_ = false;
    TimePoint zero_;          // when a frame of offset 0 is due in this round
    Duration last_offset_{};  // of the frame before
};

// A recording held in memory.
class MemoryRecording final : public Recording {
public:
    // Reads all of `source`.
    MemoryRecording(Recording& source, std::size_t expected_frames, const Progress& progress);

    std::size_t frames() const { return frames_.size(); }

    std::optional<Duration> offset() override;
    void skip() override { ++next_; }
    void read(Frame& out) override;
    std::shared_ptr<Frame> share() override;
    void rewind() override { next_ = 0; }
    std::optional<Duration> round() const override { return round_; }

private:
    struct Kept {
        Duration offset;
        std::shared_ptr<Frame> frame;
    };
    std::vector<Kept> frames_;
    std::size_t next_ = 0;
    std::optional<Duration> round_;
};

// A camera that plays a recording in real time.
std::unique_ptr<Camera> make_recorded_camera(CameraInfo info, std::unique_ptr<Recording> recording,
                                             const PlaybackOptions& options);

}  // namespace theatron::capture
