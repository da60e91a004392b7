// SPDX-License-Identifier: Apache-2.0
#include "cases/exchanged_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/error.h"
#include "cases/quoted_path.h"

namespace theatron::cases {

ExchangedFile::ExchangedFile() : memory_(memfd_create("theatron", MFD_CLOEXEC)) {
    if (!memory_.is_open())
        throw Error("Cannot make the memory that a reader reads from.");
}

void ExchangedFile::load(const std::filesystem::path& path, std::size_t most) {
    const Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW));
    if (!file.is_open() || ftruncate(memory_.get(), 0) != 0)
        throw Error("Cannot open " + quoted_path(path) + ": " + std::strerror(errno) + ".");
    buffer_.resize(1 << 20);
    std::size_t done = 0;
    while (true) {
        const ssize_t count = read(file.get(), buffer_.data(), buffer_.size());
        if (count < 0)
            throw Error("Cannot read " + quoted_path(path) + ": " + std::strerror(errno) + ".");
        if (count == 0)
            return;
        // It may grow while it is read.
        if (done + std::size_t(count) > most ||
            pwrite(memory_.get(), buffer_.data(), std::size_t(count), off_t(done)) != count)
            throw Error("Cannot take " + quoted_path(path) + " into memory.");
        done += std::size_t(count);
    }
}

}  // namespace theatron::cases
