// SPDX-License-Identifier: Apache-2.0
#include "send/lane_encoders.h"

#include <algorithm>
#include <cassert>

#include "video/depth_codecs.h"

namespace theatron::send {
namespace {

// Encoders by their settings: those that stay are moved over, new ones are made.
template <class Encoder, class Make>
std::vector<Encoder> updated(std::vector<Encoder>& old, const std::vector<LaneSetting>& settings,
                             StreamId stream, WantedKeys& keys, Make make) {
    std::vector<Encoder> result;
    for (const LaneSetting& s : settings) {
        const auto same =
            std::find_if(old.begin(), old.end(), [&](const auto& e) { return e.id == s.id; });
        if (same != old.end()) {
            result.push_back(std::move(*same));
            continue;
        }
        result.push_back(make(s));
        keys.insert({stream, s.id});
    }
    return result;
}

}  // namespace

void LaneEncoders::set_settings(const std::vector<LaneSetting>& depth,
                                const std::vector<LaneSetting>& color, WantedKeys& keys) {
    depth_ = updated(depth_, depth, depth_stream(camera_), keys, [](const LaneSetting& s) {
        const auto parsed = video::parse_depth_setting(s.codec);
        assert(parsed.problem.empty());
        return Depth{s.id, std::uint8_t(parsed.setting.id),
                     video::make_depth_encoder(parsed.setting)};
    });
    color_ = updated(color_, color, color_stream(camera_), keys, [](const LaneSetting& s) {
        const auto parsed = video::parse_color_setting(s.codec);
        assert(parsed.problem.empty());
        return Color{s.id, std::uint8_t(parsed.setting.id),
                     video::make_color_encoder(parsed.setting), 0};
    });
}

void LaneEncoders::set_region(const codec::strata::Region& region) {
    for (Depth& setting : depth_)
        setting.encoder.set_region(region);
}

void LaneEncoders::publish(wire::MediaHeader& header, ByteView payload) {
    header.payload_size = std::uint32_t(payload.size());
    header.encoded = now_();
    const std::shared_ptr<Bytes> message = messages_.take();
    message->resize(wire::media_header_size);
    wire::write_media_header(header, message->data());
    message->insert(message->end(), payload.begin(), payload.end());
    publish_({header, message});
}

void LaneEncoders::encode_depth(DepthView depth, wire::MediaHeader header, const WantedKeys& keys) {
    header.stream = depth_stream(camera_);
    for (Depth& setting : depth_) {
        header.setting = setting.id;
        header.codec = setting.codec;
        scratch_.resize(std::max(scratch_.size(), setting.encoder.max_encoded_size(depth.size)));
        const bool key = keys.contains({header.stream, setting.id});
        const auto encoded = setting.encoder.encode(depth, header.frame, key, scratch_);
        header.key = encoded.key;
        header.reference = encoded.reference_frame;
        header.temporal_layer = std::uint8_t(encoded.layer);
        publish(header, ByteView(scratch_).first(encoded.bytes));
    }
}

int LaneEncoders::encode_color(const ColorData& color, wire::MediaHeader header,
                               const WantedKeys& keys) {
    header.stream = color_stream(camera_);
    int damaged = 0;
    for (Color& setting : color_) {
        header.setting = setting.id;
        header.codec = setting.codec;
        const bool key = keys.contains({header.stream, setting.id});
        const auto encoded = setting.encoder->encode(color, key);
        // A camera's damaged picture is left out; its depth is not.
        if (!encoded) {
            ++damaged;
            continue;
        }
        header.key = encoded->key;
        header.reference = encoded->key ? header.frame : setting.encoded_last;
        setting.encoded_last = header.frame;
        publish(header, encoded->bytes);
    }
    return damaged;
}

}  // namespace theatron::send
