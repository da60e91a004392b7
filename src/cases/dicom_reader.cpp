// SPDX-License-Identifier: Apache-2.0
// Reads DICOM images, one file after another. Runs in a sandbox: the files are untrusted, and GDCM,
// which unpacks the pixels, is large.
#include <gdcmTrace.h>

#include <algorithm>

#include "cases/dicom_image.h"
#include "cases/dicom_pixels.h"
#include "cases/foreign_answer.h"
#include "cases/foreign_files.h"
#include "cases/foreign_input.h"

namespace theatron::cases {
namespace {

Answer answer_of(DicomFile::Kind kind) {
    switch (kind) {
        case DicomFile::Kind::good:
            return Answer::content;
        case DicomFile::Kind::no_dicom:
            return Answer::no_dicom;
        case DicomFile::Kind::cut_off:
            return Answer::cut_off;
        case DicomFile::Kind::too_large:
            return Answer::too_large;
        case DicomFile::Kind::damaged:
            break;
    }
    return Answer::unreadable;
}

// The frames of one file, in their order. A message asks for the next one.
void send_frames(sandbox::Inside& inside, const DicomFile& file, const DicomImage& image) {
    const int frames = image.common.problem.empty() ? image.frames : 1;
    for (int frame = 0; frame < frames; ++frame) {
        if (frame > 0 && !inside.receive())
            return;
        DicomSlice slice = describe_frame(file, image, frame);
        if (slice.problem.empty())
            slice.problem = packing_problem(file);
        Answer result = Answer::content;
        if (slice.problem.empty()) {
            std::vector<int> values;
            StoredBits bits;
            try {
                result = read_stored_values(file, image, frame, values, bits);
            } catch (const std::bad_alloc&) {
                throw;
            } catch (const std::exception&) {
                result = Answer::compression;
            }
            if (result == Answer::content)
                take_samples(image, bits, values, slice);
        }
        if (result != Answer::content)
            return answer(inside, result, encode_identifiers(slice));
        const bool is_last = frame + 1 == frames || !slice.problem.empty();
        const Bytes encoded = encode(slice);
        answer(inside, is_last ? Answer::content : Answer::content_and_more, encoded);
        if (is_last)
            return;
    }
}

}  // namespace

void serve_dicom(sandbox::Inside& inside) {
    gdcm::Trace::WarningOff();
    gdcm::Trace::ErrorOff();
    while (inside.receive()) {
        const Bytes bytes = bytes_of(inside, max_dicom_file_bytes);
        const DicomFile file = parse_dicom(bytes, max_dicom_file_bytes);
        const DicomImage image = describe_image(file);
        if (file.kind != DicomFile::Kind::good)
            answer(inside, answer_of(file.kind));
        else if (image.what != Answer::content)
            answer(inside, image.what, encode_identifiers(image.common));
        else
            send_frames(inside, file, image);
    }
}

}  // namespace theatron::cases
