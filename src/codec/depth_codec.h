// SPDX-License-Identifier: Apache-2.0
// The common interface of all depth codecs, and their selection by name.
//
// Most codecs are pairs of pure functions on views (raw.h, rvl.h, …). This interface
// lets a stream, a benchmark or a test use any of them. Names and parameters are those
// of the command line: "rvl", "zstd:delta=1".
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

// The content of an earlier frame that both sides have, as depth or in a form private
// to the codec. Most codecs use `depth` alone.
struct Reference {
    DepthImage depth;
    Bytes memory;
};

// One codec with its parameters. Encoding and decoding depend on the arguments alone;
// the object only holds parameters and scratch memory. One thread at a time.
class DepthCodec {
public:
    virtual ~DepthCodec() = default;

    // True if decoded depth equals the encoded depth, bit by bit.
    virtual bool lossless() const = 0;
    // True if the codec can refer to a reference frame.
    virtual bool temporal() const = 0;
    // Sets the region that stays exact, from the next encoded frame on. Codecs without
    // a bounded error ignore it. Empty: no region. Precondition: strata::is_valid.
    virtual void set_region(strata::Region) {}
    // Bytes that always suffice for an image of this size.
    virtual std::size_t max_encoded_size(Size size) const = 0;

    // Encodes `depth` into `out` (max_encoded_size bytes) and returns the bytes used.
    // `reference` is null for a key frame, else it belongs to an image of the same size.
    // `next` receives the reference for later frames: the depth as the decoder will
    // have it, or the codec's private form. `next` may be null if no frame will refer to
    // this one, and must differ from `reference`. Codecs that are not temporal ignore
    // both.
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

// Codec numbers in the media header. Never reused.
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

// A codec setting, checked, in its canonical spelling.
struct DepthSetting {
    DepthCodecId id = DepthCodecId::trvl;
    std::string text = "trvl";
    int layers = 1;  // temporal layers, 1 to max_layers; see depth_stream.h
    bool operator==(const DepthSetting&) const = default;
};

// A setting, or one sentence for the user on what is wrong with the text.
struct ParsedDepthSetting {
    DepthSetting setting;
    std::string problem;  // empty if `setting` holds
};

// Parses "trvl" or "zstd:delta=1". The problem names the available codecs or the
// wrong parameter.
ParsedDepthSetting parse_depth_setting(std::string_view text);

// Makes the codec of a setting returned by parse_depth_setting.
std::unique_ptr<DepthCodec> make_depth_codec(const DepthSetting& setting);

// All codec names, for help texts, tests and benchmarks.
std::vector<std::string> depth_codec_names();

}  // namespace theatron::codec
