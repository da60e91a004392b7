// SPDX-License-Identifier: Apache-2.0
// The description of the images in a DICOM file: their size and place, and how stored values become
// measured ones. Pure, safe for any bytes.
#pragma once

#include "cases/dicom_elements.h"
#include "cases/dicom_slice.h"
#include "cases/foreign_answer.h"

namespace theatron::cases {

struct StoredBits {
    int allocated = 16, stored = 16, high = 15;
    bool is_signed = false;
};

// Measured values out of a table (Modality LUT): the one of `first` and those that follow.
struct ValueTable {
    int first = 0;
    std::vector<int> values;  // empty: there is none
    int value_of(int stored) const;
};

struct DicomImage {
    Answer what = Answer::no_image;  // `content`, or why there is nothing to show
    int columns = 0, rows = 0, frames = 1;
    StoredBits bits;
    ValueTable table;
    DicomSlice common;  // what all frames have
    // The "functional groups" of images with many frames: for all, and for each.
    std::vector<DicomSet> of_all, of_each;
};

DicomImage describe_image(const DicomFile& file);

// A frame without its samples: place, scale and window; a problem where they hold no numbers.
DicomSlice describe_frame(const DicomFile& file, const DicomImage& image, int frame);

// Takes stored values, which have not been shifted or masked yet, over into the slice.
void take_samples(const DicomImage& image, const StoredBits& bits, std::vector<int>& raw,
                  DicomSlice& slice);

}  // namespace theatron::cases
