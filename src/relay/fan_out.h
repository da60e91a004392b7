// SPDX-License-Identifier: Apache-2.0
// Chooses the frames that a relay sends to each of its receivers. It reads headers alone: the
// payloads are sealed.
//
// A receiver begins with the newest key frame and the frames of layer 0 since, as fast as its link
// takes them, then gets live frames up to its highest layer. One whose link lost a frame begins
// with the next key frame. A key frame is asked for only where that chain is older than chain_age.
//
// A pure state machine; time is passed in.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <vector>

#include "base/ids.h"
#include "base/time.h"
#include "net/outbox.h"
#include "session/key_requests.h"
#include "session/layer_gate.h"
#include "wire/control.h"
#include "wire/media_header.h"

namespace theatron::relay {

class FanOut {
public:
    // The oldest chain with which a receiver begins.
    static constexpr Duration chain_age = std::chrono::seconds(2);
    // Between two key frames of a stream that are asked for; longer where key frames would be more
    // than key_share of the stream's bytes.
    static constexpr Duration key_interval = std::chrono::seconds(2);
    static constexpr double key_share = 0.05;
    static constexpr Duration longest_key_interval = std::chrono::seconds(6);
    // A longer chain of a setting is forgotten.
    static constexpr std::size_t max_chain_frames = 120;
    static constexpr std::size_t max_chain_bytes = std::size_t(32) << 20;

    // The connections of the receivers.
    struct Port {
        std::function<net::Outbox::Pushed(ParticipantId, net::Media)> send;
        std::function<bool(ParticipantId, StreamId)> is_behind;  // as net::Outbox
    };
    explicit FanOut(Port port) : port_(std::move(port)) {}

    // By receiver: the settings that it gets, and the highest layer of each.
    using Wishes = std::map<ParticipantId, std::map<SettingId, int>>;
    void set_wishes(Wishes wishes, TimePoint now);
    // The receiver is connected now, or no longer.
    void come(ParticipantId receiver, TimePoint now);
    void leave(ParticipantId receiver) { receivers_.erase(receiver); }
    // A frame of the host, `message` with this header.
    void on_media(const wire::MediaHeader& header, std::shared_ptr<const Bytes> message,
                  TimePoint now);
    // Frames of the host were lost on the way to here.
    void on_lost();
    // A frame has begun to leave to this receiver: more may follow.
    void on_left(ParticipantId receiver);
    // The key frames to ask the host for.
    std::vector<session::KeyRequests::Key> take_keys(TimePoint now);

    std::size_t receivers() const { return receivers_.size(); }
    std::size_t cached_bytes() const;

private:
    struct Frame {
        wire::MediaHeader header;
        std::shared_ptr<const Bytes> message;
    };
    // A key frame and all frames of layer 0 since.
    struct Chain {
        std::deque<Frame> frames;  // empty: there is none
        std::size_t bytes = 0;
        TimePoint begun;
        std::uint64_t number = 0;  // grows with each key frame
        // For the share of key frames.
        StreamId stream{};
        double bytes_per_second = 0;
        TimePoint newest;
        bool has_come = false;
        void clear() {
            frames.clear();
            bytes = 0;
        }
    };
    enum class State { waits, catches_up, live };
    struct Stream {
        State state = State::waits;
        std::uint64_t chain = 0;  // that it catches up with
        std::size_t next = 0;     // frame of it
    };
    struct Receiver {
        session::LayerGate gate;
        std::map<SettingId, Stream> streams;
    };

    void note(Chain& chain, const wire::MediaHeader& header, std::shared_ptr<const Bytes> message,
              TimePoint now);
    bool push(ParticipantId id, Stream& stream, const Frame& frame);
    void begin(ParticipantId id, Receiver& receiver, SettingId setting, TimePoint now);
    void catch_up(ParticipantId id, Receiver& receiver, SettingId setting);
    void ask(SettingId setting) { asked_.insert(setting); }
    Duration interval_of(const Chain& chain) const;

    const Port port_;
    Wishes wishes_;
    std::map<ParticipantId, Receiver> receivers_;  // that are connected
    std::map<SettingId, Chain> chains_;
    std::set<SettingId> asked_;                // key frames that somebody waits for
    std::map<SettingId, TimePoint> asked_at_;  // of the host
};

}  // namespace theatron::relay
