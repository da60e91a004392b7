// SPDX-License-Identifier: Apache-2.0
// One camera's way through the host: capture, then encode once per setting.
//
// Two threads: one waits for the camera, one encodes. Between them the newest
// frame wins, so slow encoding never makes frames older. Lanes know nothing of
// each other: nobody waits for a neighbour.
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "base/ids.h"
#include "base/newest_slot.h"
#include "base/pool.h"
#include "base/statistics.h"
#include "capture/camera.h"
#include "codec/strata_region.h"
#include "wire/control.h"
#include "wire/media_header.h"

namespace theatron::send {

// One encoded image, ready for any number of receivers.
struct EncodedMedia {
    wire::MediaHeader header;
    std::shared_ptr<const Bytes> message;  // header and payload
};

// A setting to encode, in its one spelling.
struct LaneSetting {
    SettingId id{};
    std::string codec;
};

// What a stage took per frame, and what was lost, since the lane began.
struct LaneFigures {
    std::string name;
    double frames_per_second = 0;
    std::uint64_t frames = 0;          // taken from the camera
    std::uint64_t dropped_newest = 0;  // replaced by a newer one before they were encoded
    std::uint64_t bytes = 0;           // encoded, all settings together
    struct Stage {
        std::string name;
        double p50_ms = 0, p99_ms = 0;
    };
    std::vector<Stage> stages;  // "capture", "depth_encode", "color_encode", "queue"
};

class CameraLane {
public:
    struct Events {
        // From the encoding thread.
        std::function<void(EncodedMedia)> media;
        // From the capturing thread.
        std::function<void(wire::CameraState)> state;
    };

    // Takes over `camera` and starts at once. `waiting_frames`: how many may wait
    // for the encoder; one for the least age, more for the fewest drops.
    CameraLane(CameraId id, std::unique_ptr<capture::Camera> camera, Events events,
               std::size_t waiting_frames = 1);
    ~CameraLane();

    CameraId id() const { return id_; }
    const capture::CameraInfo& info() const { return info_; }

    // From any thread. With no settings nothing is encoded. Each new setting
    // begins with a key frame.
    void set_settings(std::vector<LaneSetting> depth, std::vector<LaneSetting> color);

    // From any thread. The part of the depth image, in its pixels, that stays exact
    // from the next frame on where a codec's error is bounded; empty: all of it.
    // It must be strata::is_valid.
    void set_region(codec::strata::Region region);

    // From any thread. The next frame, or if none comes soon the last one again,
    // becomes a key frame.
    void request_key(StreamId stream, SettingId setting);

    LaneFigures figures() const;

private:
    struct Encoders;

    void capture();
    void encode();
    void encode_frame(const Frame& frame, Encoders& encoders);
    void update_encoders(Encoders& encoders);

    const CameraId id_;
    const std::unique_ptr<capture::Camera> camera_;
    const capture::CameraInfo info_;
    const Events events_;

    NewestSlot<FramePtr> newest_;
    std::atomic<bool> stopping_{false};
    Pool<Bytes> messages_;

    mutable std::mutex mutex_;  // guards all below
    std::vector<LaneSetting> depth_settings_, color_settings_;
    codec::strata::Region region_;
    bool settings_changed_ = false;  // or the region
    std::set<std::pair<StreamId, SettingId>> keys_wanted_;
    std::uint64_t frames_ = 0, dropped_newest_ = 0, bytes_ = 0;
    mutable RateWindow rate_;
    std::map<std::string, SampleWindow> stages_;

    std::thread capturing_, encoding_;
};

}  // namespace theatron::send
