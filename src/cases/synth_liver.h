// SPDX-License-Identifier: Apache-2.0
// The shape of a generated liver: signed distances, negative inside, in patient coordinates.
//
// Two lobes over the hollow of the organs below, a fissure between them, uneven by a few
// millimetres; eight segments after Couinaud, parted by planes where the hepatic veins and the
// portal vein run in most people. Pure functions.
#pragma once

#include <cstdint>

#include "geometry/vec.h"
#include "medical/volume.h"

namespace theatron::cases {

inline constexpr int liver_segments = 8;

// Smooth union of two distances: rounded where they meet within `width`.
double smooth_union(double a, double b, double width);
// First-order distance to an ellipsoid.
double ellipsoid(Vec3 p, Vec3 center, Vec3 radii);

class SynthLiver {
public:
    // Between 1.3 and 1.7 litres, as the seed says.
    explicit SynthLiver(std::uint64_t seed);

    double distance(Vec3 p) const;
    // To segment 1 to 8 of the liver; `liver` is distance(p).
    double segment_distance(Vec3 p, int segment, double liver) const;
    Vec3 gradient(Vec3 p) const;  // of distance()
    // Neighbours that lie against the liver.
    double gall_bladder_distance(Vec3 p) const;
    double vena_cava_distance(Vec3 p) const;

    // The places where the portal vein and the artery enter and where the hepatic veins leave.
    Vec3 porta() const { return to_patient({-14, 8, -12}); }
    Vec3 confluence() const { return to_patient({-14, 34, 52}); }
    Vec3 core() const { return to_patient({-45, 0, 5}); }  // centimetres deep
    Vec3 to_patient(Vec3 model) const;
    Vec3 to_model(Vec3 patient) const;
    medical::Box box() const;  // around the liver, with some room
    double scale() const { return scale_; }

private:
    double model_distance(Vec3 p) const;
    double unevenness(Vec3 p) const;

    std::uint64_t seed_;
    double scale_ = 1;
    double left_length_, dome_height_;
};

}  // namespace theatron::cases
