// SPDX-License-Identifier: Apache-2.0
#include "codec/decode_fuzz.h"
#include "codec/simple_codecs.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const auto codec = theatron::codec::make_ans(true);
    theatron::codec::fuzz_depth_codec(*codec, std::as_bytes(std::span(data, size)), false);
    return 0;
}
