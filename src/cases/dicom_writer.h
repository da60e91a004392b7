// SPDX-License-Identifier: Apache-2.0
// Writes one DICOM image: CT, grey, 16 bits, uncompressed (explicit VR, little-endian).
//
// For generated cases and tests. Equal arguments give equal bytes on every machine: there are no
// dates and no random numbers in it.
#pragma once

#include <string>

#include "base/bytes.h"
#include "cases/dicom_slice.h"

namespace theatron::cases {

struct DicomTexts {
    std::string instance_uid, study_uid, series_description, patient_name, patient_id;
    std::string birth_date, birth_name;  // of the patient; empty: not in the file
    int instance = 1;                    // its number in the series
};

// The samples of `slice` are stored as they are, signed. It must have a place.
Bytes write_dicom(const DicomSlice& slice, const DicomTexts& texts);

}  // namespace theatron::cases
