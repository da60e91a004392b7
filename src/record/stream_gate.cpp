// SPDX-License-Identifier: Apache-2.0
#include "record/stream_gate.h"

#include <algorithm>

namespace theatron::record {
namespace {

// A key frame exposed this long before the beginning is as good as one after it.
constexpr Duration fresh = std::chrono::milliseconds(500);
// A camera that stands still sends its last picture again, however old that is.
constexpr Duration begin_patience = std::chrono::seconds(2);
constexpr Duration key_patience = std::chrono::milliseconds(700);
constexpr std::size_t kept_numbers = 64;

}  // namespace

StreamGate::Answer StreamGate::on_frame(const wire::MediaHeader& header, TimePoint now) {
    if (!begun_) {
        const bool is_fresh = header.captured >= opened_ - fresh;
        begun_ = header.key && (is_fresh || now >= opened_ + begin_patience);
        if (!begun_)
            return {.record = false, .ask_for_key = ask(now)};
    }
    if (!header.key &&
        std::find(recorded_.begin(), recorded_.end(), header.reference) == recorded_.end())
        // A frame of an upper layer is only skipped: the next of layer 0 does not need it.
        return {.record = false, .ask_for_key = header.temporal_layer == 0 && ask(now)};
    recorded_.push_back(header.frame);
    if (recorded_.size() > kept_numbers)
        recorded_.pop_front();
    return {.record = true};
}

bool StreamGate::ask(TimePoint now) {
    if (asked_ && now - *asked_ < key_patience)
        return false;
    asked_ = now;
    return true;
}

}  // namespace theatron::record
