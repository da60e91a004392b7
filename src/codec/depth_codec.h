// SPDX-License-Identifier: Apache-2.0
// The family of depth codecs behind one shape, and the choice between them.
//
// Each codec is a pair of pure functions on views (raw.h, rvl.h, …). This file
// names them all, so that a stream, a benchmark or a test can take any of them.
// The names and parameters are those of the command line: "rvl", "zstd:delta=1".
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/bytes.h"
#include "base/status.h"
#include "codec/strata_region.h"
#include "image/image.h"

namespace theatron::codec {

// What a temporal frame refers to: a frame that both sides have, as depth or as
// whatever the codec remembers of it instead. Most codecs use `depth` alone.
struct Reference {
    DepthImage depth;
    Bytes memory;
};

// One codec with its parameters. Encoding and decoding are const and keep no
// state but scratch memory inside the object: use one object per thread.
class DepthCodec {
public:
    virtual ~DepthCodec() = default;

    // True if decoded depth equals what was encoded, bit by bit.
    virtual bool lossless() const = 0;
    // True if the codec makes use of a reference frame.
    virtual bool temporal() const = 0;
    // The part of the image that stays exact from the next encoded frame on, for
    // codecs whose error is bounded outside of it; others leave it alone. Empty
    // while none is drawn. It must be strata::is_valid.
    virtual void set_region(strata::Region) {}
    // Bytes that always suffice for an image of this size.
    virtual std::size_t max_encoded_size(Size size) const = 0;

    // Encodes `depth` into `out` (max_encoded_size bytes) and returns the bytes
    // used. `reference` is null for a key frame; it is of an image of the same
    // size. `next` receives what a later frame needs to refer to this one: the
    // depth as the decoder will have it, or the codec's memory. It may be null where
    // no frame will refer to this one, and may not be `reference`. A codec that
    // is not temporal leaves it alone.
    virtual std::size_t encode(DepthView depth, const Reference* reference,
                               std::span<std::byte> out, Reference* next) = 0;

    // The size of an encoded image. Safe for untrusted input.
    virtual Result<Size> read_size(ByteView encoded) const = 0;

    // Decodes into `out`, whose size must match. `reference` and `next` as in
    // encode; a temporal frame without reference is Status::missing_reference.
    // Safe for untrusted input. On failure `out` and `next` are unspecified.
    virtual Status decode(ByteView encoded, const Reference* reference, MutableDepthView out,
                          Reference* next) = 0;
};

inline constexpr int max_layers = 3;

// Numbers of the codecs in the media header. Never reused.
enum class DepthCodecId : std::uint8_t {
    raw = 1,
    rvl = 2,
    trvl = 3,
    zstd = 4,
    lz4 = 5,
    ans = 6,
    h264 = 7,
    strata = 8,
};

// A codec as a receiver asks for it, checked and in its one spelling.
struct DepthSetting {
    DepthCodecId id = DepthCodecId::trvl;
    std::string text = "trvl";
    int layers = 1;  // temporal layers, 1 to max_layers; see depth_stream.h
    bool operator==(const DepthSetting&) const = default;
};

// A specification understood, or one sentence for the user about what is wrong.
struct ParsedDepthSetting {
    DepthSetting setting;
    std::string problem;  // empty if `setting` holds
};

// Understands "trvl" or "zstd:delta=1". The problem names the codecs there are,
// or the parameter that is wrong.
ParsedDepthSetting parse_depth_setting(std::string_view text);

// Makes the codec of a setting that parse_depth_setting gave.
std::unique_ptr<DepthCodec> make_depth_codec(const DepthSetting& setting);

// Every codec name, for help texts, tests and benchmarks.
std::vector<std::string> depth_codec_names();

}  // namespace theatron::codec
