// SPDX-License-Identifier: Apache-2.0
#include "synthetic/sensor_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace theatron::synthetic {

namespace {

constexpr float mm_per_m = 1000;
// Amplitude around a hole, as a multiple of min_counts, from which on the hole counts as
// dazzling, not dark.
constexpr float bright = 9;

// Solves the normal equations m p = r of six parameters; false if they are singular.
bool solve(double (&m)[6][7]) {
    for (int i = 0; i < 6; ++i) {
        if (m[i][i] < 1e-6)
            return false;
        for (int k = i + 1; k < 6; ++k) {
            const double factor = m[k][i] / m[i][i];
            for (int c = i; c < 7; ++c)
                m[k][c] -= factor * m[i][c];
        }
    }
    for (int i = 5; i >= 0; --i) {
        for (int c = i + 1; c < 6; ++c)
            m[i][6] -= m[i][c] * m[c][6];
        m[i][6] /= m[i][i];
    }
    return true;
}

// The depth of one pixel on a curved surface fitted to the surrounding pixels of the same
// surface.
float smoothed(View<const float> depth, int x, int y) {
    // Every second pixel suffices: neighbours share most of their noise.
    constexpr int radius = 4, step = 2;
    const float own = depth.row(y)[x];
    const float same_surface = 15 + 0.012f * own;
    double m[6][7] = {};
    int n = 0;
    for (int dy = -radius; dy <= radius; dy += step) {
        for (int dx = -radius; dx <= radius; dx += step) {
            if (x + dx < 0 || x + dx >= depth.size.width || y + dy < 0 ||
                y + dy >= depth.size.height)
                continue;
            const float z = depth.row(y + dy)[x + dx];
            if (z == 0 || std::abs(z - own) > same_surface)
                continue;
            const double u = dx, v = dy;
            const double row[7] = {1, u, v, u * u, u * v, v * v, z - own};
            for (int i = 0; i < 6; ++i) {
                for (int c = i; c < 7; ++c)
                    m[i][c] += row[i] * row[c];
            }
            ++n;
        }
    }
    for (int i = 0; i < 6; ++i) {
        for (int c = 0; c < i; ++c)
            m[i][c] = m[c][i];
    }
    return n >= 10 && solve(m) ? own + float(m[0][6]) : own;
}

using Mask = Image<std::uint8_t>;

Image<float> neighbourhood_mean(const Image<float>& in) {
    Image<float> out(in.size);
    const auto [width, height] = in.size;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            float sum = 0;
            for (int dy = -1; dy <= 1; ++dy) {
                for (int dx = -1; dx <= 1; ++dx)
                    sum += in.view().row(
                        std::clamp(y + dy, 0, height - 1))[std::clamp(x + dx, 0, width - 1)];
            }
            out.view().row(y)[x] = sum / 9;
        }
    }
    return out;
}

// Holes of at least three pixels: dark or dazzling surfaces, not edges.
Mask wide_holes(const Image<float>& valid) {
    Image<float> inner(valid.size);
    const Image<float> mean = neighbourhood_mean(valid);
    for (std::size_t i = 0; i < inner.pixels.size(); ++i)
        inner.pixels[i] = mean.pixels[i] == 0;
    const Image<float> grown = neighbourhood_mean(inner);
    Mask wide(valid.size);
    for (std::size_t i = 0; i < wide.pixels.size(); ++i)
        wide.pixels[i] = grown.pixels[i] > 0;
    return wide;
}

// Measured properties of a scene, from which its surfaces are derived.
struct Estimate {
    Image<float> depth_mm;  // 0 = not measured
    Image<float> valid;     // share of the frames in which it was measured
    Image<float> counts;    // amplitude
};

// Fills narrow holes with the surface beside them: the model has to find the edges itself.
void fill_holes(Estimate& e) {
    const auto [width, height] = e.depth_mm.size;
    for (int pass = 0; pass < 3; ++pass) {
        const Estimate before = e;
        for (int y = 1; y + 1 < height; ++y) {
            for (int x = 1; x + 1 < width; ++x) {
                const int at = y * width + x;
                if (before.depth_mm.pixels[std::size_t(at)] > 0)
                    continue;
                // Alternating sides, so that neither surface grows.
                const int side = (x + y) % 2 ? 1 : -1;
                for (const int offset : {side, side * width, -side, -side * width}) {
                    const std::size_t from = std::size_t(at + offset);
                    if (before.depth_mm.pixels[from] == 0)
                        continue;
                    e.depth_mm.pixels[std::size_t(at)] = before.depth_mm.pixels[from];
                    e.counts.pixels[std::size_t(at)] = before.counts.pixels[from];
                    break;
                }
            }
        }
    }
}

bool at_step(const Image<float>& depth_mm, int x, int y) {
    float nearest = 1e9f, farthest = 0;
    for (int dy = -2; dy <= 2; ++dy) {
        for (int dx = -2; dx <= 2; ++dx) {
            const int px = std::clamp(x + dx, 0, depth_mm.size.width - 1);
            const float z =
                depth_mm.view().row(std::clamp(y + dy, 0, depth_mm.size.height - 1))[px];
            if (z == 0)
                continue;
            nearest = std::min(nearest, z);
            farthest = std::max(farthest, z);
        }
    }
    return farthest - nearest > 60 + 0.03f * nearest;
}

// Beyond the hexagon nothing is known, so its rim must not be classified as dark.
void trust_rim(Estimate& e) {
    Image<float> lit(e.valid.size);
    for (int y = 0; y < lit.size.height; ++y) {
        for (int x = 0; x < lit.size.width; ++x)
            lit.view().row(y)[x] = inside_mask(lit.size, x, y);
    }
    const Image<float> inner = neighbourhood_mean(neighbourhood_mean(lit));
    for (std::size_t i = 0; i < lit.pixels.size(); ++i) {
        if (inner.pixels[i] < 0.99f)
            e.valid.pixels[i] = 1;
    }
}

Scene scene_from(Estimate e, const DepthSensorParams& params) {
    const Size size = e.depth_mm.size;
    trust_rim(e);
    const Mask dark = wide_holes(e.valid);
    const Image<float> around = neighbourhood_mean(e.valid);
    const Image<float> measured = e.depth_mm;
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            if (measured.view().row(y)[x] > 0)
                e.depth_mm.view().row(y)[x] = smoothed(measured.view(), x, y);
        }
    }
    fill_holes(e);

    Scene scene;
    for (Image<float>* image : {&scene.depth_m, &scene.reflectivity, &scene.cos_incidence})
        image->resize(size);
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            const std::size_t i = std::size_t(y * size.width + x);
            const float z = e.depth_mm.pixels[i] / mm_per_m;
            float counts = e.counts.pixels[i];
            const float validity = (around.pixels[i] + e.valid.pixels[i]) / 2;
            const bool step = at_step(e.depth_mm, x, y);
            if (dark.pixels[i] && step)
                counts = 0;
            else if (validity < 1 && !step)
                counts = counts > bright * params.min_counts
                             ? params.max_counts / (2 * validity + 0.01f)
                             : 2 * params.min_counts * validity;
            const float light = illumination_at(params, size, x, y);
            scene.depth_m.pixels[i] = z;
            scene.cos_incidence.pixels[i] = 1;
            scene.reflectivity.pixels[i] = counts * z * z / (params.counts_at_1m * light);
        }
    }
    return scene;
}

// The variance of the noise around a pixel, from pixels of the same surface.
float variance_around(const DepthImage& first, const DepthImage& second, int x, int y) {
    constexpr int radius = 6;
    const int own = std::max(first.view().row(y)[x], second.view().row(y)[x]);
    double sum = 0;
    int n = 0;
    for (int py = std::max(y - radius, 0); py <= std::min(y + radius, first.size.height - 1);
         ++py) {
        for (int px = std::max(x - radius, 0); px <= std::min(x + radius, first.size.width - 1);
             ++px) {
            const int a = first.view().row(py)[px], b = second.view().row(py)[px];
            if (a == 0 || b == 0 || std::abs(b - a) > 12 || std::abs(a - own) > own / 20)
                continue;
            sum += (b - a) * (b - a);
            ++n;
        }
    }
    // Rounding of both frames to millimetres adds a variance of 1/12 each.
    return n > 8 ? std::max(float(sum / n) / 2 - 1 / 12.0f, 0.03f) : 4.0f;
}

}  // namespace

Scene scene_from_pair(const DepthImage& first, const DepthImage& second,
                      const DepthSensorParams& params) {
    const Size size = first.size;
    Estimate e{Image<float>(size), Image<float>(size), Image<float>(size)};
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            const std::size_t i = std::size_t(y * size.width + x);
            const float a = first.pixels[i], b = second.pixels[i];
            const int frames = (a > 0) + (b > 0);
            if (frames == 0)
                continue;
            e.valid.pixels[i] = float(frames) / 2;
            e.depth_mm.pixels[i] = (a + b) / float(frames);
            // The model's variance law, solved for the amplitude.
            const float v = variance_around(first, second, x, y);
            const float root =
                std::sqrt(params.shot_mm2 * params.shot_mm2 + 4 * v * params.read_mm2);
            e.counts.pixels[i] =
                std::max((params.shot_mm2 + root) / (2 * v), 2.2f * params.min_counts);
        }
    }
    return scene_from(std::move(e), params);
}

Scene scene_from_infrared(const DepthImage& depth, const DepthImage& infrared,
                          const DepthSensorParams& params) {
    const Size size = depth.size;
    Estimate e{Image<float>(size), Image<float>(size), Image<float>(size)};
    for (std::size_t i = 0; i < size.area(); ++i) {
        e.depth_mm.pixels[i] = depth.pixels[i];
        e.valid.pixels[i] = depth.pixels[i] > 0;
        e.counts.pixels[i] = infrared.pixels[i];
    }
    e.counts = neighbourhood_mean(e.counts);
    return scene_from(std::move(e), params);
}

TEST(SensorScene, RecoversWhatTheModelDrew) {
    // A slope with a line missing.
    const Size size{120, 108};
    const DepthSensorParams params = nfov_binned();
    Scene slope;
    for (Image<float>* image : {&slope.depth_m, &slope.reflectivity, &slope.cos_incidence})
        image->resize(size);
    for (std::size_t i = 0; i < size.area(); ++i) {
        slope.depth_m.pixels[i] = 1.8f + 0.002f * float(i % 120);
        slope.reflectivity.pixels[i] = 0.3f;
        slope.cos_incidence.pixels[i] = 1;
    }
    DepthSensorParams drawn = params;
    drawn.offset_mm = drawn.scale = drawn.wiggle_mm = drawn.field_mm = drawn.fixed_mm = 0;
    DepthSensor sensor(drawn, size, 3);
    DepthImage first(size), second(size);
    sensor.capture(slope.truth(), 0, first.view());
    sensor.capture(slope.truth(), 1, second.view());
    for (int x = 0; x < size.width; ++x)
        first.view().row(50)[x] = second.view().row(50)[x] = 0;

    const Scene found = scene_from_pair(first, second, params);
    double square = 0, counts = 0, n = 0;
    for (int y = 30; y < 80; ++y) {
        if (std::abs(y - 50) < 4)
            continue;
        for (int x = 30; x < 90; ++x) {
            const double error = found.depth_m.view().row(y)[x] - slope.depth_m.view().row(y)[x];
            square += error * error;
            counts += found.reflectivity.view().row(y)[x];
            ++n;
        }
    }
    EXPECT_LT(std::sqrt(square / n), 0.001);
    EXPECT_NEAR(counts / n, 0.3, 0.06);
}

}  // namespace theatron::synthetic
