// SPDX-License-Identifier: Apache-2.0
// The encoders of one lane: one for each distinct setting that somebody receives.
#pragma once

#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "base/ids.h"
#include "base/pool.h"
#include "codec/depth_stream.h"
#include "codec/strata_region.h"
#include "image/frame.h"
#include "video/color_codec.h"
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

// Frames whose key was asked for.
using WantedKeys = std::set<std::pair<StreamId, SettingId>>;

// Depth and colour may be encoded at the same time, each by one thread.
class LaneEncoders {
public:
    using Publish = std::function<void(EncodedMedia)>;

    // `now` tells when a message was encoded.
    LaneEncoders(CameraId camera, Publish publish, std::function<TimePoint()> now)
        : camera_(camera), publish_(std::move(publish)), now_(std::move(now)) {}

    // Encoders of settings that stay go on; they know their reference frames. A new
    // one begins with a key frame, which is added to `keys`.
    void set_settings(const std::vector<LaneSetting>& depth, const std::vector<LaneSetting>& color,
                      WantedKeys& keys);
    // Of all depth encoders from the next frame on.
    void set_region(const codec::strata::Region& region);
    bool empty() const { return depth_.empty() && color_.empty(); }
    bool has_depth() const { return !depth_.empty(); }
    bool has_color() const { return !color_.empty(); }

    // `header` holds what is the same for all settings of the frame.
    void encode_depth(DepthView depth, wire::MediaHeader header, const WantedKeys& keys);
    // Returns how many settings could not encode it because it is damaged.
    int encode_color(const ColorData& color, wire::MediaHeader header, const WantedKeys& keys);

private:
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
    void publish(wire::MediaHeader& header, ByteView payload);

    const CameraId camera_;
    const Publish publish_;
    const std::function<TimePoint()> now_;
    std::vector<Depth> depth_;
    std::vector<Color> color_;
    Bytes scratch_;  // depth is encoded here before its size is known
    Pool<Bytes> messages_;
};

}  // namespace theatron::send
