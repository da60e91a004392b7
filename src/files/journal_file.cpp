// SPDX-License-Identifier: Apache-2.0
#include "files/journal_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/error.h"

namespace theatron::files {

JournalFile::JournalFile(std::filesystem::path path) : path_(std::move(path)) {
    file_ =
        open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW | O_NOCTTY, 0600);
    if (file_ < 0)
        refuse("open");
    if (flock(file_, LOCK_EX | LOCK_NB) != 0) {
        const bool is_used = errno == EWOULDBLOCK;
        const int error = errno;
        close(file_);
        if (is_used)
            throw Error("Another program writes '" + path_.string() +
                        "' at the moment; end it first.");
        errno = error;
        refuse("lock");
    }
    // The name of a new file is durable only after its folder has been synchronised.
    const auto parent = path_.parent_path();
    const int folder =
        open(parent.empty() ? "." : parent.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const bool is_durable = folder >= 0 && fsync(folder) == 0;
    const int error = errno;
    if (folder >= 0)
        close(folder);
    if (!is_durable) {
        close(file_);
        errno = error;
        refuse("make");
    }
}

JournalFile::~JournalFile() {
    close(file_);
}

std::string JournalFile::text(std::size_t max_bytes) const {
    struct stat info {};
    if (fstat(file_, &info) != 0)
        refuse("read");
    if (!S_ISREG(info.st_mode) || std::size_t(info.st_size) > max_bytes)
        throw Error("'" + path_.string() + "' is no journal: it is no file of at most " +
                    std::to_string(max_bytes) + " bytes.");
    std::string text(std::size_t(info.st_size), '\0');
    std::size_t size = 0;
    while (size < text.size()) {
        const ssize_t count = pread(file_, text.data() + size, text.size() - size, off_t(size));
        if (count < 0 && errno == EINTR)
            continue;
        if (count < 0)
            refuse("read");
        if (count == 0)
            break;
        size += std::size_t(count);
    }
    text.resize(size);
    return text;
}

void JournalFile::keep(std::size_t bytes) {
    if (ftruncate(file_, off_t(bytes)) != 0 || fsync(file_) != 0)
        refuse("change");
}

void JournalFile::append(std::string_view line) {
    // Otherwise the lines would go into a file that nobody finds.
    struct stat info {};
    if (fstat(file_, &info) != 0)
        refuse("write to");
    if (info.st_nlink == 0)
        throw Error("'" + path_.string() + "' was deleted while it was written; put it back.");
    while (!line.empty()) {
        const ssize_t count = write(file_, line.data(), line.size());
        if (count < 0 && errno == EINTR)
            continue;
        if (count < 0)
            refuse("write to");
        line.remove_prefix(std::size_t(count));
    }
    if (fdatasync(file_) != 0)
        refuse("write to");
}

void JournalFile::refuse(const char* what) const {
    throw Error(std::string("Cannot ") + what + " '" + path_.string() +
                "': " + std::strerror(errno) + ".");
}

}  // namespace theatron::files
