// SPDX-License-Identifier: Apache-2.0
// The filters of one camera, one after the other.
//
// A chain keeps what its filters remember of earlier frames. It allocates when
// it is made and never again, has no threads and reads no clock. To change the
// settings of a running camera make a new chain and drop the old one: it is
// settled again after a few frames.
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
    bool off() const;  // apply() returns its input

    // Filters one frame, which has the chain's size, and returns what became of it. The
    // result is the chain's, where a filter remembers it for the next frame anyway: it is
    // valid until the next call and as long as the chain, or, if the chain is off, `in`.
    // `since_last_frame` is the time since the frame of the call before, by the
    // frames' capture times: after a pause the past counts less, after a second
    // or a step back in time nothing. It does not matter for the first frame.
    DepthView apply(DepthView in, Duration since_last_frame);

private:
    class State;
    std::unique_ptr<State> state_;
};

}  // namespace theatron::filter
