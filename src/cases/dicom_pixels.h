// SPDX-License-Identifier: Apache-2.0
// Stored values of one frame. Packed ones are unpacked with GDCM, which may end the process: only
// for the process that reads foreign files (foreign_files.h), and for tests.
#pragma once

#include <string>
#include <vector>

#include "cases/dicom_image.h"

namespace theatron::cases {

// Why the pixels of a valid file cannot be unpacked, as the end of a sentence; empty if they can.
std::string packing_problem(const DicomFile& file);

// Answer::content, and the stored values as they are, with the bits that count in `bits`; or why
// there are none.
Answer read_stored_values(const DicomFile& file, const DicomImage& image, int frame,
                          std::vector<int>& values, StoredBits& bits);

}  // namespace theatron::cases
