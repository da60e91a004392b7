// SPDX-License-Identifier: Apache-2.0
// What is on its way to one peer, what the way carries, and how much more may
// be put on it: the answer to buffers in the network that would rather make
// frames old than drop them.
//
// The peer says how many bytes it has taken. From chunks that had to queue
// behind others comes the rate at which the narrowest place serves them, which may
// be the link or the peer's decoders; the shortest round trip is the way's own delay.
// Media on its way is kept to what that rate carries in one round trip and a small
// queue, so a frame that is chosen late is also new when it arrives, and a state waits
// behind little. Control, states and voice count, too, and may exceed the window by
// interaction_reserve. Pure: time is an argument.
#pragma once

#include <cstdint>
#include <deque>

#include "base/time.h"
#include "wire/envelope.h"

namespace theatron::net {

class Flight {
public:
    // Before anything is known about the way, and never less than the latter.
    static constexpr double first_window = 1 << 20;
    static constexpr double smallest_window = 26 * 1024;
    // Bytes of control, states and voice that may be on the way beyond the window.
    static constexpr double interaction_reserve = 8 * 1024;
    static_assert(wire::max_untold < std::size_t(smallest_window));

    // The queue that is allowed at the narrowest place of a way with this rate: long enough for
    // the rate to be used in full, short enough for what must not wait
    // (docs/decisions/traffic-classes.md).
    static Duration allowed_queue(double bytes_per_second);

    // A chunk of media leaves. `queued` is when its message was there to be sent.
    void sent(std::size_t bytes, TimePoint queued, bool ends_message, TimePoint now);
    // Control, states or voice leave.
    void sent_interaction(std::size_t bytes, TimePoint now) { sent(bytes, now, false, now); }

    // The peer has taken `total` bytes since the beginning, and said so `held` later. What cannot
    // be is ignored.
    void acknowledge(std::uint64_t total, Duration held, TimePoint now);

    // False if what is on its way should arrive first. A peer that never
    // acknowledges anything is not held back. Ask when there is media to send.
    bool may_send(TimePoint now);
    // The same for control, states and voice.
    bool may_send_interaction(TimePoint now) const;
    // There is nothing more to send now.
    void idle() { held_back_ = false; }

    std::uint64_t bytes_on_the_way() const { return sent_ - acknowledged_; }
    double window(TimePoint now) const;

    // What suits the rate of the way; the largest while it is not known.
    std::size_t chunk_size() const;    // media in one envelope
    std::size_t unsent_limit() const;  // what the kernel may hold that has not left yet
    // What the way carries; 0 while it is not known, or was last seen long ago.
    double bytes_per_second(TimePoint now) const;
    Duration round_trip() const;  // the shortest of the last seconds

    // The longest time from queued to arrived, of messages that arrived since the
    // last call and of the oldest that has not.
    Duration take_delay(TimePoint now);

private:
    struct Chunk {
        std::uint64_t end = 0;  // sent_ after it
        TimePoint sent, queued;
        bool ends_message = false;
        bool held_back = false;  // had to wait for the window
    };

    double rate() const { return busy_bytes_ / busy_seconds_; }  // if busy_seconds_ > 0
    void note_round_trip(Duration round_trip, TimePoint now);
    void learn(double bytes, const Chunk& newest, Duration round_trip, TimePoint now);

    std::uint64_t sent_ = 0, acknowledged_ = 0;
    bool answering_ = false;
    bool held_back_ = false;
    std::deque<Chunk> chunks_;  // on their way, oldest first
    TimePoint last_answer_;

    // Of the last while in which chunks queued.
    double busy_bytes_ = 0, busy_seconds_ = 0;
    TimePoint busy_at_;
    double window_at_first_ = first_window;

    Duration shortest_now_ = Duration::max(), shortest_before_ = Duration::max();
    TimePoint bucket_began_, low_seen_, draining_until_;
    Duration delay_{};
};

}  // namespace theatron::net
