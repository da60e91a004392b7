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
};

// Its counterpart.
class ByteDecompressor {
public:
    virtual ~ByteDecompressor() = default;
    // Decompresses all of `in` to exactly out.size() bytes. Safe for untrusted input.
    virtual Status decompress(ByteView in, std::span<std::byte> out) = 0;
};

// Null in the web build, which only decodes. `level` is 1 to 19.
std::unique_ptr<ByteCompressor> make_zstd_compressor(int level);
std::unique_ptr<ByteCompressor> make_lz4_compressor();

// Null if this build does not have the library.
std::unique_ptr<ByteDecompressor> make_zstd_decompressor();
std::unique_ptr<ByteDecompressor> make_lz4_decompressor();

bool has_zstd();
bool has_lz4();

// The two sides of one library.
struct ByteLibrary {
    std::unique_ptr<ByteCompressor> compressor;
    std::unique_ptr<ByteDecompressor> decompressor;
};

// `quantisation_step` is 1 (lossless) to max_quantisation_step. Null without a
// decompressor. Without a compressor the codec must not encode.
std::unique_ptr<DepthCodec> make_library_codec(DepthCodecId id, ByteLibrary library, bool delta,
                                               int quantisation_step);

}  // namespace theatron::codec
