// SPDX-License-Identifier: Apache-2.0
#include "send/media_queue.h"

namespace theatron::send {

namespace {

std::size_t size_of(const EncodedMedia& media) {
    return media.message ? media.message->size() : 0;
}

}  // namespace

void MediaQueue::keep_everything(bool keep) {
    const std::lock_guard lock(mutex_);
    keep_everything_ = keep;
}

bool MediaQueue::is_full(const Lane& lane) const {
    if (!keep_everything_)
        return lane.waiting.size() >= max_waiting;
    return lane.waiting.size() >= max_kept || bytes_ >= max_kept_bytes;
}

void MediaQueue::drop_waiting(Lane& lane) {
    for (const EncodedMedia& media : lane.waiting)
        bytes_ -= size_of(media);
    lane.dropped += lane.waiting.size();
    lane.waiting.clear();
    lane.broken = true;
}

bool MediaQueue::put(EncodedMedia media) {
    const std::lock_guard lock(mutex_);
    Lane& lane = lanes_[{media.header.stream, media.header.setting}];
    if (is_full(lane))
        drop_waiting(lane);
    if (lane.broken && !media.header.key) {
        ++lane.dropped;
    } else {
        lane.broken = false;
        bytes_ += size_of(media);
        lane.waiting.push_back(std::move(media));
    }
    return !std::exchange(told_, true);
}

MediaQueue::Taken MediaQueue::take() {
    Taken taken;
    const std::lock_guard lock(mutex_);
    told_ = false;
    bytes_ = 0;
    for (auto& [key, lane] : lanes_) {
        for (EncodedMedia& media : lane.waiting)
            taken.media.push_back(std::move(media));
        lane.waiting.clear();
        if (lane.dropped > 0)
            taken.dropped[key.first] += std::exchange(lane.dropped, 0);
        if (lane.broken)
            taken.broken.push_back(key);
    }
    // Settings come and go; lanes that are not broken need not be kept.
    std::erase_if(lanes_, [](const auto& entry) { return !entry.second.broken; });
    return taken;
}

}  // namespace theatron::send
