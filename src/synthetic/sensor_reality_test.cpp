// SPDX-License-Identifier: Apache-2.0
// The sensor model compared with real frames: their scenes, smoothed, are the model's input;
// its output must have the statistics of the real frames.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <string>

#include "files/png_file.h"
#include "synthetic/sensor_model.h"
#include "synthetic/sensor_scene.h"
#include "synthetic/sensor_statistics.h"
#include "testing/shared_data.h"

namespace theatron::synthetic {
namespace {

constexpr double tolerance = 0.15;

void compare(const char* what, double real, double model) {
    std::printf("  %-30s %8.3f %8.3f  %+5.1f %%\n", what, real, model, 100 * (model / real - 1));
    EXPECT_NEAR(model, real, tolerance * real) << what;
}

void show(const char* what, double real, double model) {
    std::printf("  %-30s %8.3f %8.3f\n", what, real, model);
}

class RealPair : public ::testing::TestWithParam<const char*> {};

TEST_P(RealPair, LooksLikeTheModelOfItsScene) {
    const std::string folder = std::string("azure-nfov-2x2-pair-") + GetParam() + "_320x288/depth/";
    THEATRON_REQUIRE_DATA(folder);
    const DepthImage first =
        files::read_depth_png(theatron::testing::shared_data() / (folder + "00000.png"));
    const DepthImage second =
        files::read_depth_png(theatron::testing::shared_data() / (folder + "00001.png"));
    const DepthSensorParams params = nfov_binned();
    const Scene scene = scene_from_pair(first, second, params);

    // Pairs of several cameras, stacked vertically, so that random errors average out.
    constexpr int cameras = 4;
    const Size stacked{first.size.width, cameras * first.size.height};
    DepthImage frames[2] = {DepthImage(stacked), DepthImage(stacked)};
    for (int camera = 0; camera < cameras; ++camera) {
        DepthSensor sensor(params, first.size, std::uint32_t(camera));
        for (std::uint32_t i = 0; i < 2; ++i) {
            std::uint16_t* top = frames[i].view().row(camera * first.size.height);
            sensor.capture(scene.truth(), i, {top, first.size});
        }
    }

    const PairStatistics real = measure_pair(first, second);
    const PairStatistics model = measure_pair(frames[0], frames[1]);
    std::printf("  %-30s %8s %8s\n", GetParam(), "real", "model");
    compare("rvl bits per pixel", real.rvl_bits, model.rvl_bits);
    compare("trvl bits per pixel", real.trvl_bits, model.trvl_bits);
    compare("valid pixels, %", real.valid, model.valid);
    compare("validity flips, %", real.flips, model.flips);
    compare("changed pixels, %", real.changed, model.changed);
    compare("neighbour correlation", real.correlation, model.correlation);
    show("correlation at 2 pixels", real.correlation_2, model.correlation_2);
    const char* names[] = {"difference 0, %", "difference +1, %", "difference -1, %",
                           "difference +2, %", "difference -2, %"};
    for (std::size_t i = 0; i < 5; ++i)
        show(names[i], real.shares[i], model.shares[i]);
    for (std::size_t bin = 0; bin < distance_bins; ++bin) {
        const std::string name = "sigma mm, " + std::to_string(distance_bounds_mm[bin]) + "-" +
                                 std::to_string(distance_bounds_mm[bin + 1]) + " mm";
        // Bins with less than half a per cent of the image are too small to compare.
        if (real.pixels[bin] > 0.45)
            compare(name.c_str(), real.sigma[bin], model.sigma[bin]);
    }
}

INSTANTIATE_TEST_SUITE_P(Azure, RealPair, ::testing::Values("room", "person"),
                         [](const auto& scene) { return std::string(scene.param); });

// Deviation of a depth image from locally flat, along rows, by infrared counts: a second
// difference over two pixels, which slopes do not change.
constexpr int counts_bounds[] = {60, 100, 150, 250, 400, 700, 1200};

double roughness(const DepthImage& depth, const DepthImage& infrared, int from, int to) {
    double sum = 0;
    int n = 0;
    for (int y = 0; y < depth.size.height; ++y) {
        const std::uint16_t* z = depth.view().row(y);
        const std::uint16_t* counts = infrared.view().row(y);
        for (int x = 2; x + 2 < depth.size.width; ++x) {
            if (counts[x] < from || counts[x] >= to || !z[x - 2] || !z[x] || !z[x + 2])
                continue;
            const int bend = z[x - 2] - 2 * z[x] + z[x + 2];
            if (std::abs(bend) > 12)
                continue;
            sum += bend * bend;
            ++n;
        }
    }
    return std::sqrt(sum / n);
}

TEST(RealFrame, LooksLikeTheModelOfItsScene) {
    const std::string folder = "azure-nfov-unbinned-1frame_640x576/";
    THEATRON_REQUIRE_DATA(folder);
    const auto path = theatron::testing::shared_data() / folder;
    const DepthImage real = files::read_depth_png(path / "depth/00000.png");
    const DepthImage infrared = files::read_depth_png(path / "ir/00000.png");
    const DepthSensorParams params = nfov_unbinned();
    const Scene scene = scene_from_infrared(real, infrared, params);
    DepthSensor sensor(params, real.size, 1);
    DepthImage frames[2] = {DepthImage(real.size), DepthImage(real.size)};
    for (std::uint32_t i = 0; i < 2; ++i)
        sensor.capture(scene.truth(), i, frames[i].view());
    const PairStatistics as_pair = measure_pair(frames[0], frames[1]);

    const double pixels = double(real.size.area());
    const auto valid = [&](const DepthImage& depth) {
        return 100 - 100 * double(std::count(depth.pixels.begin(), depth.pixels.end(), 0)) / pixels;
    };
    std::printf("  %-30s %8s %8s\n", "unbinned frame", "real", "model");
    compare("rvl bits per pixel", rvl_bits(real) / pixels, rvl_bits(frames[0]) / pixels);
    compare("valid pixels, %", valid(real), valid(frames[0]));
    for (std::size_t i = 0; i + 1 < std::size(counts_bounds); ++i) {
        const int from = counts_bounds[i], to = counts_bounds[i + 1];
        const std::string name =
            "bend mm, " + std::to_string(from) + "-" + std::to_string(to) + " counts";
        compare(name.c_str(), roughness(real, infrared, from, to),
                roughness(frames[0], infrared, from, to));
    }
    std::printf("  model only: flips %.2f %%, trvl %.2f bits, correlation %.2f, sigma",
                as_pair.flips, as_pair.trvl_bits, as_pair.correlation);
    for (const double sigma : as_pair.sigma)
        std::printf(" %.2f", sigma);
    std::printf("\n");
}

}  // namespace
}  // namespace theatron::synthetic
