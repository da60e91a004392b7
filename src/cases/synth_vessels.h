// SPDX-License-Identifier: Apache-2.0
// Trees of vessels in a generated liver, and the distance to them.
#pragma once

#include <cstdint>
#include <vector>

#include "cases/synth_liver.h"
#include "geometry/vec.h"

namespace theatron::cases {

// A piece of a vessel: a cone with rounded ends.
struct VesselPiece {
    Vec3 a, b;
    double radius_a_mm = 1, radius_b_mm = 1;
    int generation = 0;  // 0 at the root
};

double distance(Vec3 p, const VesselPiece& piece);

struct SynthVessels {
    std::vector<VesselPiece> portal_vein, artery, hepatic_veins;
};

// A portal vein that branches towards all of the liver, an artery beside it, and the right, middle
// and left hepatic vein, which join at the vena cava and keep clear of the other two. Radii follow
// Murray's law (1926): the cubes of the branches' radii sum to that of their stem. No piece comes
// nearer to the liver's surface than a millimetre.
SynthVessels grow_vessels(const SynthLiver& liver, std::uint64_t seed);

}  // namespace theatron::cases
