// SPDX-License-Identifier: Apache-2.0
// The state that a host keeps between runs, and its address.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "files/private_file.h"
#include "net/link.h"

namespace theatron::host {

// The default folder of a host's keys and tokens. Throws Error if the environment names no
// folder.
std::filesystem::path default_state_folder();

// A shorter token can be guessed: some hundred a second can be tried.
inline constexpr std::size_t least_token_characters = 16;

// Throws Error for a token that can be guessed or cannot be part of a link.
void check_token(const std::string& token);

// The first word of a file or pipe that other users cannot read. Throws Error.
std::string read_token(const std::filesystem::path& path);

// The token in this file of the folder, made at first use. It outlives the host, so that links stay
// valid after a restart. Only its owner may read it. An empty file gets a new token, and the log
// tells. Throws Error.
std::string load_or_make_token(const std::filesystem::path& folder, const char* name);

// One host at a time uses a state folder. Throws Error, with the process that has it, if another
// host does; also if the folder cannot be used. The lock ends with the object, or the process.
class StateLock {
public:
    explicit StateLock(const std::filesystem::path& folder);
    ~StateLock();
    StateLock(const StateLock&) = delete;
    StateLock& operator=(const StateLock&) = delete;

private:
    int file_ = -1;
};

// True if a host uses this folder now. A host that begins at the same moment may be told so
// wrongly and not start, so ask rarely.
bool is_host_running(const std::filesystem::path& folder);

// Notes the address of the host's links, for 'theatron link'. Throws Error.
void write_address(const std::filesystem::path& folder, const net::Link& link);
// Address and fingerprint of the host that last ran with this folder; no token. Throws Error if
// none has. `owner`: for root, the user that the host runs as.
net::Link read_address(const std::filesystem::path& folder,
                       std::optional<files::Owner> owner = std::nullopt);

// The address of a host that listens on all interfaces: its first outside IPv4 address, or
// 127.0.0.1.
std::string outside_address();

}  // namespace theatron::host
