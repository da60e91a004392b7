// SPDX-License-Identifier: Apache-2.0
#include <lz4.h>
#include <zstd.h>

#include <cassert>

#include "codec/library_codec.h"

namespace theatron::codec {
namespace {

class Zstd final : public ByteCompressor {
public:
    explicit Zstd(int level) : level_(level) {}
    ~Zstd() override { ZSTD_freeCCtx(context_); }
    Zstd(const Zstd&) = delete;
    Zstd& operator=(const Zstd&) = delete;

    std::size_t bound(std::size_t count) const override { return ZSTD_compressBound(count); }
    std::size_t compress(ByteView in, std::span<std::byte> out) override {
        const std::size_t used =
            ZSTD_compressCCtx(context_, out.data(), out.size(), in.data(), in.size(), level_);
        assert(!ZSTD_isError(used));
        return used;
    }

private:
    ZSTD_CCtx* context_ = ZSTD_createCCtx();
    int level_;
};

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

private:
    // LZ4 requires the state to be aligned to 8 bytes.
    std::vector<std::uint64_t> state_ =
        std::vector<std::uint64_t>(std::size_t(LZ4_sizeofState()) / 8 + 1);
};

}  // namespace

std::unique_ptr<ByteCompressor> make_zstd_compressor(int level) {
    return std::make_unique<Zstd>(level);
}
std::unique_ptr<ByteCompressor> make_lz4_compressor() {
    return std::make_unique<Lz4>();
}

}  // namespace theatron::codec
