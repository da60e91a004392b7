// SPDX-License-Identifier: Apache-2.0
#include "send/media_queue.h"

namespace theatron::send {

bool MediaQueue::put(EncodedMedia media) {
    const std::lock_guard lock(mutex_);
    Lane& lane = lanes_[{media.header.stream, media.header.setting}];
    if (lane.waiting.size() >= max_waiting) {
        lane.dropped += lane.waiting.size();
        lane.waiting.clear();
        lane.broken = true;
    }
    if (lane.broken && !media.header.key) {
        ++lane.dropped;
    } else {
        lane.broken = false;
        lane.waiting.push_back(std::move(media));
    }
    return !std::exchange(told_, true);
}

MediaQueue::Taken MediaQueue::take() {
    Taken taken;
    const std::lock_guard lock(mutex_);
    told_ = false;
    for (auto& [key, lane] : lanes_) {
        for (EncodedMedia& media : lane.waiting)
            taken.media.push_back(std::move(media));
        lane.waiting.clear();
        if (lane.dropped > 0)
            taken.dropped[key.first] += std::exchange(lane.dropped, 0);
        if (lane.broken)
            taken.broken.push_back(key);
    }
    // Settings come and go; what is not broken need not be remembered.
    std::erase_if(lanes_, [](const auto& entry) { return !entry.second.broken; });
    return taken;
}

}  // namespace theatron::send
