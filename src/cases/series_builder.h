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

// Images nearer to one another than this lie at one place.
inline constexpr double same_place_mm = 0.01;

// Why two images cannot belong to one volume: mixed orientations, sizes, spacings, frames of
// reference, as a sentence; empty if they can. An image that names no frame has any.
std::string place_difference(const DicomSlice& a, const DicomSlice& b);

// Sorts images of one series by their places and puts them together. Refuses, with a sentence,
// images that do not belong to one volume, two different ones at one place, and distances that are
// no whole number of slices, or of which there are two. Scales of values that differ become one, of
// which half a step is lost at most. A tilted gantry gives a sheared volume. `slices` loses its
// samples.
BuiltSeries build_series(std::vector<DicomSlice>& slices);

}  // namespace theatron::cases
