// SPDX-License-Identifier: Apache-2.0
// The implementations of library_codec.h, as far as this build has the libraries.
#include <cassert>

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
class Zstd final : public ByteCompressor {
public:
    explicit Zstd(int level) : level_(level) {}
    ~Zstd() override {
        ZSTD_freeCCtx(compressor_);
        ZSTD_freeDCtx(decompressor_);
    }
    Zstd(const Zstd&) = delete;
    Zstd& operator=(const Zstd&) = delete;

    std::size_t bound(std::size_t count) const override { return ZSTD_compressBound(count); }

    std::size_t compress(ByteView in, std::span<std::byte> out) override {
        const std::size_t used =
            ZSTD_compressCCtx(compressor_, out.data(), out.size(), in.data(), in.size(), level_);
        assert(!ZSTD_isError(used));
        return used;
    }

    Status decompress(ByteView in, std::span<std::byte> out) override {
        const std::size_t frame_size = ZSTD_findFrameCompressedSize(in.data(), in.size());
        if (ZSTD_isError(frame_size))
            return reason(frame_size);
        if (frame_size != in.size())
            return Status::trailing_bytes;
        if (ZSTD_getFrameContentSize(in.data(), in.size()) != out.size())
            return Status::malformed;
        const std::size_t used =
            ZSTD_decompressDCtx(decompressor_, out.data(), out.size(), in.data(), in.size());
        if (ZSTD_isError(used))
            return reason(used);
        return used == out.size() ? Status::ok : Status::malformed;
    }

private:
    static Status reason(std::size_t error) {
        return ZSTD_getErrorCode(error) == ZSTD_error_srcSize_wrong ? Status::truncated
                                                                    : Status::malformed;
    }

    ZSTD_CCtx* compressor_ = ZSTD_createCCtx();
    ZSTD_DCtx* decompressor_ = ZSTD_createDCtx();
    int level_;
};

}  // namespace

bool has_zstd() {
    return true;
}
std::unique_ptr<ByteCompressor> make_zstd_compressor(int level) {
    return std::make_unique<Zstd>(level);
}
#else
bool has_zstd() {
    return false;
}
std::unique_ptr<ByteCompressor> make_zstd_compressor(int) {
    return nullptr;
}
#endif

#if THEATRON_HAS_LZ4
namespace {

// Format: one LZ4 block. A block has no end mark; a truncated one is accepted only if
// it still gives all pixels.
class Lz4 final : public ByteCompressor {
public:
    std::size_t bound(std::size_t count) const override {
        return std::size_t(LZ4_compressBound(int(count)));
    }
    std::size_t compress(ByteView in, std::span<std::byte> out) override {
        const int used = LZ4_compress_fast_extState(
            state_.data(), reinterpret_cast<const char*>(in.data()),
            reinterpret_cast<char*>(out.data()), int(in.size()), int(out.size()), 1);
        assert(used > 0);
        return std::size_t(used);
    }
    Status decompress(ByteView in, std::span<std::byte> out) override {
        if (in.size() > bound(out.size()))
            return Status::trailing_bytes;
        const int used = LZ4_decompress_safe(reinterpret_cast<const char*>(in.data()),
                                             reinterpret_cast<char*>(out.data()), int(in.size()),
                                             int(out.size()));
        return used == int(out.size()) ? Status::ok : Status::malformed;
    }

private:
    // LZ4 requires the state to be aligned to 8 bytes.
    std::vector<std::uint64_t> state_ =
        std::vector<std::uint64_t>(std::size_t(LZ4_sizeofState()) / 8 + 1);
};

}  // namespace

bool has_lz4() {
    return true;
}
std::unique_ptr<ByteCompressor> make_lz4_compressor() {
    return std::make_unique<Lz4>();
}
#else
bool has_lz4() {
    return false;
}
std::unique_ptr<ByteCompressor> make_lz4_compressor() {
    return nullptr;
}
#endif

}  // namespace theatron::codec
