// SPDX-License-Identifier: Apache-2.0
// The decompressors of library_codec.h, as far as this build has the libraries.
#include "codec/library_codec.h"

#if THEATRON_HAS_ZSTD
#include <zstd.h>
#include <zstd_errors.h>
#endif
#if THEATRON_HAS_LZ4
#include <lz4.h>
#endif

namespace theatron::codec {

#if THEATRON_HAS_ZSTD
namespace {

// Format: one zstd frame that states its content size, and nothing after it.
class Zstd final : public ByteDecompressor {
public:
    Zstd() = default;
    ~Zstd() override { ZSTD_freeDCtx(context_); }
    Zstd(const Zstd&) = delete;
    Zstd& operator=(const Zstd&) = delete;

    Status decompress(ByteView in, std::span<std::byte> out) override {
        const std::size_t frame_size = ZSTD_findFrameCompressedSize(in.data(), in.size());
        if (ZSTD_isError(frame_size))
            return reason(frame_size);
        if (frame_size != in.size())
            return Status::trailing_bytes;
        if (ZSTD_getFrameContentSize(in.data(), in.size()) != out.size())
            return Status::malformed;
        const std::size_t used =
            ZSTD_decompressDCtx(context_, out.data(), out.size(), in.data(), in.size());
        if (ZSTD_isError(used))
            return reason(used);
        return used == out.size() ? Status::ok : Status::malformed;
    }

private:
    static Status reason(std::size_t error) {
        return ZSTD_getErrorCode(error) == ZSTD_error_srcSize_wrong ? Status::truncated
                                                                    : Status::malformed;
    }

    ZSTD_DCtx* context_ = ZSTD_createDCtx();
};

}  // namespace

bool has_zstd() {
    return true;
}
std::unique_ptr<ByteDecompressor> make_zstd_decompressor() {
    return std::make_unique<Zstd>();
}
#else
bool has_zstd() {
    return false;
}
std::unique_ptr<ByteDecompressor> make_zstd_decompressor() {
    return nullptr;
}
#endif

#if THEATRON_HAS_LZ4
namespace {

// Format: one LZ4 block. A block has no end mark; a truncated one is accepted only if
// it still gives all pixels.
class Lz4 final : public ByteDecompressor {
public:
    Status decompress(ByteView in, std::span<std::byte> out) override {
        if (in.size() > std::size_t(LZ4_COMPRESSBOUND(int(out.size()))))
            return Status::trailing_bytes;
        const int used = LZ4_decompress_safe(reinterpret_cast<const char*>(in.data()),
                                             reinterpret_cast<char*>(out.data()), int(in.size()),
                                             int(out.size()));
        return used == int(out.size()) ? Status::ok : Status::malformed;
    }
};

}  // namespace

bool has_lz4() {
    return true;
}
std::unique_ptr<ByteDecompressor> make_lz4_decompressor() {
    return std::make_unique<Lz4>();
}
#else
bool has_lz4() {
    return false;
}
std::unique_ptr<ByteDecompressor> make_lz4_decompressor() {
    return nullptr;
}
#endif

}  // namespace theatron::codec
