// SPDX-License-Identifier: Apache-2.0
// Takes apart what devices put into one series: a scout beside the slices, several planes, phases
// and reconstructions. Pure: no files, no library.
#pragma once

#include <string>
#include <vector>

#include "cases/dicom_slice.h"

namespace theatron::cases {

struct SeriesParts {
    std::vector<std::vector<DicomSlice>> parts;  // each may be built as one volume
    std::vector<std::string> remarks;            // sentences on what was left out or taken apart
    std::string problem;  // a sentence: the images make no volume, and there are no parts
};

// Images that differ in direction, size, spacing or frame of reference become parts of their own; a
// single one beside at least three others is left out, as a scout. Several images at one place are
// taken apart by what tells them apart at every place: temporal position, acquisition, echo,
// b-value, kind of image, kernel, trigger time, time (DicomSlice::keys, in this order), or their
// numbers in the series. Where nothing does, they stay together, and build_series() refuses them.
SeriesParts split_series(std::vector<DicomSlice> slices);

}  // namespace theatron::cases
