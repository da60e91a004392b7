// SPDX-License-Identifier: Apache-2.0
// Any bytes: decoding stays inside them. Bytes that are accepted: encoding gives the same again,
// and each of the patient's planes can be cut.
#include <cstdlib>

#include "image/image.h"
#include "medical/slice.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron;
    const ByteView bytes = std::as_bytes(std::span(data, size));
    const Result<medical::Volume> volume = medical::decode_volume(bytes);
    if (!volume)
        return 0;
    const Bytes again = medical::encode_volume(*volume);
    if (!std::equal(again.begin(), again.end(), bytes.begin(), bytes.end()))
        std::abort();
    for (const auto orientation : {medical::Orientation::axial, medical::Orientation::coronal,
                                   medical::Orientation::sagittal}) {
        const medical::SliceRange range = medical::slice_range(volume->grid, orientation);
        const medical::SlicePlane plane =
            medical::slice_plane(volume->grid, orientation, range.last_mm);
        if (plane.size.area() > 1 << 16)
            continue;
        Image<std::int16_t> slice(plane.size);
        medical::reslice(*volume, plane, 0, slice.view());
    }
    return 0;
}
