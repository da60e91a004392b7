// SPDX-License-Identifier: Apache-2.0
// The child's side of a sandbox: code that reads foreign bytes with third-party libraries.
//
// A program that starts children calls run_as_child() first in main(). The child is the same
// program, started again, and ends inside that call.
#pragma once

#include <optional>
#include <span>

#include "base/bytes.h"
#include "sandbox/limits.h"

namespace theatron::sandbox {

// The resources of a reader: a descriptor to read from, shared memory, a channel to the parent.
class Inside {
public:
    Inside(int input, std::span<std::byte> area) : input_(input), area_(area) {}

    int input() const { return input_; }
    std::span<std::byte> area() const { return area_; }

    // Waits for the parent's next message, at most max_message_bytes. Nullopt: end of work.
    std::optional<Bytes> receive();
    void send(ByteView message);

private:
    int input_;
    std::span<std::byte> area_;
};

struct Reader {
    const char* name;
    Profile profile;
    // Runs until receive() returns nullopt. std::bad_alloc is reported as too much memory.
    void (*run)(Inside& inside);
    // Opens libraries that `run` needs, before the limits and the system-call filter forbid it.
    void (*prepare)() = nullptr;
};

// In a child: applies the limits, runs the reader that the parent named, and does not return. In
// the parent: returns, and enables Child.
void run_as_child(int argc, char** argv, std::span<const Reader> readers);

}  // namespace theatron::sandbox
