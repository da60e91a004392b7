// SPDX-License-Identifier: Apache-2.0
// The encoders of one lane: one for each distinct setting that a participant receives.
//
// A frame is encoded at once in the cheapest setting and in those that take no more than their
// share (encoder_cost.h), and each is published as soon as it is done. Background threads encode
// the other settings; while such an encoder is busy, frames are skipped in its stream alone. Its
// chain of references stays whole, because an encoder refers only to frames that it encoded. The
// cost of a new setting is not known yet: a few of its first frames wait instead of being skipped,
// so that a recording that begins with them misses none.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/ids.h"
#include "base/pool.h"
#include "codec/depth_stream.h"
#include "codec/strata_region.h"
#include "image/frame.h"
#include "send/encoder_cost.h"
#include "send/lane_figures.h"
#include "video/color_codec.h"
#include "wire/media_header.h"

namespace theatron::send {

// One encoded image, ready for any number of receivers.
struct EncodedMedia {
    wire::MediaHeader header;
    std::shared_ptr<const Bytes> message;  // header and payload
};

// A setting to encode, in its canonical spelling.
struct LaneSetting {
    SettingId id{};
    std::string codec;
};

// Streams and settings whose next frame must be a key frame.
using WantedKeys = std::set<std::pair<StreamId, SettingId>>;

// CPU time of the calling thread.
Duration thread_cpu_time();

// Depth and colour may be encoded at the same time, each by one thread.
class LaneEncoders {
public:
    // Frames that wait for a busy encoder, until its cost is known.
    static constexpr std::size_t max_waiting = 8;

    struct Events {
        // Called from the thread that encoded.
        std::function<void(EncodedMedia)> publish;
        // A key frame that was requested of a busy encoder is due. From a background thread.
        std::function<void(StreamId, SettingId)> key_due = [](StreamId, SettingId) {};
        // The setting no longer keeps up with the camera, or does again; `cpu` is for one picture.
        std::function<void(SettingId, bool keeps_up, Duration cpu)> keeps_up = [](SettingId, bool,
                                                                                  Duration) {};
    };
    // Clocks, threads and factories that the encoders use; tests replace them.
    struct Environment {
        std::function<TimePoint()> now;  // session time
        std::function<Duration()> cpu_time = thread_cpu_time;
        // Runs work later, on a background thread.
        std::function<void(std::function<void()>)> behind;
        Duration share{};  // see encoder_share()
        std::function<codec::DepthStreamEncoder(const codec::DepthSetting&)> make_depth;
        std::function<std::unique_ptr<video::ColorEncoder>(const video::ColorSetting&)> make_color;
    };

    LaneEncoders(CameraId camera, Events events, Environment environment);
    // Returns when no background thread encodes any more.
    ~LaneEncoders();

    // Encoders of settings that stay are kept; they know their reference frames. A new
    // one begins with a key frame.
    void set_settings(const std::vector<LaneSetting>& depth, const std::vector<LaneSetting>& color);
    // Sets the region of all depth encoders from the next frame on.
    void set_region(const codec::strata::Region& region);
    bool empty() const { return depth_.empty() && color_.empty(); }
    bool has_depth() const { return !depth_.empty(); }
    bool has_color() const { return !color_.empty(); }
    // Some setting was given no picture yet.
    bool has_new() const;

    enum class For : std::uint8_t {
        all,       // settings
        new_ones,  // that were given no picture yet
    };
    // `header` holds the fields that all settings of the frame share.
    void encode_depth(DepthView depth, wire::MediaHeader header, const WantedKeys& keys,
                      For settings = For::all);
    // Encodes frame->color, which is not empty. Returns the number of settings that could not
    // encode it at once because it is damaged.
    int encode_color(const FramePtr& frame, wire::MediaHeader header, const WantedKeys& keys,
                     For settings = For::all);

    // Returns when the background threads have no work of this object left.
    void wait_behind();

    // From any thread.
    std::vector<EncoderFigures> figures() const;

private:
    // Fields of depth and colour encoders. One thread at a time encodes; `mutex` guards the rest.
    struct Encoder {
        LaneSetting setting;
        std::uint8_t codec = 0;
        bool at_once = true;  // only on the lane's thread
        bool is_new = true;   // only on the lane's thread: no picture was given to it

        mutable std::mutex mutex;
        bool busy = false;
        bool key_due = true;     // the next picture must be a key frame
        bool key_asked = false;  // while it was busy
        bool behind = false;
        // Only while it is busy; in their order.
        std::deque<std::function<void()>> waiting;
        EncoderCost cost;
        KeepingUp keeping_up;
        std::uint64_t left_out = 0;
    };
    struct Depth : Encoder {
        codec::DepthSetting parsed;
        std::optional<codec::DepthStreamEncoder> encoder;  // made with the first picture
        std::optional<codec::strata::Region> new_region;   // guarded by `mutex`
        Bytes scratch;                                     // encoded here before the size is known
    };
    struct Color : Encoder {
        video::ColorSetting parsed;
        std::unique_ptr<video::ColorEncoder> encoder;
        FrameNumber encoded_last = 0;
    };

    // Writes the encoders that encode the picture at once into `at_once`.
    template <class E>
    void choose(const std::vector<std::shared_ptr<E>>& encoders, std::vector<std::size_t>& at_once);
    template <class E>
    static bool is_meant(const E& encoder, For settings) {
        return settings == For::all || encoder.is_new;
    }
    enum class Turn : std::uint8_t {
        now,       // the picture is its next one; end() must follow
        waits,     // encode_behind() adds it to those that wait
        left_out,  // the encoder is busy and skips it
    };
    Turn begin(Encoder& encoder, bool key);
    void end(Encoder& encoder, bool done, Duration cpu, StreamId stream);
    // Between begin() and end(); false if the picture could not be encoded.
    bool encode(Depth& encoder, DepthView depth, wire::MediaHeader header, bool key);
    bool encode(Color& encoder, const ColorData& color, wire::MediaHeader header, bool key);
    // Encodes and calls end(), also if encoding throws.
    template <class E, class Picture>
    bool encode_and_end(E& encoder, const Picture& picture, const wire::MediaHeader& header,
                        bool key);
    template <class E, class Keep, class Picture>
    void encode_behind(std::shared_ptr<E> encoder, Turn turn, Keep keep, Picture picture,
                       const wire::MediaHeader& header, bool key);
    void go_behind(std::function<void()> work);
    void publish(wire::MediaHeader& header, ByteView payload);

    const CameraId camera_;
    const Events events_;
    const Environment environment_;
    mutable std::mutex list_mutex_;  // guards changes of both lists and reading them elsewhere
    std::vector<std::shared_ptr<Depth>> depth_;
    std::vector<std::shared_ptr<Color>> color_;
    std::vector<std::size_t> depth_at_once_, color_at_once_;
    Pool<DepthImage> depths_;  // for background threads
    Pool<Bytes> messages_;

    std::mutex behind_mutex_;
    std::condition_variable behind_done_;
    int behind_ = 0;  // pictures at background threads
    bool stopping_ = false;
};

}  // namespace theatron::send
