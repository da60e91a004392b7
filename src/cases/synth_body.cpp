// SPDX-License-Identifier: Apache-2.0
#include "cases/synth_body.h"

#include <algorithm>
#include <cmath>

#include "cases/synth_random.h"

namespace theatron::cases {
namespace {

constexpr std::int16_t intercept = -1024;

// Hounsfield units in the portal-venous phase.
namespace hu {
constexpr double air = -1000, fat = -98, skin = 10, muscle = 55, fluid = 12, wall = 70;
constexpr double liver = 108, portal_vein = 178, hepatic_vein = 165, artery = 210, tumour = 62;
constexpr double bone = 420, marrow = 190, cord = 30, aorta = 170, vena_cava = 150, heart = 160;
constexpr double lung = -840, spleen = 122, kidney = 185, pancreas = 95;
}  // namespace hu

// The inside of a surface replaces the sample before; samples on the surface get a share of both.
class Sample {
public:
    explicit Sample(double edge_mm) : edge_mm_(edge_mm) {}
    void fill(double distance_mm, double value) {
        const double share = std::clamp(0.5 - distance_mm / edge_mm_, 0.0, 1.0);
        value_ += (value - value_) * share;
    }
    double value() const { return value_; }

private:
    double edge_mm_;
    double value_ = hu::air;
};

double rod(Vec3 p, double x, double y, double radius) {
    const double dx = p.x - x, dy = p.y - y;
    return std::sqrt(dx * dx + dy * dy) - radius;
}

double ellipse(Vec3 p, double x, double y, double rx, double ry) {
    return ellipsoid({p.x, p.y, 0}, {x, y, 0}, {rx, ry, 1e6});
}

// A hollow organ: its wall and what it holds, gas at the front.
void fill_hollow(Sample& sample, Vec3 p, double distance_mm, double gas_y) {
    sample.fill(distance_mm, hu::wall);
    sample.fill(distance_mm + 3, hu::fluid);
    sample.fill(std::max(distance_mm + 3, p.y - gas_y), hu::air + 30);
}

void fill_bones(Sample& sample, Vec3 p) {
    // Ribs slant down to the front and end at the costal arch.
    const double slant = p.z - 0.45 * p.y;
    const double across = (slant - 27 * std::floor(slant / 27 + 0.5)) / 6.5;
    const double outwards = ellipse(p, 0, 8, 145, 98) / 3.8;
    const double rib = std::max((std::sqrt(across * across + outwards * outwards) - 1) * 3.8,
                                -(p.y + 52 + 0.35 * p.z));
    sample.fill(rib, hu::bone);
    sample.fill(rib + 1.6, hu::marrow);
    // A vertebra: body, arch with its processes, canal; discs between the bodies.
    const double between = p.z - 30 * std::floor(p.z / 30 + 0.5);
    const double body = ellipse(p, 0, 84, 22, 17);
    const double disc = 4 - std::abs(std::abs(between) - 15);
    const double arch = std::min({ellipse(p, 0, 104, 15, 9),
                                  std::max(std::abs(p.x) - 3.5, std::abs(p.y - 117) - 12),
                                  std::max(std::abs(p.x) - 36, std::abs(p.y - 101) - 4)});
    sample.fill(std::max(arch, std::abs(between) - 9), hu::bone - 80);
    sample.fill(body, hu::bone - 60);
    sample.fill(body + 2, hu::marrow);
    sample.fill(std::max(body, -disc), hu::muscle + 25);
    sample.fill(ellipse(p, 0, 102, 9, 7), hu::cord);
}

// The trunk without the liver: skin, fat, muscle, bones, lungs' bases, heart, organs, vessels.
void fill_trunk(Sample& sample, Vec3 p) {
    const double skin = ellipse(p, 0, 10, 168, 122);
    if (skin > 2)
        return;
    sample.fill(skin, hu::skin);
    sample.fill(skin + 2, hu::fat);
    sample.fill(ellipse(p, 0, 10, 152, 106), hu::muscle);
    sample.fill(ellipse(p, 0, 8, 148.5, 102), hu::fat);
    sample.fill(ellipse(p, 0, 7, 147, 100.5), hu::muscle);
    const double inner = ellipse(p, 0, 4, 139, 91);
    sample.fill(inner, hu::fat);
    for (const double side : {-1.0, 1.0}) {
        sample.fill(ellipse(p, side * 33, 106, 27, 16), hu::muscle);
        sample.fill(ellipsoid(p, {side * 37, 82, -110}, {19, 17, 90}), hu::muscle);
    }
    // The lungs lie over the two domes of the diaphragm, the heart between them.
    const double domes = smooth_union(ellipsoid(p, {-58, 5, -30}, {90, 92, 122}),
                                      ellipsoid(p, {62, 12, -40}, {84, 88, 112}), 20);
    sample.fill(std::max(inner + 2, -domes), hu::muscle);
    sample.fill(std::max(inner + 2, -domes + 3), hu::lung);
    sample.fill(ellipsoid(p, {18, -24, 122}, {58, 48, 46}), hu::fat);
    sample.fill(ellipsoid(p, {18, -24, 124}, {54, 44, 42}), hu::heart);

    sample.fill(smooth_union(ellipsoid(p, {98, 44, 14}, {26, 40, 50}),
                             ellipsoid(p, {84, 58, 2}, {20, 26, 38}), 12),
                hu::spleen);
    fill_hollow(sample, p,
                smooth_union(ellipsoid(p, {74, 4, 24}, {34, 36, 46}),
                             ellipsoid(p, {44, -34, -26}, {46, 22, 24}), 26),
                -34);
    for (const double side : {-1.0, 1.0}) {
        const Vec3 center{side * 64, 62, side < 0 ? -78.0 : -66.0};
        const double kidney = ellipsoid(p, center, {27, 25, 52});
        sample.fill(kidney, hu::kidney);
        sample.fill(ellipsoid(p, center + Vec3{side * -13, -3, 0}, {16, 9, 26}), hu::fat + 20);
    }
    sample.fill(smooth_union(ellipsoid(p, {22, 30, -28}, {42, 9, 11}),
                             ellipsoid(p, {-24, 24, -44}, {16, 14, 22}), 12),
                hu::pancreas);
    // Loops of the bowel.
    constexpr Vec3 loops[] = {{10, -48, -78},  {52, -52, -84},   {88, -28, -70}, {34, -12, -96},
                              {72, 4, -100},   {104, 12, -64},   {-6, -12, -94}, {-52, -20, -112},
                              {-92, 12, -112}, {-20, -58, -108}, {66, -70, -62}, {108, -18, -108}};
    for (const Vec3 loop : loops)
        fill_hollow(sample, p, ellipsoid(p, loop, {19, 16, 21}), loop.y - 5);
    fill_bones(sample, p);
    sample.fill(rod(p, 13, 54, 10.5), hu::aorta);
}

double noise_at(std::uint64_t seed, std::size_t index) {
    // The sum of four uniform numbers is near enough to a normal one; its deviation is 1 / sqrt(3).
    const std::uint64_t bits = mixed(seed + 0x9e3779b97f4a7c15u * (index + 1));
    double sum = -2;
    for (int i = 0; i < 4; ++i)
        sum += double(bits >> (16 * i) & 0xffff) * (1.0 / 65535);
    return sum * 1.7320508;
}

}  // namespace

double distance(Vec3 p, const SynthTumour& tumour) {
    double nearest = length(p - tumour.center_mm) - tumour.radius_mm;
    for (const SynthTumour::Bump& bump : tumour.bumps)
        nearest =
            smooth_union(nearest, length(p - tumour.center_mm - bump.offset_mm) - bump.radius_mm,
                         0.4 * tumour.radius_mm);
    return nearest;
}

std::vector<SynthTumour> place_tumours(const SynthLiver& liver, const SynthVessels& vessels,
                                       std::uint64_t seed) {
    SynthRandom random(mixed(seed + 3));
    const medical::Box box = liver.box();
    std::vector<SynthTumour> tumours;
    for (const double size : {19.0, 13.0, 9.0}) {
        SynthTumour best;
        double best_room = -1e9;
        for (int candidate = 0; candidate < 400; ++candidate) {
            const Vec3 p{random.between(box.low_mm.x, box.high_mm.x),
                         random.between(box.low_mm.y, box.high_mm.y),
                         random.between(box.low_mm.z, box.high_mm.z)};
            double room = -liver.distance(p) - 1.4 * size - 3;
            // A tumour may touch a vessel where the liver is too small, but never leaves it.
            if (room < 0)
                room -= 1000;
            for (const SynthTumour& other : tumours)
                room = std::min(room, length(p - other.center_mm) - 1.2 * size - 40);
            for (const auto* tree : {&vessels.portal_vein, &vessels.hepatic_veins})
                for (const VesselPiece& piece : *tree)
                    if (piece.radius_b_mm > 1.6)
                        room = std::min(room, distance(p, piece) - 1.1 * size);
            if (room > best_room) {
                best_room = room;
                best.center_mm = p;
            }
        }
        best.radius_mm = size;
        for (SynthTumour::Bump& bump : best.bumps)
            bump = {random.direction() * (size * random.between(0.55, 0.75)),
                    size * random.between(0.5, 0.62)};
        tumours.push_back(best);
    }
    return tumours;
}

void vessel_layer(const medical::VolumeGrid& grid, int slice,
                  const std::vector<VesselPiece>& pieces, double far, std::span<float> out) {
    std::fill(out.begin(), out.end(), float(far));
    // For grids along the patient's axes, as all generated ones are.
    const double z = grid.point_at(0, 0, slice).z;
    const auto first = [&](double low, double origin, double step) {
        return std::max(0, int(std::floor((low - origin) / step)));
    };
    const auto last = [&](double high, double origin, double step, int side) {
        return std::min(side - 1, int(std::floor((high - origin) / step)) + 1);
    };
    const double dx = grid.column_step_mm.x, dy = grid.row_step_mm.y;
    for (const VesselPiece& piece : pieces) {
        const double reach = std::max(piece.radius_a_mm, piece.radius_b_mm) + far;
        if (z < std::min(piece.a.z, piece.b.z) - reach ||
            z > std::max(piece.a.z, piece.b.z) + reach)
            continue;
        const int row0 = first(std::min(piece.a.y, piece.b.y) - reach, grid.origin_mm.y, dy);
        const int row1 =
            last(std::max(piece.a.y, piece.b.y) + reach, grid.origin_mm.y, dy, grid.rows);
        const int column0 = first(std::min(piece.a.x, piece.b.x) - reach, grid.origin_mm.x, dx);
        const int column1 =
            last(std::max(piece.a.x, piece.b.x) + reach, grid.origin_mm.x, dx, grid.columns);
        for (int row = row0; row <= row1; ++row)
            for (int column = column0; column <= column1; ++column) {
                float& value =
                    out[std::size_t(row) * std::size_t(grid.columns) + std::size_t(column)];
                value = std::min(value, float(distance(grid.point_at(column, row, slice), piece)));
            }
    }
}

medical::Volume scan_body(const SynthLiver& liver, const SynthVessels& vessels,
                          const std::vector<SynthTumour>& tumours, const SynthOptions& options,
                          const Progress& progress) {
    constexpr double half_width = 184, low_z = -118, high_z = 118;
    medical::Volume volume;
    medical::VolumeGrid& grid = volume.grid;
    grid.columns = int(2 * half_width / options.pixel_mm) / 2 * 2;
    grid.rows = int(2 * (half_width - 44) / options.pixel_mm) / 2 * 2;
    grid.slices = int((high_z - low_z) / options.slice_mm) + 1;
    grid.origin_mm = {-options.pixel_mm * (grid.columns - 1) / 2,
                      10 - options.pixel_mm * (grid.rows - 1) / 2, low_z};
    grid.column_step_mm = {options.pixel_mm, 0, 0};
    grid.row_step_mm = {0, options.pixel_mm, 0};
    grid.slice_step_mm = {0, 0, options.slice_mm};
    volume.intercept = intercept;
    volume.window = {60, 400};
    volume.samples.resize(grid.size());

    const medical::Box box = liver.box();
    const std::size_t layer = std::size_t(grid.columns) * std::size_t(grid.rows);
    std::vector<float> veins(layer), arteries(layer), hepatic(layer);
    for (int slice = 0; slice < grid.slices; ++slice) {
        progress("Scanning the generated body", double(slice) / grid.slices);
        vessel_layer(grid, slice, vessels.portal_vein, 4, veins);
        vessel_layer(grid, slice, vessels.artery, 4, arteries);
        vessel_layer(grid, slice, vessels.hepatic_veins, 4, hepatic);
        for (std::size_t i = 0; i < layer; ++i) {
            const Vec3 p = grid.point_at(double(i % std::size_t(grid.columns)),
                                         double(i / std::size_t(grid.columns)), slice);
            Sample sample(options.pixel_mm);
            fill_trunk(sample, p);
            const bool near_liver = p.x > box.low_mm.x && p.x < box.high_mm.x &&
                                    p.y > box.low_mm.y && p.y < box.high_mm.y &&
                                    p.z > box.low_mm.z && p.z < box.high_mm.z;
            const double to_liver = near_liver ? liver.distance(p) : 1e3;
            // A layer of fat parts the liver from its neighbours.
            sample.fill(to_liver - 4, hu::fat);
            sample.fill(liver.vena_cava_distance(p), hu::vena_cava);
            sample.fill(liver.gall_bladder_distance(p), hu::fluid);
            sample.fill(to_liver, hu::liver);
            if (to_liver < 2) {
                for (const SynthTumour& tumour : tumours)
                    sample.fill(distance(p, tumour), hu::tumour);
                sample.fill(hepatic[i], hu::hepatic_vein);
                sample.fill(veins[i], hu::portal_vein);
                sample.fill(arteries[i], hu::artery);
            }
            const std::size_t index = std::size_t(slice) * layer + i;
            const double value = sample.value() + options.noise_hu * noise_at(options.seed, index);
            volume.samples[index] =
                std::int16_t(std::floor(std::clamp(value, -1024.0, 3000.0) - intercept + 0.5));
        }
    }
    return volume;
}

}  // namespace theatron::cases
