// SPDX-License-Identifier: Apache-2.0
// The texts of a DICOM file that identify its patient. Only for the process that reads foreign
// files.
#pragma once

#include <vector>

#include "cases/dicom_slice.h"

namespace gdcm {
class DataSet;
}

namespace theatron::cases {

// Bytes as the file has them, at most max_identifiers. Names and numbers of patients in its
// sequences (a directory, other numbers of the patient) follow as OtherPatientNames and
// OtherPatientIDs.
std::vector<Identifier> identifiers_in(const gdcm::DataSet& data);

}  // namespace theatron::cases
