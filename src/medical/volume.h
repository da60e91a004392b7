// SPDX-License-Identifier: Apache-2.0
// A series of medical images as one block of samples with its place in the patient, and the bytes
// of the volume files of a case (docs/formats/case_volume.md).
//
// Coordinates are DICOM patient coordinates: x to the patient's left, y to the back, z to the head
// (LPS), in millimetres. All functions are pure and safe to call from any thread.
#pragma once

#include <cstdint>
#include <vector>

#include "base/bytes.h"
#include "base/status.h"
#include "geometry/vec.h"

namespace theatron::medical {

inline constexpr int max_volume_side = 4096;
inline constexpr std::size_t max_volume_samples = std::size_t(1) << 29;
inline constexpr double max_coordinate_mm = 1e5;

// Where the samples of a volume lie. A step leads from the centre of a sample to the centre of the
// next one; steps need not be orthogonal (a tilted gantry shears the block).
struct VolumeGrid {
    int columns = 0, rows = 0, slices = 0;
    Vec3 origin_mm;  // the centre of the first sample
    Vec3 column_step_mm, row_step_mm, slice_step_mm;

    bool operator==(const VolumeGrid&) const = default;
    std::size_t size() const {
        return std::size_t(columns) * std::size_t(rows) * std::size_t(slices);
    }
    std::size_t index(int column, int row, int slice) const {
        return (std::size_t(slice) * std::size_t(rows) + std::size_t(row)) * std::size_t(columns) +
               std::size_t(column);
    }
    // The patient coordinates of a place given in samples, fractions included.
    Vec3 point_at(double column, double row, double slice) const {
        return origin_mm + column_step_mm * column + row_step_mm * row + slice_step_mm * slice;
    }
};

// Sizes within the bounds above, finite numbers, steps that span a space.
bool is_valid(const VolumeGrid& grid);

// Converts patient coordinates to samples: the inverse of VolumeGrid::point_at().
class SamplesFromPatient {
public:
    // `grid` must be valid.
    explicit SamplesFromPatient(const VolumeGrid& grid);
    Vec3 point(Vec3 patient_mm) const { return direction(patient_mm - origin_); }
    Vec3 direction(Vec3 patient_mm) const {
        return {dot(rows_[0], patient_mm), dot(rows_[1], patient_mm), dot(rows_[2], patient_mm)};
    }

private:
    Vec3 origin_;
    Vec3 rows_[3];
};

// The smallest box along the patient's axes that holds the centres of all samples.
struct Box {
    Vec3 low_mm, high_mm;
};
Box box_of(const VolumeGrid& grid);

// The values that are shown as the darkest to the brightest grey.
struct Window {
    double center = 40, width = 400;  // width above 0
    bool operator==(const Window&) const = default;
};

struct Volume {
    VolumeGrid grid;
    // The measured value (for CT in Hounsfield units) is slope * sample + intercept.
    double slope = 1, intercept = 0;
    Window window;                      // given by the images
    bool inverted = false;              // MONOCHROME1: the highest value is shown as the darkest
    std::vector<std::int16_t> samples;  // grid.size(); columns first, then rows, then slices
};

inline constexpr std::size_t volume_header_size = 148;

// `volume` must have a valid grid and grid.size() samples.
Bytes encode_volume(const Volume& volume);

// Safe for any bytes: takes no more memory than `bytes` has samples.
Result<Volume> decode_volume(ByteView bytes);

}  // namespace theatron::medical
