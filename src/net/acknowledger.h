// SPDX-License-Identifier: Apache-2.0
// Which of the bytes that came may be acknowledged, and when: the receiver's half of flow
// control (net/flight.h is the sender's).
//
// A media message is acknowledged when a decoder has taken it, so that what the sender may put
// on the way bounds what waits undecoded, too. Chunks of a message that is not complete are
// acknowledged as they come, as far as earlier messages do not wait: a message larger than the
// sender's window gets through. Pure: time is an argument.
#pragma once

#include <algorithm>
#include <optional>

#include "wire/envelope.h"

namespace theatron::net {

class Acknowledger {
public:
    // Acknowledgements of media are no closer than this.
    static constexpr Duration interval = std::chrono::milliseconds(4);

    // An envelope has come that is no acknowledgement.
    void came(std::size_t bytes, bool is_media, TimePoint now) {
        came_ += bytes;
        note(is_media, now);
    }
    // A media message is complete, and waits until taken() is told of as many bytes.
    void waits(std::size_t bytes) { waiting_ += bytes; }
    void taken(std::size_t bytes, TimePoint now) {
        waiting_ -= std::min(waiting_, std::uint64_t(bytes));
        note(true, now);
    }

    // The acknowledgement to send now, if any.
    std::optional<wire::Acknowledgement> due(TimePoint now) {
        if (untold() == 0 || (untold() < wire::max_untold && !media_untold_) ||
            (ask_again() && now < *ask_again()))
            return std::nullopt;
        told_ = came_ - waiting_;
        told_at_ = now;
        media_untold_ = false;
        return wire::Acknowledgement{told_, now - newest_};
    }

    // When to ask due() again if nothing comes until then.
    std::optional<TimePoint> ask_again() const {
        if (!media_untold_ || untold() == 0)
            return std::nullopt;
        return told_at_ + interval;
    }

private:
    // What came before a message that waits may have been told already.
    std::uint64_t untold() const { return came_ - waiting_ > told_ ? came_ - waiting_ - told_ : 0; }
    void note(bool is_media, TimePoint now) {
        newest_ = now;
        media_untold_ = media_untold_ || is_media;
    }

    std::uint64_t came_ = 0, waiting_ = 0, told_ = 0;
    bool media_untold_ = false;
    TimePoint newest_, told_at_;
};

}  // namespace theatron::net
