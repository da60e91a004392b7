// SPDX-License-Identifier: Apache-2.0
// The parent's side of a sandbox: a child process that reads foreign bytes.
//
// Whatever the child does harms nobody else: it ends itself, or is ended, and the caller gets an
// Error with one sentence. What it says is as foreign as what it reads: messages are at most
// max_message_bytes long, the shared memory may change while it is looked at, so copy first, then
// check. One thread at a time uses a Child.
#pragma once

#include <sys/types.h>

#include <span>
#include <string>

#include "base/bytes.h"
#include "sandbox/limits.h"

namespace theatron::sandbox {

class Child {
public:
    // Starts the reader of this name (run_as_child()) on `input`, an open descriptor that stays the
    // caller's. `subject`: what it reads, within a sentence, as "the file '/a/b'". Throws Error.
    Child(const std::string& reader, int input, std::string subject, const Limits& limits = {});
    ~Child();  // ends it
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    // Throws Error if the child is gone.
    void send(ByteView message);

    // The child's next message, valid until the next call. Throws Error if it ended, or was ended
    // because none came in time.
    ByteView receive();

    // What the child wrote into the shared memory, and may still be writing.
    ByteView area() const { return area_; }

    // Ends the child because it said what no honest one would say. `what` as in "a picture of 7
    // GB".
    [[noreturn]] void refuse(const std::string& what);

    pid_t pid() const { return pid_; }

private:
    ByteView receive_within(Duration patience);
    void allow_more_cpu_time();
    [[noreturn]] void report_end();
    [[noreturn]] void fail(const std::string& what);
    int end();

    std::string subject_;
    Limits limits_;
    pid_t pid_ = -1;
    int channel_ = -1;
    std::span<std::byte> area_;
    Bytes message_;
    int answers_ = 0;
    std::string problem_;  // after the end
};

}  // namespace theatron::sandbox
