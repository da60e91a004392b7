// SPDX-License-Identifier: Apache-2.0
#include "export/export_places.h"

#include <gtest/gtest.h>

namespace theatron::exporting {
namespace {

TEST(ExportPlaces, OfLaterCalibrationsLieBesideTheFirst) {
    EXPECT_EQ(place_of("e/png", 0), "e/png");
    EXPECT_EQ(place_of("e/png", 1), "e/png.2");
    EXPECT_EQ(place_of("kinect.mkv", 2), "kinect.3.mkv");
    EXPECT_EQ(place_of("e/png/", 1), "e/png.2");
    EXPECT_EQ(place_of("e/./png//", 1), "e/png.2");
    const auto here = std::filesystem::current_path();
    EXPECT_EQ(place_of(".", 1), here.parent_path() / (here.filename().string() + ".2"));
    EXPECT_EQ(place_of("./", 1), place_of(".", 1));
}

}  // namespace
}  // namespace theatron::exporting
