// SPDX-License-Identifier: Apache-2.0
// A generated case: a liver with segments, vessels, tumours and gall bladder, and a CT series of
// the same body. Equal options give equal bytes. No measurement of a person is in it.
#pragma once

#include <cstdint>
#include <filesystem>

#include "cases/import_case.h"
#include "cases/synth_liver.h"
#include "cases/synth_vessels.h"
#include "medical/case.h"
#include "medical/mesh.h"
#include "medical/volume.h"

namespace theatron::cases {

struct SynthOptions {
    std::uint64_t seed = 1;
    // Size of the images' pixels and the distance of slices; the body is the same for all.
    double pixel_mm = 1.2, slice_mm = 2;
    double noise_hu = 12;                // standard deviation
    std::size_t max_triangles = 60'000;  // of a part
};

struct SynthCase {
    medical::Case manifest;
    std::vector<medical::Mesh> meshes;  // one for each part
    medical::Volume volume;
    SynthVessels vessels;
    std::uint64_t seed = 1;
};

SynthCase make_synth_case(const SynthOptions& options, const Progress& progress);

// Writes the case's folder and the series as DICOM files into the folder `dicom` (empty: none).
// Neither may exist yet; each appears whole or not at all. Throws Error.
void write_synth_case(const SynthCase& synth, const std::filesystem::path& folder,
                      const std::filesystem::path& dicom, const Progress& progress);

}  // namespace theatron::cases
