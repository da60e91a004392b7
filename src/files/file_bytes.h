// SPDX-License-Identifier: Apache-2.0
// Whole files as bytes. The functions throw Error, one sentence that names the file.
#pragma once

#include <filesystem>
#include <string_view>

#include "base/bytes.h"

namespace theatron::files {

// Reads a regular file of at most `max_bytes` bytes.
Bytes read_file(const std::filesystem::path& path, std::size_t max_bytes = std::size_t(1) << 30);

// Writes a draft beside `path` and renames it, so that readers never see a partial file. A device
// or a pipe is written as it is.
void write_file(const std::filesystem::path& path, ByteView bytes);

// Throws Error if write_file() could not write there. Call it before long work.
void require_writable(const std::filesystem::path& path);

// Throws Error if `path` is there and may not be replaced.
void require_new(const std::filesystem::path& path, bool overwrite);

// Throws Error if `path` is a file with other content than an earlier output: one that does not
// begin with `beginning`, "a PNG picture" or the like in `kind`. An empty file may be replaced.
void require_own_kind(const std::filesystem::path& path, std::string_view beginning,
                      const char* kind);
inline constexpr std::string_view png_beginning = "\x89PNG";

// Throws Error if the path is a device or a pipe.
void require_plain(const std::filesystem::path& path);

// Throws Error if the two paths name the same file.
void require_other_file(const std::filesystem::path& output, const std::filesystem::path& input);

}  // namespace theatron::files
