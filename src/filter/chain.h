// SPDX-License-Identifier: Apache-2.0
// A sequence of filters for one camera's depth.
//
// A chain stores the state that its filters need of earlier frames. It allocates in the
// constructor only, has no threads and reads no clock. To change the settings of a running
// camera, make a new chain and drop the old one; its filters adapt within a few frames.
#pragma once

#include <memory>

#include "base/time.h"
#include "filter/chain_camera.h"
#include "filter/chain_settings.h"
#include "image/view.h"

namespace theatron::filter {

class Chain {
public:
    Chain(const ChainSettings& settings, const ChainCamera& camera);
    ~Chain();
    Chain(Chain&&) noexcept;
    Chain& operator=(Chain&&) noexcept;

    Size size() const;
    bool off() const;  // true: apply() returns its input

    // Filters one frame, which has the chain's size. The result refers to the chain's own
    // memory and is valid until the next call and as long as the chain exists; if the chain
    // is off, it is `in`. `since_last_frame` is the difference of the capture times of this
    // frame and the previous one: earlier frames lose weight in a gap, and are dropped after
    // a second or if time runs backwards. It is ignored for the first frame.
    DepthView apply(DepthView in, Duration since_last_frame);

private:
    class State;
    std::unique_ptr<State> state_;
};

}  // namespace theatron::filter
