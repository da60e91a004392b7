// SPDX-License-Identifier: Apache-2.0
// The processing of one camera on the host: capture, filter, then encode once per setting.
//
// A thread waits for the camera and does nothing else. The work on a frame runs on
// threads that all lanes share: one frame of a lane at a time, its depth and colour in
// parallel if a thread is idle. Between capture and work the newest frame wins, so slow work
// never makes frames older. Lanes are independent: none waits for another.
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "base/ids.h"
#include "base/newest_slot.h"
#include "capture/camera.h"
#include "capture/crop.h"
#include "codec/strata_region.h"
#include "filter/device_chain.h"
#include "send/capture_thread.h"
#include "send/lane_encoders.h"
#include "send/lane_figures.h"
#include "send/shared_moments.h"
#include "send/workers.h"
#include "wire/control.h"

namespace theatron::send {

class CameraLane {
public:
    struct Events {
        // From a working thread; depth and colour may come from two at once.
        std::function<void(EncodedMedia)> media;
        // The camera's condition has changed. From the workers' thread for periodic calls.
        std::function<void(wire::CameraState)> state;
        // Each frame as it was captured. From the camera's thread, which waits for the return.
        std::function<void(const FramePtr&)> frame = [](const FramePtr&) {};
        // Encoding in this setting no longer keeps up with the camera, or does again; it takes
        // `cpu` for a picture. From a working thread.
        std::function<void(SettingId, bool keeps_up, Duration cpu)> keeps_up = [](SettingId, bool,
                                                                                  Duration) {};
    };

    struct Options {
        // Frames that may wait for work: 1 for the lowest age, more for the fewest drops.
        std::size_t waiting_frames = 1;
        // A camera that can wait (Camera::skip_none()) does so while `waiting_frames` wait for
        // work, so that none of its frames is lost. Its lane is held at first.
        bool every_frame = false;
        // Opens a live camera again when it has failed. Empty: nothing does.
        capture::WatchedCamera::Open open_again;
        // Common to cameras whose frames belong together. Null: the lane's own.
        std::shared_ptr<SharedMoments> moments;
        // Drops frames that are the second of their moment.
        bool one_per_moment = false;
        // Cameras that share the workers: it determines a setting's share of their time.
        std::size_t cameras = 1;
        // As in LaneEncoders::Environment; empty: the usual ones.
        std::function<codec::DepthStreamEncoder(const codec::DepthSetting&)> make_depth;
        std::function<std::unique_ptr<video::ColorEncoder>(const video::ColorSetting&)> make_color;
        // The clock of the watched camera, of header times and of waiting for key frames.
        capture::Clock clock = capture::steady_clock();
    };

    // Takes over `camera` and starts at once. `workers` must outlive the lane.
    CameraLane(CameraId id, std::unique_ptr<capture::Camera> camera, Events events,
               Workers& workers, Options options);
    ~CameraLane();

    CameraId id() const { return id_; }
    // None of its camera's frames is lost: Options::every_frame.
    bool waits() const { return waits_; }
    const capture::CameraInfo& info() const { return info_; }

    // All below from any thread.

    // With no settings nothing is filtered or encoded. Each new setting begins with a key frame:
    // the last frame, under its number, at most once in repeat_interval, else the next one. The
    // other settings get nothing of it.
    static constexpr Duration repeat_interval = std::chrono::milliseconds(500);
    void set_settings(std::vector<LaneSetting> depth, std::vector<LaneSetting> color);

    // From the next frame on. `background` may be empty.
    void set_filter(filter::ChainSettings settings,
                    std::shared_ptr<const filter::Background> background);

    // The part of the depth image, in its pixels, that stays exact from the next frame on
    // where a codec's error is bounded; empty: all of it. It must be strata::is_valid.
    void set_region(codec::strata::Region region);

    // Depth outside of this part of the picture is not sent, from the next frame on; empty: all of
    // it is. It must lie in the picture.
    void set_crop(std::optional<capture::Crop> crop);

    // While held, no work on a frame begins: no receiver could take it yet. The newest one waits.
    void hold(bool held);

    // Frames that the camera gives from now on are not taken; those that it gave are encoded.
    void close();
    // Waits until the frames that were taken are encoded in all settings that keep up. Returns the
    // number of those that are not after this time.
    std::size_t wait_until_encoded(Duration patience);

    // The next frame becomes a key frame. If none comes within 100 ms and two periods of the
    // camera, the last one is sent again in all settings, under a new number, at most once in
    // repeat_interval: streams of one camera count their frames together.
    void request_key(StreamId stream, SettingId setting);

    LaneFigures figures() const;
    // Figures that are cheap to read.
    std::vector<EncoderFigures> encoder_figures() const { return encoders_.figures(); }
    std::uint64_t dropped_newest() const { return meter_.dropped(DropReason::newer); }

    // Returns once no work on frames runs or is due, also on background threads.
    void wait_idle();

private:
    struct Captured {
        FramePtr frame;
        TimePoint moment;
    };
    struct Orders {
        std::vector<LaneSetting> depth_settings, color_settings;
        codec::strata::Region region;
        bool settings_changed = false;  // or the region
        filter::ChainSettings filter;
        std::shared_ptr<const filter::Background> background;
        std::optional<capture::Crop> crop;
        bool filter_changed = false;  // or the crop
        WantedKeys keys;
    };

    // Without a frame for this time a camera stands: it is stale, or has ended.
    Duration key_patience() const;

    // Encoding that takes longer than this, by the clock, is worth waking another thread for.
    static constexpr Duration worth_a_thread = 200us;

    void on_frame(FramePtr frame);
    void look();
    TimePoint now() const { return options_.clock.now(); }
    LaneEncoders::Events encoder_events();
    LaneEncoders::Environment encoder_environment() const;
    void begin_work();
    void work();
    // True if a frame is now in `picture_`, to be encoded.
    bool prepare(std::optional<Captured> next);
    std::optional<LaneEncoders::For> repeats(TimePoint begin);
    void take_orders();
    void filter_frame();
    void prepare_frame(TimePoint begin, LaneEncoders::For meant);
    void encode_frame();
    void encode_depth();
    // Does nothing if the other thread has begun it.
    void encode_color();
    // One of the two parts of the frame is done; the last one ends the work on it.
    void end_part();
    void end_work();

    const CameraId id_;
    const Events events_;
    Workers& workers_;
    const Options options_;
    const bool waits_;
    const capture::CameraInfo info_;
    LaneMeter meter_;

    NewestSlot<Captured> newest_;
    std::mutex mutex_;  // guards all up to `busy_`
    std::condition_variable idle_, room_;
    Orders orders_;
    TimePoint frame_came_;
    bool wanted_ = false;        // there is something to do although no frame has come
    bool repeat_waits_ = false;  // of the last frame, until repeat_interval is over
    bool held_ = false;
    bool closed_ = false;
    bool has_frame_in_work_ = false;
    bool stopping_ = false;
    bool busy_ = false;  // work() is running or will

    // Depth and colour of a frame are encoded by one thread or by two.
    std::atomic<int> unfinished_parts_{0};
    std::atomic<bool> color_waits_{false};  // no thread has begun to encode it
    std::atomic<bool> failed_{false};

    // Only in work(), which runs once at a time.
    LaneEncoders encoders_;
    struct Picture {
        wire::MediaHeader header;  // its fields that all settings share
        DepthView depth;           // of last_, or filtered
        TimePoint begun;
        LaneEncoders::For meant = LaneEncoders::For::all;
    };
    Picture picture_;
    Duration color_took_ = worth_a_thread;  // encoding the last picture's colour
    WantedKeys keys_;
    std::optional<Captured> last_;
    FrameNumber next_number_ = 0;
    bool last_has_number_ = false;
    TimePoint repeated_;  // when a frame was encoded again
    std::unique_ptr<filter::DeviceChain> chain_;
    filter::ChainSettings filter_;
    std::shared_ptr<const filter::Background> background_;
    std::optional<capture::Crop> crop_;
    DepthImage cropped_;
    DepthView filtered_;  // of last_, if there is a chain, which it belongs to
    TimePoint filtered_at_, filtered_captured_;

    // Only in look().
    wire::CameraState told_;
    mutable std::mutex status_mutex_;
    capture::WatchedCamera::Status status_;

    std::unique_ptr<CaptureThread> capture_;
    Workers::Ticket ticket_ = 0;
};

}  // namespace theatron::send
