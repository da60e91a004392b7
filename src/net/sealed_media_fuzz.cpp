// SPDX-License-Identifier: Apache-2.0
// Any bytes as a sealed message: opening stays inside them, and nothing opens that was not sealed.
#include <cstdlib>

#include "net/sealed_media.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron;
    static const Bytes key(net::media_seal_key_size, std::byte{7});
    net::MediaOpener opener;
    opener.add_key(1, key);
    net::MediaOpener::Failure failure{};
    if (opener.open(std::as_bytes(std::span(data, size)), failure))
        std::abort();
    return 0;
}
