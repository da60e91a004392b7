// SPDX-License-Identifier: Apache-2.0
// Keys and tokens: files in a folder that only their owner may read and change. The functions
// throw Error, one sentence that names the file and says what to do.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

namespace theatron::files {

// A longer key or token file is refused.
inline constexpr std::size_t max_private_file_bytes = 64 * 1024;

// Makes the folder and its missing parents, accessible to this user only. Refuses a folder that
// belongs to another user or that others may write into.
void open_private_folder(const std::filesystem::path& folder);

// In both cases only the owner may write. `secret`: only the owner may read.
enum class Privacy { secret, readable };

// For root, which reads and writes files of the user that a service runs as.
struct Owner {
    uid_t user = 0;
    gid_t group = 0;
};

// The text of a file that belongs to this user, root or `owner`; nullopt if there is no file. A
// file of more than `max_bytes` is refused, and what is no file (a pipe would be waited for).
std::optional<std::string> read_private_file(const std::filesystem::path& path, Privacy privacy,
                                             std::size_t max_bytes = max_private_file_bytes,
                                             std::optional<Owner> owner = std::nullopt);

// The same for a file that the user has named. A pipe or a device is read, too, whoever's it is.
std::optional<std::string> read_named_file(const std::filesystem::path& path, Privacy privacy,
                                           std::size_t max_bytes = max_private_file_bytes,
                                           std::optional<Owner> owner = std::nullopt);

// Atomic and durable: after a crash at any time, `path` has its previous content or all of
// `text`. A draft left by a crash is replaced. The file belongs to this user, or to `owner`.
void write_private_file(const std::filesystem::path& path, const std::string& text,
                        std::optional<Owner> owner = std::nullopt);

// Durable, too: after a crash the file does not come back. False if there is none.
bool remove_private_file(const std::filesystem::path& path);

}  // namespace theatron::files
