// SPDX-License-Identifier: Apache-2.0
// What to send next to one peer, and what to drop: the sending policy, apart
// from any socket.
//
// Each class of traffic (wire/envelope.h) has its rule. Acknowledgements go first, and only the
// newest waits. Control is complete and in order; when a peer leaves too much of it waiting, all
// that waits is given up, and the peer must be told everything anew. Of voice the oldest packets
// are given up, of states the newest with a key replaces the one that waits. Media goes last. It
// waits in short queues, one per stream, and the newest frame wins: a frame that any receiver can
// do without is dropped as soon as a newer one comes; a broken chain of references is cut at once
// and taken up again at the next key frame. So a slow peer gets fewer frames, never older ones, and
// memory is bounded. A peer that records is sent everything instead, in order and however late, up
// to a bound of bytes. How much may be on its way at once is up to Flight, how much in a second to
// a ceiling; all classes but acknowledgements count in both.
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <optional>

#include "base/bytes.h"
#include "base/ids.h"
#include "base/time.h"
#include "net/flight.h"
#include "wire/envelope.h"

namespace theatron::net {

// One media message, shared by all peers that get it. The bytes begin with a
// wire::MediaHeader; the fields that the policy needs are repeated here.
struct Media {
    std::shared_ptr<const Bytes> bytes;
    StreamId stream{};
    SettingId setting{};
    FrameNumber frame = 0;
    FrameNumber reference = 0;
    int temporal_layer = 0;
    bool key = false;
    TimePoint queued;  // when it was there to be sent
};

// How sending to one peer goes, since the last time that it was asked for.
struct SendingFigures {
    double bytes_per_second = 0;  // what the way to the peer carries; 0 while not known
    Duration round_trip{};        // the way's own
    Duration delay{};             // the longest from queued to arrived
    int dropped = 0;              // frames given up
    std::size_t bytes_on_the_way = 0;
};

// Not thread safe.
class Outbox {
public:
    // Frames of one stream that may wait behind the one being sent.
    static constexpr std::size_t max_waiting = 2;
    // What may wait for a peer for which everything is kept. When it is full, frames are given up
    // until half of it has left, and each stream goes on with a key frame.
    static constexpr std::size_t max_kept_bytes = std::size_t(64) << 20;
    // More control than this is not kept for a peer that reads nothing.
    static constexpr std::size_t max_control_bytes = std::size_t(1) << 20;
    // What a message costs here besides its bytes.
    static constexpr std::size_t control_overhead = 64;
    // States with different keys that may wait; further ones are left out.
    static constexpr std::size_t max_waiting_states = 1024;
    // Packets of one speaker that may wait, and of all together.
    static constexpr std::size_t max_waiting_voice = 3, max_waiting_voices = 96;
    // Media waits and nothing is taken for so long: the peer should be given up.
    static constexpr Duration give_up_after = std::chrono::seconds(30);

    // Queues a control envelope (wire::wrap_control). False if there was no room: this one and all
    // that waited are gone, and the peer's picture of the session must be sent anew.
    [[nodiscard]] bool push_control(Bytes envelope);

    void put_acknowledgement(const wire::Acknowledgement& newest) { acknowledgement_ = newest; }
    void put_state(const wire::State& state);
    void push_voice(const wire::Voice& voice);

    struct Pushed {
        int dropped = 0;  // frames given up, this one included if need be
        // Nothing of this stream goes out before a key frame. Said once until the peer takes
        // something: another key frame would only replace the one that waits.
        bool needs_key = false;
    };
    Pushed push_media(Media media);

    // From now on frames wait in order up to max_kept_bytes, and none replaces another.
    void keep_everything() { keeps_everything_ = true; }

    // Fills `envelope` with what to send next; false if there is nothing, or media
    // has to wait. `now`, on a clock that never jumps, is written into a media message as `sent`.
    bool next(Bytes& envelope, TimePoint now);

    // When to ask next() again if only the ceiling held something back; otherwise after
    // the next acknowledge() or push.
    std::optional<TimePoint> ask_again() const { return ask_again_; }

    void acknowledge(const wire::Acknowledgement& word, TimePoint now);

    // How much of what has not left yet the kernel should hold at most.
    std::size_t unsent_limit() const { return flight_.unsent_limit(); }

    // At most so much from now on; 0: no ceiling.
    void set_ceiling(double bytes_per_second) { ceiling_ = bytes_per_second; }

    SendingFigures take_figures(TimePoint now);

    // Whether the peer has taken nothing for give_up_after although something waits for it. Ask a
    // few times a second.
    bool stands_still(TimePoint now);

    // A frame of the stream has not begun to leave: another would only wait behind it, and
    // frames are not kept.
    bool is_behind(StreamId stream) const {
        if (keeps_everything_)
            return false;
        const auto lane = lanes_.find(stream);
        return lane != lanes_.end() && !lane->second.waiting.empty();
    }

    bool empty() const {
        return !acknowledgement_ && !interaction_waits() && !sending_ && waiting_ == 0;
    }
    bool control_waits() const { return !control_.empty(); }
    // Counts frames that have begun to leave.
    std::uint64_t begun_frames() const { return turn_; }
    std::size_t waiting_frames() const { return waiting_ + (sending_ ? 1 : 0); }

private:
    struct Lane {
        std::deque<Media> waiting;
        SettingId setting{};
        bool broken = true;  // nothing may be sent but a key frame
        std::uint64_t turn = 0;
        std::optional<std::uint64_t> key_asked_at;  // moved_ then
    };

    Pushed queue(Media media);
    Pushed keep(Media media);
    void wait(Lane& lane, Media media);
    int drop_waiting(Lane& lane);
    Lane* longest_unserved();
    bool below_ceiling(TimePoint now, Duration ahead);
    void pay(std::size_t bytes, TimePoint now);
    bool interaction_waits() const {
        return !control_.empty() || !voice_.empty() || !states_.empty();
    }
    void next_interaction(Bytes& envelope, TimePoint now);
    void next_states(Bytes& envelope);
    void next_chunk(Bytes& envelope, TimePoint now);

    struct Packet {
        ParticipantId speaker{};
        Bytes bytes;
    };
    std::deque<Bytes> control_;
    std::size_t control_bytes_ = 0;
    std::optional<wire::Acknowledgement> acknowledgement_;
    std::deque<Packet> voice_;
    std::map<wire::StateKey, Bytes> states_;  // of those that wait the newest
    wire::StateKey last_state_;               // the one that was sent last
    std::map<StreamId, Lane> lanes_;
    std::size_t waiting_ = 0, waiting_bytes_ = 0;
    bool keeps_everything_ = false;
    bool full_ = false;  // since the bound was reached, until half has left
    std::uint64_t turn_ = 0;
    std::shared_ptr<const Bytes> sending_;
    TimePoint sending_queued_;
    std::size_t sent_ = 0;  // bytes of sending_ that are out

    // What the peer has taken, as a count that only has to change; and whether it took all that
    // was there.
    std::uint64_t moved_ = 0;
    bool idle_ = true;
    std::uint64_t moved_before_ = 0;
    std::optional<TimePoint> still_since_;

    Flight flight_;
    int dropped_ = 0;
    double ceiling_ = 0;
    TimePoint paid_until_;  // when the ceiling has made up for what was sent
    std::optional<TimePoint> ask_again_;
};

}  // namespace theatron::net
