// SPDX-License-Identifier: Apache-2.0
#include "files/file_bytes.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>

#include "base/error.h"

namespace theatron::files {
namespace {

struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Closer>;

[[noreturn]] void refuse(const char* what, const std::filesystem::path& path, const char* why) {
    throw Error("Cannot " + std::string(what) + " '" + path.string() + "': " + why + ".");
}

// False for folders, too.
bool is_device_or_pipe(const std::filesystem::path& path) {
    std::error_code ignored;
    const auto status = std::filesystem::status(path, ignored);
    return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
           !std::filesystem::is_directory(status);
}

}  // namespace

Bytes read_file(const std::filesystem::path& path, std::size_t max_bytes) {
    std::error_code problem;
    const auto status = std::filesystem::status(path, problem);
    if (status.type() == std::filesystem::file_type::not_found)
        refuse("read", path, "there is no such file");
    if (status.type() != std::filesystem::file_type::regular)
        refuse("read", path, problem ? problem.message().c_str() : "it is not a file");
    const auto size = std::filesystem::file_size(path, problem);
    if (problem)
        refuse("read", path, problem.message().c_str());
    if (size > max_bytes)
        refuse("read", path, "it is too large");

    const File file(std::fopen(path.c_str(), "rb"));
    if (!file)
        refuse("read", path, std::strerror(errno));
    Bytes bytes(size);
    if (!bytes.empty() && std::fread(bytes.data(), 1, bytes.size(), file.get()) != bytes.size())
        refuse("read", path, "it ended early");
    return bytes;
}

void write_file(const std::filesystem::path& path, ByteView bytes) {
    const bool in_place = is_device_or_pipe(path);
    std::filesystem::path draft = path;
    if (!in_place)
        draft += ".part";
    File file(std::fopen(draft.c_str(), "wb"));
    if (!file)
        refuse("write", path, std::strerror(errno));
    const bool written =
        bytes.empty() || std::fwrite(bytes.data(), 1, bytes.size(), file.get()) == bytes.size();
    // A full disk may only be reported by fclose().
    const bool closed = std::fclose(file.release()) == 0;
    if (!written || !closed || (!in_place && std::rename(draft.c_str(), path.c_str()) != 0)) {
        const int reason = errno;
        if (!in_place)
            std::remove(draft.c_str());
        refuse("write", path, std::strerror(reason));
    }
}

void require_writable(const std::filesystem::path& path) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored))
        refuse("write", path, "it is a folder");
    const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
    const bool in_place = is_device_or_pipe(path);
    if (access(in_place ? path.c_str() : folder.c_str(), in_place ? W_OK : W_OK | X_OK) != 0)
        refuse("write", path, std::strerror(errno));
}

void require_new(const std::filesystem::path& path, bool overwrite) {
    // A place that cannot be looked at is told when the file is written.
    if (std::error_code ignored; !overwrite && std::filesystem::exists(path, ignored))
        throw Error("'" + path.string() +
                    "' exists already; name another file, or give --overwrite.");
}

void require_own_kind(const std::filesystem::path& path, std::string_view beginning,
                      const char* kind) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored) ||
        std::filesystem::file_size(path, ignored) == 0)
        return;
    std::string found(beginning.size(), '\0');
    const File file(std::fopen(path.c_str(), "rb"));
    if (!file || std::fread(found.data(), 1, found.size(), file.get()) != found.size() ||
        found != beginning)
        throw Error("'" + path.string() + "' exists already and is not " + kind +
                    "; name another file.");
}

void require_plain(const std::filesystem::path& path) {
    if (is_device_or_pipe(path))
        refuse("write", path, "it is a device or a pipe, and would be replaced");
}

void require_other_file(const std::filesystem::path& output, const std::filesystem::path& input) {
    std::error_code ignored;
    if (std::filesystem::equivalent(output, input, ignored))
        throw Error("'" + output.string() +
                    "' is read, so it cannot be written at the same time; "
                    "name another file.");
}

}  // namespace theatron::files
