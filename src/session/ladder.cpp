// SPDX-License-Identifier: Apache-2.0
#include "session/ladder.h"

#include "session/stream_rates.h"
#include "wire/no_codec.h"

namespace theatron::session {

CodecTraits depth_traits(const std::string& codec, const CodecSteps& codecs) {
    if (!codecs.layered)
        return {};
    const CodecSteps::Layered layered = codecs.layered(codec);
    return {layered.independent, layered.layered && layered.codec == codec, false};
}

Ladder make_ladder(const std::string& depth, const std::string& color, const CodecSteps& codecs,
                   bool region_is_drawn) {
    LadderStep step;
    step.highest_layer = served_layers - 1;
    step.depth_codec = depth;
    step.color_codec = color;
    Ladder ladder{step};

    // Colour alone thins by the numbers of its frames.
    const bool has_depth = depth != wire::no_codec;
    const CodecSteps::Layered layered = !has_depth       ? CodecSteps::Layered{depth, true, false}
                                        : codecs.layered ? codecs.layered(depth)
                                                         : CodecSteps::Layered{};
    if (layered.layered || layered.independent) {
        step.depth_codec = layered.codec;
        while (step.highest_layer > 0) {
            --step.highest_layer;
            step.frames /= 2;
            ladder.push_back(step);
        }
    }
    if (codecs.coarser && color != wire::no_codec)
        for (const CodecSteps::Coarser& coarser : codecs.coarser(color)) {
            step.color_codec = coarser.codec;
            step.color_size = coarser.size;
            ladder.push_back(step);
        }
    if (region_is_drawn && has_depth && codecs.lossy_outside_region)
        if (std::string lossy = codecs.lossy_outside_region(step.depth_codec); !lossy.empty()) {
            step.depth_codec = std::move(lossy);
            step.lossy_outside_region = true;
            ladder.push_back(step);
        }
    return ladder;
}

}  // namespace theatron::session
