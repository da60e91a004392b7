// SPDX-License-Identifier: Apache-2.0
#include "send/camera_lane.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/steady_clock.h"
#include "codec/depth_stream.h"
#include "video/color_codec.h"
#include "video/depth_codecs.h"

namespace theatron::send {
namespace {

// If no frame comes in this time, a wanted key frame is made of the last one:
// someone joined a camera that stands still or has ended.
constexpr Duration key_patience = std::chrono::milliseconds(100);

constexpr std::size_t kept_samples = 2000;

// Which frames of several cameras belong together: those that were exposed
// nearest to the same tick of a common grid of frame periods.
TimePoint moment_of(TimePoint captured, double frames_per_second) {
    const auto period = std::int64_t(std::llround(1e6 / frames_per_second));
    const std::int64_t us = to_us(captured) + period / 2;
    return from_us(us - ((us % period) + period) % period);
}

}  // namespace

struct CameraLane::Encoders {
    struct Depth {
        SettingId id{};
        std::uint8_t codec = 0;
        codec::DepthStreamEncoder encoder;
    };
    struct Color {
        SettingId id{};
        std::uint8_t codec = 0;
        std::unique_ptr<video::ColorEncoder> encoder;
        FrameNumber encoded_last = 0;
    };
    std::vector<Depth> depth;
    std::vector<Color> color;
    std::set<std::pair<StreamId, SettingId>> keys;  // wanted of the next frame
    FrameNumber next_frame = 0;
    Bytes scratch;  // depth is encoded here before its size is known
};

CameraLane::CameraLane(CameraId id, std::unique_ptr<capture::Camera> camera, Events events,
                       std::size_t waiting_frames)
    : id_(id),
      camera_(std::move(camera)),
      info_(camera_->info()),
      events_(std::move(events)),
      newest_(waiting_frames) {
    for (const char* stage : {"capture", "queue", "depth_encode", "color_encode"})
        stages_.emplace(stage, SampleWindow(kept_samples));
    encoding_ = std::thread([this] { encode(); });
    capturing_ = std::thread([this] { capture(); });
}

CameraLane::~CameraLane() {
    stopping_ = true;
    newest_.close();
    capturing_.join();
    encoding_.join();
}

void CameraLane::set_settings(std::vector<LaneSetting> depth, std::vector<LaneSetting> color) {
    {
        const std::lock_guard lock(mutex_);
        depth_settings_ = std::move(depth);
        color_settings_ = std::move(color);
        settings_changed_ = true;
    }
    newest_.wake();
}

void CameraLane::set_region(codec::strata::Region region) {
    assert(codec::strata::is_valid(region));
    const std::lock_guard lock(mutex_);
    region_ = std::move(region);
    settings_changed_ = true;
}

void CameraLane::request_key(StreamId stream, SettingId setting) {
    const std::lock_guard lock(mutex_);
    keys_wanted_.insert({stream, setting});
}

void CameraLane::capture() {
    while (!stopping_) {
        const capture::Capture got = camera_->next(std::chrono::milliseconds(100));
        using Kind = capture::Capture::Kind;
        if (got.kind == Kind::frame) {
            const bool replaced = newest_.put(got.frame);
            const std::lock_guard lock(mutex_);
            ++frames_;
            dropped_newest_ += replaced;
            rate_.add(steady_now());
            stages_.at("capture").add(
                to_ms(got.frame->times.delivered - got.frame->times.captured));
        } else if (got.kind == Kind::end || got.kind == Kind::failed) {
            events_.state({id_,
                           got.kind == Kind::end ? wire::CameraCondition::ended
                                                 : wire::CameraCondition::failed,
                           got.problem});
            return;
        }
    }
}

void CameraLane::encode() {
    Encoders encoders;
    FramePtr last;
    while (!stopping_) {
        const auto frame = newest_.take(key_patience);
        update_encoders(encoders);
        if (frame)
            last = *frame;
        if (last && (frame || !encoders.keys.empty()))
            encode_frame(*last, encoders);
    }
}

// Takes over changed settings and wanted key frames.
void CameraLane::update_encoders(Encoders& encoders) {
    const std::lock_guard lock(mutex_);
    if (settings_changed_) {
        settings_changed_ = false;
        // Encoders of settings that stay go on; they know their reference frames.
        std::vector<Encoders::Depth> depth;
        for (const LaneSetting& s : depth_settings_) {
            const auto old = std::find_if(encoders.depth.begin(), encoders.depth.end(),
                                          [&](const auto& e) { return e.id == s.id; });
            if (old != encoders.depth.end()) {
                depth.push_back(std::move(*old));
                continue;
            }
            const auto parsed = video::parse_depth_setting(s.codec);
            assert(parsed.problem.empty());
            depth.push_back(
                {s.id, std::uint8_t(parsed.setting.id), video::make_depth_encoder(parsed.setting)});
            keys_wanted_.insert({depth_stream(id_), s.id});
        }
        std::vector<Encoders::Color> color;
        for (const LaneSetting& s : color_settings_) {
            const auto old = std::find_if(encoders.color.begin(), encoders.color.end(),
                                          [&](const auto& e) { return e.id == s.id; });
            if (old != encoders.color.end()) {
                color.push_back(std::move(*old));
                continue;
            }
            const auto parsed = video::parse_color_setting(s.codec);
            assert(parsed.problem.empty());
            color.push_back(
                {s.id, std::uint8_t(parsed.setting.id), video::make_color_encoder(parsed.setting)});
            keys_wanted_.insert({color_stream(id_), s.id});
        }
        encoders.depth = std::move(depth);
        for (Encoders::Depth& setting : encoders.depth)
            setting.encoder.set_region(region_);
        encoders.color = std::move(color);
    }
    encoders.keys.merge(keys_wanted_);
    keys_wanted_.clear();
}

void CameraLane::encode_frame(const Frame& frame, Encoders& encoders) {
    const TimePoint begin = steady_now();
    wire::MediaHeader header;
    header.frame = encoders.next_frame++;
    header.moment = moment_of(frame.times.captured, info_.frames_per_second);
    header.captured = frame.times.captured;
    header.delivered = frame.times.delivered;
    header.filtered = frame.times.filtered;

    const auto publish = [&](ByteView payload) {
        header.payload_size = std::uint32_t(payload.size());
        header.encoded = steady_now();
        const std::shared_ptr<Bytes> message = messages_.take();
        message->resize(wire::media_header_size);
        wire::write_media_header(header, message->data());
        message->insert(message->end(), payload.begin(), payload.end());
        {
            const std::lock_guard lock(mutex_);
            bytes_ += message->size();
        }
        events_.media({header, message});
    };

    for (Encoders::Depth& setting : encoders.depth) {
        header.stream = depth_stream(id_);
        header.setting = setting.id;
        header.codec = setting.codec;
        encoders.scratch.resize(
            std::max(encoders.scratch.size(), setting.encoder.max_encoded_size(frame.depth.size)));
        const bool key = encoders.keys.contains({header.stream, setting.id});
        const auto encoded =
            setting.encoder.encode(frame.depth.view(), header.frame, key, encoders.scratch);
        header.key = encoded.key;
        header.reference = encoded.reference_frame;
        header.temporal_layer = std::uint8_t(encoded.layer);
        publish(ByteView(encoders.scratch).first(encoded.bytes));
    }
    const TimePoint depth_done = steady_now();

    if (!frame.color.empty()) {
        header.temporal_layer = 0;
        for (Encoders::Color& setting : encoders.color) {
            header.stream = color_stream(id_);
            header.setting = setting.id;
            header.codec = setting.codec;
            const bool key = encoders.keys.contains({header.stream, setting.id});
            const auto encoded = setting.encoder->encode(frame.color, key);
            // A camera's damaged picture is left out; its depth is not.
            if (!encoded)
                continue;
            header.key = encoded->key;
            header.reference = encoded->key ? header.frame : setting.encoded_last;
            setting.encoded_last = header.frame;
            publish(encoded->bytes);
        }
    }
    const TimePoint color_done = steady_now();
    encoders.keys.clear();

    const std::lock_guard lock(mutex_);
    stages_.at("queue").add(to_ms(begin - frame.times.delivered));
    if (!encoders.depth.empty())
        stages_.at("depth_encode").add(to_ms(depth_done - begin));
    if (!encoders.color.empty())
        stages_.at("color_encode").add(to_ms(color_done - depth_done));
}

LaneFigures CameraLane::figures() const {
    const std::lock_guard lock(mutex_);
    LaneFigures figures;
    figures.name = info_.name;
    figures.frames_per_second = rate_.per_second(steady_now());
    figures.frames = frames_;
    figures.dropped_newest = dropped_newest_;
    figures.bytes = bytes_;
    for (const auto& [name, samples] : stages_)
        figures.stages.push_back({name, samples.percentile(0.5), samples.percentile(0.99)});
    return figures;
}

}  // namespace theatron::send
