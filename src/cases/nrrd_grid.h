// SPDX-License-Identifier: Apache-2.0
// The axes of an NRRD file, and where in the patient they lie. Only for this module.
#pragma once

#include <string>
#include <vector>

#include "cases/nrrd_header.h"
#include "medical/volume.h"

namespace theatron::cases::nrrd {

struct Axes {
    std::vector<std::size_t> sizes;  // of space
    std::vector<Vec3> directions;
    std::size_t layers = 1;
    std::size_t before_layers = 1;  // samples of one layer that follow one another
    bool layers_come_last = false;  // one whole layer after another
};

// Both return the problem as the end of a sentence, or nothing.
std::string read_axes(const Fields& fields, Axes& axes);
std::string read_grid(const Fields& fields, const Axes& axes, medical::VolumeGrid& grid);

}  // namespace theatron::cases::nrrd
