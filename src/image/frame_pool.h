// SPDX-License-Identifier: Apache-2.0
// Frames whose memory is used again, so that a running camera allocates nothing.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "image/frame.h"

namespace theatron {

// Hands out frames with the memory, and the stale content, of released ones.
// Thread safe. Frames may outlive the pool.
class FramePool {
public:
    std::shared_ptr<Frame> take() {
        std::unique_ptr<Frame> frame;
        {
            const std::lock_guard lock(shelf_->mutex);
            if (!shelf_->frames.empty()) {
                frame = std::move(shelf_->frames.back());
                shelf_->frames.pop_back();
            }
        }
        if (!frame)
            frame = std::make_unique<Frame>();
        return {frame.release(), [shelf = shelf_](Frame* used) {
                    std::unique_ptr<Frame> back(used);
                    const std::lock_guard lock(shelf->mutex);
                    if (shelf->frames.size() < max_kept)
                        shelf->frames.push_back(std::move(back));
                }};
    }

private:
    static constexpr std::size_t max_kept = 16;
    struct Shelf {
        std::mutex mutex;
        std::vector<std::unique_ptr<Frame>> frames;
    };
    std::shared_ptr<Shelf> shelf_ = std::make_shared<Shelf>();
};

}  // namespace theatron
