// SPDX-License-Identifier: Apache-2.0
// Input from an open descriptor, for libavformat. Only for code that runs in a sandbox.
#pragma once

extern "C" {
#include <libavformat/avformat.h>
}

#include <sys/types.h>

#include <cstdint>

namespace theatron::capture {

class AvInput {
public:
    // `descriptor` is owned by the caller. Throws std::bad_alloc.
    explicit AvInput(int descriptor);
    ~AvInput();
    AvInput(const AvInput&) = delete;

    AVIOContext* context() { return context_; }

private:
    static int read(void* self, std::uint8_t* out, int size);
    static std::int64_t seek(void* self, std::int64_t offset, int whence);

    int descriptor_;
    off_t place_ = 0;
    AVIOContext* context_ = nullptr;
};

// Throws std::bad_alloc if this result of libavformat or libavcodec says that memory is short,
// which must not be reported as a damaged file.
void check_av_memory(int result);

}  // namespace theatron::capture
