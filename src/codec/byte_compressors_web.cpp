// SPDX-License-Identifier: Apache-2.0
// A page only decodes: the encoders would be most of these libraries.
#include "codec/library_codec.h"

namespace theatron::codec {

std::unique_ptr<ByteCompressor> make_zstd_compressor(int) {
    return nullptr;
}
std::unique_ptr<ByteCompressor> make_lz4_compressor() {
    return nullptr;
}

}  // namespace theatron::codec
