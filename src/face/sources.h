// SPDX-License-Identifier: Apache-2.0
// The names that each kind of tracker gives its values, and which channels of the internal vector
// they feed.
//
// One table a source. An input feeds one channel or more, each through a simple shape; a channel
// that several inputs feed is their weighted mean over those that are present. So an avatar that
// asks VRCFaceTracking for `SmileFrownLeft` alone and one that asks for `MouthCornerPullLeft` both
// give a smile.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "face/channels.h"

namespace theatron::face {

enum class Source : std::uint8_t {
    arkit,        // 52 shapes by ARKit's names
    unified,      // VRCFaceTracking's Unified Expressions, version 2
    xr_fb_face2,  // OpenXR XR_FB_face_tracking2; its first 63 values are XR_FB_face_tracking
    xr_htc,       // OpenXR XR_HTC_facial_tracking: 14 of the eyes, then 37 of the lips; no brows
};
inline constexpr Source all_sources[] = {Source::arkit, Source::unified, Source::xr_fb_face2,
                                         Source::xr_htc};

// "arkit", "unified", "xr_fb", "xr_htc".
std::string_view source_name(Source source);
std::optional<Source> source_of(std::string_view name);

enum class Shape : std::uint8_t {
    plain,       // the value
    positive,    // of a signed value, what is above 0
    negative,    // what is below 0
    lid_closed,  // VRCFaceTracking's lid: 0 closed, 0.75 open
    lid_wide,    // and 1 wide open
    opening,     // 1 open, 0 closed
};

struct Term {
    std::size_t input;  // position in the source's names
    Channel channel;
    Shape shape = Shape::plain;
    float weight = 1;
};

struct SourceTable {
    // Those of an OpenXR source are in the order of its array.
    std::span<const std::string_view> inputs;
    std::span<const Term> terms;
    ChannelMask mask;  // the channels that the source can have

    // Also names that the source's own header gives with a prefix and an ending:
    // XR_FACE_EXPRESSION2_JAW_DROP_FB.
    std::optional<std::size_t> input_of(std::string_view name) const;
};

const SourceTable& table_of(Source source);

struct Mapped {
    Channels values{};
    ChannelMask present;
};

// `inputs` and `present` belong together; what is beyond the table is left out. Values that are no
// numbers count as absent, others are limited to 0..1 after their shape. Safe on any values.
Mapped map_inputs(Source source, std::span<const float> inputs, const std::vector<bool>& present);

// The same where all of `inputs` are present, as OpenXR gives them.
Mapped map_inputs(Source source, std::span<const float> inputs);

}  // namespace theatron::face
