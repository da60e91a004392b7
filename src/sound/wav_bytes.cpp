// SPDX-License-Identifier: Apache-2.0
#include "sound/wav_bytes.h"

#include "voice/packet.h"

namespace theatron::sound {

Bytes wav_head(std::uint32_t data_size, int channels) {
    Bytes head;
    ByteWriter out(head);
    out.put_bytes(as_bytes("RIFF"));
    out.put(std::uint32_t(data_size + wav_head_size - 8));
    out.put_bytes(as_bytes("WAVEfmt "));
    out.put(std::uint32_t(16));
    out.put(std::uint16_t(1));  // PCM
    out.put(std::uint16_t(channels));
    out.put(std::uint32_t(voice::sample_rate));
    out.put(std::uint32_t(voice::sample_rate * 2 * channels));
    out.put(std::uint16_t(2 * channels));
    out.put(std::uint16_t(16));
    out.put_bytes(as_bytes("data"));
    out.put(data_size);
    return head;
}

Bytes wav_bytes(std::span<const std::int16_t> samples) {
    Bytes bytes = wav_head(std::uint32_t(2 * samples.size()));
    ByteWriter out(bytes);
    for (const std::int16_t sample : samples)
        out.put(sample);
    return bytes;
}

std::vector<std::int16_t> samples_of_wav(ByteView file) {
    if (file.size() < wav_head_size)
        return {};
    std::vector<std::int16_t> samples((file.size() - wav_head_size) / 2);
    for (std::size_t i = 0; i < samples.size(); ++i)
        samples[i] = load_le<std::int16_t>(file.data() + wav_head_size + 2 * i);
    return samples;
}

}  // namespace theatron::sound
