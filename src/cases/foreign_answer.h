// SPDX-License-Identifier: Apache-2.0
// Answers of the processes that read foreign files: one byte for the result, and the number of
// bytes in the shared memory. Only for this module.
#pragma once

#include <cstdint>

#include "base/bytes.h"
#include "sandbox/inside.h"

namespace theatron::cases {

enum class Answer : std::uint8_t {
    content = 1,      // lies in the shared memory
    end = 2,          // there is no more
    no_image = 3,     // DICOM, but no image
    unreadable = 4,   // not of the format, or damaged
    cut_off = 5,      // ends before its pixels do
    color = 6,        // not grey
    many_frames = 7,  // several images in one file
    compression = 8,  // in a way that the library does not know
    too_large = 9,    // for the shared memory
    no_scale = 10,    // all values would be the same
};

inline void answer(sandbox::Inside& inside, Answer what, std::size_t bytes = 0) {
    Bytes message(9);
    message[0] = std::byte(what);
    store_le(message.data() + 1, std::uint64_t(bytes));
    inside.send(message);
}

// Copies content into the shared memory and answers; too_large if it does not fit.
inline void answer(sandbox::Inside& inside, Answer what, ByteView content) {
    if (content.size() > inside.area().size())
        return answer(inside, Answer::too_large);
    std::copy(content.begin(), content.end(), inside.area().begin());
    answer(inside, what, content.size());
}
inline void answer(sandbox::Inside& inside, ByteView content) {
    answer(inside, Answer::content, content);
}

}  // namespace theatron::cases
