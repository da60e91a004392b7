// SPDX-License-Identifier: Apache-2.0
// One DICOM image as its reader, a process of its own, hands it over.
//
// A malicious file may control the reader, so its answers are untrusted: decoding is safe for any
// bytes. Only the fields below pass through. Texts that identify the patient are kept separately.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/bytes.h"
#include "base/status.h"
#include "geometry/vec.h"
#include "medical/volume.h"

namespace theatron::cases {

inline constexpr std::size_t max_dicom_text = 250;   // bytes of a text; a name has three spellings
inline constexpr std::size_t max_identifiers = 255;  // texts that identify
inline constexpr int max_frames = 65'536;            // images in one file
inline constexpr std::size_t max_slice_head = 131072;  // bytes of an encoded slice but its samples

// A text that may identify the patient, under DICOM's name for it ("PatientName").
struct Identifier {
    std::string name, value;
    auto operator<=>(const Identifier&) const = default;
};

// Texts that tell phases and reconstructions of one series apart: see series_parts.h.
inline constexpr std::size_t slice_keys = 10;
inline constexpr std::size_t image_kind_key = 4;  // "ORIGINAL\\PRIMARY\\AXIAL"

struct DicomSlice {
    std::string series_uid, frame_uid, modality;
    // Why the image cannot be shown as the file means it, as the end of a sentence that begins with
    // the file's name. Empty: it can.
    std::string problem;
    std::array<std::string, slice_keys> keys;
    int instance = 0;  // its number in the series
    int columns = 0, rows = 0;
    // Unit vectors along rows and columns, the first pixel's centre, spacing: LPS, millimetres.
    Vec3 right, down, position_mm;
    double column_spacing_mm = 1, row_spacing_mm = 1;
    bool has_place = false;  // orientation, position and spacing were given
    double slope = 1, intercept = 0;
    bool has_window = false;
    bool has_wrong_window = false;  // one is there that cannot be used
    medical::Window window;
    bool inverted = false;      // MONOCHROME1
    bool deidentified = false;  // PatientIdentityRemoved is YES
    std::string charset;        // of the identifiers, before they are decoded
    std::vector<Identifier> identifiers;
    // Stored values, row by row. `lowered`: the file has unsigned values beyond 32767, so 32768
    // was subtracted from all values.
    bool lowered = false;
    // Samples of these values, both included, hold nothing.
    bool has_padding = false;
    int padding_low = 0, padding_high = 0;
    std::vector<std::int16_t> samples;
};

Bytes encode(const DicomSlice& slice);
// Identifiers are in UTF-8 then. A slice with a problem has no columns, rows and samples.
Result<DicomSlice> decode_dicom_slice(ByteView bytes);

// The charset and the identifiers alone, of a file that is no slice.
Bytes encode_identifiers(const DicomSlice& slice);
Result<std::vector<Identifier>> decode_identifiers(ByteView bytes);

}  // namespace theatron::cases
