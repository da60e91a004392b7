// SPDX-License-Identifier: Apache-2.0
// Answers of the processes that read foreign files: one byte for the result, and the number of
// bytes in the shared memory. Only for this module.
#pragma once

#include <cstdint>

#include "base/bytes.h"
#include "sandbox/inside.h"

namespace theatron::cases {

enum class Answer : std::uint8_t {
    content = 1,       // lies in the shared memory
    content_and_more,  // as content, and there is another one
    end,               // there is no more
    unreadable,        // damaged
    cut_off,           // ends before its pixels do
    lacks,             // triangles that it announces
    more,              // triangles than it announces
    compression,       // in a way that is not known
    too_large,         // for the shared memory, or for a case
    // Not for us: see NotForUs.
    no_image,       // DICOM, but no image
    color,          // not grey
    many_frames,    // several images in one file, without a place of each
    other_samples,  // of a kind that is no grey image's: bits, floating-point numbers
    dose,           // of a radiation, as DICOM
    map,            // of computed values, as DICOM
    segmentation,   // masks or contours, as DICOM
    document,       // a surface as DICOM
    no_dicom,       // other content than the file's name says
    no_picture,     // the same
    no_mesh,        // the same
    no_triangles,   // points, lines, or nothing at all
    extension,      // of glTF, which is needed and not known; its name follows
    property,       // of glTF, whose value cannot be; its name follows
    version,        // of glTF, which is not read; its number follows
    skin,           // of glTF, which would move the corners
    hidden,         // of glTF: all that it has
    // A file beside a glTF file is needed; its name follows. The reader's input has its content
    // when it is asked to go on.
    other_buffer,
    polygons,   // in a format of triangles
    no_places,  // of the corners, but other properties
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
