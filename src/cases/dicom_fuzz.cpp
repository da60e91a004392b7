// SPDX-License-Identifier: Apache-2.0
// Any bytes as a DICOM file: its elements, what they say about its images, and plain pixels. A
// slice that was read passes on as it is. Packed pixels are a library's, which a sandbox holds.
#include <cstdlib>

#include "cases/dicom_pixels.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron;
    constexpr std::size_t most = 1 << 20;
    constexpr int most_frames = 4;
    const ByteView bytes = std::as_bytes(std::span(data, size));
    const cases::DicomFile file = cases::parse_dicom(bytes, most);
    const cases::DicomImage image = cases::describe_image(file);
    if (!cases::decode_identifiers(cases::encode_identifiers(image.common)))
        std::abort();
    if (file.kind != cases::DicomFile::Kind::good || image.what != cases::Answer::content ||
        file.set.find(cases::pixel_data_tag)->is_open)
        return 0;
    for (int frame = 0; frame < std::min(image.frames, most_frames); ++frame) {
        cases::DicomSlice slice = cases::describe_frame(file, image, frame);
        if (!slice.problem.empty())
            return 0;
        std::vector<int> values;
        cases::StoredBits bits;
        // Large announced sizes cost time and memory, not safety.
        if (std::size_t(image.columns) * std::size_t(image.rows) > most ||
            cases::read_stored_values(file, image, frame, values, bits) != cases::Answer::content)
            return 0;
        cases::take_samples(image, bits, values, slice);
        const Result<cases::DicomSlice> read = cases::decode_dicom_slice(cases::encode(slice));
        if (read && read->samples != slice.samples)
            std::abort();
    }
    return 0;
}
