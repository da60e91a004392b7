// SPDX-License-Identifier: Apache-2.0
// Leaves out the upper temporal layers of a receiver's streams. Pure.
#pragma once

#include <map>

#include "base/ids.h"

namespace theatron::session {

class LayerGate {
public:
    // True if a frame of this layer is sent to the receiver, whose highest layer is `highest`. Call
    // it for every frame, in order: a layer opens only with a frame of layer 0, because its frames
    // refer to one another.
    bool passes(StreamId stream, int layer, int highest) {
        int& open = open_[stream];
        if (layer == 0 || highest < open)
            open = highest;
        return layer <= open;
    }
    void forget(StreamId stream) { open_.erase(stream); }

private:
    std::map<StreamId, int> open_;  // the highest layer that passes
};

}  // namespace theatron::session
