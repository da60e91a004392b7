// SPDX-License-Identifier: Apache-2.0
#include "medical/slice.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace theatron::medical {
namespace {

struct Axis {
    Vec3 right, down, normal;  // positions grow along the normal
};

Axis axis_of(Orientation orientation) {
    switch (orientation) {
        case Orientation::axial:
            return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        case Orientation::coronal:
            return {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}};
        case Orientation::sagittal:
            break;
    }
    return {{0, 1, 0}, {0, 0, -1}, {1, 0, 0}};
}

// The distance of samples along a direction: that of the step that leads most along it.
double spacing_along(const VolumeGrid& grid, Vec3 direction) {
    double best = 0, spacing = 1;
    for (const Vec3 step : {grid.column_step_mm, grid.row_step_mm, grid.slice_step_mm}) {
        const double along = std::abs(dot(normalized(step), direction));
        if (along > best) {
            best = along;
            spacing = length(step);
        }
    }
    return spacing;
}

double low(Box box, Vec3 direction) {
    return std::min(dot(box.low_mm, direction), dot(box.high_mm, direction));
}
double high(Box box, Vec3 direction) {
    return std::max(dot(box.low_mm, direction), dot(box.high_mm, direction));
}

// A little more than a whole number of steps is a whole number.
int steps_within(double extent_mm, double step_mm) {
    return std::max(0, int(std::floor(extent_mm / step_mm + 1e-3)));
}

// The pixels of a row that lie within [-0.5, side - 0.5) of one direction of samples.
void cut(double start, double step, int side, int& first, int& end) {
    const double low_edge = -0.5 - 1e-9, high_edge = side - 0.5 + 1e-9;
    if (std::abs(step) < 1e-12) {
        if (start < low_edge || start > high_edge)
            end = first;
        return;
    }
    double from = (low_edge - start) / step, to = (high_edge - start) / step;
    if (from > to)
        std::swap(from, to);
    first = std::max(first, int(std::ceil(std::clamp(from, -1.0, 1e6))));
    end = std::min(end, int(std::floor(std::clamp(to, -1.0, 1e6))) + 1);
}

// One direction of the eight samples around a place.
struct Cell {
    std::size_t low, step;  // offsets in the volume
    float share;            // of the higher sample
};
inline Cell cell_at(double place, int side, std::size_t stride) {
    const double inside = std::clamp(place, 0.0, side - 1.0);
    const int i = std::min(int(inside), std::max(side - 2, 0));
    return {std::size_t(i) * stride, side > 1 ? stride : 0, float(inside - i)};
}

inline float mix(float a, float b, float share) {
    return a + (b - a) * share;
}

// As floor(value + 0.5), in instructions that all processors have for vectors.
inline std::int16_t rounded_sample(float value) {
    const float raised = value + 0.5f;
    const int cut_off = int(raised);
    return std::int16_t(cut_off - int(raised < float(cut_off)));
}

// A coordinate of the samples along a row of a picture.
enum class Way { still, walks, other };

// So near to a sample, the interpolated value rounds to that sample.
constexpr double on_sample = 1e-6;

Way way_of(double start, double step, int pixels) {
    if (std::abs(step) * pixels < 1e-9)
        return Way::still;
    const bool steps_by_one = std::abs(std::abs(step) - 1) * pixels < on_sample / 2;
    return steps_by_one && std::abs(start - std::round(start)) < on_sample / 2 ? Way::walks
                                                                               : Way::other;
}

Cell still_cell(double place, int side, std::size_t stride) {
    Cell cell = cell_at(place, side, stride);
    if (cell.share > 1 - on_sample)
        cell = {cell.low + cell.step, 0, 0};
    else if (cell.share < on_sample)
        cell = {cell.low, 0, 0};
    return cell;
}

// Pixels `first` to `end` of a row that goes from sample to sample, as in slices along the axes of
// the volume: a(x) are its samples or the nearest ones beside it.
template <class Step>
void blend_row(const std::int16_t* samples, Step step, const Cell& j, const Cell& k, int count,
               std::int16_t* out) {
    const auto at = [&](int x, std::size_t beside) {
        return samples[std::ptrdiff_t(step) * x + std::ptrdiff_t(beside)];
    };
    if (j.share == 0 && k.share == 0) {
        for (int x = 0; x < count; ++x)
            out[x] = at(x, 0);
    } else if (j.share == 0 || k.share == 0) {
        const Cell& blended = j.share == 0 ? k : j;
        for (int x = 0; x < count; ++x)
            out[x] = rounded_sample(mix(at(x, 0), at(x, blended.step), blended.share));
    } else {
        for (int x = 0; x < count; ++x)
            out[x] =
                rounded_sample(mix(mix(at(x, 0), at(x, j.step), j.share),
                                   mix(at(x, k.step), at(x, j.step + k.step), j.share), k.share));
    }
}

struct RowAxis {
    double start, step;  // in samples, a pixel
    int side;
    std::size_t stride;
};

// False, and nothing is done, if the row does not go from sample to sample.
bool walk_row(const std::int16_t* samples, const RowAxis (&axes)[3], int first, int end,
              std::int16_t* row) {
    int walking = -1;
    for (int i = 0; i < 3; ++i) {
        const Way way = way_of(axes[i].start, axes[i].step, end);
        if (way == Way::other || (way == Way::walks && walking >= 0))
            return false;
        if (way == Way::walks)
            walking = i;
    }
    if (walking < 0)
        return false;
    const RowAxis& along = axes[walking];
    const RowAxis &a = axes[(walking + 1) % 3], &b = axes[(walking + 2) % 3];
    const Cell j = still_cell(a.start, a.side, a.stride), k = still_cell(b.start, b.side, b.stride);
    const double at_first = std::round(along.start) + std::round(along.step) * first;
    const auto inside = std::size_t(std::clamp(at_first, 0.0, along.side - 1.0));
    const std::int16_t* from = samples + inside * along.stride + j.low + k.low;
    const auto step = std::ptrdiff_t(along.stride) * (along.step < 0 ? -1 : 1);
    if (step == 1)
        blend_row(from, std::integral_constant<int, 1>(), j, k, end - first, row + first);
    else
        blend_row(from, step, j, k, end - first, row + first);
    return true;
}

}  // namespace

Vec2 pixel_of(const SlicePlane& plane, Vec3 point_mm) {
    const Vec3 from_corner = point_mm - plane.top_left_mm;
    return {dot(from_corner, plane.right) / plane.mm_per_pixel,
            dot(from_corner, plane.down) / plane.mm_per_pixel};
}

SliceRange slice_range(const VolumeGrid& grid, Orientation orientation) {
    const Vec3 normal = axis_of(orientation).normal;
    const Box box = box_of(grid);
    SliceRange range{low(box, normal), high(box, normal), spacing_along(grid, normal), 1};
    range.count = steps_within(range.last_mm - range.first_mm, range.step_mm) + 1;
    return range;
}

SlicePlane slice_plane(const VolumeGrid& grid, Orientation orientation, double position_mm) {
    const Axis axis = axis_of(orientation);
    const Box box = box_of(grid);
    SlicePlane plane;
    plane.right = axis.right;
    plane.down = axis.down;
    plane.mm_per_pixel = std::min(spacing_along(grid, axis.right), spacing_along(grid, axis.down));
    plane.top_left_mm = axis.right * low(box, axis.right) + axis.down * low(box, axis.down) +
                        axis.normal * position_mm;
    const auto pixels = [&](Vec3 direction) {
        const double extent = high(box, direction) - low(box, direction);
        return std::min(steps_within(extent, plane.mm_per_pixel) + 1, max_side);
    };
    plane.size = {pixels(axis.right), pixels(axis.down)};
    return plane;
}

SlicePlane oblique_plane(Vec3 center_mm, Vec3 right, Vec3 down, double mm_per_pixel, Size size) {
    SlicePlane plane;
    plane.right = normalized(right);
    plane.down = normalized(down - plane.right * dot(down, plane.right));
    plane.mm_per_pixel = mm_per_pixel;
    plane.size = size;
    plane.top_left_mm = center_mm - plane.right * ((size.width - 1) * mm_per_pixel / 2) -
                        plane.down * ((size.height - 1) * mm_per_pixel / 2);
    return plane;
}

void reslice(const Volume& volume, const SlicePlane& plane, std::int16_t outside,
             View<std::int16_t> out) {
    assert(out.size == plane.size && volume.samples.size() == volume.grid.size());
    const VolumeGrid& grid = volume.grid;
    const SamplesFromPatient samples(grid);
    const Vec3 step = samples.direction(plane.right * plane.mm_per_pixel);
    const std::size_t row_stride = std::size_t(grid.columns);
    const std::size_t slice_stride = row_stride * std::size_t(grid.rows);

    for (int y = 0; y < out.size.height; ++y) {
        std::int16_t* row = out.row(y);
        const Vec3 start = samples.point(plane.point_at(0, y));
        int first = 0, end = out.size.width;
        cut(start.x, step.x, grid.columns, first, end);
        cut(start.y, step.y, grid.rows, first, end);
        cut(start.z, step.z, grid.slices, first, end);
        // A row that misses the volume leaves both anywhere, also beyond the row.
        first = std::min(first, out.size.width);
        end = std::clamp(end, first, out.size.width);
        std::fill(row, row + first, outside);
        std::fill(row + end, row + out.size.width, outside);
        const RowAxis axes[] = {{start.x, step.x, grid.columns, 1},
                                {start.y, step.y, grid.rows, row_stride},
                                {start.z, step.z, grid.slices, slice_stride}};
        if (first < end && walk_row(volume.samples.data(), axes, first, end, row))
            continue;
        for (int x = first; x < end; ++x) {
            const Cell i = cell_at(start.x + step.x * x, grid.columns, 1);
            const Cell j = cell_at(start.y + step.y * x, grid.rows, row_stride);
            const Cell k = cell_at(start.z + step.z * x, grid.slices, slice_stride);
            const std::int16_t* s = volume.samples.data() + i.low + j.low + k.low;
            const auto line = [&](const std::int16_t* p) {
                return mix(float(p[0]), float(p[i.step]), i.share);
            };
            const float near_side = mix(line(s), line(s + j.step), j.share);
            const float far_side = mix(line(s + k.step), line(s + k.step + j.step), j.share);
            row[x] = std::int16_t(std::floor(mix(near_side, far_side, k.share) + 0.5f));
        }
    }
}

std::string direction_letters(Vec3 direction) {
    struct Part {
        double size;
        char letter;
    };
    Part parts[] = {{std::abs(direction.x), direction.x > 0 ? 'L' : 'R'},
                    {std::abs(direction.y), direction.y > 0 ? 'P' : 'A'},
                    {std::abs(direction.z), direction.z > 0 ? 'H' : 'F'}};
    std::stable_sort(parts, parts + 3,
                     [](const Part& a, const Part& b) { return a.size > b.size; });
    std::string letters;
    for (const Part& part : parts)
        if (part.size > 0.25 * length(direction))
            letters += part.letter;
    return letters;
}

EdgeLetters edge_letters(const SlicePlane& plane) {
    return {direction_letters(-plane.right), direction_letters(plane.right),
            direction_letters(-plane.down), direction_letters(plane.down)};
}

ScaleBar scale_bar(double mm_per_pixel, double max_pixels) {
    double best = 1;
    for (const double decade : {1.0, 10.0, 100.0, 1000.0})
        for (const double digit : {1.0, 2.0, 5.0})
            if (digit * decade <= max_pixels * mm_per_pixel)
                best = digit * decade;
    return {best, best / mm_per_pixel};
}

}  // namespace theatron::medical
