// SPDX-License-Identifier: Apache-2.0
// The adaptive jitter buffer of one speaker: packets go in as they arrive, samples come out at the
// pace of the sound card.
//
// The playing delay follows the delays of the last packets: late packets make it longer, punctual
// ones shorter, by time stretching (voice/stretch.h). The same control takes up the difference of
// the clocks of the speaker's and the listener's sound card. A lost frame is taken from the forward
// error correction of the next packet, otherwise concealed by the decoder.
//
// Pure; time is passed in. Not thread safe. Safe for any packets; memory is bounded.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "base/time.h"
#include "voice/packet.h"

namespace theatron::voice {

// Decodes the frames of one speaker, in order. Each function fills `out`, one frame, completely.
class FrameDecoder {
public:
    virtual ~FrameDecoder() = default;
    // False if the bytes are no frame of this length; `out` is then not specified.
    virtual bool decode(ByteView opus, std::span<float> out) = 0;
    // The frame before `next`, from the copy in it or concealed.
    virtual bool recover(ByteView next, std::span<float> out) = 0;
    virtual void conceal(std::span<float> out) = 0;
};

class Playout {
public:
    // Packets that wait; more are not taken.
    static constexpr std::size_t max_waiting_packets = 64;
    // Frames whose delay decides the playing delay: 8 s of 20 ms.
    static constexpr std::size_t remembered_delays = 400;
    static constexpr Duration longest_delay = std::chrono::milliseconds(400);

    // The decoder must outlive this object.
    explicit Playout(FrameDecoder& decoder) : decoder_(decoder) {}

    // A packet has arrived. Those of another frame length than the first begin a new stream.
    void put(const Packet& packet, TimePoint now);

    // Fills `out` with the samples to be heard from `now` on: silence where there is no voice.
    void pull(std::span<float> out, TimePoint now);

    struct Figures {
        std::uint64_t samples = 0;            // of voice that came out, all of the below included
        std::uint64_t concealed = 0;          // samples that the decoder invented
        std::uint64_t recovered = 0;          // samples from forward error correction
        std::uint64_t longest_concealed = 0;  // samples without a received one between them
        std::uint64_t late = 0;               // packets that came after their time
        std::uint64_t stretches = 0;          // periods that were left out or repeated
    };
    const Figures& figures() const { return figures_; }
    // The time that a frame waits at present, and the time that it should, both from the arrival of
    // the quickest packets. The first is 0 while nothing is played.
    Duration delay() const {
        const bool plays = playing_ && delay_known_ && level_db_ > -127;
        return plays ? Duration(std::int64_t(delay_us_)) : Duration{};
    }
    Duration target() const { return target_; }
    // The level of the frame that was decoded last, in dB; -127 while the speaker is silent.
    int level_db() const { return level_db_; }

private:
    struct Waiting {
        Bytes opus;
        bool pauses = false;
        int level_db = -127;
    };
    void begin(std::int64_t number);
    void note_delay(std::int64_t number, TimePoint now);
    void next_block(TimePoint now);
    bool next_frame(std::vector<float>& block);
    void append_concealed(std::vector<float>& block);
    void adjust(std::vector<float>& block, double error_us);
    void skip_to(double delay_us, TimePoint now);
    Duration frame_time() const { return Duration(frame_ms_ * 1000); }
    double ready_us() const { return double(ready_.size() - taken_) * 1e6 / sample_rate; }

    FrameDecoder& decoder_;
    int frame_ms_ = 0;  // 0: no packet yet
    std::size_t frame_samples_ = 0;
    std::map<std::int64_t, Waiting> waiting_;
    std::int64_t newest_ = 0;  // number of a frame, without wrapping
    std::int64_t next_ = 0;    // frame to be decoded next
    bool playing_ = false;     // false until the first frame has waited long enough
    bool pauses_ = false;      // the speaker has said that it is silent
    std::size_t owed_ = 0;     // concealed samples in place of a frame that may still come
    std::vector<float> ready_;
    std::size_t taken_ = 0;               // of ready_
    std::vector<std::int64_t> transits_;  // microseconds, a ring
    std::size_t oldest_transit_ = 0;
    std::int64_t base_us_ = 0;  // the smallest of transits_
    Duration block_time_{};     // of the last pull
    Duration target_ = std::chrono::milliseconds(40);
    double delay_us_ = 0;
    bool delay_known_ = false;
    std::size_t since_stretch_ = 0;  // samples
    std::uint64_t concealed_run_ = 0;
    int level_db_ = -127;
    Figures figures_;
};

}  // namespace theatron::voice
