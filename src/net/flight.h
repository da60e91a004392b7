// SPDX-License-Identifier: Apache-2.0
// Flow control towards one peer: bytes in flight, the rate of the path, and the window
// that follows from both. Network buffers are long and make frames old instead of
// dropping them; the window keeps their queues short.
//
// The peer acknowledges the bytes that it has taken. Chunks that queued behind others
// show the rate of the bottleneck, which is the link or the peer's decoders. The
// shortest round trip is the delay of the path without queues. The window is the rate
// times the sum of round trip and a short queue: a frame that is chosen late is then
// still new on arrival, and a state waits behind few bytes. Control, states and voice
// count too and may exceed the window by interaction_reserve.
//
// A lost packet holds back what came behind it. Where the kernel tells so (see()), such bytes
// neither fill the window nor count as queued: the path carries them.
// Pure: time is an argument.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <optional>

#include "base/time.h"
#include "net/tcp_path.h"
#include "wire/envelope.h"

namespace theatron::net {

class Flight {
    struct Chunk {
        std::uint64_t end = 0;  // of all bytes sent, after it
        TimePoint sent, queued;
        bool ends_message = false;
        bool is_media = false;
        bool held_back = false;  // had to wait for the window
    };

public:
    // The window before the first measurement, and the smallest one; bytes.
    static constexpr double first_window = 1 << 20;
    static constexpr double smallest_window = 26 * 1024;
    // Bytes of control, states and voice that may be in flight beyond the window.
    static constexpr double interaction_reserve = 8 * 1024;
    static_assert(wire::max_untold < std::size_t(smallest_window));

    // The queueing time that is allowed at a bottleneck of this rate: long enough to use the whole
    // rate, short enough for states and voice, which share the queue
    // (docs/decisions/traffic-classes.md).
    static Duration allowed_queue(double bytes_per_second);

    // A chunk of media is sent. `queued` is the time when its message entered the outbox.
    void sent(std::size_t bytes, TimePoint queued, bool ends_message, TimePoint now) {
        note_sent(bytes, {0, now, queued, ends_message, true, held_back_});
    }
    // An envelope of control, states, voice or content is sent.
    void sent_interaction(std::size_t bytes, TimePoint now) {
        note_sent(bytes, {0, now, now, false, false, held_back_});
    }

    // The peer has taken `total` bytes since the beginning and waited for `held` before it sent
    // this. Totals that are impossible or not newer are ignored.
    void acknowledge(std::uint64_t total, Duration held, TimePoint now);

    // Takes the kernel's present word. To be called before acknowledge(), and when may_send()
    // refused: true if more may be sent than before.
    bool see(const TcpPath& path, TimePoint now);

    // False if the window is full. True for a peer that has never acknowledged anything.
    // Call only if there is media to send: a refusal marks the next chunk as held back.
    bool may_send(TimePoint now);
    // The same for control, states and voice.
    bool may_send_interaction(TimePoint now) const;
    // The outbox is empty: the next chunk has not been held back.
    void idle() { held_back_ = false; }

    std::uint64_t bytes_on_the_way() const { return sent_ - acknowledged_; }
    double window(TimePoint now) const;
    // The window was full when media waited.
    bool is_held_back() const { return held_back_; }

    // Sizes that suit the measured rate; the largest ones before the first measurement.
    std::size_t chunk_size() const;    // bytes of media in one envelope
    std::size_t unsent_limit() const;  // bytes that the kernel may keep unsent
    // The measured rate; 0 if there is no measurement, or none of the last two seconds.
    double bytes_per_second(TimePoint now) const;
    Duration round_trip() const;  // the shortest of the last seconds

    // The longest time from queued to arrived, of media messages that arrived since the last call
    // and of the oldest that has not. Other bytes are no measure of it: without media a peer
    // acknowledges them in lots.
    Duration take_delay(TimePoint now);

private:
    void note_sent(std::size_t bytes, Chunk chunk);

    double rate() const { return busy_bytes_ / busy_seconds_; }  // if busy_seconds_ > 0
    std::uint64_t bytes_in_network() const {
        return bytes_on_the_way() - std::min(behind_gap_, bytes_on_the_way());
    }
    void note_round_trip(Duration round_trip, TimePoint now);
    void learn(double bytes, const Chunk& newest, Duration round_trip, TimePoint now);
    bool is_probing(const TcpPath& path, TimePoint now);
    void learn_rate(double bytes, double busy_seconds, TimePoint now);

    std::uint64_t sent_ = 0, acknowledged_ = 0;
    bool answering_ = false;
    bool held_back_ = false;
    std::deque<Chunk> chunks_;  // on their way, oldest first
    TimePoint last_answer_;

    // Bytes and time of the last phases in which chunks queued; older ones weigh less.
    double busy_bytes_ = 0, busy_seconds_ = 0;
    TimePoint busy_at_;
    double window_at_first_ = first_window;

    Duration shortest_now_ = Duration::max(), shortest_before_ = Duration::max();
    TimePoint bucket_began_, low_seen_, draining_until_;
    Duration delay_{};

    // As see() was told last.
    std::uint32_t sent_again_ = 0;
    std::uint64_t behind_gap_ = 0;
    Duration kernel_queue_{};
    double kernel_rate_ = 0;
    std::optional<TimePoint> gap_seen_at_;  // when a packet had been sent again, or BBR probed
    std::optional<TimePoint> probe_began_;  // the last one
};

}  // namespace theatron::net
