// SPDX-License-Identifier: Apache-2.0
// Owns a file descriptor. Only for systems with POSIX files.
#pragma once

#include <unistd.h>

#include <utility>

namespace theatron {

class Descriptor {
public:
    // Takes over `number`; a negative one is none.
    explicit Descriptor(int number) : number_(number) {}
    ~Descriptor() { close(); }
    Descriptor(Descriptor&& other) noexcept : number_(other.release()) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;

    bool is_open() const { return number_ >= 0; }
    int get() const { return number_; }
    // The caller closes it from now on.
    int release() { return std::exchange(number_, -1); }
    // False: the system reports an error, which is in errno. Bytes that were written may be lost
    // then.
    bool close() {
        const int number = release();
        return number < 0 || ::close(number) == 0;
    }

private:
    int number_;
};

}  // namespace theatron
