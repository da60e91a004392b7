// SPDX-License-Identifier: Apache-2.0
#include "capture/readable_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/error.h"

namespace theatron::capture {

std::string quoted(const std::filesystem::path& path) {
    return "'" + path.string() + "'";
}

ReadableFile::ReadableFile(const std::filesystem::path& path) {
    // O_NONBLOCK: opening must not wait if the path is a pipe or a device.
    descriptor_ = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK);
    if (descriptor_ < 0 && (errno == ENOENT || errno == ENOTDIR))
        throw Error("There is no file " + quoted(path) + ".");
    if (descriptor_ < 0)
        throw Error("Cannot read " + quoted(path) + ": " + std::strerror(errno) + ".");
    struct stat info {};
    if (fstat(descriptor_, &info) != 0 || !S_ISREG(info.st_mode)) {
        close(descriptor_);
        throw Error(quoted(path) + " is not a file.");
    }
    bytes_ = std::uint64_t(info.st_size);
    // The lock prevents a recording into this file.
    (void)flock(descriptor_, LOCK_SH | LOCK_NB);
}

ReadableFile::~ReadableFile() {
    close(descriptor_);
}

}  // namespace theatron::capture
