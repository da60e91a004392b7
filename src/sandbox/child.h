// SPDX-License-Identifier: Apache-2.0
// The parent's side of a sandbox: a child process that reads foreign bytes.
//
// A compromised child can only end or be ended; the caller then gets an Error, one sentence.
// Output of the child is as untrusted as its input: messages have at most max_message_bytes,
// and the shared memory may change while it is read, so copy first and check the copy. One
// thread at a time.
#pragma once

#include <sys/types.h>

#include <span>
#include <string>

#include "base/bytes.h"
#include "sandbox/limits.h"

namespace theatron::sandbox {

class Child {
public:
    // Starts the reader of this name (run_as_child()) on `input`, an open descriptor owned by the
    // caller. `subject` is its source within a sentence, as "the file '/a/b'". Throws Error.
    Child(const std::string& reader, int input, std::string subject, const Limits& limits = {});
    ~Child();  // ends the child
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    // Throws Error if the child has ended.
    void send(ByteView message);

    // The child's next message, valid until the next call. Throws Error if the child ended, or was
    // ended because no message came in time.
    ByteView receive();

    // Waits at most `timeout`; true if receive() would return or throw at once.
    bool wait(Duration timeout);

    // The shared memory. The child may write to it at any time.
    ByteView area() const { return area_; }

    // Ends the child because of output that a correct reader never sends, and throws. `what` as in
    // "a picture of 7 GB".
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
    std::string problem_;  // set once the child has ended
};

}  // namespace theatron::sandbox
