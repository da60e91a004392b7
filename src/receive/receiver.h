// SPDX-License-Identifier: Apache-2.0
// From media messages to images: decodes them, pairs depth and colour of a
// camera, detects missing frames, and measures the age of pictures.
//
// No threads and no clock of its own: the owner calls it from one thread with
// the session time, and gets frames that any thread may keep.
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/pool.h"
#include "base/statistics.h"
#include "codec/depth_stream.h"
#include "image/frame.h"
#include "video/color_codec.h"
#include "wire/control.h"
#include "wire/media_header.h"

namespace theatron::receive {

// The newest images of one camera, decoded. Depth and colour are of the same moment
// if both have arrived. Late colour is of an earlier one; it is empty before the first.
// Where the host sends no depth (wire/no_codec.h), each colour image makes a frame whose
// depth image has no pixels.
struct CameraFrame {
    CameraId camera{};
    FrameNumber number = 0;
    TimePoint moment;
    FrameTimes times;
    DepthImage depth;
    std::shared_ptr<const ColorImage> color;
    bool past = false;  // not of the present: this participant looks back
};
using CameraFramePtr = std::shared_ptr<const CameraFrame>;

// The part of the depth image that equals the output of the host's filters bit by bit.
enum class Exactness {
    nowhere,
    region,  // bounded error outside of the region of interest
    everywhere,
};

// Figures of one received stream, for status lines and reports to the host.
struct StreamFigures {
    StreamId stream{};
    std::string codec;  // the current one
    double frames_per_second = 0;
    double mbit_per_second = 0;  // payload and media header
    std::uint64_t frames = 0;    // decoded
    std::uint64_t bytes = 0;
    std::uint64_t dropped = 0;  // frames made by the host that were not decoded here
    FrameNumber newest = 0;
    double age_ms = 0;                     // of the newest frame, when it was decoded
    double age_now_ms = 0;                 // of the newest frame, now
    Exactness exact = Exactness::nowhere;  // of the newest depth frame
    double age_p50_ms = 0, age_p95_ms = 0, age_p99_ms = 0, age_max_ms = 0;  // of the last minutes
    bool past = false;     // as in wire::StreamSetting; no ages but age_now_ms are of such frames
    double decode_ms = 0;  // from a frame's arrival to its image, of the last ones
    std::uint64_t decoder_failures = 0;  // frames that a decoder took and gave up later
    // For how long frames have been asked for of which none has come; 0 where one came.
    double awaited_ms = 0;
    bool has_come = false;  // a frame, also before reset_figures()
};

// The largest message of a stream whose pictures have `pixels`; a larger one is refused before
// it is copied or decoded. No codec needs more.
constexpr std::size_t max_media_size(std::size_t pixels) {
    return wire::media_header_size + 64 * 1024 + 4 * pixels;
}
// The same for the streams of a camera, by its calibration; 0 for others.
std::size_t max_media_size(const wire::Camera& camera, StreamId stream);

class Receiver {
public:
    // Called from on_media() and poll().
    struct Events {
        std::function<void(CameraFramePtr)> frame;
        std::function<void(StreamId, SettingId)> needs_key;
        // Session time after decoding. Empty: decoding takes no time.
        std::function<TimePoint()> now = {};
        // For tests. Empty: video::make_color_decoder.
        std::function<std::unique_ptr<video::ColorDecoder>(video::ColorCodecId)> make_color = {};
    };

    explicit Receiver(Events events) : events_(std::move(events)) {}

    // Sets the cameras that the host announced. A camera that was there before with the same
    // lenses keeps its decoders; streams of other cameras are forgotten. A camera whose
    // calibration cannot be read (Status of decode_calibration) gets no pictures.
    void set_cameras(const std::vector<wire::Camera>& cameras);
    // Throws Error if this build does not know one of the codecs; the others are set. A picture is
    // never put together of the past and the present.
    void set_settings(const std::vector<wire::StreamSetting>& settings);

    // Takes one whole media message. Damaged and unknown ones are counted.
    // Safe for untrusted input.
    Status on_media(ByteView message, TimePoint now);

    // Takes over pictures that decoders have finished since: for decoders that answer later.
    void poll(TimePoint now);
    // Pictures that decoders have not finished.
    std::size_t pending() const;

    std::vector<StreamFigures> figures(TimePoint now);
    std::uint64_t refused() const { return refused_; }

    // Resets rates, ages and drops.
    void reset_figures();
    // Resets ages alone: the clock that they were measured with was wrong.
    void forget_ages();

private:
    struct Stream {
        CameraId camera{};
        bool is_depth = false;
        // By the calibration. Pictures of other sizes are refused.
        Size size;
        std::size_t max_message = 0;
        // Empty before the first set_settings(), where nothing is sent, and where this build does
        // not know the codec; else a decoder exists.
        std::optional<SettingId> setting;
        std::string codec;
        codec::DepthSetting depth_setting;
        bool depth_is_lossless = false;  // as the setting says, whatever the region
        std::unique_ptr<codec::DepthStreamDecoder> depth;
        std::unique_ptr<video::ColorDecoder> color;
        video::ColorCodecId color_codec{};
        bool color_is_automatic = false;  // the host may change `color_codec`
        // The frame to which a colour frame that is no key frame must refer.
        std::optional<FrameNumber> color_reference;
        struct Submitted {
            FrameNumber frame = 0;
            TimePoint captured, arrived;
        };
        std::deque<Submitted> submitted;  // to `color`, which has not finished them

        bool counting = false;                   // a frame has come since the figures were reset
        std::optional<TimePoint> awaited_since;  // while no frame has come
        FrameNumber newest = 0;
        std::uint64_t frames = 0, bytes = 0, dropped = 0;
        RateWindow frame_rate, bit_rate;
        SampleWindow ages{4000};
        // Sorting them takes long, so that is done once for many frames.
        double age_p50_ms = 0, age_p95_ms = 0, age_p99_ms = 0, age_max_ms = 0;
        std::uint64_t sorted_at = 0;
        double age_ms = 0, decode_ms = 0;
        std::uint64_t decoder_failures = 0;
        std::optional<TimePoint> newest_captured;
        Exactness exact = Exactness::nowhere;
        bool asked_for_key = false;
        TimePoint asked_at;
        bool past = false;
    };
    // Images that wait for the other one of the same moment.
    struct CameraImages {
        Bytes calibration;
        std::shared_ptr<CameraFrame> depth;  // newest, not yet handed on
        std::shared_ptr<const ColorImage> color;
        FrameNumber color_number = 0;
        bool has_color = false;
        bool has_depth = true;  // the host sends it
    };

    // One sentence if this build does not know the codec.
    std::string set_codec(Stream& stream, const wire::StreamSetting& setting) const;
    void set_past(Stream& stream, bool past);
    void stop(Stream& stream);
    static void add_age(Stream& stream, double ms);
    static void add_decode_time(Stream& stream, Duration time);
    Status decode_depth(Stream& stream, const wire::MediaHeader& header, ByteView payload,
                        TimePoint now);
    void set_color_codec(Stream& stream, video::ColorCodecId codec) const;
    Status follow_color_codec(Stream& stream, const wire::MediaHeader& header) const;
    Status decode_color(Stream& stream, const wire::MediaHeader& header, ByteView payload,
                        TimePoint now);
    void take_pictures(StreamId id, Stream& stream, TimePoint now);
    void count(Stream& stream, const wire::MediaHeader& header, std::size_t size, TimePoint now);
    static Exactness exactness(const Stream& stream, ByteView payload);
    void ask_for_key(StreamId id, Stream& stream, TimePoint now);
    void hand_on(CameraImages& camera);
    void hand_on_color(const Stream& stream, const Stream::Submitted& submitted, TimePoint done);
    static void sort_ages(Stream& stream);

    Events events_;
    std::map<StreamId, Stream> streams_;
    std::map<CameraId, CameraImages> cameras_;
    Pool<CameraFrame> frames_;
    Pool<ColorImage> colors_;
    std::uint64_t refused_ = 0;
};

}  // namespace theatron::receive
