// SPDX-License-Identifier: Apache-2.0
#include "room/measured_distance.h"

#include <gtest/gtest.h>

#include <random>

namespace theatron::room {
namespace {

MeasuredPoint seen_from(std::uint32_t camera, Vec3 eye, Vec3 point) {
    MeasuredPoint measured;
    measured.camera = camera;
    measured.room_from_camera = look_at(eye, {0, 1, 0}, {0, 1, 0});
    measured.in_camera = inverse(measured.room_from_camera) * point;
    measured.deviation_m = 0.002;
    measured.pixel_radians = 0.0035;
    return measured;
}

TEST(MeasuredDistance, AlongTheRayHasTheNoiseOfBothPoints) {
    const MeasuredPoint a = seen_from(1, {0, 1, 2}, {0, 1, 0});
    const MeasuredPoint b = seen_from(1, {0, 1, 2}, {0, 1, -0.5});
    const MeasuredDistance distance = distance_between(a, b);
    EXPECT_NEAR(distance.length_m, 0.5, 1e-12);
    EXPECT_NEAR(distance.deviation_m, 0.002 * std::sqrt(2), 1e-9);
}

TEST(MeasuredDistance, AcrossTheRayHasTheErrorOfPixels) {
    const MeasuredPoint a = seen_from(1, {0, 1, 2}, {-0.001, 1, 0});
    const MeasuredPoint b = seen_from(1, {0, 1, 2}, {0.001, 1, 0});
    EXPECT_NEAR(distance_between(a, b).deviation_m, 2 * 0.0035 / std::sqrt(6), 1e-5);
}

TEST(MeasuredDistance, ThePlaceOfTheSameCameraDoesNotMatter) {
    MeasuredPoint a = seen_from(1, {0, 1, 2}, {0, 1, 0}), b = seen_from(1, {0, 1, 2}, {0.3, 1, 0});
    const double before = distance_between(a, b).deviation_m;
    for (std::size_t i = 0; i < 6; ++i)
        a.placement[7 * i] = b.placement[7 * i] = 1e-4;
    EXPECT_EQ(distance_between(a, b).deviation_m, before);
    b.camera = 2;
    EXPECT_GT(distance_between(a, b).deviation_m, 2 * before);
}

TEST(MeasuredDistance, TheDeviationIsThatOfRepeatedMeasurements) {
    MeasuredPoint a = seen_from(1, {0.3, 1.4, 2}, {-0.2, 1.1, 0.1});
    MeasuredPoint b = seen_from(2, {1.6, 1.8, -0.9}, {0.15, 0.9, -0.1});
    // A correlated placement: factor times factor transposed.
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    std::array<double, 36> factor{};
    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j <= i; ++j)
            factor[6 * i + j] = normal(random) * (i < 3 ? 0.0008 : 0.0015);
    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < 6; ++j)
            for (std::size_t k = 0; k < 6; ++k)
                b.placement[6 * i + j] += factor[6 * i + k] * factor[6 * j + k];

    std::uniform_real_distribution<double> pixel(-0.5, 0.5);
    const auto noisy = [&](const MeasuredPoint& point) {
        const Vec3 ray = normalized(point.in_camera);
        const Vec3 u = normalized(cross(ray, {0, 1, 0})), v = cross(ray, u);
        const double width = point.pixel_radians * length(point.in_camera);
        return point.in_camera + ray * (point.deviation_m * normal(random)) +
               u * (width * pixel(random)) + v * (width * pixel(random));
    };
    double sum = 0, squares = 0;
    constexpr int count = 40'000;
    for (int n = 0; n < count; ++n) {
        std::array<double, 6> white{}, motion{};
        for (double& w : white)
            w = normal(random);
        for (std::size_t i = 0; i < 6; ++i)
            for (std::size_t j = 0; j < 6; ++j)
                motion[i] += factor[6 * i + j] * white[j];
        const Vec3 p = noisy(b);
        const Vec3 moved =
            p + cross({motion[0], motion[1], motion[2]}, p) + Vec3{motion[3], motion[4], motion[5]};
        const double d = length(a.room_from_camera * noisy(a) - b.room_from_camera * moved);
        sum += d;
        squares += d * d;
    }
    const double mean = sum / count;
    const double deviation = std::sqrt(squares / count - mean * mean);
    EXPECT_NEAR(distance_between(a, b).deviation_m, deviation, 0.03 * deviation);
    // It would not be without the placement.
    b.placement = {};
    EXPECT_LT(distance_between(a, b).deviation_m, 0.9 * deviation);
}

}  // namespace
}  // namespace theatron::room
