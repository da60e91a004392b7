// SPDX-License-Identifier: Apache-2.0
// Depth through general-purpose compressors. The input is the pixels, or with `delta`
// the planes of planes.h; it may be quantised before.
//
// docs/formats/depth_zstd.md and depth_lz4.md specify the bytes.
#pragma once

#include <memory>

#include "codec/depth_codec.h"

namespace theatron::codec {

// A byte compressor with its working memory.
class ByteCompressor {
public:
    virtual ~ByteCompressor() = default;
    // Bytes that always suffice for `count` bytes.
    virtual std::size_t bound(std::size_t count) const = 0;
    // Compresses into `out` of bound(in.size()) bytes; returns the bytes used.
    virtual std::size_t compress(ByteView in, std::span<std::byte> out) = 0;
    // Decompresses all of `in` to exactly out.size() bytes. Safe for untrusted input.
    virtual Status decompress(ByteView in, std::span<std::byte> out) = 0;
};

// Null if this build does not have the library. `level` is 1 to 19.
std::unique_ptr<ByteCompressor> make_zstd_compressor(int level);
std::unique_ptr<ByteCompressor> make_lz4_compressor();

bool has_zstd();
bool has_lz4();

// `quantisation_step` is 1 (lossless) to max_quantisation_step. Null if `compressor`
// is null.
std::unique_ptr<DepthCodec> make_library_codec(DepthCodecId id,
                                               std::unique_ptr<ByteCompressor> compressor,
                                               bool delta, int quantisation_step);

}  // namespace theatron::codec
