// SPDX-License-Identifier: Apache-2.0
#include "synthetic/sensor_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "image/image.h"
#include "synthetic/sensor_scene.h"
#include "synthetic/sensor_statistics.h"

namespace theatron::synthetic {
namespace {

constexpr Size nfov{640, 576};
constexpr Size small{160, 144};

Scene flat_scene(Size size, float depth_m, float reflectivity, float cos_incidence = 1) {
    Scene scene;
    for (Image<float>* image : {&scene.depth_m, &scene.reflectivity, &scene.cos_incidence})
        image->resize(size);
    scene.depth_m.pixels.assign(size.area(), depth_m);
    scene.reflectivity.pixels.assign(size.area(), reflectivity);
    scene.cos_incidence.pixels.assign(size.area(), cos_incidence);
    return scene;
}

// A wall with rows of boxes in front of it, and a dark stripe with amplitudes around the
// limit.
Scene boxes_scene() {
    Scene scene = flat_scene(nfov, 1.8f, 0.5f);
    for (int y = 0; y < nfov.height; ++y) {
        for (int x = 0; x < nfov.width; ++x) {
            if (x % 80 < 50 && y % 100 < 60)
                scene.depth_m.view().row(y)[x] = 1.2f + 0.002f * float(x % 80);
            if (y > 300 && y < 340)
                scene.reflectivity.view().row(y)[x] = 0.0015f * float(x % 80);
        }
    }
    return scene;
}

DepthSensorParams without_errors() {
    DepthSensorParams params;
    params.shot_mm2 = params.read_mm2 = 0;
    params.multipath = 0;
    params.offset_mm = params.scale = params.wiggle_mm = params.field_mm = params.fixed_mm = 0;
    return params;
}

DepthImage captured(DepthSensor& sensor, const Scene& scene, std::uint32_t frame) {
    DepthImage depth(scene.depth_m.size);
    sensor.capture(scene.truth(), frame, depth.view());
    return depth;
}

PairStatistics two_frames(const Scene& scene, const DepthSensorParams& params = {}) {
    DepthSensor sensor(params, scene.depth_m.size, 1);
    return measure_pair(captured(sensor, scene, 0), captured(sensor, scene, 1));
}

// True if a pixel around this one is on another surface or dark.
bool near_trouble(const Scene& scene, int x, int y) {
    const float own = scene.depth_m.view().row(y)[x];
    for (int dy = -2; dy <= 2; ++dy) {
        for (int dx = -2; dx <= 2; ++dx) {
            if (x + dx < 0 || x + dx >= nfov.width || y + dy < 0 || y + dy >= nfov.height)
                continue;
            if (std::abs(scene.depth_m.view().row(y + dy)[x + dx] - own) > 0.1f ||
                scene.reflectivity.view().row(y + dy)[x + dx] < 0.5f)
                return true;
        }
    }
    return false;
}

TEST(DepthSensor, RepeatsItselfInAnyOrder) {
    const Scene scene = boxes_scene();
    DepthSensor once({}, nfov, 5), again({}, nfov, 5), other({}, nfov, 6);
    const DepthImage third = captured(once, scene, 3);
    captured(again, scene, 9);
    EXPECT_EQ(captured(again, scene, 3), third);
    EXPECT_NE(captured(once, scene, 4), third);
    EXPECT_NE(captured(other, scene, 3), third);
}

TEST(DepthSensor, NoiseFollowsDistanceReflectivityAndIncidence) {
    const DepthSensorParams params;
    double previous = 0;
    for (const float depth : {0.6f, 1.0f, 1.5f, 2.2f, 3.0f}) {
        // In the middle of the image, where the light is even.
        const Size size{64, 64};
        DepthSensorParams even = params;
        even.corner_falloff = 0;
        DepthSensor sensor(even, size, 1);
        const Scene scene = flat_scene(size, depth, 0.6f);
        const double counts = params.counts_at_1m * 0.6 / (depth * depth);
        const double expected = params.shot_mm2 / counts + params.read_mm2 / (counts * counts);
        double squares = 0, n = 0;
        for (std::uint32_t frame = 0; frame < 20; frame += 2) {
            const DepthImage a = captured(sensor, scene, frame);
            const DepthImage b = captured(sensor, scene, frame + 1);
            for (std::size_t i = 0; i < a.pixels.size(); ++i) {
                if (a.pixels[i] && b.pixels[i]) {
                    squares += std::pow(a.pixels[i] - b.pixels[i], 2);
                    ++n;
                }
            }
        }
        const double sigma = std::sqrt(squares / n / 2);
        // Rounding adds a variance of 1/12 mm^2.
        EXPECT_NEAR(sigma, std::sqrt(expected + 1 / 12.0), 0.07 * sigma) << depth << " m";
        EXPECT_GT(sigma, previous);
        previous = sigma;
    }
    const auto sigma = [](float reflectivity, float cosine) {
        return two_frames(flat_scene(nfov, 2, reflectivity, cosine)).sigma[3];
    };
    EXPECT_GT(sigma(0.3f, 1), 1.4 * sigma(0.6f, 1));
    EXPECT_NEAR(sigma(0.6f, 0.5f), sigma(0.3f, 1), 0.01);
}

TEST(DepthSensor, NeighboursShareTheirNoise) {
    const PairStatistics wall = two_frames(flat_scene(nfov, 2, 0.5f));
    EXPECT_GT(wall.correlation, 0.53);
    EXPECT_LT(wall.correlation, 0.62);
    EXPECT_GT(wall.correlation_2, 0.3);
    EXPECT_LT(wall.correlation_2, 0.45);
}

TEST(DepthSensor, ValidityFlickersAtEdgesAndOnDarkSurfaces) {
    const Scene scene = boxes_scene();
    DepthSensor sensor({}, nfov, 1);
    const DepthImage a = captured(sensor, scene, 0), b = captured(sensor, scene, 1);
    const PairStatistics pair = measure_pair(a, b);
    EXPECT_GT(pair.flips, 1);
    EXPECT_LT(pair.flips, 4);
    int elsewhere = 0, invalid_elsewhere = 0;
    for (int y = 0; y < nfov.height; ++y) {
        for (int x = 0; x < nfov.width; ++x) {
            if (!inside_mask(nfov, x, y) || near_trouble(scene, x, y))
                continue;
            elsewhere += (a.view().row(y)[x] != 0) != (b.view().row(y)[x] != 0);
            invalid_elsewhere += a.view().row(y)[x] == 0;
        }
    }
    // In the darkest corners of the image even the wall is close to the limit.
    EXPECT_LT(elsewhere, 20);
    EXPECT_LT(invalid_elsewhere, 20);
}

TEST(DepthSensor, MeasuresOnlyInsideTheHexagon) {
    DepthSensor sensor({}, nfov, 1);
    const DepthImage depth = captured(sensor, flat_scene(nfov, 1.5f, 0.6f), 0);
    int valid = 0;
    for (int y = 0; y < nfov.height; ++y) {
        for (int x = 0; x < nfov.width; ++x) {
            EXPECT_EQ(depth.view().row(y)[x] != 0, inside_mask(nfov, x, y));
            valid += depth.view().row(y)[x] != 0;
        }
    }
    // As in the real camera's infrared image: 82.4 % of the pixels.
    EXPECT_NEAR(double(valid) / double(nfov.area()), 0.824, 0.01);
    EXPECT_FALSE(inside_mask(nfov, 140, 0));
    EXPECT_TRUE(inside_mask(nfov, 160, 0));
}

TEST(DepthSensor, DarkAndDazzlingSurfacesAreMissing) {
    DepthSensor sensor(without_errors(), small, 1);
    const auto middle = [&](const Scene& scene) {
        return captured(sensor, scene, 0).view().row(small.height / 2)[small.width / 2];
    };
    EXPECT_EQ(middle(flat_scene(small, 2, 0.5f)), 2000);
    EXPECT_EQ(middle(flat_scene(small, 2, 0.01f)), 0);
    EXPECT_EQ(middle(flat_scene(small, 0.1f, 1)), 0);

    Scene mirror = flat_scene(small, 1, 0.3f);
    Image<float> specular(small);
    specular.pixels.assign(small.area(), 0.8f);
    DepthTruth truth = mirror.truth();
    truth.specular = specular.view();
    DepthImage depth(small);
    sensor.capture(truth, 0, depth.view());
    EXPECT_EQ(depth.view().row(72)[80], 0);
    mirror.cos_incidence.pixels.assign(small.area(), 0.9f);
    sensor.capture(truth, 0, depth.view());
    EXPECT_EQ(depth.view().row(72)[80], 1000);
}

// Two walls side by side, the right one farther away by `step_m`.
std::vector<int> row_across_step(float step_m) {
    Scene scene = flat_scene(small, 1, 0.5f);
    for (int y = 0; y < small.height; ++y) {
        for (int x = 80; x < small.width; ++x)
            scene.depth_m.view().row(y)[x] += step_m;
    }
    DepthSensor sensor(without_errors(), small, 1);
    const DepthImage depth = captured(sensor, scene, 0);
    const std::uint16_t* row = depth.view().row(72);
    return {row + 76, row + 84};
}

TEST(DepthSensor, MixesSurfacesThatShareAPixel) {
    const std::vector<int> low = row_across_step(0.06f);
    EXPECT_EQ(low.front(), 1000);
    EXPECT_EQ(low.back(), 1060);
    int between = 0;
    for (const int mm : low)
        between += mm > 1003 && mm < 1057;
    EXPECT_GE(between, 2);

    const std::vector<int> high = row_across_step(1);
    EXPECT_EQ(high.front(), 1000);
    EXPECT_EQ(high.back(), 2000);
    EXPECT_GE(std::count(high.begin(), high.end(), 0), 1);
    EXPECT_LE(std::count(high.begin(), high.end(), 0), 3);
}

TEST(DepthSensor, InnerCornersReadLonger) {
    // Two walls that meet at a right angle at x = 320, 2 m away, seen along the bisector;
    // focal length 504 pixels.
    Scene scene = flat_scene(nfov, 2, 0.5f, 0.7f);
    Scene outer = scene;
    for (int y = 0; y < nfov.height; ++y) {
        for (int x = 0; x < nfov.width; ++x) {
            const float u = std::abs((float(x) + 0.5f - 320) / 504);
            scene.depth_m.view().row(y)[x] = 2 / (1 + u);
            outer.depth_m.view().row(y)[x] = 2 / (1 - u);
        }
    }
    DepthSensorParams params = without_errors();
    params.multipath = DepthSensorParams{}.multipath;
    DepthSensor sensor(params, nfov, 1);
    const auto error_mm = [&](const Scene& of, int x) {
        const DepthImage depth = captured(sensor, of, 0);
        return depth.view().row(288)[x] - 1000 * of.depth_m.view().row(288)[x];
    };
    EXPECT_GT(error_mm(scene, 320), 4);
    EXPECT_LT(error_mm(scene, 320), 20);
    EXPECT_NEAR(error_mm(scene, 400), 0, 0.6);
    EXPECT_NEAR(error_mm(outer, 320), 0, 0.6);
}

TEST(DepthSensor, EveryCameraHasItsOwnSmoothBias) {
    double squares = 0;
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
        const DepthSensor sensor({}, small, seed);
        const DepthSensor next({}, small, seed + 1);
        EXPECT_NE(sensor.distance_error_mm(1500), next.distance_error_mm(1500));
        for (int i = 50; i < 400; ++i) {
            const float mm = 10 * float(i);
            const float error = sensor.distance_error_mm(mm);
            // The manufacturer specifies less than 11 mm + 0.1 % of the distance.
            EXPECT_LT(std::abs(error), 11 + mm / 1000);
            EXPECT_LT(std::abs(sensor.distance_error_mm(mm + 10) - error), 0.3f);
            squares += error * error / (20 * 350);
        }
    }
    EXPECT_GT(std::sqrt(squares), 1);
    EXPECT_LT(std::sqrt(squares), 4);
}

TEST(DepthSensor, FixedErrorsShowInTheImage) {
    DepthSensorParams params;
    params.shot_mm2 = params.read_mm2 = 0;
    const Scene wall = flat_scene(small, 1.5f, 0.5f);
    for (std::uint32_t seed = 0; seed < 4; ++seed) {
        DepthSensor sensor(params, small, seed);
        const DepthImage depth = captured(sensor, wall, 0);
        EXPECT_EQ(captured(sensor, wall, 1), depth);
        double sum = 0, squares = 0, n = 0;
        for (const std::uint16_t mm : depth.pixels) {
            if (mm == 0)
                continue;
            const double error = mm - 1500.0 - sensor.distance_error_mm(1500);
            sum += error;
            squares += error * error;
            ++n;
        }
        EXPECT_NEAR(sum / n, 0, params.field_mm);
        EXPECT_NEAR(std::sqrt(squares / n), params.field_mm, 0.5 * params.field_mm);
    }
}

ColorImage grey(std::uint8_t level) {
    ColorImage picture(small);
    picture.pixels.assign(small.area(), {level, level, level});
    return picture;
}

TEST(ColorSensor, GivesEachCameraItsGainsAndNoise) {
    const ColorImage picture = grey(120);
    const auto look = [&](std::uint32_t seed, std::uint32_t frame) {
        ColorImage out(small);
        apply_color_sensor({}, seed, frame, picture.view(), out.view());
        return out;
    };
    EXPECT_EQ(look(1, 0), look(1, 0));
    EXPECT_NE(look(1, 0), look(1, 1));

    const auto mean_and_deviation = [](const ColorImage& image) {
        double sum = 0, squares = 0;
        for (const Rgb& p : image.pixels) {
            sum += p.g;
            squares += p.g * p.g;
        }
        const double n = double(image.pixels.size()), mean = sum / n;
        return std::pair(mean, std::sqrt(squares / n - mean * mean));
    };
    const auto [mean1, deviation1] = mean_and_deviation(look(1, 0));
    const auto [mean2, deviation2] = mean_and_deviation(look(2, 0));
    EXPECT_NEAR(deviation1, ColorSensorParams{}.noise, 0.1);
    EXPECT_NEAR(mean1, 120, 25);
    EXPECT_GT(std::abs(mean1 - mean2), 0.5);

    // A camera without deviations returns the picture unchanged.
    ColorImage out(small);
    apply_color_sensor({.exposure_stops = 0, .white_balance = 0, .noise = 0}, 1, 0, picture.view(),
                       out.view());
    EXPECT_EQ(out, picture);
}

TEST(SensorRandom, IsSpreadLikeANormalDistribution) {
    double sum = 0, squares = 0, fourth = 0;
    constexpr int n = 1 << 16;
    for (std::uint32_t i = 0; i < n; ++i) {
        const double v = normal_at(77, i);
        sum += v;
        squares += v * v;
        fourth += v * v * v * v;
    }
    EXPECT_NEAR(sum / n, 0, 0.015);
    EXPECT_NEAR(squares / n, 1, 0.02);
    EXPECT_NEAR(fourth / n, 2.7, 0.1);  // 3 for a true one, 3 - 1.2 / 4 for four bytes
}

TEST(SensorRandom, FieldHasUnitVariance) {
    NoiseField field({256, 256}, 1.5f, 0.35f);
    const View<const float> v = field.draw(3);
    double squares = 0;
    for (int y = 0; y < 256; ++y) {
        for (int x = 0; x < 256; ++x)
            squares += v.row(y)[x] * v.row(y)[x];
    }
    EXPECT_NEAR(squares / 65536, 1, 0.05);
}

}  // namespace
}  // namespace theatron::synthetic
