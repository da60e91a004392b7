// SPDX-License-Identifier: Apache-2.0
// The body around a generated liver, as a CT scanner would see it. Only for this module.
#pragma once

#include <array>
#include <vector>

#include "cases/synth_case.h"

namespace theatron::cases {

// A ball with bumps.
struct SynthTumour {
    struct Bump {
        Vec3 offset_mm;  // of its centre from the ball's
        double radius_mm = 1;
    };
    Vec3 center_mm;
    double radius_mm = 1;
    std::array<Bump, 4> bumps;
};
double distance(Vec3 p, const SynthTumour& tumour);

// Three of different sizes, inside the liver, apart from each other and, where there is room, off
// the large vessels.
std::vector<SynthTumour> place_tumours(const SynthLiver& liver, const SynthVessels& vessels,
                                       std::uint64_t seed);

// The least distance to any of the pieces at each sample of a layer; `far` where none is nearer.
// Takes the pieces near the layer only.
void vessel_layer(const medical::VolumeGrid& grid, int slice,
                  const std::vector<VesselPiece>& pieces, double far, std::span<float> out);

medical::Volume scan_body(const SynthLiver& liver, const SynthVessels& vessels,
                          const std::vector<SynthTumour>& tumours, const SynthOptions& options,
                          const Progress& progress);

}  // namespace theatron::cases
