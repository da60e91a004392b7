// SPDX-License-Identifier: Apache-2.0
#include "codec/depth_stream.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <utility>

namespace theatron::codec {

int temporal_layer(int layers, std::uint32_t position) {
    const std::uint32_t in_group = position % (1u << (layers - 1));
    return in_group == 0 ? 0 : layers - 1 - std::countr_zero(in_group);
}

void StreamReferences::clear() {
    for (Held& held : held_)
        held.valid = false;
}

const Reference* StreamReferences::find(FrameNumber frame) const {
    for (const Held& held : held_) {
        if (held.valid && held.frame == frame)
            return &held.reference;
    }
    return nullptr;
}

const Reference* StreamReferences::most_recent_below(int layer, FrameNumber& frame) const {
    const Held* best = nullptr;
    for (int i = 0; i < std::max(layer, 1); ++i) {
        const Held& held = held_[std::size_t(i)];
        if (held.valid && (best == nullptr || held.age_rank > best->age_rank))
            best = &held;
    }
    if (best == nullptr)
        return nullptr;
    frame = best->frame;
    return &best->reference;
}

Reference* StreamReferences::space_for(int layer) {
    return is_referred_to(layer) ? &space_ : nullptr;
}

void StreamReferences::keep(int layer, FrameNumber frame) {
    if (!is_referred_to(layer))
        return;
    Held& held = held_[std::size_t(layer)];
    held.valid = true;
    held.frame = frame;
    held.age_rank = ++kept_;
    std::swap(held.reference, space_);
}

DepthStreamEncoder::DepthStreamEncoder(const DepthSetting& setting)
    : DepthStreamEncoder(make_depth_codec(setting), setting.layers) {}

DepthStreamEncoder::DepthStreamEncoder(std::unique_ptr<DepthCodec> codec, int layers)
    : codec_(std::move(codec)), references_(layers) {}

EncodedDepth DepthStreamEncoder::encode(DepthView depth, FrameNumber frame, bool key,
                                        std::span<std::byte> out) {
    EncodedDepth result;
    result.frame = result.reference_frame = frame;
    const Reference* reference = nullptr;
    if (!key && codec_->temporal() && depth.size == size_) {
        result.layer = temporal_layer(references_.layers(), position_);
        reference = references_.most_recent_below(result.layer, result.reference_frame);
    }
    result.key = reference == nullptr;
    if (result.key) {
        result.layer = 0;
        references_.clear();
        position_ = 0;
        size_ = depth.size;
    }
    ++position_;
    if (!codec_->temporal()) {
        result.bytes = codec_->encode(depth, nullptr, out, nullptr);
        return result;
    }
    result.bytes = codec_->encode(depth, reference, out, references_.space_for(result.layer));
    references_.keep(result.layer, frame);
    return result;
}

DepthStreamDecoder::DepthStreamDecoder(const DepthSetting& setting)
    : DepthStreamDecoder(make_depth_codec(setting), setting.layers) {}

DepthStreamDecoder::DepthStreamDecoder(std::unique_ptr<DepthCodec> codec, int layers)
    : codec_(std::move(codec)), references_(layers) {}

Status DepthStreamDecoder::decode(const FrameLink& link, ByteView encoded, MutableDepthView out) {
    if (link.layer < 0 || link.layer >= references_.layers() || (link.key && link.layer != 0))
        return Status::malformed;
    const Reference* reference = link.key ? nullptr : references_.find(link.reference_frame);
    if (!link.key && reference == nullptr)
        return Status::missing_reference;

    Reference* space = codec_->temporal() ? references_.space_for(link.layer) : nullptr;
    const Status status = codec_->decode(encoded, reference, out, space);
    if (status != Status::ok)
        return status;
    // No later frame refers to a frame before the key frame.
    if (link.key)
        references_.clear();
    if (codec_->temporal())
        references_.keep(link.layer, link.frame);
    return Status::ok;
}

}  // namespace theatron::codec
