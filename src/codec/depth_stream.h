// SPDX-License-Identifier: Apache-2.0
// A depth codec applied to a stream: selects the reference of each frame, and stores
// the references.
//
// With N temporal layers, each group of 2^(N-1) frames is a small hierarchy:
//
//   layer 2      1     3           5     7
//   layer 1         2                 6
//   layer 0   0              4              8
//
// The first frame of a group refers to the first of the group before, any other frame
// to the most recent frame of a lower layer. A receiver may therefore skip the highest
// layers, which halves or quarters the frame rate, or lose single frames of them, and
// still decodes the rest. Each side stores one reference per layer that is referred
// to. Nothing is allocated after the first few frames.
#pragma once

#include <array>
#include <memory>

#include "base/ids.h"
#include "codec/depth_codec.h"

namespace theatron::codec {

// The layer of the frame at `position` since the last key frame.
int temporal_layer(int layers, std::uint32_t position);

// The place of a frame in its stream, sent beside the encoded bytes.
struct FrameLink {
    FrameNumber frame = 0;
    FrameNumber reference_frame = 0;  // of a key frame: its own number
    int layer = 0;
    bool key = false;
};

struct EncodedDepth : FrameLink {
    std::size_t bytes = 0;
};

// The references stored on one side of a stream.
class StreamReferences {
public:
    explicit StreamReferences(int layers) : layers_(layers) {}

    int layers() const { return layers_; }
    void clear();
    // Null if the frame is not stored.
    const Reference* find(FrameNumber frame) const;
    // The most recent frame of a layer below `layer`, or of layer 0 for layer 0.
    const Reference* most_recent_below(int layer, FrameNumber& frame) const;
    // The storage for a frame of this layer; null if no frame will refer to it.
    Reference* space_for(int layer);
    // Records that the storage now contains `frame` of `layer`, replacing the layer's
    // previous frame.
    void keep(int layer, FrameNumber frame);

private:
    struct Held {
        bool valid = false;
        FrameNumber frame = 0;
        std::uint32_t age_rank = 0;  // larger is more recent
        Reference reference;
    };
    bool is_referred_to(int layer) const { return layers_ == 1 || layer + 1 < layers_; }

    int layers_;
    std::uint32_t kept_ = 0;
    std::array<Held, max_layers> held_;  // by layer
    Reference space_;
};

// Encodes the frames of one camera with one setting. Use from one thread at a time.
class DepthStreamEncoder {
public:
    explicit DepthStreamEncoder(const DepthSetting& setting);
    // With a codec made elsewhere, for example one that needs a video library.
    DepthStreamEncoder(std::unique_ptr<DepthCodec> codec, int layers);

    std::size_t max_encoded_size(Size size) const { return codec_->max_encoded_size(size); }

    // As DepthCodec::set_region.
    void set_region(strata::Region region) { codec_->set_region(std::move(region)); }

    // Encodes `depth` into `out` (max_encoded_size bytes). The frame is a key frame if
    // `key` is set, if it is the first, if the image size changed, or if the codec is
    // not temporal. A key frame starts a new group. Frame numbers may have gaps.
    EncodedDepth encode(DepthView depth, FrameNumber frame, bool key, std::span<std::byte> out);

private:
    std::unique_ptr<DepthCodec> codec_;
    StreamReferences references_;
    std::uint32_t position_ = 0;  // since the last key frame
    Size size_;
};

// Decodes the frames of one stream, in order, with gaps. Use from one thread at
// a time.
class DepthStreamDecoder {
public:
    explicit DepthStreamDecoder(const DepthSetting& setting);
    DepthStreamDecoder(std::unique_ptr<DepthCodec> codec, int layers);

    // The size of an encoded image. Safe for untrusted input.
    Result<Size> read_size(ByteView encoded) const { return codec_->read_size(encoded); }

    // Decodes into `out`, whose size must match. Status::missing_reference if the frame
    // referred to was skipped or lost; decoding recovers with a later frame of a lower
    // layer or with a key frame. Safe for untrusted input, `link` included. On failure
    // `out` is unspecified and the references are unchanged.
    Status decode(const FrameLink& link, ByteView encoded, MutableDepthView out);

private:
    std::unique_ptr<DepthCodec> codec_;
    StreamReferences references_;
};

}  // namespace theatron::codec
