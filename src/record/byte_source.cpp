// SPDX-License-Identifier: Apache-2.0
#include "record/byte_source.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/error.h"

namespace theatron::record {
namespace {

class FileSource final : public ByteSource {
public:
    explicit FileSource(const std::filesystem::path& path)
        // Without waiting for a writer, where it is a pipe.
        : file_(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
        struct stat found {};
        if (file_ < 0 || fstat(file_, &found) != 0) {
            const std::string why = std::strerror(errno);
            if (file_ >= 0)
                close(file_);
            throw Error("Cannot open '" + path.string() + "': " + why + ".");
        }
        if (!S_ISREG(found.st_mode)) {
            close(file_);
            throw Error("'" + path.string() + "' is not a file.");
        }
        // The lock keeps other programs from replacing the file; a file that is being recorded is
        // read without a lock.
        (void)flock(file_, LOCK_SH | LOCK_NB);
        size_ = std::uint64_t(found.st_size);
    }
    FileSource(const FileSource&) = delete;
    ~FileSource() override { close(file_); }

    std::uint64_t size() const override { return size_; }

    bool read(std::uint64_t at, std::span<std::byte> out) override {
        if (at > size_ || size_ - at < out.size())
            return false;
        while (!out.empty()) {
            const ssize_t n = pread(file_, out.data(), out.size(), off_t(at));
            if (n < 0 && errno == EINTR)
                continue;
            if (n <= 0)
                return false;
            out = out.subspan(std::size_t(n));
            at += std::uint64_t(n);
        }
        return true;
    }

private:
    int file_;
    std::uint64_t size_ = 0;
};

}  // namespace

std::unique_ptr<ByteSource> open_file_source(const std::filesystem::path& path) {
    return std::make_unique<FileSource>(path);
}

}  // namespace theatron::record
