// SPDX-License-Identifier: Apache-2.0
#include "cases/series_parts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cases/series_builder.h"
#include "cases/series_values.h"

namespace theatron::cases {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

DicomSlice slice_at(double z, int value = 0) {
    DicomSlice slice;
    slice.series_uid = "1.2.3";
    slice.columns = 40;
    slice.rows = 30;
    slice.right = {1, 0, 0};
    slice.down = {0, 1, 0};
    slice.position_mm = {0, 0, z};
    slice.has_place = true;
    slice.samples.assign(40 * 30, std::int16_t(value));
    return slice;
}

std::vector<std::size_t> sizes(const SeriesParts& split) {
    std::vector<std::size_t> found;
    for (const std::vector<DicomSlice>& part : split.parts)
        found.push_back(part.size());
    return found;
}

TEST(SeriesParts, AScoutIsLeftOutAndOtherPlanesAreParts) {
    std::vector<DicomSlice> slices{slice_at(0), slice_at(1), slice_at(2), slice_at(3)};
    slices[3].down = {0, 0, -1};
    const SeriesParts split = split_series(slices);
    EXPECT_THAT(sizes(split), ElementsAre(3));
    EXPECT_THAT(split.remarks, ElementsAre(HasSubstr("1 image of the series with another")));
    for (DicomSlice slice : {slice_at(4), slice_at(5)}) {
        slice.down = {0, 0, -1};
        slices.push_back(slice);
    }
    EXPECT_THAT(sizes(split_series(slices)), ElementsAre(3, 3));
}

TEST(SeriesParts, PhasesAreTakenApartByWhatTellsThemApartEverywhere) {
    std::vector<DicomSlice> slices;
    for (int k = 0; k < 3; ++k)
        for (int phase = 0; phase < 2; ++phase) {
            slices.push_back(slice_at(k, 10 * k + phase));
            slices.back().keys[7] = std::to_string(2 * k + phase);  // a time of each image
            slices.back().keys[1] = std::to_string(phase);
        }
    const SeriesParts split = split_series(slices);
    ASSERT_THAT(sizes(split), ElementsAre(3, 3));
    for (int phase = 0; phase < 2; ++phase)
        for (const DicomSlice& slice : split.parts[std::size_t(phase)])
            EXPECT_EQ(slice.samples[0] % 10, phase);
    // A part of the second phase is enough.
    slices.pop_back();
    EXPECT_THAT(sizes(split_series(slices)), ElementsAre(3, 2));
    for (DicomSlice& slice : slices)
        slice.keys = {};
    EXPECT_THAT(sizes(split_series(slices)), ElementsAre(5)) << "nothing tells them apart";
}

TEST(SeriesParts, CopiesAreNoPhases) {
    std::vector<DicomSlice> slices{slice_at(0), slice_at(0), slice_at(1, 5), slice_at(1, 5)};
    const SeriesParts split = split_series(slices);
    EXPECT_THAT(sizes(split), ElementsAre(4));
    EXPECT_THAT(split.remarks, IsEmpty());
}

TEST(SeriesParts, AFrameOfReferenceThatIsMissingIsNoOtherOne) {
    std::vector<DicomSlice> slices{slice_at(0), slice_at(1), slice_at(2)};
    slices[1].frame_uid = slices[2].frame_uid = "1.2.9";
    EXPECT_THAT(sizes(split_series(slices)), ElementsAre(3));
    slices[2].frame_uid = "1.2.10";
    EXPECT_THAT(sizes(split_series(slices)), ElementsAre(2, 1));
}

TEST(SeriesParts, AFrameOfReferenceOfEachImageSaysNothing) {
    std::vector<DicomSlice> slices{slice_at(0), slice_at(1), slice_at(2)};
    for (std::size_t i = 0; i < slices.size(); ++i)
        slices[i].frame_uid = "1.2." + std::to_string(i);
    const SeriesParts split = split_series(slices);
    EXPECT_THAT(sizes(split), ElementsAre(3));
    EXPECT_THAT(split.remarks, ElementsAre(HasSubstr("a frame of reference of its own")));
}

BuiltSeries built_at(const std::vector<double>& heights) {
    std::vector<DicomSlice> slices;
    for (const double z : heights)
        slices.push_back(slice_at(z));
    return build_series(slices);
}

TEST(Series, TwoDistancesAreNoMissingSlices) {
    EXPECT_THAT(built_at({0, 2.5, 5, 7.5, 15, 22.5}).problem, HasSubstr("others 7.50 mm"));
    EXPECT_THAT(built_at({0, 7.5, 15, 17.5, 20, 22.5, 25}).problem, HasSubstr("others 7.50 mm"));
    EXPECT_THAT(built_at({0, 2, 4, 8, 10, 14, 16}).missing_slices, ElementsAre(3, 6));
}

TEST(Series, RoundedPlacesAreOnOneLine) {
    // 0.625 mm with one digit.
    const BuiltSeries built = built_at({0, 0.6, 1.3, 1.9, 2.5, 3.1, 3.8, 4.4, 5});
    EXPECT_EQ(built.problem, "");
    EXPECT_EQ(built.volume.grid.slices, 9);
    EXPECT_NEAR(built.volume.grid.slice_step_mm.z, 0.625, 1e-9);
}

TEST(Series, ScalesOfSlicesBecomeOneOfWhichHalfAStepIsLost) {
    std::vector<DicomSlice> slices{slice_at(0, 30'000), slice_at(1, 30'000), slice_at(2, -7)};
    slices[0].slope = 0.5;
    slices[1].slope = 3;
    slices[2].slope = 1.25;
    const BuiltSeries built = build_series(slices);
    ASSERT_EQ(built.problem, "");
    const double values[] = {15'000, 90'000, -8.75};
    for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(built.volume.slope * built.volume.samples[built.volume.grid.index(0, 0, k)] +
                        built.volume.intercept,
                    values[k], 1.5);
}

TEST(Series, AWindowThatNobodyGivesShowsValuesAndNoPadding) {
    std::vector<DicomSlice> slices{slice_at(0), slice_at(1)};
    for (DicomSlice& slice : slices) {
        for (std::size_t i = 0; i < slice.samples.size(); ++i)
            slice.samples[i] = std::int16_t(i < 900 ? -2000 : i % 100);
        slice.samples[1000] = 32'000;  // a piece of metal
        slice.has_padding = true;
        slice.padding_low = slice.padding_high = -2000;
        slice.slope = 1e-3;
    }
    const BuiltSeries built = build_series(slices);
    EXPECT_NEAR(built.volume.window.center, 0.0495, 0.002);
    EXPECT_NEAR(built.volume.window.width, 0.098, 0.004);
}

}  // namespace
}  // namespace theatron::cases
