// SPDX-License-Identifier: Apache-2.0
// A decoding worker of a browser's page: receive::Receiver behind messages (decoder_messages.h).
#pragma once

#include <functional>

#include "base/bytes.h"
#include "base/time.h"

namespace theatron::client {

// One for the life of the worker. `reply` gets encoded messages for the page; `clock_difference`
// is the worker's steady clock less that of the page.
void begin_decoder_worker(Duration clock_difference, std::function<void(ByteView)> reply);
// An encoded message of the page.
void on_decoder_work(ByteView message);

}  // namespace theatron::client
