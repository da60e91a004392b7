// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "cases/series_builder.h"

namespace theatron::cases {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

DicomSlice slice_at(Vec3 position) {
    DicomSlice slice;
    slice.series_uid = "1.2.3";
    slice.modality = "CT";
    slice.columns = 4;
    slice.rows = 3;
    slice.right = {1, 0, 0};
    slice.down = {0, 1, 0};
    slice.position_mm = position;
    slice.column_spacing_mm = 0.5;
    slice.row_spacing_mm = 0.75;
    slice.has_place = true;
    slice.intercept = -1024;
    slice.samples.assign(12, std::int16_t(position.z));
    return slice;
}

std::vector<DicomSlice> slices_at(std::vector<double> heights) {
    std::vector<DicomSlice> slices;
    for (const double z : heights)
        slices.push_back(slice_at({-10, -20, z}));
    return slices;
}

BuiltSeries build(std::vector<DicomSlice> slices) {
    return build_series(slices);
}

TEST(Series, ImagesAreSortedByTheirPlaces) {
    std::vector<DicomSlice> slices = slices_at({10, 0, 5, 15, 20});
    const BuiltSeries built = build(slices);
    ASSERT_EQ(built.problem, "");
    EXPECT_THAT(built.missing_slices, IsEmpty());
    EXPECT_EQ(built.volume.grid.slices, 5);
    EXPECT_EQ(built.volume.grid.origin_mm, (Vec3{-10, -20, 0}));
    EXPECT_EQ(built.volume.grid.slice_step_mm, (Vec3{0, 0, 5}));
    EXPECT_EQ(built.volume.grid.column_step_mm, (Vec3{0.5, 0, 0}));
    EXPECT_EQ(built.volume.grid.row_step_mm, (Vec3{0, 0.75, 0}));
    for (int k = 0; k < 5; ++k)
        EXPECT_EQ(built.volume.samples[built.volume.grid.index(1, 1, k)], 5 * k);
}

TEST(Series, MissingSlicesAreNamedAndStayEmpty) {
    const BuiltSeries built = build(slices_at({0, 5, 10, 25, 30, 35}));
    ASSERT_EQ(built.problem, "");
    EXPECT_THAT(built.missing_slices, ElementsAre(3, 4));
    EXPECT_EQ(built.volume.grid.slices, 8);
    EXPECT_EQ(built.volume.samples[built.volume.grid.index(0, 0, 4)], 0);
    EXPECT_EQ(built.volume.samples[built.volume.grid.index(0, 0, 5)], 25);
}

TEST(Series, ObliqueImagesAndATiltedGantryKeepTheirPlaces) {
    // Tilted about the left-right axis; the table moves along z, so the block is sheared.
    std::vector<DicomSlice> slices;
    for (int i = 0; i < 6; ++i) {
        DicomSlice slice = slice_at({0, 0, 3.0 * i});
        slice.down = {0, 0.96, -0.28};
        slices.push_back(slice);
    }
    const BuiltSeries built = build(slices);
    ASSERT_EQ(built.problem, "");
    EXPECT_NEAR(length(built.volume.grid.slice_step_mm - Vec3{0, 0, 3}), 0, 1e-12);
    EXPECT_NEAR(length(built.volume.grid.point_at(0, 2, 1) - Vec3{0, 1.44, 2.58}), 0, 1e-12);
}

TEST(Series, WhatDoesNotFitTogetherIsRefused) {
    const auto changed = [](auto change) {
        std::vector<DicomSlice> slices = slices_at({0, 5, 10, 15});
        change(slices);
        return build(slices).problem;
    };
    EXPECT_THAT(build({}).problem, HasSubstr("no images"));
    EXPECT_THAT(changed([](auto& s) {
                    s[2].right = {0, 1, 0}, s[2].down = {0, 0, -1};
                }),
                HasSubstr("mixed orientations"));
    EXPECT_THAT(changed([](auto& s) { s[1].has_place = false; }), HasSubstr("its place"));
    EXPECT_THAT(changed([](auto& s) { s[1].columns = 3, s[1].rows = 4; }),
                HasSubstr("different sizes"));
    EXPECT_THAT(changed([](auto& s) { s[0].frame_uid = "1.3", s[1].frame_uid = "1.2"; }),
                HasSubstr("reference"));
    EXPECT_THAT(changed([](auto& s) { s[1].position_mm.z = 10; }), HasSubstr("same place"));
    EXPECT_THAT(changed([](auto& s) { s[1].position_mm.z = 7; }), HasSubstr("lie unevenly"));
    EXPECT_THAT(changed([](auto& s) { s[1].position_mm.x += 20; }), HasSubstr("in one line"));
    EXPECT_THAT(changed([](auto& s) { s[3].position_mm.z = 5000; }), HasSubstr("slices in a row"));
}

TEST(Series, UnsignedValuesThatDoNotFitAreLoweredTogether) {
    std::vector<DicomSlice> slices = slices_at({0, 5});
    slices[0].samples.assign(12, 100);
    slices[1].samples.assign(12, std::int16_t(40000 - 32768));
    slices[1].lowered = true;
    const BuiltSeries built = build(slices);
    ASSERT_EQ(built.problem, "");
    const auto value = [&](int k) {
        return built.volume.slope * built.volume.samples[built.volume.grid.index(0, 0, k)] +
               built.volume.intercept;
    };
    EXPECT_EQ(value(0), 100 - 1024);
    EXPECT_EQ(value(1), 40000 - 1024);
}

TEST(DicomSlice, ComesBackAsItWasSentAndEveryTruncationIsRefused) {
    DicomSlice slice = slice_at({1, 2, 3});
    slice.identifiers = {{"PatientName", "Doe^Jane"}};
    slice.has_window = slice.deidentified = slice.inverted = slice.has_wrong_window = true;
    slice.window = {40, 400};
    const Bytes bytes = encode(slice);
    const Result<DicomSlice> read = decode_dicom_slice(bytes);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->series_uid, "1.2.3");
    EXPECT_EQ(read->identifiers, slice.identifiers);
    EXPECT_EQ(read->samples, slice.samples);
    EXPECT_EQ(read->position_mm, slice.position_mm);
    EXPECT_TRUE(read->deidentified && read->inverted && read->has_window && read->has_wrong_window);
    for (std::size_t n = 0; n < bytes.size(); ++n)
        EXPECT_FALSE(decode_dicom_slice(ByteView(bytes).first(n))) << n;
}

TEST(DicomSlice, IdentifiersComeBackWithoutAnImage) {
    DicomSlice slice;
    slice.charset = "ISO_IR 100";
    slice.identifiers = {{"PatientName", "M\xfcller^Anna"}, {"PatientID", "4711"}};
    const Bytes bytes = encode_identifiers(slice);
    const Result<std::vector<Identifier>> read = decode_identifiers(bytes);
    ASSERT_TRUE(read);
    EXPECT_THAT(*read, ElementsAre(Identifier{"PatientName", "Müller^Anna"},
                                   Identifier{"PatientID", "4711"}));
    for (std::size_t n = 0; n < bytes.size(); ++n)
        EXPECT_FALSE(decode_identifiers(ByteView(bytes).first(n))) << n;
}

}  // namespace
}  // namespace theatron::cases
