// SPDX-License-Identifier: Apache-2.0
// The interface of the coders that the depth benchmark measures: each encodes images in order
// and decodes them in order.
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
    // Drops the state of all frames so far.
    virtual void restart() {}
    // Encodes the next frame. The result is in `out`, whose memory is reused, or in the coder;
    // it is valid until the next call.
    virtual ByteView encode(const DepthImage& depth, Bytes& out) = 0;
    // Decodes frame `frame` of those encoded since restart, in order. `out` has its size.
    virtual bool decode(std::size_t frame, ByteView encoded, DepthImage& out) = 0;
};

// The libraries used as yardsticks, as far as this build has them.
std::vector<std::unique_ptr<BenchCoder>> depth_yardsticks();
// The yardstick zstd1_raw alone, which every build has.
std::vector<std::unique_ptr<BenchCoder>> zstd_yardstick();

}  // namespace theatron
