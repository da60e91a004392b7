// SPDX-License-Identifier: Apache-2.0
#include "synthetic/sensor_model.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace theatron::synthetic {
namespace {

constexpr float pi = 3.14159265f;
constexpr int multipath_cell = 8;  // pixels a side
// The largest relative change of 1/z from one cell to the next on a wall, at an angle of
// about 57 degrees. A larger change is an occlusion.
constexpr float steepest_wall = 0.025f;
constexpr float table_step_mm = 10;  // resolution of distance_error_
constexpr int table_size = 1024;     // to 10 m
constexpr float max_phase_mm = 300;  // limit of the distance between mixed surfaces

// A depth edge. Neighbours are examined only there, not inside surfaces.
constexpr float step_at(float depth_mm) {
    return 15 + 0.02f * depth_mm;
}

// The specular lobe of instruments and wet tissue at normal incidence, wide enough to cover
// some pixels.
float glint(float specular, float cos_incidence) {
    const float c4 = std::pow(cos_incidence, 4.0f);
    const float c16 = c4 * c4 * c4 * c4;
    const float c64 = c16 * c16 * c16 * c16;
    return specular * 60 * c64 * c64 * c64 * c64;
}

// Random values on a coarse grid, interpolated.
class SlowField {
public:
    explicit SlowField(std::uint32_t key) : key_(key) {}

    float at(float u, float v) const {  // 0 to 1 over the image
        const float gx = u * cells, gy = v * cells;
        const int x = int(gx), y = int(gy);
        const float fx = smooth(gx - float(x)), fy = smooth(gy - float(y));
        return blend(blend(node(x, y), node(x + 1, y), fx),
                     blend(node(x, y + 1), node(x + 1, y + 1), fx), fy);
    }

private:
    static constexpr int cells = 6;
    static float smooth(float t) { return t * t * (3 - 2 * t); }
    static float blend(float a, float b, float t) { return a + (b - a) * t; }
    float node(int x, int y) const { return normal_at(key_, std::uint32_t(y * 64 + x)); }

    std::uint32_t key_;
};

std::vector<float> distance_table(const DepthSensorParams& params, std::uint32_t seed) {
    const std::uint32_t key = noise_key(seed, 0, distance_errors);
    const float offset = params.offset_mm * normal_at(key, 0);
    const float scale = params.scale * normal_at(key, 1);
    const float phase1 = 2 * pi * uniform_at(key, 2), phase2 = 2 * pi * uniform_at(key, 3);
    std::vector<float> table(table_size);
    for (int i = 0; i < table_size; ++i) {
        const float mm = float(i) * table_step_mm;
        table[std::size_t(i)] = offset + scale * mm +
                                params.wiggle_mm * (0.7f * std::sin(2 * pi * mm / 1500 + phase1) +
                                                    0.3f * std::sin(2 * pi * mm / 375 + phase2));
    }
    return table;
}

std::vector<float> pixel_errors(const DepthSensorParams& params, Size size, std::uint32_t seed) {
    const SlowField slow(noise_key(seed, 0, slow_errors));
    NoiseField noise(size, 1, 0.5f);
    const View<const float> fixed = noise.draw(noise_key(seed, 0, fixed_errors));
    std::vector<float> errors(size.area());
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x)
            errors[std::size_t(y * size.width + x)] =
                params.field_mm *
                    slow.at(float(x) / float(size.width), float(y) / float(size.height)) +
                params.fixed_mm * fixed.row(y)[x];
    }
    return errors;
}

}  // namespace

DepthSensorParams nfov_unbinned() {
    return {};
}

DepthSensorParams nfov_binned() {
    DepthSensorParams params;
    params.counts_at_1m *= 4;
    params.max_counts *= 4;
    params.read_mm2 *= 4;  // four pixels are read per output pixel
    return params;
}

// Measured on the infrared image of an unbinned 640x576 frame, accurate to two pixels. Edges
// of binned frames are at half of these coordinates.
bool inside_mask(Size size, int x, int y) {
    const float px = (float(x) + 0.5f) * 640 / float(size.width);
    const float py = (float(y) + 0.5f) * 576 / float(size.height);
    return px > 152 - py / 1.8f && px < 514 + py / 1.8f && px > 0.6f * (py - 333) &&
           px < 628 - 0.6f * (py - 396);
}

float illumination_at(const DepthSensorParams& params, Size size, int x, int y) {
    const float dx = (2 * float(x) + 1) / float(size.width) - 1;
    const float dy = (2 * float(y) + 1 - float(size.height)) / float(size.width);
    return std::max(1 - params.corner_falloff * (dx * dx + dy * dy), 0.05f);
}

DepthSensor::DepthSensor(const DepthSensorParams& params, Size size, std::uint32_t seed)
    : params_(params),
      size_(size),
      seed_(seed),
      mask_(size.area()),
      illumination_(size.area()),
      pixel_error_mm_(pixel_errors(params, size, seed)),
      distance_error_(distance_table(params, seed)),
      noise_(size, params.noise_radius_px, params.noise_white_share),
      counts_(size.area()),
      depth_mm_(size.area()),
      seen_counts_(size.area()),
      seen_mm_(size.area()) {
    assert(is_valid(size));
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            const std::size_t at = std::size_t(y * size.width + x);
            mask_[at] = inside_mask(size, x, y);
            illumination_[at] = illumination_at(params, size, x, y);
        }
    }
}

float DepthSensor::distance_error_mm(float depth_mm) const {
    const float at = std::clamp(depth_mm / table_step_mm, 0.0f, float(table_size - 2));
    const std::size_t i = std::size_t(at);
    const float t = at - float(i);
    return distance_error_[i] + (distance_error_[i + 1] - distance_error_[i]) * t;
}

void DepthSensor::receive_light(const DepthTruth& truth) {
    const bool shiny = truth.specular.pixels != nullptr;
    for (int y = 0; y < size_.height; ++y) {
        const std::size_t row = std::size_t(y) * std::size_t(size_.width);
        const float* depth = truth.depth_m.row(y);
        const float* reflectivity = truth.reflectivity.row(y);
        const float* cosine = truth.cos_incidence.row(y);
        const float* light = illumination_.data() + row;
        float* counts = counts_.data() + row;
        float* mm = depth_mm_.data() + row;
        for (int x = 0; x < size_.width; ++x) {
            const float near = std::max(depth[x], 0.05f);
            const float sent_back = reflectivity[x] * std::max(cosine[x], 0.0f);
            const bool there = depth[x] > 0;
            counts[x] = there ? params_.counts_at_1m * light[x] * sent_back / (near * near) : 0.0f;
            mm[x] = there ? depth[x] * 1000 : 0.0f;
        }
        if (!shiny)
            continue;
        const float* specular = truth.specular.row(y);
        for (int x = 0; x < size_.width; ++x) {
            if (specular[x] > 0 && cosine[x] > 0.95f && depth[x] > 0.05f)
                counts[x] += params_.counts_at_1m * light[x] * glint(specular[x], cosine[x]) /
                             (depth[x] * depth[x]);
        }
    }
}

// Multipath: light that is reflected between the walls of a corner arrives late, so that the
// corner reads too far and looks rounded. Detected in screen space on a coarse grid: on a
// plane 1/z is linear over the image; inside a corner it is below the mean of opposite
// neighbours.
void DepthSensor::add_multipath() {
    const int columns = size_.width / multipath_cell, rows = size_.height / multipath_cell;
    if (columns < 2 || rows < 2)
        return;
    const auto inverse_at = [&](int column, int row) {
        if (column < 0 || column >= columns || row < 0 || row >= rows)
            return 0.0f;
        const int x = column * multipath_cell + multipath_cell / 2;
        const int y = row * multipath_cell + multipath_cell / 2;
        const float mm = depth_mm_[std::size_t(y * size_.width + x)];
        return mm > 0 ? 1 / mm : 0.0f;
    };
    corner_mm_.assign(std::size_t(columns * rows), 0);
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const float own = inverse_at(column, row);
            if (own == 0)
                continue;
            float inside = 0;
            static constexpr int directions[4][2] = {{1, 0}, {0, 1}, {1, 1}, {1, -1}};
            for (const auto& [dx, dy] : directions) {
                float line[5];
                for (int k = -2; k <= 2; ++k)
                    line[k + 2] = inverse_at(column + k * dx, row + k * dy);
                float steepest = 0;
                for (int k = 0; k < 4; ++k)
                    steepest = std::max(steepest, std::abs(line[k + 1] - line[k]));
                if (steepest <= steepest_wall * own)
                    inside = std::max(inside, ((line[0] + line[4]) / 2 - own) / (own * own));
            }
            corner_mm_[std::size_t(row * columns + column)] = params_.multipath * inside;
        }
    }

    for (int y = 0; y < size_.height; ++y) {
        const float gy =
            std::clamp((float(y) + 0.5f) / multipath_cell - 0.5f, 0.0f, float(rows) - 1.001f);
        const float fy = gy - std::floor(gy);
        const float* above = corner_mm_.data() + int(gy) * columns;
        const float* below = above + columns;
        float* mm = depth_mm_.data() + std::size_t(y) * std::size_t(size_.width);
        for (int x = 0; x < size_.width; ++x) {
            const float gx = std::clamp((float(x) + 0.5f) / multipath_cell - 0.5f, 0.0f,
                                        float(columns) - 1.001f);
            const int column = int(gx);
            const float fx = gx - float(column);
            const float upper = above[column] + (above[column + 1] - above[column]) * fx;
            const float lower = below[column] + (below[column + 1] - below[column]) * fx;
            mm[x] += mm[x] > 0 ? upper + (lower - upper) * fy : 0.0f;
        }
    }
}

// Copies depth and amplitudes, and mixes them in pixels that see two surfaces.
void DepthSensor::mix_at_edges(std::uint32_t frame) {
    seen_counts_ = counts_;
    seen_mm_ = depth_mm_;
    const std::uint32_t key = noise_key(seed_, frame, mixing_noise);
    const int width = size_.width;
    near_edge_.assign(std::size_t(width), 0);
    for (int y = 2; y + 2 < size_.height; ++y) {
        const float* mm = depth_mm_.data() + std::size_t(y) * std::size_t(width);
        for (int x = 2; x + 2 < width; ++x) {
            const float own = mm[x];
            const auto step = [&](int offset) { return std::abs(mm[x + offset] - own); };
            const float widest =
                std::max(std::max(std::max(step(-1), step(1)), std::max(step(-2), step(2))),
                         std::max(std::max(step(-width), step(width)),
                                  std::max(step(-2 * width), step(2 * width))));
            near_edge_[std::size_t(x)] = widest > step_at(own);
        }
        for (int x = 2; x + 2 < width; ++x) {
            if (near_edge_[std::size_t(x)])
                mix_pixel(x, y, normal_at(key, std::uint32_t(y * width + x)));
        }
    }
}

// One pixel with light of a near and a far surface. The stronger surface is measured, with an
// error towards the other by its share of the light. If the modulation frequencies would
// disagree too much, the camera rejects the pixel.
void DepthSensor::mix_pixel(int x, int y, float jitter) {
    const float blur[5] = {params_.blur_second, params_.blur_next,
                           1 - 2 * (params_.blur_next + params_.blur_second), params_.blur_next,
                           params_.blur_second};
    float weights[25], depths[25];
    float nearest = 1e9f, farthest = 0;
    int n = 0;
    for (int dy = -2; dy <= 2; ++dy) {
        const std::size_t row = std::size_t((y + dy) * size_.width + x);
        for (int dx = -2; dx <= 2; ++dx) {
            const std::size_t at = row + std::size_t(dx);
            const float mm = depth_mm_[at];
            if (mm == 0)
                continue;
            weights[n] = blur[dy + 2] * blur[dx + 2] * counts_[at];
            depths[n++] = mm;
            nearest = std::min(nearest, mm);
            farthest = std::max(farthest, mm);
        }
    }
    const std::size_t at = std::size_t(y * size_.width + x);
    const float middle = (nearest + farthest) / 2;
    float weight[2] = {0, 0}, sum[2] = {0, 0};
    for (int i = 0; i < n; ++i) {
        const int far = depths[i] > middle;
        weight[far] += weights[i];
        sum[far] += weights[i] * depths[i];
    }
    const float all = weight[0] + weight[1];
    seen_counts_[at] = all;
    if (all == 0) {
        seen_mm_[at] = 0;
        return;
    }
    const int stronger = weight[1] > weight[0];
    const float surface = sum[stronger] / weight[stronger];
    float pull = 0;
    for (int i = 0; i < n; ++i)
        pull += weights[i] * std::clamp(depths[i] - surface, -max_phase_mm, max_phase_mm);
    pull /= all;
    const float limit = params_.max_mixed_mm * (1 + params_.mixed_jitter * jitter);
    seen_mm_[at] = std::abs(pull) > limit ? 0 : surface + pull;
}

void DepthSensor::capture(const DepthTruth& truth, std::uint32_t frame, MutableDepthView out) {
    assert(truth.specular.pixels == nullptr || truth.specular.size == size_);
    assert(truth.depth_m.size == size_ && truth.reflectivity.size == size_ &&
           truth.cos_incidence.size == size_ && out.size == size_);
    receive_light(truth);
    add_multipath();
    mix_at_edges(frame);

    const View<const float> noise = noise_.draw(noise_key(seed_, frame, depth_noise));
    for (int y = 0; y < size_.height; ++y) {
        const std::size_t row = std::size_t(y) * std::size_t(size_.width);
        const float* random = noise.row(y);
        // Phase and amplitude noise are independent and of the same kind: the field upside
        // down serves as the second one.
        const float* amplitude_noise = noise.row(size_.height - 1 - y);
        std::uint16_t* depth = out.row(y);
        for (int x = 0; x < size_.width; ++x) {
            const std::size_t at = row + std::size_t(x);
            const float counts = seen_counts_[at];
            depth[x] = 0;
            if (seen_mm_[at] == 0 || !mask_[at] || !measurable(counts, amplitude_noise[x]))
                continue;
            const float per_count = 1 / counts;
            const float sigma =
                std::sqrt((params_.shot_mm2 + params_.read_mm2 * per_count) * per_count);
            const float mm = seen_mm_[at] + distance_error_mm(seen_mm_[at]) + pixel_error_mm_[at] +
                             sigma * random[x];
            depth[x] = std::uint16_t(std::clamp(mm + 0.5f, 0.0f, 65535.0f));
        }
    }
}

// True if this amplitude is measured, for one random value `noise`. The limits are noisy, so
// that dark and dazzling surfaces flicker.
bool DepthSensor::measurable(float counts, float noise) const {
    const float jitter = params_.counts_jitter * noise;
    return counts + jitter * params_.min_counts >= params_.min_counts &&
           counts * (1 + jitter) <= params_.max_counts;
}

}  // namespace theatron::synthetic
