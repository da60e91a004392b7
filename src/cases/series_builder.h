// SPDX-License-Identifier: Apache-2.0
// From single DICOM images to one volume. Pure: no files, no library.
#pragma once

#include <string>
#include <vector>

#include "cases/dicom_slice.h"
#include "medical/volume.h"

namespace theatron::cases {

struct BuiltSeries {
    medical::Volume volume;
    std::vector<int> missing_slices;  // numbered from 0; filled with the lowest sample
    std::size_t repeated = 0;         // images that were there twice, and are taken once
    std::string problem;              // a sentence; empty if `volume` holds
};

// Sorts images of one series by their places and puts them together. Refuses, with a sentence,
// mixed orientations, sizes, spacings and scales, two different images at one place, and distances
// that are no whole number of slices. A tilted gantry gives a sheared volume. `slices` loses its
// samples.
BuiltSeries build_series(std::vector<DicomSlice>& slices);

}  // namespace theatron::cases
