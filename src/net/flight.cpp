// SPDX-License-Identifier: Apache-2.0
#include "net/flight.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace theatron::net {
namespace {

// A chunk whose round trip is longer than the shortest one by more than this has queued.
constexpr Duration jitter = std::chrono::milliseconds(3);
// Time constant with which older measurements of the rate lose weight, in time of a busy path.
constexpr double memory_s = 0.06;
// Measurements of the rate together stand for at most this much time.
constexpr double busy_time_s = 2 * memory_s;
// A rate measured longer ago is not reported: the path may have changed.
constexpr Duration rate_validity = std::chrono::seconds(2);
// The shortest round trip is that of the last one to two of these.
constexpr Duration bucket = std::chrono::seconds(5);
// With a queue that never empties, the shortest round trip would grow without end. After this time
// without a short one the window shrinks for a moment, so that the queue drains.
constexpr Duration low_patience = std::chrono::seconds(3);
constexpr double drain_share = 0.75;
// A round trip of seconds comes from a peer that paused. No queue needs so long to drain.
constexpr Duration drain_time = std::chrono::milliseconds(250);
// A chunk that waited for the window and met no queue adds this share of its bytes to the measured
// rate. On a long path many such chunks are sent before a queue shows that the rate is reached.
constexpr double growth = 1.0 / 6;
// The allowed queue: this time, plus the transmission time of these bytes.
constexpr double queue_s = 0.005, queue_bytes = 25e3;
// Above this rate the bottleneck is probably the peer's decoders, at which the pictures of many
// cameras arrive at once.
constexpr double decoders_bytes_per_second = 12.5e6;
constexpr Duration shortest_queue = std::chrono::milliseconds(8);
constexpr Duration longest_queue = std::chrono::milliseconds(30);
// Transmission times of a chunk and of the unsent bytes in the kernel, about.
constexpr double chunk_s = 0.003, unsent_s = 0.006;
constexpr std::size_t smallest_chunk = 2 * 1024;
constexpr std::size_t smallest_unsent = 4 * 1024, largest_unsent = 64 * 1024;
// BBR's PROBE_RTT: packets in flight, its length with the round trip before it, and the shortest
// time from one to the next. A link that needs no more packets in flight has this window always.
constexpr std::uint32_t window_of_probe = 4;
constexpr Duration longest_probe = std::chrono::milliseconds(400);
constexpr Duration probe_apart = std::chrono::seconds(5);
// A peer that acknowledges nothing must not cost memory.
constexpr std::size_t max_chunks = 8192;

}  // namespace

void Flight::note_sent(std::size_t bytes, Chunk chunk) {
    sent_ += bytes;
    chunk.end = sent_;
    chunks_.push_back(chunk);
    if (chunks_.size() > max_chunks)
        chunks_.pop_front();
}

void Flight::acknowledge(std::uint64_t total, Duration held, TimePoint now) {
    if (total > sent_ || total <= acknowledged_)
        return;
    const double bytes = double(total - acknowledged_);
    acknowledged_ = total;
    answering_ = true;
    Chunk newest;
    bool any = false;
    for (; !chunks_.empty() && chunks_.front().end <= total; chunks_.pop_front()) {
        newest = chunks_.front();
        any = true;
        if (newest.ends_message)
            delay_ = std::max(delay_, now - newest.queued);
    }
    if (!any)
        return;
    const Duration took = std::max(now - newest.sent - held, Duration(0));
    note_round_trip(took, now);
    learn(bytes, newest, took, now);
    last_answer_ = now;
}

void Flight::note_round_trip(Duration took, TimePoint now) {
    if (shortest_now_ == Duration::max() || now - bucket_began_ > bucket) {
        shortest_before_ = shortest_now_;
        shortest_now_ = took;
        bucket_began_ = now;
    }
    shortest_now_ = std::min(shortest_now_, took);

    if (took <= round_trip() + jitter) {
        low_seen_ = now;
    } else if (low_seen_ != TimePoint{} && now - low_seen_ > low_patience) {
        low_seen_ = now;
        draining_until_ = now + std::min(2 * took, drain_time);
    }
}

// BBR stops for a moment to measure the round trip: nothing is lost, and the bytes wait here.
bool Flight::is_probing(const TcpPath& path, TimePoint now) {
    if (path.window == 0 || path.window > window_of_probe)
        return false;
    if (!probe_began_ || now - *probe_began_ > probe_apart)
        probe_began_ = now;
    return now - *probe_began_ < longest_probe;
}

bool Flight::see(const TcpPath& path, TimePoint now) {
    if (path.sent_again > sent_again_ || is_probing(path, now))
        gap_seen_at_ = now;
    sent_again_ = path.sent_again;
    kernel_queue_ = path.queue;
    kernel_rate_ = path.bytes_per_second;
    return std::exchange(behind_gap_, path.behind_gap) < path.behind_gap;
}

void Flight::learn(double bytes, const Chunk& newest, Duration took, TimePoint now) {
    const bool was_behind_gap = gap_seen_at_ && newest.sent <= *gap_seen_at_;
    const Duration queued =
        was_behind_gap ? std::min(kernel_queue_, took - round_trip()) : took - round_trip();
    if (queued > jitter) {
        // The queue of a chunk that met an empty path began after the last answer.
        const double busy = to_seconds(std::min(now - last_answer_, queued));
        // Bytes behind a gap are taken at once, however slowly they came.
        learn_rate(was_behind_gap ? kernel_rate_ * busy : bytes, busy, now);
    } else if (newest.held_back) {
        // It was held back and met no queue: the path carries more than the measured rate.
        if (busy_seconds_ > 0)
            busy_bytes_ += growth * bytes;
        else
            window_at_first_ += bytes;
    }
}

void Flight::learn_rate(double bytes, double busy_seconds, TimePoint now) {
    const double kept = std::exp(-busy_seconds / memory_s);
    busy_bytes_ = busy_bytes_ * kept + bytes;
    busy_seconds_ = busy_seconds_ * kept + busy_seconds;
    // A peer that paused for seconds must not weigh so much that the rate also stays low for
    // seconds after the pause.
    if (const double scale = busy_time_s / busy_seconds_; scale < 1) {
        busy_bytes_ *= scale;
        busy_seconds_ = busy_time_s;
    }
    busy_at_ = now;
}

Duration Flight::round_trip() const {
    const Duration shortest = std::min(shortest_now_, shortest_before_);
    return shortest == Duration::max() ? Duration(0) : shortest;
}

double Flight::bytes_per_second(TimePoint now) const {
    return busy_seconds_ > 0 && now - busy_at_ < rate_validity ? rate() : 0;
}

double Flight::window(TimePoint now) const {
    if (busy_seconds_ <= 0)
        return window_at_first_;
    const double seconds = now < draining_until_ ? drain_share * to_seconds(round_trip())
                                                 : to_seconds(round_trip() + allowed_queue(rate()));
    return std::max(smallest_window, rate() * seconds);
}

bool Flight::may_send(TimePoint now) {
    if (!answering_)
        return true;
    const bool may = double(bytes_in_network()) < window(now);
    held_back_ = held_back_ || !may;
    return may;
}

bool Flight::may_send_interaction(TimePoint now) const {
    return !answering_ || double(bytes_in_network()) < window(now) + interaction_reserve;
}

Duration Flight::allowed_queue(double bytes_per_second) {
    if (bytes_per_second > decoders_bytes_per_second)
        return longest_queue;
    return std::clamp(seconds_to_duration(queue_s + queue_bytes / bytes_per_second), shortest_queue,
                      longest_queue);
}

std::size_t Flight::chunk_size() const {
    if (busy_seconds_ <= 0)
        return wire::usual_chunk_size;
    return std::size_t(
        std::clamp(rate() * chunk_s, double(smallest_chunk), double(wire::usual_chunk_size)));
}

std::size_t Flight::unsent_limit() const {
    if (busy_seconds_ <= 0)
        return largest_unsent;
    return std::size_t(
        std::clamp(rate() * unsent_s, double(smallest_unsent), double(largest_unsent)));
}

Duration Flight::take_delay(TimePoint now) {
    const auto media = std::find_if(chunks_.begin(), chunks_.end(),
                                    [](const Chunk& chunk) { return chunk.is_media; });
    if (answering_ && media != chunks_.end())
        delay_ = std::max(delay_, now - media->queued);
    // An answer takes about half of the round trip to come back.
    return std::max(std::exchange(delay_, Duration(0)) - round_trip() / 2, Duration(0));
}

}  // namespace theatron::net
