// SPDX-License-Identifier: Apache-2.0
// The page's side of its decoding workers, which the page's script starts and joins to this
// program: src/client decodes in the page itself while there are none.
#pragma once

#include <functional>

#include "base/bytes.h"

namespace theatron::client {

struct DecoderPool {
    unsigned count = 0;
    // Hands an encoded message (decoder_messages.h) to a worker; copies it. Replies arrive in
    // order.
    std::function<void(unsigned worker, ByteView message)> post;
    // Set by Decoders while it uses the workers.
    std::function<void(unsigned worker, ByteView message)> on_reply;
};
// The one of this page. `count` and `post` are set before a participant begins.
DecoderPool& decoder_pool();

}  // namespace theatron::client
