// SPDX-License-Identifier: Apache-2.0
// Tells if two sets of texts may name the same patient. A case is of one patient.
//
// Pure; safe for any bytes.
#pragma once

#include <vector>

#include "cases/dicom_slice.h"

namespace theatron::cases {

// False if they have different numbers; if they have the same one and names differ without equal
// dates of birth, or dates of birth without equal names; if one of them has no number and names or
// dates of birth differ. Only PatientName, PatientBirthDate and PatientID count.
bool may_be_one_patient(const std::vector<Identifier>& a, const std::vector<Identifier>& b);

}  // namespace theatron::cases
