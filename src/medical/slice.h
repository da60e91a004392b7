// SPDX-License-Identifier: Apache-2.0
// Slices through a volume in any plane, and the marks around them: the letters of the patient's
// directions and the scale.
//
// All functions are pure and safe to call from any thread. Coordinates are LPS, millimetres.
#pragma once

#include <cstdint>
#include <string>

#include "image/view.h"
#include "medical/volume.h"

namespace theatron::medical {

// A picture's place in the patient.
struct SlicePlane {
    Vec3 top_left_mm;  // the centre of the first pixel
    Vec3 right, down;  // unit vectors, orthogonal
    double mm_per_pixel = 1;
    Size size;

    Vec3 point_at(double column, double row) const {
        return top_left_mm + right * (column * mm_per_pixel) + down * (row * mm_per_pixel);
    }
    Vec3 normal() const { return cross(right, down); }
};

// The pixel (fractions included) whose point is the nearest to `point_mm`.
Vec2 pixel_of(const SlicePlane& plane, Vec3 point_mm);

// The patient's planes. Axial pictures are seen from the feet, coronal ones from the front,
// sagittal ones from the left, as radiologists are used to.
enum class Orientation : std::uint8_t { axial, coronal, sagittal };

// The places that slices of an orientation take along z (axial), y (coronal) or x (sagittal).
struct SliceRange {
    double first_mm = 0, last_mm = 0;
    double step_mm = 1;  // the distance of samples in that direction
    int count = 1;       // of slices from first to last
};
SliceRange slice_range(const VolumeGrid& grid, Orientation orientation);

// The plane at `position_mm` that shows all of the volume, pixels as close as its samples. Where
// the volume lies along the patient's axes, pixels of original slices are the original samples.
SlicePlane slice_plane(const VolumeGrid& grid, Orientation orientation, double position_mm);

// The plane through `center_mm` with these directions, which need be neither orthogonal nor of
// length 1, but not parallel.
SlicePlane oblique_plane(Vec3 center_mm, Vec3 right, Vec3 down, double mm_per_pixel, Size size);

// The samples of `volume` in `plane`, interpolated linearly between the eight around each pixel's
// centre; `outside` beyond the outermost half sample. `out` has the size of `plane`.
void reslice(const Volume& volume, const SlicePlane& plane, std::int16_t outside,
             View<std::int16_t> out);

// The letters of a direction, the greatest part first: "L", "PL", "HAR". L left, R right, A
// anterior, P posterior, H head, F feet (DICOM PS3.3, C.7.6.1.1.1); parts below a quarter are left
// out.
std::string direction_letters(Vec3 direction);

struct EdgeLetters {
    std::string left, right, top, bottom;
};
EdgeLetters edge_letters(const SlicePlane& plane);

// The longest of 1, 2, 5, 10, 20, 50 ... millimetres that is at most `max_pixels` long.
struct ScaleBar {
    double length_mm = 1;
    double pixels = 1;
};
ScaleBar scale_bar(double mm_per_pixel, double max_pixels);

}  // namespace theatron::medical
