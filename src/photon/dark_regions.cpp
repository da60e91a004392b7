// SPDX-License-Identifier: Apache-2.0
#include "photon/dark_regions.h"

#include <algorithm>
#include <cstdint>

namespace theatron::photon {
namespace {

// A pixel is dark if it is darker than the mean around it, by more than noise.
constexpr int reach = 20, margin = 7;

// Sums of all pixels above and to the left.
std::vector<std::uint32_t> sums_of(GreyView grey) {
    const auto [width, height] = grey.size;
    const auto stride = std::size_t(width) + 1;
    std::vector<std::uint32_t> sums(stride * (std::size_t(height) + 1));
    for (int y = 0; y < height; ++y) {
        std::uint32_t row = 0;
        const std::size_t above = std::size_t(y) * stride;
        for (int x = 0; x < width; ++x) {
            row += grey.row(y)[x];
            sums[above + stride + std::size_t(x) + 1] = sums[above + std::size_t(x) + 1] + row;
        }
    }
    return sums;
}

struct Run {
    int y, begin, end;
    std::uint32_t parent;
};

std::uint32_t root_of(std::vector<Run>& runs, std::uint32_t i) {
    while (runs[i].parent != i)
        i = runs[i].parent = runs[runs[i].parent].parent;
    return i;
}

void add_runs(GreyView grey, const std::vector<std::uint32_t>& sums, int y,
              std::vector<Run>& runs) {
    const auto [width, height] = grey.size;
    const auto stride = std::size_t(width) + 1;
    const int top = std::max(y - reach, 0), bottom = std::min(y + reach + 1, height);
    const std::uint32_t* const upper = sums.data() + std::size_t(top) * stride;
    const std::uint32_t* const lower = sums.data() + std::size_t(bottom) * stride;
    int begin = -1;
    for (int x = 0; x <= width; ++x) {
        bool dark = false;
        if (x < width) {
            const int left = std::max(x - reach, 0), right = std::min(x + reach + 1, width);
            const std::uint32_t sum = lower[right] - lower[left] - upper[right] + upper[left];
            const auto count = std::uint32_t((right - left) * (bottom - top));
            dark = std::uint32_t(grey.row(y)[x] + margin) * count < sum;
        }
        if (dark && begin < 0)
            begin = x;
        if (!dark && begin >= 0) {
            runs.push_back({y, begin, x, std::uint32_t(runs.size())});
            begin = -1;
        }
    }
}

// Joins the runs of a row, from `row` on, to those of the row above, from `above` to `row`.
void join_rows(std::vector<Run>& runs, std::size_t above, std::size_t row) {
    for (std::size_t low = row, high = above; low < runs.size() && high < row;) {
        if (runs[low].begin < runs[high].end && runs[high].begin < runs[low].end) {
            const std::uint32_t a = root_of(runs, std::uint32_t(low));
            const std::uint32_t b = root_of(runs, std::uint32_t(high));
            runs[std::max(a, b)].parent = std::min(a, b);
        }
        runs[low].end < runs[high].end ? ++low : ++high;
    }
}

std::vector<Run> dark_runs(GreyView grey) {
    const std::vector<std::uint32_t> sums = sums_of(grey);
    std::vector<Run> runs;
    std::size_t above = 0;
    for (int y = 0; y < grey.size.height; ++y) {
        const std::size_t row = runs.size();
        add_runs(grey, sums, y, runs);
        join_rows(runs, above, row);
        above = row;
    }
    return runs;
}

struct Box {
    int left = 1 << 20, right = 0, top = 1 << 20, bottom = 0;
    int width() const { return right - left; }
    int height() const { return bottom - top; }
    std::int64_t area() const { return std::int64_t(width()) * height(); }
    bool is_large_enough() const {
        return std::max(width(), height()) >= least_region_width &&
               std::min(width(), height()) >= least_region_height;
    }
};

// Andrew's monotone chain, for points in the order of their y, then x.
std::vector<Point> hull_of(const std::vector<Point>& points) {
    std::vector<Point> hull;
    const auto add = [&](Point p, std::size_t first) {
        while (hull.size() >= first + 2 &&
               cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0)
            hull.pop_back();
        hull.push_back(p);
    };
    for (const Point p : points)
        add(p, 0);
    const std::size_t turn = hull.size() - 1;
    for (auto p = points.rbegin(); p != points.rend(); ++p)
        add(*p, turn);
    hull.pop_back();
    return hull;
}

double area_of(const std::vector<Point>& polygon) {
    double twice = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i)
        twice += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
    return twice / 2;
}

}  // namespace

std::vector<std::vector<Point>> dark_regions(GreyView grey, std::size_t most) {
    std::vector<Run> runs = dark_runs(grey);
    std::vector<Box> boxes(runs.size());
    for (std::uint32_t i = 0; i < runs.size(); ++i) {
        Box& box = boxes[root_of(runs, i)];
        box.left = std::min(box.left, runs[i].begin);
        box.right = std::max(box.right, runs[i].end);
        box.top = std::min(box.top, runs[i].y);
        box.bottom = std::max(box.bottom, runs[i].y + 1);
    }
    std::vector<std::uint32_t> large;
    for (std::uint32_t i = 0; i < runs.size(); ++i)
        if (runs[i].parent == i && boxes[i].is_large_enough())
            large.push_back(i);
    std::stable_sort(large.begin(), large.end(), [&](std::uint32_t a, std::uint32_t b) {
        return boxes[a].area() > boxes[b].area();
    });
    large.resize(std::min(large.size(), most));

    constexpr std::uint32_t none = ~std::uint32_t(0);
    std::vector<std::uint32_t> number(runs.size(), none);
    for (std::uint32_t i = 0; i < large.size(); ++i)
        number[large[i]] = i;
    // The ends of each region's rows; runs come from top to bottom.
    std::vector<std::vector<Run>> rows(large.size());
    for (std::uint32_t i = 0; i < runs.size(); ++i) {
        const std::uint32_t region = number[root_of(runs, i)];
        if (region == none)
            continue;
        if (rows[region].empty() || rows[region].back().y != runs[i].y)
            rows[region].push_back(runs[i]);
        rows[region].back().end = runs[i].end;
    }
    std::vector<std::vector<Point>> hulls;
    for (const std::vector<Run>& region : rows) {
        std::vector<Point> points;
        for (const Run& row : region)
            for (const int y : {row.y, row.y + 1})
                for (const int x : {row.begin, row.end})
                    points.push_back({double(x), double(y)});
        std::sort(points.begin(), points.end(),
                  [](Point a, Point b) { return a.y != b.y ? a.y < b.y : a.x < b.x; });
        hulls.push_back(hull_of(points));
    }
    return hulls;
}

std::optional<Quad> quad_around(std::vector<Point> hull, double least_share) {
    const double area = area_of(hull);
    while (hull.size() > 4) {
        // Dropping the side from `i` to `i + 1` moves both to where the sides beside it meet.
        double least = 0;
        std::size_t best = hull.size();
        Point best_meeting;
        const std::size_t n = hull.size();
        for (std::size_t i = 0; i < n; ++i) {
            const Point a = hull[i], b = hull[(i + 1) % n];
            const Point before = a - hull[(i + n - 1) % n], after = b - hull[(i + 2) % n];
            // With y down and clockwise, the sides meet outside if this is above zero.
            const double turn = -cross(before, after);
            if (turn <= 0)
                continue;
            const double along = -cross(b - a, after) / turn;
            const Point meeting = a + before * along;
            const double added = cross(meeting - a, b - a) / 2;
            if (along >= 0 && (best == n || added < least)) {
                least = added;
                best = i;
                best_meeting = meeting;
            }
        }
        if (best == n)
            return std::nullopt;
        hull[best] = best_meeting;
        hull.erase(hull.begin() + std::ptrdiff_t((best + 1) % n));
    }
    if (hull.size() < 4 || area < least_share * area_of(hull))
        return std::nullopt;
    const Quad quad{hull[0], hull[1], hull[2], hull[3]};
    return is_proper(quad) ? std::optional(quad) : std::nullopt;
}

}  // namespace theatron::photon
