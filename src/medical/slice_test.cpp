// SPDX-License-Identifier: Apache-2.0
#include "medical/slice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "image/image.h"
#include "medical/case.h"
#include "medical/window.h"

namespace theatron::medical {
namespace {

// Each sample is a linear function of its place, so that interpolation is exact.
double value_at(Vec3 p) {
    return 10 * p.x - 20 * p.y + 5 * p.z;
}

Volume ramp(VolumeGrid grid) {
    Volume volume;
    volume.grid = grid;
    for (int k = 0; k < grid.slices; ++k)
        for (int j = 0; j < grid.rows; ++j)
            for (int i = 0; i < grid.columns; ++i)
                volume.samples.push_back(
                    std::int16_t(std::lround(value_at(grid.point_at(i, j, k)))));
    return volume;
}

const VolumeGrid upright{20, 16, 10, {-30, 40, -200}, {2, 0, 0}, {0, 2, 0}, {0, 0, 4}};

Image<std::int16_t> cut(const Volume& volume, const SlicePlane& plane) {
    Image<std::int16_t> image(plane.size);
    reslice(volume, plane, -1000, image.view());
    return image;
}

TEST(Slice, AnAxialSliceHasTheOriginalSamples) {
    const Volume volume = ramp(upright);
    for (int k = 0; k < upright.slices; ++k) {
        const SlicePlane plane = slice_plane(upright, Orientation::axial, -200 + 4 * k);
        ASSERT_EQ(plane.size, (Size{20, 16}));
        const Image<std::int16_t> image = cut(volume, plane);
        for (int j = 0; j < 16; ++j)
            for (int i = 0; i < 20; ++i)
                ASSERT_EQ(image.view().row(j)[i], volume.samples[upright.index(i, j, k)]);
    }
}

TEST(Slice, EveryOrientationShowsWhatLiesThere) {
    // Also where slices are tilted and the block is sheared.
    const VolumeGrid tilted{24, 24, 24, {5, -7, 11}, {1.9, 0.2, 0}, {-0.2, 1.9, 0.3}, {0, 0.4, 2}};
    for (const VolumeGrid& grid : {upright, tilted}) {
        const Volume volume = ramp(grid);
        for (const Orientation orientation :
             {Orientation::axial, Orientation::coronal, Orientation::sagittal}) {
            const SliceRange range = slice_range(grid, orientation);
            const SlicePlane plane =
                slice_plane(grid, orientation, (range.first_mm + range.last_mm) / 2);
            const Image<std::int16_t> image = cut(volume, plane);
            int inside = 0;
            for (int y = 0; y < plane.size.height; ++y)
                for (int x = 0; x < plane.size.width; ++x) {
                    const std::int16_t shown = image.view().row(y)[x];
                    const Vec3 place = SamplesFromPatient(grid).point(plane.point_at(x, y));
                    const bool well_inside = place.x >= 0 && place.x <= grid.columns - 1 &&
                                             place.y >= 0 && place.y <= grid.rows - 1 &&
                                             place.z >= 0 && place.z <= grid.slices - 1;
                    if (well_inside) {
                        ASSERT_NEAR(shown, value_at(plane.point_at(x, y)), 1.01);
                    }
                    inside += well_inside;
                }
            EXPECT_GT(inside, int(plane.size.area()) / 2);
        }
    }
}

TEST(Slice, AnObliquePlaneIsCentredAndBlackOutside) {
    const Volume volume = ramp(upright);
    const Vec3 center = upright.point_at(10, 8, 5);
    const SlicePlane plane = oblique_plane(center, {1, 1, 0}, {0, 0.3, -1}, 0.8, {101, 101});
    EXPECT_NEAR(dot(plane.right, plane.down), 0, 1e-12);
    const Vec2 middle = pixel_of(plane, center);
    EXPECT_NEAR(middle.x, 50, 1e-9);
    EXPECT_NEAR(middle.y, 50, 1e-9);
    const Image<std::int16_t> image = cut(volume, plane);
    EXPECT_NEAR(image.view().row(50)[50], value_at(center), 1.01);
    EXPECT_EQ(image.view().row(0)[0], -1000);
}

TEST(Slice, ASingleSliceIsShownWithinHalfItsThickness) {
    const VolumeGrid flat{8, 8, 1, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 5}};
    const Volume volume = ramp(flat);
    EXPECT_EQ(slice_range(flat, Orientation::axial).count, 1);
    EXPECT_EQ(cut(volume, slice_plane(flat, Orientation::axial, 2.4)).view().row(3)[2], -40);
    EXPECT_EQ(cut(volume, slice_plane(flat, Orientation::axial, 2.6)).view().row(3)[2], -1000);
}

TEST(Slice, RowsThatMissTheVolumeStayWithinTheImage) {
    // The rows lie along one axis of the samples, beyond the volume along another one and, in the
    // second case, so far away that no pixel number holds the distance.
    const Volume volume = ramp(upright);
    for (const double away_mm : {100.0, 1e12}) {
        SlicePlane plane = slice_plane(upright, Orientation::axial, -200);
        plane.top_left_mm = {-30 - away_mm, 40 - away_mm, -200};
        const Image<std::int16_t> image = cut(volume, plane);
        for (int y = 0; y < plane.size.height; ++y)
            for (int x = 0; x < plane.size.width; ++x)
                ASSERT_EQ(image.view().row(y)[x], -1000);
    }
}

// Rows that go from sample to sample have a way of their own.
TEST(Slice, NoiseIsInterpolatedBetweenTheEightSamplesAround) {
    Volume volume = ramp(upright);
    std::mt19937 rng(11);
    for (std::int16_t& sample : volume.samples)
        sample = std::int16_t(rng());
    const VolumeGrid& grid = volume.grid;
    const auto reference = [&](Vec3 p) {
        const double places[] = {std::clamp(p.x, 0.0, grid.columns - 1.0),
                                 std::clamp(p.y, 0.0, grid.rows - 1.0),
                                 std::clamp(p.z, 0.0, grid.slices - 1.0)};
        const int sides[] = {grid.columns, grid.rows, grid.slices};
        int low[3];
        for (int i = 0; i < 3; ++i)
            low[i] = std::min(int(places[i]), sides[i] - 2);
        double sum = 0;
        for (int corner = 0; corner < 8; ++corner) {
            double weight = 1;
            int at[3];
            for (int i = 0; i < 3; ++i) {
                const int high = corner >> i & 1;
                at[i] = low[i] + high;
                weight *= high ? places[i] - low[i] : 1 - (places[i] - low[i]);
            }
            sum += weight * volume.samples[grid.index(at[0], at[1], at[2])];
        }
        return sum;
    };
    for (const auto orientation :
         {Orientation::axial, Orientation::coronal, Orientation::sagittal}) {
        const SliceRange range = slice_range(grid, orientation);
        for (const double steps : {0.0, 1.0, 1.4, 2.999, range.count - 1.0}) {
            const SlicePlane plane =
                slice_plane(grid, orientation, range.first_mm + steps * range.step_mm);
            const Image<std::int16_t> image = cut(volume, plane);
            for (int y = 0; y < plane.size.height; ++y)
                for (int x = 0; x < plane.size.width; ++x)
                    ASSERT_NEAR(image.view().row(y)[x],
                                reference(SamplesFromPatient(grid).point(plane.point_at(x, y))),
                                0.52)
                        << int(orientation) << " " << steps << " " << x << " " << y;
        }
    }
}

TEST(Slice, LettersNameThePatientsSides) {
    const EdgeLetters axial = edge_letters(slice_plane(upright, Orientation::axial, -190));
    EXPECT_EQ(axial.left + axial.right + axial.top + axial.bottom, "RLAP");
    const EdgeLetters coronal = edge_letters(slice_plane(upright, Orientation::coronal, 50));
    EXPECT_EQ(coronal.left + coronal.right + coronal.top + coronal.bottom, "RLHF");
    const EdgeLetters sagittal = edge_letters(slice_plane(upright, Orientation::sagittal, 0));
    EXPECT_EQ(sagittal.left + sagittal.right + sagittal.top + sagittal.bottom, "APHF");
    EXPECT_EQ(direction_letters({0.5, -0.8, 0.1}), "AL");
    EXPECT_EQ(direction_letters({-0.5, 0.5, 0.7}), "HRP");
}

TEST(Slice, ScaleBarsAreRoundLengths) {
    EXPECT_EQ(scale_bar(0.7, 200).length_mm, 100);
    EXPECT_NEAR(scale_bar(0.7, 200).pixels, 142.86, 0.01);
    EXPECT_EQ(scale_bar(0.1, 150).length_mm, 10);
    EXPECT_EQ(scale_bar(5, 3).length_mm, 10);
}

TEST(Window, GreysFollowTheLinearFunctionOfDicom) {
    // PS3.3, C.11.2.1.2: c = 2048, w = 4096 take 0 ... 4095 to 0 ... 255.
    EXPECT_EQ(grey_of(-1, {2048, 4096}), 0);
    EXPECT_EQ(grey_of(0, {2048, 4096}), 0);
    EXPECT_EQ(grey_of(4095, {2048, 4096}), 255);
    EXPECT_EQ(grey_of(2048, {2048, 4096}), 128);
    // A width of 1 is a threshold at c - 0.5.
    EXPECT_EQ(grey_of(99, {100, 1}), 0);
    EXPECT_EQ(grey_of(100, {100, 1}), 255);
    // Maps have values below 1: a thousandth of a mm2/s, in steps of a millionth.
    EXPECT_EQ(grey_of(0, {0.0015, 0.003}, 1e-6), 0);
    EXPECT_NEAR(grey_of(0.0015, {0.0015, 0.003}, 1e-6), 128, 1);
    EXPECT_EQ(grey_of(0.003, {0.0015, 0.003}, 1e-6), 255);
}

TEST(Window, ATableKnowsSlopeInterceptAndInversion) {
    const GreyTable table({40, 400}, 1, -1024, false), inverted({40, 400}, 1, -1024, true);
    for (const int stored : {-32768, 0, 864, 1063, 1064, 1200, 1263, 32767}) {
        EXPECT_EQ(table[std::int16_t(stored)], grey_of(stored - 1024, {40, 400}));
        EXPECT_EQ(inverted[std::int16_t(stored)], 255 - table[std::int16_t(stored)]);
    }
}

TEST(Case, NamesTellRoles) {
    EXPECT_EQ(role_of_name("liver"), Role::shell);
    EXPECT_EQ(role_of_name("VH_F_liver_capsule"), Role::shell);
    EXPECT_EQ(role_of_name("portal_vein"), Role::portal_vein);
    EXPECT_EQ(role_of_name("Leber"), Role::shell);
    EXPECT_EQ(role_of_name("Lebervenen"), Role::hepatic_vein);
    EXPECT_EQ(role_of_name("Lebersegment 4"), Role::other);
    EXPECT_EQ(role_of_name("Hepatic artery proper"), Role::artery);
    EXPECT_EQ(role_of_name("InferiorVenaCava"), Role::hepatic_vein);
    EXPECT_EQ(role_of_name("lesion_candidate"), Role::tumour);
    EXPECT_EQ(role_of_name("Tumour 2 in liver"), Role::tumour);
    EXPECT_EQ(role_of_name("VH_F_bare_area_of_liver"), Role::other);
    EXPECT_EQ(role_of_name("gall bladder"), Role::other);
}

}  // namespace
}  // namespace theatron::medical
