// SPDX-License-Identifier: Apache-2.0
#include "codec/zstd_codec.h"

#if THEATRON_HAS_ZSTD

#include <zstd.h>
#include <zstd_errors.h>

#include <cassert>

#include "codec/payload_header.h"
#include "codec/planes.h"
#include "codec/remember.h"
#include "codec/rows.h"

namespace theatron::codec {
namespace {

// The header's parameter: how the compressed bytes hold the pixels.
constexpr std::uint8_t plain_layout = 0;   // raw pixels
constexpr std::uint8_t planes_layout = 1;  // planes.h

struct FreeContext {
    void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
    void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
};

class ZstdCodec final : public DepthCodec {
public:
    ZstdCodec(int level, bool delta)
        : compressor_(ZSTD_createCCtx()),
          decompressor_(ZSTD_createDCtx()),
          level_(level),
          delta_(delta) {}

    bool lossless() const override { return true; }
    bool temporal() const override { return delta_; }
    std::size_t max_encoded_size(Size size) const override {
        return payload_header_size + ZSTD_compressBound(2 * size.area());
    }

    std::size_t encode(DepthView depth, const Reference* reference, std::span<std::byte> out,
                       Reference* next) override {
        assert(is_valid(depth.size) && out.size() >= max_encoded_size(depth.size));
        const DepthView before = delta_ ? view_of(reference) : DepthView{};
        put_header({.codec = DepthCodecId::zstd,
                    .delta = before.pixels != nullptr,
                    .parameter = delta_ ? planes_layout : plain_layout,
                    .size = depth.size},
                   out.data());
        scratch_.resize(2 * depth.size.area());
        if (delta_)
            split_planes(depth, before, scratch_);
        else
            copy_rows(depth, scratch_pixels(depth.size));
        const std::size_t used = ZSTD_compressCCtx(
            compressor_.get(), out.data() + payload_header_size, out.size() - payload_header_size,
            scratch_.data(), scratch_.size(), level_);
        assert(!ZSTD_isError(used));
        if (delta_)
            remember(depth, next);
        return payload_header_size + used;
    }

    Result<Size> read_size(ByteView encoded) const override {
        const auto header = read(encoded);
        if (!header)
            return header.error();
        return header->size;
    }

    Status decode(ByteView encoded, const Reference* reference, MutableDepthView out,
                  Reference* next) override {
        const auto header = read(encoded);
        if (!header)
            return header.error();
        if (header->size != out.size)
            return Status::size_mismatch;
        const DepthView before = header->delta ? view_of(reference) : DepthView{};
        if (header->delta && (before.pixels == nullptr || before.size != out.size))
            return Status::missing_reference;

        scratch_.resize(2 * out.size.area());
        if (const Status status = decompress(encoded.subspan(payload_header_size));
            status != Status::ok)
            return status;
        if (header->parameter == planes_layout)
            join_planes(scratch_, before, out);
        else
            copy_rows(scratch_pixels(out.size), out);
        if (delta_)
            remember(out, next);
        return Status::ok;
    }

private:
    static Result<PayloadHeader> read(ByteView encoded) {
        const auto header = read_header(encoded, DepthCodecId::zstd, true, planes_layout);
        if (header && header->delta && header->parameter != planes_layout)
            return Status::malformed;
        return header;
    }

    // One zstd frame of exactly the size of `scratch_`, and nothing after it.
    Status decompress(ByteView compressed) {
        const std::size_t frame_size =
            ZSTD_findFrameCompressedSize(compressed.data(), compressed.size());
        if (ZSTD_isError(frame_size))
            return reason(frame_size);
        if (frame_size != compressed.size())
            return Status::trailing_bytes;
        if (ZSTD_getFrameContentSize(compressed.data(), compressed.size()) != scratch_.size())
            return Status::malformed;
        const std::size_t used =
            ZSTD_decompressDCtx(decompressor_.get(), scratch_.data(), scratch_.size(),
                                compressed.data(), compressed.size());
        if (ZSTD_isError(used))
            return reason(used);
        return used == scratch_.size() ? Status::ok : Status::malformed;
    }
    static Status reason(std::size_t error) {
        return ZSTD_getErrorCode(error) == ZSTD_error_srcSize_wrong ? Status::truncated
                                                                    : Status::malformed;
    }

    MutableDepthView scratch_pixels(Size size) {
        return {reinterpret_cast<std::uint16_t*>(scratch_.data()), size};
    }

    std::unique_ptr<ZSTD_CCtx, FreeContext> compressor_;
    std::unique_ptr<ZSTD_DCtx, FreeContext> decompressor_;
    Bytes scratch_;
    int level_;
    bool delta_;
};

}  // namespace

bool has_zstd() {
    return true;
}
std::unique_ptr<DepthCodec> make_zstd(int level, bool delta) {
    return std::make_unique<ZstdCodec>(level, delta);
}

}  // namespace theatron::codec

#else

namespace theatron::codec {

bool has_zstd() {
    return false;
}
std::unique_ptr<DepthCodec> make_zstd(int, bool) {
    return nullptr;
}

}  // namespace theatron::codec

#endif
