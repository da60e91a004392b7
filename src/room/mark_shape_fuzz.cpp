// SPDX-License-Identifier: Apache-2.0
// Any bytes that are a mark: it can be drawn.
#include <cmath>
#include <cstdlib>

#include "room/mark_shape.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron;
    const ByteView bytes = std::as_bytes(std::span(data, size));
    const std::optional<session::Mark> mark = session::decode_mark(bytes);
    if (!mark)
        return 0;
    for (const render::LinePiece& piece : room::mark_line(*mark))
        if (!std::isfinite(length(piece.from) + length(piece.to)) || piece.from_radius_m < 0 ||
            piece.to_radius_m < 0)
            std::abort();
    if (room::label_places(*mark).empty())
        std::abort();
    return 0;
}
