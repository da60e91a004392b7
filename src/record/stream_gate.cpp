// SPDX-License-Identifier: Apache-2.0
#include "record/stream_gate.h"

#include <algorithm>
#include <utility>

namespace theatron::record {
namespace {

// No codec refers further back.
constexpr std::size_t kept_numbers = 64;

}  // namespace

StreamGate::Answer StreamGate::on_frame(const wire::MediaHeader& header, TimePoint now) {
    const bool has_reference = header.key || (open_ && has_recorded(header.reference));
    // A camera's frame may come without colour. Its next colour then refers to the last one.
    const bool whole_chain = !is_depth(header.stream) && !header.key && has_reference;
    if (newest_) {
        const auto step = std::int32_t(header.frame - *newest_);
        if (step > 1 && !whole_chain)
            figures_.lost += std::uint64_t(step - 1);
    }
    newest_ = header.frame;

    if (!has_reference) {
        if (begun_)
            ++figures_.lost;
        // A frame of an upper layer is only skipped: the next of layer 0 does not need it.
        return {.record = false, .ask_for_key = (!open_ || header.temporal_layer == 0) && ask(now)};
    }
    open_ = begun_ = true;
    recorded_.push_back(header.frame);
    if (recorded_.size() > kept_numbers)
        recorded_.pop_front();
    ++figures_.recorded;
    has_references_ = has_references_ || !header.key;
    if (const bool wanted = std::exchange(wants_key_, false); wanted && !header.key) {
        asked_ = now;
        return {.record = true, .ask_for_key = true};
    }
    if (!next_key_)
        next_key_ = now + (phase_ > Duration(0) ? phase_ : key_period);
    if (header.key || now < *next_key_)
        return {.record = true};
    *next_key_ += ((now - *next_key_) / key_period + 1) * key_period;
    asked_ = now;
    return {.record = true, .ask_for_key = true};
}

bool StreamGate::on_dropped(TimePoint now) {
    --figures_.recorded;
    ++figures_.dropped;
    open_ = false;
    recorded_.clear();
    return ask(now);
}

void StreamGate::close() {
    open_ = false;
    recorded_.clear();
    asked_.reset();
}

void StreamGate::restart() {
    close();
    newest_.reset();
    begun_ = has_references_ = false;
}

bool StreamGate::has_recorded(FrameNumber frame) const {
    return std::find(recorded_.begin(), recorded_.end(), frame) != recorded_.end();
}

bool StreamGate::ask(TimePoint now) {
    if (asked_ && now - *asked_ < key_patience)
        return false;
    asked_ = now;
    return true;
}

}  // namespace theatron::record
