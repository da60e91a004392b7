// SPDX-License-Identifier: Apache-2.0
// Tells files that lack their end, as after a full disk or an aborted copy. Pure, and safe for
// untrusted bytes.
#pragma once

#include <cstdint>

#include "base/bytes.h"

namespace theatron::capture {

// Bytes of a file's beginning that are enough for is_cut_off().
inline constexpr std::size_t cut_off_bytes = 4096;

// True if a Matroska, AVI or Windows Media file of `file_bytes` bytes is shorter than its beginning
// states. False if that states no size, as where the file was written to a pipe.
bool is_cut_off(ByteView beginning, std::uint64_t file_bytes);

// The same of an open file; false if its beginning cannot be read.
bool is_cut_off(int descriptor, std::uint64_t file_bytes);

}  // namespace theatron::capture
