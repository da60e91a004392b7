// SPDX-License-Identifier: Apache-2.0
#include "capture/crop.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <vector>

namespace theatron::capture {
namespace {

// Removes a number from the front of the text, and the separator `behind` unless that is 0.
std::optional<int> take_number(std::string_view& text, char behind) {
    int value = 0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (problem != std::errc() || value < 0)
        return std::nullopt;
    text.remove_prefix(std::size_t(end - text.data()));
    if (behind == 0)
        return text.empty() ? std::optional(value) : std::nullopt;
    if (text.empty() || text[0] != behind)
        return std::nullopt;
    text.remove_prefix(1);
    return value;
}

// The pixels of a line that a pixel of the smaller line covers, with weights in 1/256.
struct Cover {
    int first = 0;
    std::vector<std::uint32_t> weights;
};

std::vector<Cover> covers(int from, int to) {
    std::vector<Cover> result(static_cast<std::size_t>(to));
    const double step = double(from) / to;
    for (int i = 0; i < to; ++i) {
        const double begin = i * step, end = begin + step;
        Cover& cover = result[std::size_t(i)];
        cover.first = int(begin);
        const int last = std::min(int(std::ceil(end - 1e-9)), from);
        // Rounds cumulative sums, not single weights, so that the weights sum up to 256.
        std::uint32_t before = 0;
        for (int x = cover.first; x < last; ++x) {
            const double share = (std::min(end, x + 1.0) - begin) / step;
            const auto sum = x + 1 == last ? 256u : std::uint32_t(std::lround(share * 256));
            cover.weights.push_back(sum - before);
            before = sum;
        }
    }
    return result;
}

}  // namespace

std::optional<Size> parse_size(std::string_view text) {
    const auto width = take_number(text, 'x');
    const auto height = width ? take_number(text, 0) : std::nullopt;
    if (!height || !is_valid({*width, *height}))
        return std::nullopt;
    return Size{*width, *height};
}

std::optional<Crop> parse_crop(std::string_view text) {
    const auto x = take_number(text, ':');
    const auto y = x ? take_number(text, ':') : std::nullopt;
    const auto size = y ? parse_size(text) : std::nullopt;
    if (!size)
        return std::nullopt;
    return Crop{*x, *y, *size};
}

bool lies_in(const Crop& crop, Size whole) {
    return crop.x >= 0 && crop.y >= 0 && is_valid(crop.size) &&
           crop.x <= whole.width - crop.size.width && crop.y <= whole.height - crop.size.height;
}

CameraModel cropped(CameraModel camera, const Crop& crop) {
    camera.cx -= crop.x;
    camera.cy -= crop.y;
    camera.size = crop.size;
    return camera;
}

Crop color_seen_by_depth(const Calibration& calibration, double near_m, double far_m) {
    // The visible region has smooth borders; the margin compensates for the pixels between
    // samples.
    constexpr int step = 8, margin = 4;
    const CameraModel& depth = calibration.depth;
    double left = 1e9, top = 1e9, right = -1e9, bottom = -1e9;
    for (int y = 0; y < depth.size.height + step - 1; y += step)
        for (int x = 0; x < depth.size.width + step - 1; x += step) {
            const auto ray = unproject(depth, {double(std::min(x, depth.size.width - 1)),
                                               double(std::min(y, depth.size.height - 1))});
            if (!ray)
                continue;
            for (const double z : {near_m, far_m}) {
                const auto pixel = project(calibration.color, calibration.color_from_depth *
                                                                  Vec3{ray->x * z, ray->y * z, z});
                if (!pixel)
                    continue;
                left = std::min(left, pixel->x);
                right = std::max(right, pixel->x);
                top = std::min(top, pixel->y);
                bottom = std::max(bottom, pixel->y);
            }
        }
    const auto inside = [](double value, int limit) {
        return int(std::clamp(value, 0.0, double(limit)));
    };
    const Size whole = calibration.color.size;
    Crop crop{inside(std::floor(left) - margin, whole.width),
              inside(std::floor(top) - margin, whole.height),
              {}};
    crop.size = {std::max(inside(std::ceil(right) + 1 + margin, whole.width) - crop.x, 0),
                 std::max(inside(std::ceil(bottom) + 1 + margin, whole.height) - crop.y, 0)};
    return crop;
}

void scale_by_area(ColorView image, MutableColorView out) {
    assert(out.size.width <= image.size.width && out.size.height <= image.size.height);
    const std::vector<Cover> columns = covers(image.size.width, out.size.width);
    const std::vector<Cover> rows = covers(image.size.height, out.size.height);
    using Sum = std::array<std::uint32_t, 3>;
    std::vector<Sum> line(std::size_t(image.size.width));
    for (int y = 0; y < out.size.height; ++y) {
        std::fill(line.begin(), line.end(), Sum{});
        const Cover& row = rows[std::size_t(y)];
        for (std::size_t i = 0; i < row.weights.size(); ++i) {
            const Rgb* from = image.row(row.first + int(i));
            const std::uint32_t weight = row.weights[i];
            for (std::size_t x = 0; x < line.size(); ++x) {
                line[x][0] += weight * from[x].r;
                line[x][1] += weight * from[x].g;
                line[x][2] += weight * from[x].b;
            }
        }
        for (int x = 0; x < out.size.width; ++x) {
            const Cover& column = columns[std::size_t(x)];
            Sum sum{};
            for (std::size_t i = 0; i < column.weights.size(); ++i)
                for (std::size_t c = 0; c < sum.size(); ++c)
                    sum[c] += column.weights[i] * line[std::size_t(column.first) + i][c];
            constexpr std::uint32_t half = 1 << 15;
            out.row(y)[x] = {std::uint8_t((sum[0] + half) >> 16),
                             std::uint8_t((sum[1] + half) >> 16),
                             std::uint8_t((sum[2] + half) >> 16)};
        }
    }
}

}  // namespace theatron::capture
