// SPDX-License-Identifier: Apache-2.0
// The sending policy towards one peer: chooses the next envelope and drops messages,
// without any socket.
//
// Each class of traffic (wire/envelope.h) has its rule. Acknowledgements go first, and only the
// newest waits. Control is complete and in order; if too much of it waits, all of it is dropped
// and the session's state must be sent again. Voice drops its oldest packets. A new
// state replaces the waiting one with the same key. Media goes last. It waits in short queues, one
// per stream, and the newest frame wins: when a newer frame comes, a waiting frame to which none
// refers is dropped; a broken chain of references is cut at once and continued at the next key
// frame. So a slow peer gets fewer frames, never older ones, and memory is bounded. A peer that
// records gets everything instead, in order and however late, up to a bound of bytes. Content that
// the peer has asked for (organs, images) takes what the others leave: the gaps between pictures,
// and of a link that pictures fill one byte of content_share, so that it always comes to its end.
// Flight limits
// the bytes in flight, a ceiling the bytes per second; all classes except acknowledgements count
// in both.
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <optional>

#include "base/bytes.h"
#include "base/content_hash.h"
#include "base/ids.h"
#include "base/time.h"
#include "net/flight.h"
#include "net/held_pictures.h"
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
    TimePoint queued;  // when it entered the outbox
};

// Figures of sending to one peer since the last call of take_figures().
struct SendingFigures {
    double bytes_per_second = 0;  // rate of the path to the peer; 0 while not known
    Duration round_trip{};        // of the path without queues
    Duration delay{};             // the longest from queued to arrived
    int dropped = 0;              // frames
    std::size_t bytes_on_the_way = 0;
    bool takes_nothing = false;  // bytes are on the way, and the peer has taken none
    bool loses_packets = false;  // the path, by chance (net/loss_watch.h)
};

// Not thread safe.
class Outbox {
public:
    // Frames of one stream that may wait behind the one being sent.
    static constexpr std::size_t max_waiting = 2;
    // Bytes that may wait for a peer for which everything is kept. If they are more, frames are
    // dropped until half of them has left, and each stream continues with a key frame.
    static constexpr std::size_t max_kept_bytes = std::size_t(64) << 20;
    // Bytes of control that may wait for a peer that reads nothing.
    static constexpr std::size_t max_control_bytes = std::size_t(1) << 20;
    // Bytes that a waiting message counts beside its own.
    static constexpr std::size_t control_overhead = 64;
    // States with different keys that may wait; further ones are dropped.
    static constexpr std::size_t max_waiting_states = 1024;
    // Packets of one speaker that may wait, and of all together.
    static constexpr std::size_t max_waiting_voice = 3, max_waiting_voices = 96;
    // The same for a peer for which everything is kept: ten seconds of eight speakers.
    static constexpr std::size_t max_kept_voice = 500, max_kept_voices = 4000;
    // Parts of content that may wait; further ones are dropped, and the peer asks again.
    static constexpr std::size_t max_waiting_content = 4;
    // While pictures wait too, one byte in this number is content.
    static constexpr std::size_t content_share = 8;
    // Longest time in which a peer takes nothing although something waits: see stands_still().
    static constexpr Duration give_up_after = std::chrono::seconds(30);

    // Queues a control envelope (wire::wrap_control). False if there was no room: then this one and
    // all that waited are dropped, and the session's state must be sent to the peer again.
    [[nodiscard]] bool push_control(Bytes envelope);

    void put_acknowledgement(const wire::Acknowledgement& newest) { acknowledgement_ = newest; }
    void put_state(const wire::State& state);
    void push_voice(const wire::Voice& voice);

    // A part of content that the peer has asked for; it leaves in wire::Content messages.
    struct Content {
        ContentHash hash;
        std::shared_ptr<const Bytes> bytes;  // the whole; null: it is not here
        std::uint64_t offset = 0, end = 0;   // within it
    };
    // False, and nothing is queued, if max_waiting_content parts wait.
    bool push_content(Content content);

    struct Pushed {
        int dropped = 0;  // frames, possibly including this one
        // Nothing of this stream is sent before a key frame. True only once until the peer takes
        // something: another key frame would only replace the waiting one.
        bool needs_key = false;
    };
    Pushed push_media(Media media);

    // From now on frames wait in order up to max_kept_bytes, and none replaces another.
    void keep_everything() { keeps_everything_ = true; }

    // Fills `envelope` with the next one to send; false if nothing waits or all is held back.
    // `now`, on a clock that never jumps, is written into a media message as `sent`.
    bool next(Bytes& envelope, TimePoint now);

    // The time to call next() again if the ceiling held something back; empty otherwise.
    // Call next() also after each acknowledge() and push.
    std::optional<TimePoint> ask_again() const { return ask_again_; }

    void acknowledge(const wire::Acknowledgement& word, TimePoint now);

    // As Flight: what the kernel says, before acknowledge() and while the window is full.
    bool see(const TcpPath& path, TimePoint now) { return flight_.see(path, now); }
    bool window_is_full() const { return !idle_ && flight_.is_held_back(); }

    // Bytes that the kernel should keep unsent at most.
    std::size_t unsent_limit() const { return flight_.unsent_limit(); }

    // Limits the rate from now on; 0: no ceiling.
    void set_ceiling(double bytes_per_second) { ceiling_ = bytes_per_second; }

    SendingFigures take_figures(TimePoint now);

    // True if the peer has taken nothing for give_up_after although something waits for it. Call it
    // a few times a second.
    bool stands_still(TimePoint now);
    // Pictures that wait, and the time since the peer took something: see HeldPictures. Call it
    // after stands_still().
    HeldPictures held(TimePoint now) const;

    // True if a frame of the stream waits and has not begun to leave: another frame would only
    // wait behind it. False for a peer for which everything is kept.
    bool is_behind(StreamId stream) const {
        if (keeps_everything_)
            return false;
        const auto lane = lanes_.find(stream);
        return lane != lanes_.end() && !lane->second.waiting.empty();
    }

    bool empty() const {
        return !acknowledgement_ && !interaction_waits() && !sending_ && waiting_ == 0 &&
               content_.empty();
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
    void next_content(Bytes& envelope, TimePoint now);

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
    std::deque<Content> content_;
    std::size_t media_since_content_ = 0;  // bytes, while content waited
    bool keeps_everything_ = false;
    bool full_ = false;  // since the bound was reached, until half has left
    std::uint64_t turn_ = 0;
    std::shared_ptr<const Bytes> sending_;
    TimePoint sending_queued_;
    std::size_t sent_ = 0;  // bytes of sending_ that are out

    // A count that changes whenever the peer takes something; and true while nothing is
    // waiting.
    std::uint64_t moved_ = 0;
    bool idle_ = true;
    std::uint64_t moved_before_ = 0;
    bool has_taken_ = false;  // the peer, since the last take_figures()
    std::optional<TimePoint> still_since_;

    Flight flight_;
    int dropped_ = 0;
    double ceiling_ = 0;
    TimePoint paid_until_;  // when the sent bytes are within the ceiling again
    std::optional<TimePoint> ask_again_;
};

}  // namespace theatron::net
