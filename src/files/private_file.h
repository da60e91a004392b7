// SPDX-License-Identifier: Apache-2.0
// Keys and tokens: files in a folder that only their owner may read and change. Functions throw
// Error with one sentence that names the file and says what to do.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

namespace theatron::files {

// A longer key or token file is refused.
inline constexpr std::size_t max_private_file_bytes = 64 * 1024;

// Makes the folder, and those above it that are missing, for this user alone. Refuses a folder of
// another user or one that others may write into.
void open_private_folder(const std::filesystem::path& folder);

// Nobody but the owner may change either kind; a secret nobody else may read.
enum class Privacy { secret, readable };

// The text of a file that belongs to this user or root. Nothing where no file is.
std::optional<std::string> read_private_file(const std::filesystem::path& path, Privacy privacy);

// After a crash at any moment `path` is as it was before or holds all of `text`; what a crash left
// beside it is replaced.
void write_private_file(const std::filesystem::path& path, const std::string& text);

}  // namespace theatron::files
