// SPDX-License-Identifier: Apache-2.0
#include "net/outbox.h"

#include <algorithm>

#include "wire/envelope.h"

namespace theatron::net {

bool Outbox::push_control(Bytes envelope) {
    control_bytes_ += envelope.size();
    control_.push_back(std::move(envelope));
    return control_bytes_ <= max_control_bytes;
}

int Outbox::drop_waiting(Lane& lane) {
    const int dropped = int(lane.waiting.size());
    waiting_ -= lane.waiting.size();
    lane.waiting.clear();
    return dropped;
}

Outbox::Pushed Outbox::push_media(Media media) {
    Lane& lane = lanes_[media.stream];
    Pushed result;
    if (media.setting != lane.setting) {
        result.dropped += drop_waiting(lane);
        lane.setting = media.setting;
        lane.broken = true;
    }

    if (media.key) {
        // Needs nothing that waits, and nothing older is worth more.
        result.dropped += drop_waiting(lane);
        lane.broken = false;
    } else if (lane.broken) {
        return {result.dropped + 1, true};
    } else if (lane.waiting.size() >= max_waiting) {
        // A frame of an upper layer that nothing waiting refers to can go alone.
        const auto spare =
            std::find_if(lane.waiting.begin(), lane.waiting.end(), [&](const Media& m) {
                const auto refers = [&](const Media& other) {
                    return !other.key && other.reference == m.frame;
                };
                return m.temporal_layer > 0 && !refers(media) &&
                       std::none_of(lane.waiting.begin(), lane.waiting.end(), refers);
            });
        if (spare != lane.waiting.end()) {
            lane.waiting.erase(spare);
            --waiting_;
            ++result.dropped;
        } else if (media.temporal_layer > 0) {
            // Later frames of layer 0 do not need it, and of its own layer's
            // followers the receiver knows from their reference what to skip.
            return {result.dropped + 1, false};
        } else {
            result.dropped += drop_waiting(lane) + 1;
            lane.broken = true;
            return {result.dropped, true};
        }
    }
    lane.waiting.push_back(std::move(media));
    ++waiting_;
    return result;
}

bool Outbox::next(Bytes& envelope, TimePoint now) {
    if (!control_.empty()) {
        envelope = std::move(control_.front());
        control_.pop_front();
        control_bytes_ -= envelope.size();
        return true;
    }
    if (!sending_) {
        // The stream that was served longest ago.
        Lane* chosen = nullptr;
        for (auto& [stream, lane] : lanes_)
            if (!lane.waiting.empty() && (!chosen || lane.turn < chosen->turn))
                chosen = &lane;
        if (!chosen)
            return false;
        sending_ = std::move(chosen->waiting.front().bytes);
        sent_ = 0;
        chosen->waiting.pop_front();
        chosen->turn = ++turn_;
        --waiting_;
    }
    const bool first = sent_ == 0;
    sent_ = wire::wrap_chunk(*sending_, sent_, envelope);
    if (first)
        wire::stamp_sent(std::span(envelope).subspan(wire::chunk_header_size), now);
    if (sent_ == sending_->size())
        sending_.reset();
    return true;
}

}  // namespace theatron::net
