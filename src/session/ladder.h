// SPDX-License-Identifier: Apache-2.0
// The steps that reduce the data for a receiver: first fewer frames of the same
// encoded stream, then coarser colour, last bounded loss of depth outside the
// region of interest. Depth inside the region is the same on every step.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace theatron::session {

// Properties of codecs for the ladder; this module knows no codec.
struct CodecSteps {
    struct Layered {
        std::string codec;         // the same codec with temporal layers, if it has them
        bool independent = false;  // no frame refers to another: any may be left out
        bool layered = false;      // `codec` has layers
    };
    std::function<Layered(const std::string& depth)> layered;

    struct Coarser {
        std::string codec;
        double size = 1;  // bytes relative to the requested codec, about
    };
    std::function<std::vector<Coarser>(const std::string& color)> coarser;

    // True if colour frames of this codec, as their headers name it, refer to each other, so that
    // none can be left out. Null: false.
    std::function<bool(std::uint8_t codec)> refers;

    // The codec with bounded loss outside the region of interest; empty if it has
    // none. Null: no codec has.
    std::function<std::string(const std::string& depth)> lossy_outside_region;
};

// Properties of one setting for sending. All but `chain` follow from its text, which is read once.
struct CodecTraits {
    // No frame refers to another: any may be left out, by its number.
    bool independent = false;
    // Any upper temporal layer may be left out.
    bool layered = false;
    // Colour whose frames refer to each other: none may be left out. Taken from the newest frame,
    // because a setting may leave the codec to the publisher.
    bool chain = false;
};
CodecTraits depth_traits(const std::string& codec, const CodecSteps& codecs);

struct LadderStep {
    int highest_layer = 0;
    double frames = 1;  // share of all
    std::string depth_codec, color_codec;
    double color_size = 1;  // as in Coarser
    bool lossy_outside_region = false;
};

using Ladder = std::vector<LadderStep>;

// All steps; the first one is what was requested. Loss is a step only if a region
// is drawn: without one the whole image stays exact.
Ladder make_ladder(const std::string& depth, const std::string& color, const CodecSteps& codecs,
                   bool region_is_drawn);

}  // namespace theatron::session
