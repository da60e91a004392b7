// SPDX-License-Identifier: Apache-2.0
// Decimal numbers of DICOM (PS3.5, 6.2, "DS"): whole, or none. A field that is there and is no
// number is never replaced by a usual value.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "cases/dicom_elements.h"

namespace theatron::cases {

// One component, blanks and zeros at its ends apart. Nothing: no finite number, or one with
// anything behind it, as "1,5".
std::optional<double> dicom_decimal(std::string_view component);

enum class Field { absent, good, bad };

// The first `count` components of a field, text or binary (FL, FD). `bad` where it is there and
// does not hold them.
Field dicom_decimals(const DicomSet& set, DicomTag tag, double* out, int count);

// "has a rescale slope of '1,5', which is no number of DICOM; export it again".
std::string bad_field(const DicomSet& set, DicomTag tag, std::string_view name, int count);

}  // namespace theatron::cases
