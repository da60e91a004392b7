// SPDX-License-Identifier: Apache-2.0
#include "host/mixed_registrations.h"

#include <gtest/gtest.h>

#include "geometry/calibration.h"

namespace theatron::host {
namespace {

wire::Camera camera(const char* name, std::uint64_t registration) {
    Calibration calibration;
    calibration.depth = pinhole({64, 48}, 70);
    calibration.registered = true;
    calibration.registration = registration;
    wire::Camera camera;
    camera.name = name;
    camera.calibration = encode_calibration(calibration);
    return camera;
}

TEST(MixedRegistrations, AreNamed) {
    EXPECT_EQ(mixed_registrations({}), "");
    EXPECT_EQ(mixed_registrations({camera("left", 7), camera("by hand", 0), camera("right", 7)}),
              "");
    const std::string problem =
        mixed_registrations({camera("left", 7), camera("right", 7), camera("cart", 8)});
    EXPECT_NE(problem.find("'left' and 'cart' come from different"), std::string::npos) << problem;
}

TEST(MixedRegistrations, DoNotMatterForACameraThatMovesWithAPerson) {
    wire::Camera own = camera("own", 8);
    own.kind = wire::CameraKind::person;
    EXPECT_EQ(mixed_registrations({camera("left", 7), own}), "");
}

}  // namespace
}  // namespace theatron::host
