// SPDX-License-Identifier: Apache-2.0
// The receivers that a publisher sends to directly, as far as its link and theirs carry that
// (docs/decisions/direct-sending.md). A receiver whose frames are lost or late again and again must
// go, and the host sends to it. Where that happens to several at once, the link that they share is
// full: the one that came last goes, and the others get time.
//
// A pure state machine. A receiver is known by the secret of its grant.
#pragma once

#include <vector>

#include "base/bytes.h"
#include "base/time.h"

namespace theatron::session {

class DirectLoad {
public:
    // Losses count and fade by this factor with each on_tick(), ten times a second.
    static constexpr double max_losses = 5, losses_kept = 0.98;
    // Losses from which on a receiver counts as one of several that are slow at once.
    static constexpr double shared_losses = max_losses / 2;
    // A receiver that came at most this long ago counts, too: the others were not slow before.
    static constexpr Duration trial = std::chrono::seconds(5);
    // A receiver that had to go may come again after this time, which doubles each time: if it
    // alone was slow, and if the link that it shares was full.
    static constexpr Duration first_bar = std::chrono::seconds(2),
                              first_shared_bar = std::chrono::seconds(30),
                              longest_bar = std::chrono::minutes(10);
    // A receiver that has stayed for this time begins again with the first bar.
    static constexpr Duration proven = std::chrono::minutes(2);

    bool may_come(const Bytes& receiver, TimePoint now) const;
    void on_come(const Bytes& receiver, TimePoint now);
    void on_left(const Bytes& receiver);
    // A frame for it was left out.
    void on_loss(const Bytes& receiver);
    // `late`: the receivers whose frames are late now. Returns those that must go; they count as
    // having left.
    std::vector<Bytes> on_tick(const std::vector<Bytes>& late, TimePoint now);
    // Forgets all other receivers.
    void keep_only(const std::vector<Bytes>& receivers);

private:
    struct Receiver {
        Bytes secret;
        bool is_here = false;
        TimePoint came;
        double losses = 0;
        Duration bar{};      // the last one; none: it never had to go
        TimePoint bar_ends;  // it may come again
    };
    const Receiver* find(const Bytes& secret) const;
    Receiver& at(const Bytes& secret);
    Bytes send_away(Receiver& receiver, Duration least_bar, TimePoint now);

    std::vector<Receiver> receivers_;
};

}  // namespace theatron::session
