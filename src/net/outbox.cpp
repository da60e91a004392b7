// SPDX-License-Identifier: Apache-2.0
#include "net/outbox.h"

#include <algorithm>
#include <utility>

#include "wire/envelope.h"

namespace theatron::net {
namespace {

// So much later than the ceiling would have it a chunk may be paid for.
constexpr Duration ceiling_burst = std::chrono::milliseconds(20);
// What TLS, WebSocket, TCP and IP add to a chunk, about.
constexpr std::size_t chunk_overhead = 600;

}  // namespace

bool Outbox::push_control(Bytes envelope) {
    control_bytes_ += envelope.size() + control_overhead;
    control_.push_back(std::move(envelope));
    return control_bytes_ <= max_control_bytes;
}

int Outbox::drop_waiting(Lane& lane) {
    const int dropped = int(lane.waiting.size());
    waiting_ -= lane.waiting.size();
    for (const Media& media : lane.waiting)
        waiting_bytes_ -= media.bytes->size();
    lane.waiting.clear();
    return dropped;
}

void Outbox::wait(Lane& lane, Media media) {
    ++waiting_;
    waiting_bytes_ += media.bytes->size();
    lane.waiting.push_back(std::move(media));
}

// Of all streams, so that a gap has one beginning and one end.
Outbox::Pushed Outbox::keep(Media media) {
    Lane& lane = lanes_[media.stream];
    lane.broken = lane.broken || media.setting != lane.setting;
    lane.setting = media.setting;
    full_ = waiting_bytes_ + media.bytes->size() > (full_ ? max_kept_bytes / 2 : max_kept_bytes);
    if (full_) {
        // A key frame is of no use before there is room for it.
        lane.broken = true;
        return {1, false};
    }
    if (lane.broken && !media.key)
        return {1, true};
    lane.broken = false;
    wait(lane, std::move(media));
    return {};
}

Outbox::Pushed Outbox::push_media(Media media) {
    const StreamId stream = media.stream;
    Pushed pushed = keeps_everything_ ? keep(std::move(media)) : queue(std::move(media));
    dropped_ += pushed.dropped;
    if (pushed.needs_key) {
        Lane& lane = lanes_[stream];
        pushed.needs_key = idle_ || lane.key_asked_at != moved_;
        lane.key_asked_at = moved_;
    }
    return pushed;
}

Outbox::Pushed Outbox::queue(Media media) {
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
            waiting_bytes_ -= spare->bytes->size();
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
    wait(lane, std::move(media));
    return result;
}

// The stream that was served longest ago, of those where something waits.
Outbox::Lane* Outbox::longest_unserved() {
    Lane* chosen = nullptr;
    for (auto& [stream, lane] : lanes_)
        if (!lane.waiting.empty() && (!chosen || lane.turn < chosen->turn))
            chosen = &lane;
    return chosen;
}

bool Outbox::below_ceiling(TimePoint now) {
    if (ceiling_ <= 0 || paid_until_ <= now + ceiling_burst)
        return true;
    ask_again_ = paid_until_ - ceiling_burst;
    return false;
}

bool Outbox::next(Bytes& envelope, TimePoint now) {
    ask_again_.reset();
    if (!control_.empty()) {
        envelope = std::move(control_.front());
        control_.pop_front();
        control_bytes_ -= envelope.size() + control_overhead;
        idle_ = false;
        moved_ += waiting_ == 0 && !sending_;
        return true;
    }
    if (!acknowledgement_.empty()) {
        envelope = std::exchange(acknowledgement_, {});
        idle_ = false;
        return true;
    }
    idle_ = !sending_ && waiting_ == 0;
    if (idle_) {
        flight_.idle();
        return false;
    }
    if (!flight_.may_send(now) || !below_ceiling(now))
        return false;
    if (!sending_) {
        Lane& lane = *longest_unserved();
        sending_ = std::move(lane.waiting.front().bytes);
        sending_queued_ = lane.waiting.front().queued;
        sent_ = 0;
        waiting_bytes_ -= sending_->size();
        lane.waiting.pop_front();
        lane.turn = ++turn_;
        --waiting_;
    }
    const std::size_t from = sent_;
    sent_ = wire::wrap_chunk(*sending_, sent_, envelope);
    if (from == 0)
        wire::stamp_sent(std::span(envelope).subspan(wire::chunk_header_size), now);
    const bool ends = sent_ == sending_->size();
    flight_.sent(sent_ - from, sending_queued_, ends, now);
    if (ceiling_ > 0)
        paid_until_ = std::max(paid_until_, now) +
                      seconds_to_duration(double(sent_ - from + chunk_overhead) / ceiling_);
    if (ends)
        sending_.reset();
    ++moved_;
    return true;
}

void Outbox::acknowledge(std::uint64_t media_bytes, TimePoint now) {
    const std::uint64_t before = flight_.bytes_on_the_way();
    flight_.acknowledge(media_bytes, now);
    moved_ += flight_.bytes_on_the_way() != before;
}

bool Outbox::stands_still(TimePoint now) {
    // A ceiling may hold back for longer.
    if (idle_ || ask_again_ || moved_ != moved_before_ || !still_since_) {
        moved_before_ = moved_;
        still_since_ = now;
    }
    return now - *still_since_ >= give_up_after;
}

SendingFigures Outbox::take_figures(TimePoint now) {
    SendingFigures figures;
    figures.bytes_per_second = flight_.bytes_per_second(now);
    figures.round_trip = flight_.round_trip();
    figures.delay = flight_.take_delay(now);
    figures.dropped = std::exchange(dropped_, 0);
    figures.bytes_on_the_way = std::size_t(flight_.bytes_on_the_way());
    return figures;
}

}  // namespace theatron::net
