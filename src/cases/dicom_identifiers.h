// SPDX-License-Identifier: Apache-2.0
// The texts of a DICOM file that identify its patient.
// Pure, safe for any bytes.
#pragma once

#include <vector>

#include "cases/dicom_elements.h"
#include "cases/dicom_slice.h"

namespace theatron::cases {

// Bytes as the file has them, at most max_identifiers. Names and numbers of patients in its
// sequences (a directory, other numbers of the patient) follow as OtherPatientNames and
// OtherPatientIDs.
std::vector<Identifier> identifiers_in(const DicomSet& set);

}  // namespace theatron::cases
