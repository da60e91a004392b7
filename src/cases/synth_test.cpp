// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "cases/case_folder.h"
#include "cases/case_pictures.h"
#include "cases/foreign_files.h"
#include "cases/synth_body.h"
#include "cases/synth_case.h"
#include "medical/mesh_measures.h"
#include "medical/slice.h"
#include "testing/temporary_folder.h"

namespace theatron::cases {
namespace {

using ::testing::IsEmpty;
namespace fs = std::filesystem;

constexpr auto no_progress = [](std::string_view, double) {};

// Coarse and without noise, so that it takes a second or two; made once for all tests.
const SynthCase& coarse() {
    static const SynthCase synth = [] {
        SynthOptions options;
        options.seed = 3;
        options.pixel_mm = 2;
        options.slice_mm = 2.5;
        options.noise_hu = 0;
        options.max_triangles = 30'000;
        return make_synth_case(options, no_progress);
    }();
    return synth;
}

// Grown once; those of seed 3 are the case's.
const SynthVessels& vessels_of(std::uint64_t seed) {
    static std::map<std::uint64_t, SynthVessels> grown;
    if (seed == coarse().seed)
        return coarse().vessels;
    const auto known = grown.find(seed);
    return known != grown.end()
               ? known->second
               : grown.emplace(seed, grow_vessels(SynthLiver(seed), seed)).first->second;
}

std::vector<const medical::Mesh*> meshes_of(medical::Role role) {
    std::vector<const medical::Mesh*> meshes;
    for (std::size_t i = 0; i < coarse().meshes.size(); ++i)
        if (coarse().manifest.parts[i].role == role)
            meshes.push_back(&coarse().meshes[i]);
    return meshes;
}

double to_tree(Vec3 point, const std::vector<VesselPiece>& tree) {
    double nearest = 1e9;
    for (const VesselPiece& piece : tree)
        nearest = std::min(nearest, distance(point, piece));
    return nearest;
}

TEST(Synth, ALiverHas1200To1800Millilitres) {
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
        const SynthLiver liver(seed);
        const medical::Box box = liver.box();
        std::size_t inside = 0;
        constexpr double step = 6;
        const Vec3 size = (box.high_mm - box.low_mm) * (1 / step);
        for (int z = 0; z <= int(size.z); ++z)
            for (int y = 0; y <= int(size.y); ++y)
                for (int x = 0; x <= int(size.x); ++x)
                    inside += liver.distance(box.low_mm +
                                             Vec3{double(x), double(y), double(z)} * step) < 0;
        const double litres = double(inside) * step * step * step * 1e-6;
        EXPECT_GT(litres, 1.2) << seed;
        EXPECT_LT(litres, 1.8) << seed;
    }
    const double mesh_mm3 = medical::shape_of(*meshes_of(medical::Role::shell).at(0)).volume_mm3;
    EXPECT_GT(mesh_mm3, 1.2e6);
    EXPECT_LT(mesh_mm3, 1.8e6);
}

TEST(Synth, VesselsOfAtLeastFiveGenerationsNeverLeaveTheShell) {
    for (const std::uint64_t seed : {0, 1, 3}) {
        const SynthLiver liver(seed);
        const SynthVessels& vessels = vessels_of(seed);
        for (const auto* tree : {&vessels.portal_vein, &vessels.artery, &vessels.hepatic_veins}) {
            std::set<int> generations;
            double worst = -1e9;
            for (const VesselPiece& piece : *tree) {
                generations.insert(piece.generation);
                for (int i = 0; i <= 8; ++i) {
                    const Vec3 p = piece.a + (piece.b - piece.a) * (i / 8.0);
                    worst = std::max(
                        worst, liver.distance(p) + std::max(piece.radius_a_mm, piece.radius_b_mm));
                }
            }
            EXPECT_GE(generations.size(), 5u);
            EXPECT_GT(tree->size(), 900u);
            EXPECT_LT(worst, 0) << "seed " << seed;
        }
        // The artery lies beside the portal vein, except at forks.
        const auto beside = std::ranges::count_if(vessels.artery, [&](const VesselPiece& piece) {
            return to_tree(piece.b, vessels.portal_vein) > 0;
        });
        EXPECT_GT(double(beside), 0.9 * double(vessels.artery.size()));
        const auto touching =
            std::ranges::count_if(vessels.hepatic_veins, [&](const VesselPiece& vein) {
                return std::ranges::any_of(vessels.portal_vein, [&](const VesselPiece& other) {
                    return distance(vein.b, other) < vein.radius_b_mm;
                });
            });
        std::printf("seed %d: %d of %zu pieces of hepatic veins touch the portal vein\n", int(seed),
                    int(touching), vessels.hepatic_veins.size());
        EXPECT_LT(double(touching), 0.02 * double(vessels.hepatic_veins.size()));
    }
    const SynthLiver liver(3);
    for (const medical::Role role :
         {medical::Role::portal_vein, medical::Role::artery, medical::Role::hepatic_vein})
        for (const medical::Vec3f p : meshes_of(role).at(0)->positions)
            ASSERT_LT(liver.distance(medical::to_double(p)), 0);
}

TEST(Synth, ThreeTumoursLieApartInTheLiver) {
    const auto tumours = meshes_of(medical::Role::tumour);
    ASSERT_EQ(tumours.size(), 3u);
    const SynthLiver liver(3);
    for (const medical::Mesh* tumour : tumours) {
        EXPECT_TRUE(medical::shape_of(*tumour).manifold);
        for (const medical::Vec3f p : tumour->positions)
            ASSERT_LT(liver.distance(medical::to_double(p)), 0);
    }
}

// Seed 99 leaves little room between the vessels.
TEST(Synth, TumoursNeverLeaveTheLiver) {
    for (const std::uint64_t seed : {0, 1, 99}) {
        const SynthLiver liver(seed);
        for (const SynthTumour& tumour : place_tumours(liver, vessels_of(seed), seed)) {
            constexpr int steps = 20;
            const double step = 1.6 * tumour.radius_mm / steps;
            for (int z = -steps; z <= steps; ++z)
                for (int y = -steps; y <= steps; ++y)
                    for (int x = -steps; x <= steps; ++x) {
                        const Vec3 p =
                            tumour.center_mm + Vec3{double(x), double(y), double(z)} * step;
                        ASSERT_TRUE(distance(p, tumour) > 0 || liver.distance(p) < 0)
                            << "seed " << seed;
                    }
        }
    }
}

TEST(Synth, EverySurfaceIsClosedAndManifold) {
    for (std::size_t i = 0; i < coarse().meshes.size(); ++i) {
        const medical::MeshShape shape = medical::shape_of(coarse().meshes[i]);
        EXPECT_TRUE(shape.manifold) << coarse().manifest.parts[i].name;
        EXPECT_GT(shape.volume_mm3, 1000) << coarse().manifest.parts[i].name;
    }
}

TEST(Synth, EightSegmentsAreTheWholeLiver) {
    std::vector<const medical::Mesh*> segments = meshes_of(medical::Role::other);
    ASSERT_EQ(segments.size(), 9u);
    segments.erase(segments.begin());  // the gall bladder
    double sum = 0;
    for (const medical::Mesh* segment : segments) {
        const medical::MeshShape shape = medical::shape_of(*segment);
        EXPECT_TRUE(shape.manifold);
        EXPECT_GT(shape.volume_mm3, 1e4);
        sum += shape.volume_mm3;
    }
    const double liver = medical::shape_of(*meshes_of(medical::Role::shell).at(0)).volume_mm3;
    EXPECT_NEAR(sum, liver, 0.04 * liver);
}

// The HU at `point`, interpolated.
double value_at(const medical::Volume& volume, Vec3 point) {
    const medical::SlicePlane one = medical::oblique_plane(point, {1, 0, 0}, {0, 1, 0}, 1, {1, 1});
    std::int16_t sample = 0;
    medical::reslice(volume, one, 0, View<std::int16_t>(&sample, {1, 1}));
    return sample + volume.intercept;
}

double to_vessels(Vec3 point) {
    const SynthVessels& vessels = coarse().vessels;
    return std::min({to_tree(point, vessels.portal_vein), to_tree(point, vessels.artery),
                     to_tree(point, vessels.hepatic_veins)});
}

// Where the images cross the value half way between both sides, along a vertex's normal.
double edge_offset_mm(Vec3 point, Vec3 normal, double inside, double outside) {
    const medical::Volume& volume = coarse().volume;
    const double middle = (inside + outside) / 2;
    double nearest = 1e9;
    for (int i = -50; i < 50; ++i) {
        const double offset = 0.05 * i;
        if ((value_at(volume, point + normal * offset) < middle) !=
                (value_at(volume, point + normal * (offset + 0.05)) < middle) &&
            std::abs(offset) < std::abs(nearest))
            nearest = offset;
    }
    return nearest;
}

TEST(Synth, SurfacesLieWhereTheImagesShowThemWithinAMillimetre) {
    const medical::Volume& volume = coarse().volume;
    for (const medical::Role role : {medical::Role::shell, medical::Role::tumour}) {
        double sum = 0, worst = 0;
        std::size_t count = 0;
        for (const medical::Mesh* mesh : meshes_of(role))
            for (std::size_t i = 0; i < mesh->positions.size(); i += 7) {
                const Vec3 p = medical::to_double(mesh->positions[i]);
                const Vec3 normal = medical::to_double(mesh->normals[i]);
                const double inside = value_at(volume, p - normal * 3),
                             outside = value_at(volume, p + normal * 3);
                // Only places where nothing else is near: the liver in fat, a tumour in the liver.
                const bool clear = role == medical::Role::shell
                                       ? std::abs(inside - 108) < 8 && std::abs(outside + 98) < 20
                                       : std::abs(inside - 62) < 8 && std::abs(outside - 108) < 8;
                if (!clear || to_vessels(p) < 4.5)
                    continue;
                const double offset = std::abs(edge_offset_mm(p, normal, inside, outside));
                sum += offset;
                worst = std::max(worst, offset);
                ++count;
            }
        ASSERT_GT(count, 40u);
        std::printf("%s: mean %.2f mm, worst %.2f mm of %zu places\n",
                    std::string(medical::to_text(role)).c_str(), sum / double(count), worst, count);
        EXPECT_LT(sum / double(count), 0.4);
        EXPECT_LT(worst, 1.0);
    }
}

// The shapes that the images are made of.
TEST(Synth, SurfacesLieWithinAMillimetreOfTheShapes) {
    const SynthLiver liver(3);
    for (const medical::Vec3f p : meshes_of(medical::Role::shell).at(0)->positions)
        ASSERT_LT(std::abs(liver.distance(medical::to_double(p))), 1);
    const SynthVessels& vessels = coarse().vessels;
    const std::pair<medical::Role, const std::vector<VesselPiece>*> trees[] = {
        {medical::Role::portal_vein, &vessels.portal_vein},
        {medical::Role::artery, &vessels.artery},
        {medical::Role::hepatic_vein, &vessels.hepatic_veins}};
    for (const auto& [role, tree] : trees) {
        const medical::Mesh& mesh = *meshes_of(role).at(0);
        for (std::size_t i = 0; i < mesh.positions.size(); i += 11)
            ASSERT_LT(std::abs(to_tree(medical::to_double(mesh.positions[i]), *tree)), 1);
    }
}

TEST(Synth, TheCaseAndItsDicomSeriesAreWhole) {
    testing::TemporaryFolder folder;
    const fs::path target = folder.path() / "case", dicom = folder.path() / "dicom";
    write_synth_case(coarse(), target, dicom, no_progress);
    const CheckReport report = check_case(target);
    EXPECT_THAT(report.problems, IsEmpty());
    EXPECT_THAT(report.remarks, IsEmpty());

    const medical::Volume& volume = coarse().volume;
    const std::vector<DicomSlice> slices = DicomFiles().read(dicom / "0020.dcm");
    ASSERT_EQ(slices.size(), 1u);
    EXPECT_TRUE(slices[0].deidentified);
    EXPECT_EQ(slices[0].intercept, volume.intercept);
    EXPECT_NEAR(length(slices[0].position_mm - volume.grid.point_at(0, 0, 19)), 0, 1e-6);
    EXPECT_TRUE(std::equal(slices[0].samples.begin(), slices[0].samples.end(),
                           volume.samples.begin() + std::ptrdiff_t(volume.grid.index(0, 0, 19))));
    const LoadedCase loaded = read_case(target);
    EXPECT_EQ(picture_of_parts(loaded, {200, 160}).size, (Size{200, 160}));
}

TEST(Synth, TheSeedAloneDecidesWhatComesOut) {
    const auto ends = [](const SynthVessels& vessels) {
        std::vector<Vec3> places;
        for (const VesselPiece& piece : vessels.portal_vein)
            places.push_back(piece.b);
        return places;
    };
    EXPECT_EQ(ends(vessels_of(3)), ends(grow_vessels(SynthLiver(3), 3)));
    EXPECT_NE(ends(vessels_of(3)), ends(vessels_of(1)));
}

}  // namespace
}  // namespace theatron::cases
