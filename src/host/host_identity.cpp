// SPDX-License-Identifier: Apache-2.0
#include "host/host_identity.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <sstream>

#include "base/error.h"
#include "base/log.h"
#include "files/private_file.h"
#include "files/state_folder.h"
#include "net/certificate.h"
#include "net/own_addresses.h"

namespace theatron::host {

namespace {

constexpr const char* address_file = "host.address";

}  // namespace

std::filesystem::path default_state_folder() {
    if (auto folder = files::state_folder(); !folder.empty())
        return folder;
    throw Error(
        "Neither XDG_STATE_HOME nor HOME names a folder for the host's key and tokens; name one "
        "with --state.");
}

void check_token(const std::string& token) {
    if (token.size() < least_token_characters)
        throw Error("The join token has " + std::to_string(token.size()) +
                    " characters and could be guessed; give at least " +
                    std::to_string(least_token_characters) +
                    ", or leave it out, and the host makes one.");
    if (!std::ranges::all_of(token, [](char c) {
            return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                   std::string_view("-._~").find(c) != std::string_view::npos;
        }))
        throw Error(
            "A join token is part of a link, so it may hold letters, digits and -._~ only.");
}

std::string read_token(const std::filesystem::path& path) {
    const auto text = files::read_named_file(path, files::Privacy::secret);
    if (!text)
        throw Error("There is no file '" + path.string() + "' with a join token.");
    std::string token;
    std::istringstream(*text) >> token;
    check_token(token);
    return token;
}

std::string load_or_make_token(const std::filesystem::path& folder, const char* name) {
    const auto path = folder / name;
    const auto text = files::read_private_file(path, files::Privacy::secret);
    std::string token;
    std::istringstream(text.value_or("")) >> token;
    if (!token.empty()) {
        // A half token is easier to guess, and nobody's link holds it.
        if (text->find('\n') == std::string::npos)
            throw Error("'" + path.string() +
                        "' is cut off: its line has no end. Copy the file back, or remove it: then "
                        "a new token is made, and links with the old one let nobody in.");
        try {
            check_token(token);
        } catch (const Error& error) {
            throw Error("In '" + path.string() + "': " + error.what());
        }
        return token;
    }
    token = net::random_token();
    files::write_private_file(path, token + "\n");
    if (text)
        log::warning("host",
                     "token file was empty: its token is new, and links with the old one "
                     "no longer let anybody in",
                     {{"file", path.string()}});
    return token;
}

StateLock::StateLock(const std::filesystem::path& folder) {
    files::open_private_folder(folder);
    const std::filesystem::path path = folder / "host.lock";
    file_ = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600);
    if (file_ < 0)
        throw Error("Cannot use '" + path.string() + "': " + std::strerror(errno) + ".");
    char text[32] = "";
    if (flock(file_, LOCK_EX | LOCK_NB) != 0) {
        const int error = errno;
        const bool is_known = pread(file_, text, sizeof(text) - 1, 0) > 0;
        close(file_);
        if (error == EWOULDBLOCK)
            throw Error(
                "Another host" +
                (is_known ? " (process " + std::to_string(std::atoi(text)) + ")" : std::string()) +
                " uses the state folder '" + folder.string() +
                "'; end it, or name another folder with --state.");
        throw Error("Cannot lock '" + path.string() + "': " + std::strerror(error) + ".");
    }
    const int length = std::snprintf(text, sizeof(text), "%d\n", int(getpid()));
    // The number is for people only.
    if (ftruncate(file_, 0) == 0)
        (void)!pwrite(file_, text, std::size_t(length), 0);
}

StateLock::~StateLock() {
    if (file_ >= 0)
        close(file_);
}

bool is_host_running(const std::filesystem::path& folder) {
    const int file = open((folder / "host.lock").c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
    if (file < 0)
        return false;
    const bool is_free = flock(file, LOCK_SH | LOCK_NB) == 0;
    close(file);
    return !is_free;
}

void write_address(const std::filesystem::path& folder, const net::Link& link) {
    net::Link address = link;
    address.token = "none";
    const std::string text = net::format_link(address) + "\n";
    // Where nothing changed, a full disk does not matter.
    if (files::read_private_file(folder / address_file, files::Privacy::readable) != text)
        files::write_private_file(folder / address_file, text);
}

net::Link read_address(const std::filesystem::path& folder, std::optional<files::Owner> owner) {
    const auto text = files::read_private_file(folder / address_file, files::Privacy::readable,
                                               files::max_private_file_bytes, owner);
    if (!text)
        throw Error("No host has run with the state folder '" + folder.string() +
                    "', so its address is not known; start 'theatron host' first, or name its "
                    "folder with --state.");
    std::string word;
    std::istringstream(*text) >> word;
    net::Link link = net::parse_link(word);
    link.token.clear();
    return link;
}

std::string outside_address() {
    const std::vector<std::string> addresses = net::own_addresses(1);
    return addresses.empty() ? "127.0.0.1" : addresses.front();
}

}  // namespace theatron::host
