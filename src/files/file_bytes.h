// SPDX-License-Identifier: Apache-2.0
// Whole files as bytes. The functions throw Error, one sentence that names the file.
#pragma once

#include <filesystem>

#include "base/bytes.h"

namespace theatron::files {

// Reads a regular file of at most `max_bytes` bytes.
Bytes read_file(const std::filesystem::path& path, std::size_t max_bytes = std::size_t(1) << 30);

// Writes a draft beside `path` and renames it, so that readers never see a partial file.
void write_file(const std::filesystem::path& path, ByteView bytes);

// Throws Error if write_file() could not write there. Call it before long work.
void require_writable(const std::filesystem::path& path);

}  // namespace theatron::files
