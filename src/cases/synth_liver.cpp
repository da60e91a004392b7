// SPDX-License-Identifier: Apache-2.0
#include "cases/synth_liver.h"

#include <algorithm>
#include <cmath>

#include "cases/synth_random.h"

namespace theatron::cases {
namespace {

constexpr Vec3 center_mm{-25, -8, 0};  // of the model, in the patient

double smooth_difference(double a, double b, double width) {
    return -smooth_union(-a, b, width);
}

double fade(double t) {
    return t * t * (3 - 2 * t);
}

// The signed distance to a plane, positive on the side of the normal.
double beyond(Vec3 p, Vec3 point, Vec3 normal) {
    return dot(p - point, normal) / length(normal);
}

// The shapes below are in the model's coordinates: right is -x, the back +y, the head +z.

// A pear: its neck at the porta, its bottom at the front edge.
double gall_bladder(Vec3 p) {
    const double bottom = ellipsoid(p, {-39, -44, -59}, {13, 21, 14});
    const double neck = ellipsoid(p, {-28, -18, -44}, {6, 18, 7});
    return smooth_union(bottom, neck, 14);
}

// A sheet upwards from below, of 3 mm to both sides.
double fissure(Vec3 p) {
    const Vec3 outside{p.x - 12, std::max(0.0, p.y + 3), std::max(0.0, p.z + 5)};
    return length(outside) - 3;
}

double vena_cava(Vec3 p) {
    const double dx = p.x - (-13 + 0.06 * p.z), dy = p.y - (58 - 0.06 * p.z);
    return std::sqrt(dx * dx + dy * dy) - 11;
}

}  // namespace

double smooth_union(double a, double b, double width) {
    const double h = std::max(width - std::abs(a - b), 0.0) / width;
    return std::min(a, b) - h * h * width / 4;
}

double ellipsoid(Vec3 p, Vec3 center, Vec3 radii) {
    const Vec3 q = p - center;
    const Vec3 once{q.x / radii.x, q.y / radii.y, q.z / radii.z};
    const Vec3 twice{once.x / radii.x, once.y / radii.y, once.z / radii.z};
    const double k = length(once), g = length(twice);
    return g > 1e-9 ? k * (k - 1) / g : -std::min({radii.x, radii.y, radii.z});
}

SynthLiver::SynthLiver(std::uint64_t seed) : seed_(mixed(seed + 1)) {
    SynthRandom random(seed_);
    left_length_ = random.between(74, 92);
    dome_height_ = random.between(74, 84);
    const double wanted_mm3 = random.between(1.3e6, 1.7e6);
    constexpr int step_mm = 4;
    std::size_t inside = 0;
    for (int z = -130; z <= 130; z += step_mm)
        for (int y = -130; y <= 130; y += step_mm)
            for (int x = -160; x <= 160; x += step_mm)
                inside += model_distance(Vec3{double(x), double(y), double(z)}) < 0;
    scale_ = cube_root(wanted_mm3 / (double(inside) * step_mm * step_mm * step_mm));
}

Vec3 SynthLiver::to_patient(Vec3 model) const {
    return center_mm + model * scale_;
}

Vec3 SynthLiver::to_model(Vec3 patient) const {
    return (patient - center_mm) * (1 / scale_);
}

// Noise on a lattice, a few millimetres deep and some centimetres wide.
double SynthLiver::unevenness(Vec3 p) const {
    double sum = 0;
    for (const double cell : {34.0, 17.0}) {
        const Vec3 q = p * (1 / cell);
        const double fx = std::floor(q.x), fy = std::floor(q.y), fz = std::floor(q.z);
        const double u = fade(q.x - fx), v = fade(q.y - fy), w = fade(q.z - fz);
        double value = 0;
        for (int corner = 0; corner < 8; ++corner) {
            const int i = corner & 1, j = corner >> 1 & 1, k = corner >> 2;
            const auto key = std::uint64_t(std::int64_t(fx) + i + 1000) * 73856093u ^
                             std::uint64_t(std::int64_t(fy) + j + 1000) * 19349663u ^
                             std::uint64_t(std::int64_t(fz) + k + 1000) * 83492791u;
            const double at = double(mixed(key ^ seed_) >> 11) * 0x1p-53 - 0.5;
            value += at * (i ? u : 1 - u) * (j ? v : 1 - v) * (k ? w : 1 - w);
        }
        sum += value * cell;
    }
    return 0.11 * sum;
}

double SynthLiver::model_distance(Vec3 p) const {
    const double right = ellipsoid(p, {-40, 8, -2}, {74, 74, dome_height_});
    const double left = ellipsoid(p, {left_length_ - 54, -26, 30}, {left_length_, 44, 36});
    double liver = smooth_union(right, left, 44);
    // The underside: a wide hollow that faces down, back and to the left, so that both lobes become
    // wedges with a sharp front edge.
    liver = smooth_difference(liver, ellipsoid(p, {120, 66, -238}, {260, 260, 260}), 9);
    // Hollows of spine, stomach and right kidney, and the groove of the vena cava.
    liver = smooth_difference(liver, ellipsoid(p, {28, 98, 10}, {60, 68, 130}), 20);
    liver = smooth_difference(liver, ellipsoid(p, {66, 26, 6}, {58, 40, 40}), 22);
    liver = smooth_difference(liver, ellipsoid(p, {-52, 82, -72}, {36, 44, 48}), 18);
    // The caudate lobe beside the vena cava, the porta below it, the gall bladder's bed.
    liver = smooth_union(liver, ellipsoid(p, {-6, 26, 12}, {18, 19, 30}), 14);
    liver = smooth_difference(liver, ellipsoid(p, {-12, 6, -30}, {26, 9, 14}), 12);
    liver = smooth_difference(liver, vena_cava(p) - 0.8, 14);
    liver = smooth_difference(liver, gall_bladder(p) - 0.8, 9);
    // The fissure of the round ligament, which notches the front edge.
    liver = smooth_difference(liver, fissure(p), 8);
    return liver + unevenness(p);
}

double SynthLiver::distance(Vec3 p) const {
    return model_distance(to_model(p)) * scale_;
}

double SynthLiver::gall_bladder_distance(Vec3 p) const {
    return gall_bladder(to_model(p)) * scale_;
}

double SynthLiver::vena_cava_distance(Vec3 p) const {
    return vena_cava(to_model(p)) * scale_;
}

Vec3 SynthLiver::gradient(Vec3 p) const {
    constexpr double h = 0.5;
    return Vec3{distance(p + Vec3{h, 0, 0}) - distance(p - Vec3{h, 0, 0}),
                distance(p + Vec3{0, h, 0}) - distance(p - Vec3{0, h, 0}),
                distance(p + Vec3{0, 0, h}) - distance(p - Vec3{0, 0, h})} *
           (1 / (2 * h));
}

double SynthLiver::segment_distance(Vec3 patient, int segment, double liver) const {
    const Vec3 p = to_model(patient);
    // The planes of the right, middle and left hepatic vein, and that of the portal vein.
    const double right_vein = beyond(p, {-55, 20, 0}, {-1, 0.9, 0});
    const double middle_vein = beyond(p, {-14, 10, 0}, {-1, 0.35, 0});
    const double left_vein = beyond(p, {12, 0, 0}, {1, 0.1, 0});
    const double portal = beyond(p, {0, 0, -4}, {0, 0, 1});
    const double portal_left = beyond(p, {40, -25, 22}, {0, 0.5, 1});
    const double caudate = ellipsoid(p, {-7, 34, 10}, {23, 26, 36});
    double region = 0;
    switch (segment) {
        case 1:
            return std::max(liver, caudate * scale_);
        case 2:
            region = std::max(-left_vein, -portal_left);
            break;
        case 3:
            region = std::max(-left_vein, portal_left);
            break;
        case 4:
            region = std::max(left_vein, middle_vein);
            break;
        case 5:
            region = std::max({-middle_vein, right_vein, portal});
            break;
        case 6:
            region = std::max({-middle_vein, -right_vein, portal});
            break;
        case 7:
            region = std::max({-middle_vein, -right_vein, -portal});
            break;
        default:
            region = std::max({-middle_vein, right_vein, -portal});
            break;
    }
    return std::max(liver, std::max(region, -caudate) * scale_);
}

medical::Box SynthLiver::box() const {
    return {to_patient({-125, -85, -92}), to_patient({2 * left_length_ - 40, 92, 90})};
}

}  // namespace theatron::cases
