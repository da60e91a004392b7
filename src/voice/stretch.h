// SPDX-License-Identifier: Apache-2.0
// Makes a block of voice shorter or longer by one period, without a change of pitch.
//
// The period is the lag of the best normalised correlation. One period is left out or repeated with
// a linear cross-fade (waveform-similarity overlap-add: W. Verhelst and M. Roelands, ICASSP 1993).
#pragma once

#include <span>
#include <vector>

namespace theatron::voice {

// Periods that are looked for, in samples: 2.5 to 10 ms.
inline constexpr std::size_t min_period = 120, max_period = 480;

struct Period {
    std::size_t samples = 0;  // 0: the block is too short
    double similarity = 0;    // -1 to 1; 1 for a periodic block and for silence
};

// The period at the beginning of a block, at most half of the block.
Period find_period(std::span<const float> block);

// Both change the block's beginning; its first and its last sample stay. `period` is at most half
// of the block.
void leave_out(std::vector<float>& block, std::size_t period);
void repeat(std::vector<float>& block, std::size_t period);

}  // namespace theatron::voice
