// SPDX-License-Identifier: Apache-2.0
// What the depth benchmark measures: something that encodes images in order, and
// decodes them in order. Benchmarks only.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/bytes.h"
#include "image/image.h"

namespace theatron {

class BenchCoder {
public:
    virtual ~BenchCoder() = default;
    virtual std::string name() const = 0;
    virtual bool lossless() const { return true; }
    // Forgets all frames so far.
    virtual void restart() {}
    // Encodes the next frame. `out` is used again from frame to frame; the result
    // lies in it, or in the coder until the next call.
    virtual ByteView encode(const DepthImage& depth, Bytes& out) = 0;
    // Decodes the next frame of all those encoded since restart. `out` has its size.
    virtual bool decode(std::size_t frame, ByteView encoded, DepthImage& out) = 0;
};

// The libraries to compare with, as far as this build has them.
std::vector<std::unique_ptr<BenchCoder>> depth_yardsticks();

}  // namespace theatron
