// SPDX-License-Identifier: Apache-2.0
// The child's side of a sandbox: code that reads foreign bytes with libraries that are not ours.
//
// A program that starts children calls run_as_child() first of all in main(): the child is the same
// program, started again, and ends in there.
#pragma once

#include <optional>
#include <span>

#include "base/bytes.h"
#include "sandbox/limits.h"

namespace theatron::sandbox {

// What a reader has: a descriptor to read from, memory that the parent sees, a channel.
class Inside {
public:
    Inside(int input, std::span<std::byte> area) : input_(input), area_(area) {}

    int input() const { return input_; }
    std::span<std::byte> area() const { return area_; }

    // Waits for the parent's next message, at most max_message_bytes. Nothing: it wants no more.
    std::optional<Bytes> receive();
    void send(ByteView message);

private:
    int input_;
    std::span<std::byte> area_;
};

struct Reader {
    const char* name;
    Profile profile;
    // Runs until receive() gives nothing. std::bad_alloc is told to the parent as too much memory.
    void (*run)(Inside& inside);
};

// In a child: limits itself, runs the reader that the parent named, and does not return. Otherwise
// returns, and Child may be used.
void run_as_child(int argc, char** argv, std::span<const Reader> readers);

}  // namespace theatron::sandbox
