// SPDX-License-Identifier: Apache-2.0
// WAV files of 16 bits at the sample rate of voice, mono unless stated.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/bytes.h"

namespace theatron::sound {

inline constexpr std::size_t wav_head_size = 44;

// The head of a file with `data_size` bytes of samples.
Bytes wav_head(std::uint32_t data_size, int channels = 1);
Bytes wav_bytes(std::span<const std::int16_t> samples);
// A program that writes WAV to a pipe cannot go back to state the size: where a file states 0
// bytes of samples and others than further chunks follow, it gets the size of all that follows.
void mend_streamed_wav(Bytes& wav);
// The samples of a file with such a head, which is not checked.
std::vector<std::int16_t> samples_of_wav(ByteView file);

}  // namespace theatron::sound
