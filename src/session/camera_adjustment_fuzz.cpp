// SPDX-License-Identifier: Apache-2.0
// Any bytes: decoding stays inside them. An accepted adjustment encodes to bytes that decode to the
// same, and one within its limits gives a finite pose near the registered one.
#include <cmath>
#include <cstdlib>

#include "session/camera_adjustment.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron;
    const auto adjustment = session::decode_adjustment(std::as_bytes(std::span(data, size)));
    if (!adjustment)
        return 0;
    if (session::rounded(*adjustment) != *adjustment || session::text_of(*adjustment).empty())
        std::abort();
    if (!session::is_within_limits(*adjustment, {640, 576}))
        return 0;
    const Pose registered = look_at({1, 2, 3}, {0, 1, 0}, {0, 1, 0});
    const Pose now = session::nudged(registered, *adjustment);
    const Pose back = session::without_nudge(now, *adjustment);
    if (!(length(now.translation - registered.translation) < 0.31) ||
        !(length(back.translation - registered.translation) < 1e-9))
        std::abort();
    return 0;
}
