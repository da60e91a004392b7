// SPDX-License-Identifier: Apache-2.0
// Damage that FFmpeg's readers of files pass over: no result tells it, only what they log.
#pragma once

#include <cstdint>

namespace theatron::capture {

// From now on, in this process, nothing is printed, and what readers of files call an error is
// counted. FFmpeg must be loaded.
void count_av_complaints();
std::uint64_t av_complaints();

}  // namespace theatron::capture
