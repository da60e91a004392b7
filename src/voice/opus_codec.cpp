// SPDX-License-Identifier: Apache-2.0
#include <opus.h>

#include <algorithm>
#include <cassert>
#include <cstdlib>

#include "voice/opus_codec.h"

namespace theatron::voice {
namespace {

// The share of lost packets for which the encoder adds copies of frames to the next ones.
constexpr int expected_loss_percent = 5;
// Opus: a packet of this size or less need not be sent.
constexpr opus_int32 silent_size = 2;

const unsigned char* bytes_of(ByteView view) {
    return reinterpret_cast<const unsigned char*>(view.data());
}

}  // namespace

std::size_t samples_in(ByteView opus) {
    constexpr int most_frames = 48;  // RFC 6716, 3.2.5
    unsigned char table = 0;
    const unsigned char* frames[most_frames];
    opus_int16 sizes[most_frames];
    if (opus.empty() || opus.size() > 48 * max_opus_size ||
        opus_packet_parse(bytes_of(opus), opus_int32(opus.size()), &table, frames, sizes, nullptr) <
            1)
        return 0;
    const int samples =
        opus_packet_get_nb_samples(bytes_of(opus), opus_int32(opus.size()), sample_rate);
    return samples > 0 ? std::size_t(samples) : 0;
}

void Encoder::Free::operator()(OpusEncoder* encoder) const {
    opus_encoder_destroy(encoder);
}

Encoder::Encoder(int frame_ms, int bits_per_second, bool finds_silence)
    : frame_samples_(std::size_t(frame_ms) * sample_rate / 1000) {
    assert(frame_ms == 10 || frame_ms == 20);
    int error = 0;
    encoder_.reset(opus_encoder_create(sample_rate, 1, OPUS_APPLICATION_VOIP, &error));
    if (error != OPUS_OK)
        std::abort();
    opus_encoder_ctl(encoder_.get(), OPUS_SET_BITRATE(bits_per_second));
    opus_encoder_ctl(encoder_.get(), OPUS_SET_SIGNAL(OPUS_SIGNAL_VOICE));
    opus_encoder_ctl(encoder_.get(), OPUS_SET_INBAND_FEC(1));
    opus_encoder_ctl(encoder_.get(), OPUS_SET_PACKET_LOSS_PERC(expected_loss_percent));
    opus_encoder_ctl(encoder_.get(), OPUS_SET_DTX(finds_silence ? 1 : 0));
}

Encoder::~Encoder() = default;

bool Encoder::encode(std::span<const float> frame, Bytes& out) {
    assert(frame.size() == frame_samples_);
    out.resize(max_opus_size);
    const opus_int32 size =
        opus_encode_float(encoder_.get(), frame.data(), int(frame.size()),
                          reinterpret_cast<unsigned char*>(out.data()), opus_int32(out.size()));
    assert(size > 0);
    out.resize(std::size_t(std::max<opus_int32>(size, 1)));
    return size > silent_size;
}

void Decoder::Free::operator()(OpusDecoder* decoder) const {
    opus_decoder_destroy(decoder);
}

Decoder::Decoder() {
    int error = 0;
    decoder_.reset(opus_decoder_create(sample_rate, 1, &error));
    if (error != OPUS_OK)
        std::abort();
}

Decoder::~Decoder() = default;

bool Decoder::decode(ByteView opus, std::span<float> out) {
    return opus_decode_float(decoder_.get(), bytes_of(opus), opus_int32(opus.size()), out.data(),
                             int(out.size()), 0) == int(out.size());
}

bool Decoder::recover(ByteView next, std::span<float> out) {
    return opus_decode_float(decoder_.get(), bytes_of(next), opus_int32(next.size()), out.data(),
                             int(out.size()), 1) == int(out.size());
}

void Decoder::conceal(std::span<float> out) {
    if (opus_decode_float(decoder_.get(), nullptr, 0, out.data(), int(out.size()), 0) !=
        int(out.size()))
        std::fill(out.begin(), out.end(), 0.0f);
}

}  // namespace theatron::voice
