// SPDX-License-Identifier: Apache-2.0
// Decides how many received bytes are acknowledged, and when: the receiver's half of flow
// control (net/flight.h is the sender's).
//
// A media message is acknowledged when a decoder has taken it. The sender's window then also
// bounds the undecoded messages. Chunks of an incomplete message are acknowledged on arrival,
// except for as many bytes as earlier messages still wait with: so a message larger than the
// sender's window gets through. Pure: time is an argument.
#pragma once

#include <algorithm>
#include <optional>

#include "wire/envelope.h"

namespace theatron::net {

class Acknowledger {
public:
    // Shortest time between two acknowledgements of media.
    static constexpr Duration interval = std::chrono::milliseconds(4);

    // An envelope of this size has arrived that is no acknowledgement.
    void came(std::size_t bytes, bool is_media, TimePoint now) {
        received_ += bytes;
        note(is_media, now);
    }
    // A media message is complete. It waits until taken() is called for as many bytes.
    void waits(std::size_t bytes) { waiting_ += bytes; }
    void taken(std::size_t bytes, TimePoint now) {
        waiting_ -= std::min(waiting_, std::uint64_t(bytes));
        note(true, now);
    }

    // The acknowledgement to send now, if any.
    std::optional<wire::Acknowledgement> due(TimePoint now) {
        if (unsent() == 0 || (unsent() < wire::max_untold && !media_unsent_) ||
            (ask_again() && now < *ask_again()))
            return std::nullopt;
        acknowledged_ = received_ - waiting_;
        acknowledged_at_ = now;
        media_unsent_ = false;
        return wire::Acknowledgement{acknowledged_, now - newest_};
    }

    // The time to call due() again if nothing arrives before.
    std::optional<TimePoint> ask_again() const {
        if (!media_unsent_ || unsent() == 0)
            return std::nullopt;
        return acknowledged_at_ + interval;
    }

private:
    // Bytes to acknowledge. 0 also if chunks of a message that now waits were acknowledged before.
    std::uint64_t unsent() const {
        return std::max(received_ - waiting_, acknowledged_) - acknowledged_;
    }
    void note(bool is_media, TimePoint now) {
        newest_ = now;
        media_unsent_ = media_unsent_ || is_media;
    }

    std::uint64_t received_ = 0, waiting_ = 0, acknowledged_ = 0;
    bool media_unsent_ = false;
    TimePoint newest_, acknowledged_at_;
};

}  // namespace theatron::net
