// SPDX-License-Identifier: Apache-2.0
#include "capture/playback.h"

#include <algorithm>
#include <atomic>

#include "base/error.h"
#include "capture/transport.h"

namespace theatron::capture {
namespace {

class RecordedCamera final : public Camera {
public:
    RecordedCamera(CameraInfo info, std::unique_ptr<Recording> recording,
                   const PlaybackOptions& options, Clock clock)
        : info_(std::move(info)),
          clock_(std::move(clock)),
          recording_(std::move(recording)),
          playback_(*recording_, seconds_to_duration(1 / info_.frames_per_second), options.loop,
                    options.start) {}

    const CameraInfo& info() const override { return info_; }
    std::uint64_t lost_pictures() const override { return recording_->lost_pictures(); }

    void follow(std::shared_ptr<Transport> transport) override {
        transport_ = std::move(transport);
    }

    bool skip_none() override {
        playback_.skip_none();
        return true;
    }

    Capture next(Duration timeout) override {
        if (over_)
            return *over_;
        try {
            if (transport_)
                timeout = std::min(timeout, longest_deaf);
            const Transport::State state = transport_ ? obey() : Transport::State();
            if (state.paused)
                return still(timeout);
            if (!waiting_ && !prepare())
                return transport_ ? rest(timeout)
                                  : finish({.kind = Capture::Kind::end,
                                            .problem = recording_->problem_at_end()});
        } catch (const std::exception& problem) {
            return finish({.kind = Capture::Kind::failed, .problem = problem.what()});
        }
        const TimePoint now = clock_.now();
        if (waiting_->times.captured > now + timeout) {
            clock_.sleep(timeout);
            return {};
        }
        clock_.sleep(waiting_->times.captured - now);
        return deliver(std::move(waiting_));
    }

private:
    // A camera that waits notices a change of the transport after this time.
    static constexpr Duration longest_deaf = std::chrono::milliseconds(30);
    // Pictures of a paused recording follow each other at this share of its rate: often enough for
    // a camera that is not stale (capture/camera_care.h).
    static constexpr int still_periods = 2;

    Capture deliver(std::shared_ptr<Frame> frame) {
        frame->times.delivered = clock_.now();
        newest_ = frame->times.captured;
        if (transport_)
            shown_ = frame;
        return {.kind = Capture::Kind::frame, .frame = std::move(frame)};
    }

    // Goes to another place of the recording where the transport has.
    Transport::State obey() {
        const TimePoint now = clock_.now();
        const Transport::State state = transport_->state(now);
        if (obeyed_ == state.changes)
            return state;
        obeyed_ = state.changes;
        recording_->go_to(state.position);
        playback_.set_zero(now - state.position);
        waiting_.reset();
        has_still_ = false;
        return state;
    }

    // A paused recording: its picture again and again, as a camera sees what stands still.
    Capture still(Duration timeout) {
        const TimePoint now = clock_.now();
        if (has_still_ && now < next_still_) {
            clock_.sleep(std::min(timeout, Duration(next_still_ - now)));
            return {};
        }
        auto frame = pool_.take();
        if (has_still_ && shown_) {
            frame->depth = shown_->depth;
            frame->color = shown_->color;
        } else if (!recording_->offset()) {
            return rest(timeout);
        } else if (!recording_->read(*frame)) {
            return {};
        }
        frame->number = playback_.take_number();
        frame->times = {.captured = now};
        has_still_ = true;
        next_still_ = now + still_periods * seconds_to_duration(1 / info_.frames_per_second);
        return deliver(std::move(frame));
    }

    Capture rest(Duration timeout) {
        clock_.sleep(timeout);
        return {.kind = Capture::Kind::end, .may_go_on = true};
    }

    // Reads the next frame before it is due.
    bool prepare() {
        while (!waiting_)
            if (!read_next())
                return false;
        return true;
    }

    // False at the end. A frame that is damaged does not become waiting_.
    bool read_next() {
        auto upcoming = playback_.upcoming(clock_.now());
        // Where a pause ends, its still picture is newer.
        while (upcoming && transport_ && upcoming->due <= newest_) {
            recording_->skip();
            upcoming = playback_.upcoming(clock_.now());
        }
        if (!upcoming)
            return false;
        auto frame = playback_.share();
        if (!frame) {
            frame = pool_.take();
            if (!playback_.read(*frame))
                return true;
        }
        frame->number = upcoming->number;
        frame->times = {.captured = upcoming->due};
        waiting_ = std::move(frame);
        return true;
    }

    Capture finish(Capture how) {
        over_ = std::move(how);
        return *over_;
    }

    CameraInfo info_;
    const Clock clock_;
    std::unique_ptr<Recording> recording_;
    Playback playback_;
    FramePool pool_;
    std::shared_ptr<Frame> waiting_;
    std::optional<Capture> over_;
    std::shared_ptr<Transport> transport_;
    std::uint64_t obeyed_ = 0;
    std::shared_ptr<const Frame> shown_;  // the last one, if there is a transport
    bool has_still_ = false;              // a picture of this pause was shown
    TimePoint next_still_, newest_;
};

}  // namespace

PlaybackOptions take_playback_options(Options& options) {
    PlaybackOptions playback;
    playback.loop = options.take_flag("loop");
    playback.start = options.take_int("start", 0, 0, 1'000'000);
    constexpr int not_given = -1;
    if (const int preload = options.take_int("preload", not_given, 0, 1); preload != not_given)
        playback.preload = preload == 1;
    return playback;
}

std::optional<Playback::Upcoming> Playback::upcoming(TimePoint now) {
    while (true) {
        const std::optional<Duration> offset = recording_.offset();
        if (!offset) {
            if (!rewind())
                return std::nullopt;
            continue;
        }
        if (to_pass_over_ > 0) {
            --to_pass_over_;
            recording_.skip();
            continue;
        }
        if (!begun_) {
            begun_ = true;
            zero_ = now - *offset;
        }
        last_offset_ = *offset;
        // Times of damaged files may stand still; two frames of one time would be the same one.
        TimePoint due = zero_ + *offset;
        if (last_due_)
            due = std::max(due, *last_due_ + Duration(1));
        if (!skips_ || now - due <= period_)
            return Upcoming{number_, due};
        recording_.skip();
        ++number_;
    }
}

void Playback::set_zero(TimePoint zero) {
    begun_ = true;
    zero_ = zero;
    to_pass_over_ = 0;
    last_due_.reset();
}

bool Playback::read(Frame& out) {
    note_played();
    return recording_.read(out);
}

std::shared_ptr<Frame> Playback::share() {
    auto frame = recording_.share();
    if (frame)
        note_played();
    return frame;
}

void Playback::note_played() {
    ++number_;
    const TimePoint due = zero_ + last_offset_;
    last_due_ = last_due_ ? std::max(due, *last_due_ + Duration(1)) : due;
}

bool Playback::rewind() {
    if (!loop_)
        return false;
    recording_.rewind();
    zero_ += recording_.round().value_or(last_offset_ + period_);
    return recording_.offset().has_value();
}

void Recording::go_to(Duration position) {
    rewind();
    while (true) {
        const auto here = offset();
        if (!here || *here >= position)
            return;
        skip();
    }
}

MemoryRecording::MemoryRecording(Recording& source, std::size_t expected_frames,
                                 const Progress& progress) {
    // Limited, because the expected number may come from a damaged file.
    frames_.reserve(std::min<std::size_t>(expected_frames, 1 << 14));
    while (const std::optional<Duration> offset = source.offset()) {
        Kept kept{*offset, std::make_shared<Frame>()};
        if (source.read(*kept.frame))
            frames_.push_back(std::move(kept));
        if (progress && expected_frames > 0)
            progress("reading frames",
                     std::min(1.0, double(frames_.size()) / double(expected_frames)));
    }
    lost_pictures_ = source.lost_pictures();
    problem_at_end_ = source.problem_at_end();
}

std::optional<Duration> MemoryRecording::offset() {
    if (next_ == frames_.size())
        return std::nullopt;
    return frames_[next_].offset;
}

bool MemoryRecording::read(Frame& out) {
    const Frame& kept = *frames_[next_++].frame;
    // Assignment reuses the memory of `out`.
    out.depth = kept.depth;
    out.color = kept.color;
    return true;
}

std::shared_ptr<Frame> MemoryRecording::share() {
    const std::shared_ptr<Frame>& frame = frames_[next_].frame;
    if (frame.use_count() > 1)
        return nullptr;
    // Orders this thread after the last reads of the frame's previous user.
    std::atomic_thread_fence(std::memory_order_acquire);
    ++next_;
    return frame;
}

void MemoryRecording::go_to(Duration position) {
    const auto after =
        std::upper_bound(frames_.begin(), frames_.end(), position,
                         [](Duration wanted, const Kept& kept) { return wanted < kept.offset; });
    next_ = std::size_t(std::max<std::ptrdiff_t>(after - frames_.begin() - 1, 0));
}

std::unique_ptr<Camera> make_recorded_camera(CameraInfo info, std::unique_ptr<Recording> recording,
                                             const PlaybackOptions& options, Clock clock) {
    return std::make_unique<RecordedCamera>(std::move(info), std::move(recording), options,
                                            std::move(clock));
}

}  // namespace theatron::capture
