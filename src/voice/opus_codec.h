// SPDX-License-Identifier: Apache-2.0
// Opus for voice (RFC 6716) by libopus: mono, 48 kHz, with in-band forward error correction, and
// nothing to send in silence. The web build has it only where libopus's sources are there.
#pragma once

#include <memory>
#include <span>

#include "base/bytes.h"
#include "voice/playout.h"

struct OpusEncoder;
struct OpusDecoder;

namespace theatron::voice {

// Samples at 48 kHz of one Opus packet; 0 if it is damaged. Safe for untrusted input.
std::size_t samples_in(ByteView opus);

// Both allocate in their constructor only, which ends the program if memory is exhausted.
class Encoder {
public:
    // `frame_ms`: 10 or 20; `bits_per_second`: 6000 to 128 000. `finds_silence`: encode() tells
    // voice and silence apart; otherwise each frame counts as voice.
    explicit Encoder(int frame_ms, int bits_per_second = 32'000, bool finds_silence = true);
    ~Encoder();

    std::size_t frame_samples() const { return frame_samples_; }
    // Encodes one frame of frame_samples() samples, -1 to 1, into `out`, replacing its content.
    // False: the frame is silent, and after the first such frame none needs to be sent until the
    // next true. `out` has a frame in either case.
    bool encode(std::span<const float> frame, Bytes& out);

private:
    struct Free {
        void operator()(OpusEncoder* encoder) const;
    };
    std::unique_ptr<OpusEncoder, Free> encoder_;
    std::size_t frame_samples_;
};

class Decoder : public FrameDecoder {
public:
    Decoder();
    ~Decoder() override;

    bool decode(ByteView opus, std::span<float> out) override;
    bool recover(ByteView next, std::span<float> out) override;
    void conceal(std::span<float> out) override;

private:
    struct Free {
        void operator()(OpusDecoder* decoder) const;
    };
    std::unique_ptr<OpusDecoder, Free> decoder_;
};

}  // namespace theatron::voice
