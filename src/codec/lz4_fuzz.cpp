// SPDX-License-Identifier: Apache-2.0
#include "codec/decode_fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron::codec;
    static const auto codec = make_depth_codec(parse_depth_setting("lz4:delta=1").setting);
    fuzz_depth_codec(*codec, std::as_bytes(std::span(data, size)), false);
    return 0;
}
