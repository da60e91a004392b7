// SPDX-License-Identifier: Apache-2.0
// The letters at a slice's edges are those of the patient's sides that the picture shows there,
// however the images were stored.
#include "viewer/slice_texts.h"

#include <gtest/gtest.h>

#include <cmath>

#include "viewer/monitor.h"

namespace theatron::viewer {
namespace {

constexpr int side = 21;

// A block of samples around the origin with these steps; bright where the patient's coordinates in
// LPS are nearest to `bright_mm`.
medical::Volume volume(Vec3 column, Vec3 row, Vec3 slice, Vec3 bright_mm) {
    medical::Volume v;
    v.grid = {side, side, side, (column + row + slice) * (-(side - 1) / 2.0), column, row, slice};
    for (int k = 0; k < side; ++k)
        for (int j = 0; j < side; ++j)
            for (int i = 0; i < side; ++i)
                v.samples.push_back(length(v.grid.point_at(i, j, k) - bright_mm) < 3 ? 1000 : 0);
    return v;
}

struct Stored {
    const char* name;
    Vec3 column, row, slice;
};
// As a scanner writes them, mirrored along each of the patient's axes, feet first, as coronal
// images, and tilted.
const Stored stored[] = {
    {"usual", {2, 0, 0}, {0, 2, 0}, {0, 0, 2}},
    {"left and right swapped", {-2, 0, 0}, {0, 2, 0}, {0, 0, 2}},
    {"front and back swapped", {2, 0, 0}, {0, -2, 0}, {0, 0, 2}},
    {"from head to feet", {2, 0, 0}, {0, 2, 0}, {0, 0, -2}},
    {"all swapped", {-2, 0, 0}, {0, -2, 0}, {0, 0, -2}},
    {"coronal", {2, 0, 0}, {0, 0, -2}, {0, 2, 0}},
    {"sagittal, mirrored", {0, -2, 0}, {0, 0, 2}, {-2, 0, 0}},
    {"tilted", {2, 0, 0}, {0, 1.99, 0.2}, {0, -0.2, 1.99}},
};

struct Side {
    Vec3 direction;
    std::string letter;
};
const Side sides[] = {{{1, 0, 0}, "L"},  {{-1, 0, 0}, "R"}, {{0, 1, 0}, "P"},
                      {{0, -1, 0}, "A"}, {{0, 0, 1}, "H"},  {{0, 0, -1}, "F"}};

// The letter at the edge towards which the picture is bright; empty where it is bright in its
// middle or nowhere.
std::string letter_at_bright_edge(const SlicePicture& slice, const medical::EdgeLetters& letters) {
    Vec2 sum;
    double weight = 0;
    for (int y = 0; y < slice.picture.size.height; ++y)
        for (int x = 0; x < slice.picture.size.width; ++x) {
            const double grey = slice.picture.view().row(y)[x].g;
            sum = {sum.x + grey * x, sum.y + grey * y};
            weight += grey;
        }
    if (weight == 0)
        return "";
    const double right = sum.x / weight - (slice.picture.size.width - 1) / 2.0,
                 down = sum.y / weight - (slice.picture.size.height - 1) / 2.0;
    if (std::max(std::abs(right), std::abs(down)) < 3)
        return "";
    if (std::abs(right) > std::abs(down))
        return right > 0 ? letters.right : letters.left;
    return down > 0 ? letters.bottom : letters.top;
}

TEST(SliceTexts, LettersAreThoseOfThePatientsSidesHoweverTheImagesAreStored) {
    for (const Stored& one : stored)
        for (const Side& bright : sides) {
            const medical::Volume v = volume(one.column, one.row, one.slice, bright.direction * 12);
            int seen = 0;
            for (std::uint8_t orientation = 0; orientation < 3; ++orientation) {
                session::CaseScreen screen;
                screen.orientation = orientation;
                screen.center = 500;
                screen.width = 1000;
                const SlicePicture slice = slice_picture(v, screen);
                const SliceTexts texts = slice_texts(slice.plane, screen, "Case", "CT");
                const std::string letter = letter_at_bright_edge(slice, texts.letters);
                if (letter.empty())
                    continue;
                ++seen;
                EXPECT_EQ(letter, bright.letter)
                    << one.name << ", orientation " << int(orientation);
            }
            EXPECT_EQ(seen, 2) << one.name << ", " << bright.letter;
        }
}

TEST(SliceTexts, AxialSlicesAreSeenFromTheFeetAndOthersFromTheFrontAndTheLeft) {
    const medical::Volume v = volume({2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {});
    const auto letters = [&](std::uint8_t orientation) {
        session::CaseScreen screen;
        screen.orientation = orientation;
        const medical::EdgeLetters l =
            slice_texts(slice_picture(v, screen).plane, screen, "", "").letters;
        return l.left + l.right + l.top + l.bottom;
    };
    EXPECT_EQ(letters(0), "RLAP");
    EXPECT_EQ(letters(1), "RLHF");
    EXPECT_EQ(letters(2), "APHF");
}

TEST(SliceTexts, CasePlaceAndWindowAreTold) {
    session::CaseScreen screen;
    screen.position_mm = -12.25;
    screen.center = 60;
    screen.width = 400;
    const SliceTexts texts = slice_texts({}, screen, "Liver 7", "portal venous");
    EXPECT_EQ(texts.case_name, "Liver 7");
    EXPECT_EQ(texts.series, "portal venous");
    EXPECT_EQ(texts.plane, "axial -12.2 mm");
    EXPECT_EQ(texts.window, "L 60  W 400");
}

TEST(SliceTexts, EachSaysThatItIsNotForDiagnosis) {
    EXPECT_EQ(slice_texts({}, {}, "", "").notice, "Not for diagnosis");
}

}  // namespace
}  // namespace theatron::viewer
