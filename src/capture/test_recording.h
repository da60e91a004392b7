// SPDX-License-Identifier: Apache-2.0
// A recording for tests: frames at given times, of which the depth of each is its index.
#pragma once

#include <utility>
#include <vector>

#include "capture/playback.h"

namespace theatron::capture {

class NumberedRecording final : public Recording {
public:
    explicit NumberedRecording(std::vector<Duration> offsets) : offsets_(std::move(offsets)) {}

    std::optional<Duration> offset() override {
        return next_ < offsets_.size() ? std::optional(offsets_[next_]) : std::nullopt;
    }
    void skip() override { ++next_; }
    void rewind() override { next_ = 0; }
    bool read(Frame& out) override {
        out.depth.resize({1, 1});
        out.depth.pixels[0] = std::uint16_t(next_++);
        return true;
    }

private:
    std::vector<Duration> offsets_;
    std::size_t next_ = 0;
};

}  // namespace theatron::capture
