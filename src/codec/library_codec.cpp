// SPDX-License-Identifier: Apache-2.0
#include "codec/library_codec.h"

#include <cassert>

#include "codec/payload_header.h"
#include "codec/planes.h"
#include "codec/quantise.h"
#include "codec/remember.h"
#include "codec/rows.h"

namespace theatron::codec {
namespace {

// The header's parameter: bit 0 = planes, the other bits = quantisation step - 1.
constexpr int max_parameter = 2 * (max_quantisation_step - 1) + 1;

struct Layout {
    bool planes = false;
    int step = 1;
};
constexpr Layout layout_of(std::uint8_t parameter) {
    return {(parameter & 1) != 0, parameter / 2 + 1};
}
constexpr std::uint8_t parameter_of(Layout layout) {
    return std::uint8_t((layout.step - 1) * 2 + (layout.planes ? 1 : 0));
}

class LibraryCodec final : public DepthCodec {
public:
    LibraryCodec(DepthCodecId id, ByteLibrary library, Layout layout)
        : id_(id), library_(std::move(library)), layout_(layout) {}

    bool lossless() const override { return layout_.step == 1; }
    bool temporal() const override { return layout_.planes; }
    std::size_t max_encoded_size(Size size) const override {
        assert(library_.compressor != nullptr);
        return payload_header_size + library_.compressor->bound(2 * size.area());
    }

    std::size_t encode(DepthView depth, const Reference* reference, std::span<std::byte> out,
                       Reference* next) override {
        assert(is_valid(depth.size) && out.size() >= max_encoded_size(depth.size));
        const DepthView before =
            layout_.planes ? levels_of(view_of(reference), layout_.step) : DepthView{};
        put_header({.codec = id_,
                    .delta = before.pixels != nullptr,
                    .parameter = parameter_of(layout_),
                    .size = depth.size},
                   out.data());
        DepthView coded = depth;
        if (layout_.step > 1) {
            levels_.resize(depth.size);
            quantise_rows(depth, layout_.step, levels_.view());
            coded = levels_.view();
        }
        bytes_.resize(2 * depth.size.area());
        if (layout_.planes)
            split_planes(coded, before, bytes_);
        else
            copy_rows(coded, pixels_in_bytes(depth.size));
        const std::size_t used =
            library_.compressor->compress(bytes_, out.subspan(payload_header_size));

        if (layout_.planes && next != nullptr) {
            next->depth.resize(depth.size);
            if (layout_.step > 1)
                restore_rows(levels_.view(), layout_.step, next->depth.view());
            else
                copy_rows(depth, next->depth.view());
        }
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
        const Layout layout = layout_of(header->parameter);
        const DepthView held = header->delta ? view_of(reference) : DepthView{};
        if (header->delta && (held.pixels == nullptr || held.size != out.size))
            return Status::missing_reference;

        bytes_.resize(2 * out.size.area());
        const Status status =
            library_.decompressor->decompress(encoded.subspan(payload_header_size), bytes_);
        if (status != Status::ok)
            return status;
        if (layout.planes)
            join_planes(bytes_, levels_of(held, layout.step), out);
        else
            copy_rows(pixels_in_bytes(out.size), out);
        if (layout.step > 1)
            restore_rows(out, layout.step, out);
        if (layout_.planes)
            remember(out, next);
        return Status::ok;
    }

private:
    Result<PayloadHeader> read(ByteView encoded) const {
        const auto header = read_header(encoded, id_, true, max_parameter);
        if (header && header->delta && !layout_of(header->parameter).planes)
            return Status::malformed;
        return header;
    }

    // Converts the reference to quantisation levels. A restored depth maps to the level
    // that it was restored from.
    DepthView levels_of(DepthView reference, int step) {
        if (reference.pixels == nullptr || step == 1)
            return reference;
        reference_levels_.resize(reference.size);
        quantise_rows(reference, step, reference_levels_.view());
        return reference_levels_.view();
    }

    MutableDepthView pixels_in_bytes(Size size) {
        return {reinterpret_cast<std::uint16_t*>(bytes_.data()), size};
    }

    DepthCodecId id_;
    ByteLibrary library_;
    Layout layout_;
    Bytes bytes_;
    DepthImage levels_;
    DepthImage reference_levels_;
};

}  // namespace

std::unique_ptr<DepthCodec> make_library_codec(DepthCodecId id, ByteLibrary library, bool delta,
                                               int quantisation_step) {
    if (library.decompressor == nullptr)
        return nullptr;
    return std::make_unique<LibraryCodec>(id, std::move(library), Layout{delta, quantisation_step});
}

}  // namespace theatron::codec
