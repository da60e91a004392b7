// SPDX-License-Identifier: Apache-2.0
#include "registration/depth_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace theatron::registration {
namespace {

constexpr int half_window = 6;  // pixels beside the middle one
constexpr int window = 2 * half_window + 1;
constexpr int flank = 3;      // pixels at each end that show one surface alone
constexpr int line_step = 4;  // rows, or columns, from one that is searched to the next
constexpr int along = 3;      // pixels along the edge to the two other windows of its line
constexpr double least_jump_m = 0.08, least_jump_share = 0.04;
constexpr float beyond = 0.3f;           // share of the jump by which a pixel may lie outside of it
constexpr float most_flank_bend = 0.2f;  // share of the jump that a surface changes in its flank
constexpr double most_bend_px = 0.6, most_slope = 1;
constexpr float no_position = std::numeric_limits<float>::quiet_NaN();

// The part of a pixel that shows the near surface; one that was not measured counts as a half.
std::optional<float> near_share(float units, float near_units, float far_units) {
    if (units == 0)
        return 0.5f;
    const float jump = far_units - near_units;
    if (units < near_units - beyond * jump || units > far_units + beyond * jump)
        return {};
    return std::clamp((far_units - units) / jump, 0.0f, 1.0f);
}

float position_of(float near_sum, bool is_near_first) {
    const float middle = near_sum - float(window) / 2;
    return is_near_first ? middle : -middle;
}

// Where the window of `edge` begins, and the distance of its pixels in memory.
const std::uint16_t* window_of(const DepthEdge& edge, DepthView depth, std::ptrdiff_t& step) {
    step = edge.is_in_row ? 1 : depth.row(1) - depth.row(0);
    return depth.row(edge.y) + edge.x - half_window * step;
}

}  // namespace

EdgeReference::EdgeReference(Size size)
    : size_(size), sums_(size.area()), squares_(size.area()), counts_(size.area()) {}

void EdgeReference::add(DepthView depth) {
    std::size_t i = 0;
    for (int y = 0; y < size_.height; ++y)
        for (int x = 0; x < size_.width; ++x, ++i) {
            const std::uint16_t units = depth.row(y)[x];
            sums_[i] += units;
            squares_[i] += double(units) * units;
            counts_[i] = std::uint16_t(counts_[i] + (units != 0));
        }
    ++images_;
}

// The search in mean images.
struct EdgeReference::Scan {
    const EdgeReference& of;
    const SurfaceCamera& camera;
    double spread_units;

    std::size_t index(const DepthEdge& edge, int along_window) const {
        const int x = edge.x + (edge.is_in_row ? along_window : 0);
        const int y = edge.y + (edge.is_in_row ? 0 : along_window);
        return std::size_t(y) * std::size_t(of.size_.width) + std::size_t(x);
    }

    // 0 where a surface was not always measured or has moved.
    float surface_units(std::size_t i) const {
        const double n = of.counts_[i];
        if (4 * n < 3 * of.images_)
            return 0;
        const double mean = of.sums_[i] / n;
        const double variance = of.squares_[i] / n - mean * mean;
        return variance < spread_units * spread_units ? float(mean) : 0;
    }

    std::optional<float> flank_units(const DepthEdge& edge, bool is_first, float& bend) const {
        float lowest = std::numeric_limits<float>::max(), highest = 0, sum = 0;
        for (int k = 0; k < flank; ++k) {
            const float units =
                surface_units(index(edge, is_first ? k - half_window : half_window - k));
            if (units == 0)
                return {};
            lowest = std::min(lowest, units);
            highest = std::max(highest, units);
            sum += units;
        }
        bend = std::max(bend, highest - lowest);
        return sum / flank;
    }

    // The mean of the positions in the images, as near as their mean tells it.
    std::optional<float> position(const DepthEdge& edge) const {
        float near_sum = 0;
        for (int k = -half_window; k <= half_window; ++k) {
            const std::size_t i = index(edge, k);
            const float measured = float(of.counts_[i]) / float(of.images_);
            const float mean = of.counts_[i] ? float(of.sums_[i]) / float(of.counts_[i]) : 0;
            const auto share = near_share(mean, edge.near_units, edge.far_units);
            if (!share)
                return {};
            near_sum += measured * *share + (1 - measured) * 0.5f;
        }
        return position_of(near_sum, edge.is_near_first);
    }

    // The edge in the middle of this window, if there is one.
    std::optional<DepthEdge> edge_at(int x, int y, bool is_in_row) const {
        DepthEdge edge{x, y, is_in_row, true, 0, 0, 0, {}, {}};
        float bend = 0;
        const auto first = flank_units(edge, true, bend);
        if (!first)
            return {};
        const auto last = flank_units(edge, false, bend);
        if (!last)
            return {};
        edge.is_near_first = *first < *last;
        edge.near_units = std::min(*first, *last);
        edge.far_units = std::max(*first, *last);
        const float jump = edge.far_units - edge.near_units;
        const double unit_m = camera.depth_unit_mm / 1000;
        if (jump * unit_m < std::max(least_jump_m, least_jump_share * edge.far_units * unit_m) ||
            bend > most_flank_bend * jump)
            return {};
        const auto middle = position(edge);
        if (!middle || std::abs(*middle) > 0.5f)
            return {};
        edge.position = *middle;
        return has_line(edge) ? std::optional(edge) : std::nullopt;
    }

    // Sets the edge's point and plane, if it is straight and crosses its window steeply enough.
    bool has_line(DepthEdge& edge) const {
        Vec3 ends[2];
        float positions[2];
        for (const int side : {0, 1}) {
            DepthEdge other = edge;
            (edge.is_in_row ? other.y : other.x) += side == 0 ? -along : along;
            const auto there = position(other);
            if (!there)
                return false;
            positions[side] = *there;
            if (!edge_point(other, *there, camera, ends[side]))
                return false;
        }
        if (std::abs(positions[0] + positions[1] - 2 * edge.position) > most_bend_px ||
            std::abs(positions[1] - positions[0]) > most_slope * 2 * along ||
            !edge_point(edge, edge.position, camera, edge.at))
            return false;
        edge.normal = normalized(cross(ends[0], ends[1]));
        return true;
    }
};

std::vector<DepthEdge> EdgeReference::edges(const SurfaceCamera& camera, double spread_m) const {
    std::vector<DepthEdge> found;
    if (images_ == 0)
        return found;
    const Scan scan{*this, camera, spread_m * 1000 / camera.depth_unit_mm};
    for (const bool is_in_row : {true, false}) {
        const int lines = is_in_row ? size_.height : size_.width;
        const int length = is_in_row ? size_.width : size_.height;
        for (int line = line_step; line < lines - along; line += line_step)
            for (int i = half_window; i < length - half_window; ++i)
                if (const auto edge =
                        scan.edge_at(is_in_row ? i : line, is_in_row ? line : i, is_in_row)) {
                    found.push_back(*edge);
                    i += half_window;
                }
    }
    return found;
}

std::vector<float> edge_positions(const std::vector<DepthEdge>& edges, DepthView depth) {
    std::vector<float> positions;
    positions.reserve(edges.size());
    for (const DepthEdge& edge : edges) {
        std::ptrdiff_t step = 0;
        const std::uint16_t* pixel = window_of(edge, depth, step);
        float near_sum = 0;
        int measured = 0;
        bool is_known = true;
        for (int k = 0; k < window && is_known; ++k, pixel += step) {
            const auto share = near_share(*pixel, edge.near_units, edge.far_units);
            is_known = share.has_value();
            near_sum += share.value_or(0);
            measured += *pixel != 0;
        }
        is_known = is_known && measured > half_window;
        positions.push_back(is_known ? position_of(near_sum, edge.is_near_first) : no_position);
    }
    return positions;
}

bool edge_point(const DepthEdge& edge, float position, const SurfaceCamera& camera, Vec3& point) {
    const Size size = camera.rays.size;
    const float at = std::clamp(float(edge.is_in_row ? edge.x : edge.y) + position, 0.0f,
                                float((edge.is_in_row ? size.width : size.height) - 2));
    const int whole = int(at);
    const float part = at - float(whole);
    const int x = edge.is_in_row ? whole : edge.x, y = edge.is_in_row ? edge.y : whole;
    const Ray a = camera.rays.view().row(y)[x];
    const Ray b = camera.rays.view().row(edge.is_in_row ? y : y + 1)[edge.is_in_row ? x + 1 : x];
    if (a.x == no_ray || b.x == no_ray)
        return false;
    const double z = edge.near_units * camera.depth_unit_mm / 1000;
    point = {(a.x + (b.x - a.x) * part) * z, (a.y + (b.y - a.y) * part) * z, z};
    return true;
}

}  // namespace theatron::registration
