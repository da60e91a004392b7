// SPDX-License-Identifier: Apache-2.0
#include "capture/av_input.h"

#include <unistd.h>

#include <cerrno>
#include <new>

namespace theatron::capture {

AvInput::AvInput(int descriptor) : descriptor_(descriptor) {
    constexpr int buffer_bytes = 64 << 10;
    auto* buffer = static_cast<unsigned char*>(av_malloc(buffer_bytes));
    context_ =
        buffer ? avio_alloc_context(buffer, buffer_bytes, 0, this, read, nullptr, seek) : nullptr;
    if (!context_)
        throw std::bad_alloc();
}

AvInput::~AvInput() {
    // libavformat may have replaced the buffer.
    av_freep(&context_->buffer);
    avio_context_free(&context_);
}

int AvInput::read(void* self, std::uint8_t* out, int size) {
    auto& input = *static_cast<AvInput*>(self);
    const ssize_t count = pread(input.descriptor_, out, std::size_t(size), input.place_);
    if (count <= 0)
        return count == 0 ? AVERROR_EOF : AVERROR(errno);
    input.place_ += count;
    return int(count);
}

std::int64_t AvInput::seek(void* self, std::int64_t offset, int whence) {
    auto& input = *static_cast<AvInput*>(self);
    const auto size = [&] { return lseek(input.descriptor_, 0, SEEK_END); };
    if (whence == AVSEEK_SIZE)
        return size();
    const std::int64_t from = whence == SEEK_SET ? 0 : whence == SEEK_CUR ? input.place_ : size();
    std::int64_t place;
    if (__builtin_add_overflow(from, offset, &place) || place < 0)
        return AVERROR(EINVAL);
    return input.place_ = place;
}

void check_av_memory(int result) {
    if (result == AVERROR(ENOMEM))
        throw std::bad_alloc();
}

}  // namespace theatron::capture
