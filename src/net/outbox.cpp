// SPDX-License-Identifier: Apache-2.0
#include "net/outbox.h"

#include <algorithm>
#include <utility>

#include "wire/control.h"
#include "wire/envelope.h"

namespace theatron::net {
namespace {

// The bursts that a ceiling tolerates before it holds back media, and the other classes.
constexpr Duration ceiling_burst = std::chrono::milliseconds(20);
constexpr Duration interaction_burst = std::chrono::milliseconds(100);
// Estimated overhead of TLS, WebSocket, TCP and IP: bytes per envelope, and a share of its bytes.
constexpr std::size_t envelope_overhead = 90;
constexpr double overhead_share = 0.03;

}  // namespace

bool Outbox::push_control(Bytes envelope) {
    control_bytes_ += envelope.size() + control_overhead;
    control_.push_back(std::move(envelope));
    if (control_bytes_ <= max_control_bytes)
        return true;
    control_.clear();
    control_bytes_ = 0;
    return false;
}

void Outbox::put_state(const wire::State& state) {
    const auto found = states_.find(state.key);
    if (found != states_.end())
        found->second.assign(state.body.begin(), state.body.end());
    else if (states_.size() < max_waiting_states)
        states_.try_emplace(state.key, state.body.begin(), state.body.end());
}

void Outbox::push_voice(const wire::Voice& voice) {
    const auto same = [&](const Packet& p) { return p.speaker == voice.speaker; };
    const std::size_t of_one = keeps_everything_ ? max_kept_voice : max_waiting_voice;
    const std::size_t of_all = keeps_everything_ ? max_kept_voices : max_waiting_voices;
    if (std::size_t(std::count_if(voice_.begin(), voice_.end(), same)) >= of_one)
        voice_.erase(std::find_if(voice_.begin(), voice_.end(), same));
    else if (voice_.size() >= of_all)
        voice_.pop_front();
    voice_.push_back({voice.speaker, {voice.packet.begin(), voice.packet.end()}});
}

bool Outbox::push_content(Content content) {
    if (content_.size() >= max_waiting_content)
        return false;
    content_.push_back(std::move(content));
    return true;
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

// The bound counts all streams together, so that a gap begins and ends in all of them.
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
        // A key frame refers to none of the waiting frames and replaces them.
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
            // Later frames of layer 0 do not need it. The receiver skips later frames
            // of its own layer, because their reference is missing.
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

// The stream that was served longest ago, among those with a waiting frame.
Outbox::Lane* Outbox::longest_unserved() {
    Lane* chosen = nullptr;
    for (auto& [stream, lane] : lanes_)
        if (!lane.waiting.empty() && (!chosen || lane.turn < chosen->turn))
            chosen = &lane;
    return chosen;
}

bool Outbox::below_ceiling(TimePoint now, Duration ahead) {
    if (ceiling_ <= 0 || paid_until_ <= now + ahead)
        return true;
    const TimePoint then = paid_until_ - ahead;
    ask_again_ = ask_again_ ? std::min(*ask_again_, then) : then;
    return false;
}

void Outbox::pay(std::size_t bytes, TimePoint now) {
    if (ceiling_ > 0)
        paid_until_ =
            std::max(paid_until_, now) +
            seconds_to_duration((double(bytes) * (1 + overhead_share) + double(envelope_overhead)) /
                                ceiling_);
}

bool Outbox::next(Bytes& envelope, TimePoint now) {
    ask_again_.reset();
    if (acknowledgement_) {
        wire::wrap_acknowledgement(*std::exchange(acknowledgement_, std::nullopt), envelope);
        return true;
    }
    const bool media = sending_ || waiting_ > 0;
    const bool bulk = !content_.empty();
    idle_ = !media && !bulk && !interaction_waits();
    if (idle_) {
        flight_.idle();
        return false;
    }
    if (interaction_waits() && flight_.may_send_interaction(now) &&
        below_ceiling(now, interaction_burst)) {
        next_interaction(envelope, now);
        moved_ += !media && !bulk;
        return true;
    }
    if ((!media && !bulk) || !flight_.may_send(now) || !below_ceiling(now, ceiling_burst))
        return false;
    if (bulk && (!media || media_since_content_ >= content_share * flight_.chunk_size()))
        next_content(envelope, now);
    else
        next_chunk(envelope, now);
    ++moved_;
    return true;
}

void Outbox::next_interaction(Bytes& envelope, TimePoint now) {
    if (!control_.empty()) {
        envelope = std::move(control_.front());
        control_.pop_front();
        control_bytes_ -= envelope.size() + control_overhead;
    } else if (!voice_.empty()) {
        wire::wrap_voice({voice_.front().speaker, voice_.front().bytes}, envelope);
        voice_.pop_front();
    } else {
        next_states(envelope);
    }
    flight_.sent_interaction(envelope.size(), now);
    pay(envelope.size(), now);
}

// As many as fit into one envelope, in a fixed order of keys that starts after the last one sent.
void Outbox::next_states(Bytes& envelope) {
    envelope.clear();
    while (!states_.empty()) {
        auto state = states_.upper_bound(last_state_);
        if (state == states_.end())
            state = states_.begin();
        if (!wire::append_state({state->first, state->second}, envelope))
            return;
        last_state_ = state->first;
        states_.erase(state);
    }
}

// A piece is as large as a chunk of media, so that nothing waits longer behind it.
void Outbox::next_content(Bytes& envelope, TimePoint now) {
    Content& content = content_.front();
    wire::Content piece{
        Bytes(content.hash.bytes.begin(), content.hash.bytes.end()), content.offset, 0, {}};
    if (content.bytes) {
        const std::uint64_t size =
            std::min<std::uint64_t>(flight_.chunk_size(), content.end - content.offset);
        const auto begin = content.bytes->begin() + std::ptrdiff_t(content.offset);
        piece.total = content.bytes->size();
        piece.bytes.assign(begin, begin + std::ptrdiff_t(size));
        content.offset += size;
    }
    envelope = wire::wrap_control(wire::encode(piece));
    if (!content.bytes || content.offset == content.end)
        content_.pop_front();
    media_since_content_ = 0;
    flight_.sent_interaction(envelope.size(), now);
    pay(envelope.size(), now);
}

void Outbox::next_chunk(Bytes& envelope, TimePoint now) {
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
    sent_ = wire::wrap_chunk(*sending_, sent_, envelope, flight_.chunk_size());
    if (from == 0)
        wire::stamp_sent(std::span(envelope).subspan(wire::chunk_header_size), now);
    const bool ends = sent_ == sending_->size();
    flight_.sent(envelope.size(), sending_queued_, ends, now);
    pay(envelope.size(), now);
    media_since_content_ = content_.empty() ? 0 : media_since_content_ + envelope.size();
    if (ends)
        sending_.reset();
}

void Outbox::acknowledge(const wire::Acknowledgement& word, TimePoint now) {
    const std::uint64_t before = flight_.bytes_on_the_way();
    flight_.acknowledge(word.taken, word.held, now);
    if (flight_.bytes_on_the_way() == before)
        return;
    ++moved_;
    has_taken_ = true;
}

bool Outbox::stands_still(TimePoint now) {
    // A ceiling may hold an envelope back for longer than give_up_after.
    if (idle_ || ask_again_ || moved_ != moved_before_ || !still_since_) {
        moved_before_ = moved_;
        still_since_ = now;
    }
    return now - *still_since_ >= give_up_after;
}

HeldPictures Outbox::held(TimePoint now) const {
    HeldPictures held;
    const auto add = [&](const std::shared_ptr<const Bytes>& bytes) {
        held.bytes += bytes->size() / std::size_t(bytes.use_count());
    };
    if (sending_)
        add(sending_);
    for (const auto& [stream, lane] : lanes_)
        for (const Media& media : lane.waiting)
            add(media.bytes);
    held.still = still_since_ ? now - *still_since_ : Duration(0);
    held.records = keeps_everything_;
    return held;
}

SendingFigures Outbox::take_figures(TimePoint now) {
    SendingFigures figures;
    figures.bytes_per_second = flight_.bytes_per_second(now);
    figures.round_trip = flight_.round_trip();
    figures.delay = flight_.take_delay(now);
    figures.dropped = std::exchange(dropped_, 0);
    figures.bytes_on_the_way = std::size_t(flight_.bytes_on_the_way());
    const bool has_taken = std::exchange(has_taken_, false);
    figures.takes_nothing = figures.bytes_on_the_way > 0 && !has_taken;
    return figures;
}

}  // namespace theatron::net
