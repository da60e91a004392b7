// SPDX-License-Identifier: Apache-2.0
#include "sound/wav_bytes.h"

#include <algorithm>
#include <string_view>

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

void mend_streamed_wav(Bytes& wav) {
    constexpr std::size_t first_chunk = 12, chunk_head = 8;
    const auto is_called = [&](std::size_t at, std::string_view name) {
        return std::ranges::equal(ByteView(wav).subspan(at, name.size()), as_bytes(name));
    };
    // The place behind the chunks from there on that say their size; beyond the end: they do not
    // end with the file.
    const auto next = [&](std::size_t at) {
        const std::size_t size = load_le<std::uint32_t>(wav.data() + at + 4);
        return at + chunk_head + size + size % 2;
    };
    for (std::size_t at = first_chunk; at + chunk_head < wav.size(); at = next(at)) {
        if (!is_called(at, "data"))
            continue;
        const std::size_t samples = at + chunk_head;
        if (next(at) != samples)
            return;
        // Chunks that follow are no samples.
        std::size_t end = samples;
        while (end + chunk_head <= wav.size())
            end = next(end);
        const std::size_t size = std::min<std::size_t>(wav.size() - samples, ~std::uint32_t(0));
        if (end != wav.size())
            store_le(wav.data() + at + 4, std::uint32_t(size));
        return;
    }
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
