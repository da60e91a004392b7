// SPDX-License-Identifier: Apache-2.0
#include "cases/series_builder.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace theatron::cases {
namespace {

using medical::Volume;

constexpr double same_direction = 1e-4, same_spacing_mm = 1e-3;
constexpr double same_place_mm = 0.01;
// Positions are written with two or three digits, and tables do not move evenly.
constexpr double uneven_share = 0.1;
constexpr double sideways_mm = 0.5;
constexpr int max_missing_in_a_row = 50;

struct Sorted {
    double along_mm;  // the slices' normal
    std::size_t index;
};

bool differ(Vec3 a, Vec3 b, double tolerance) {
    return length(a - b) > tolerance;
}

std::string in_mm(double value) {
    char text[32];
    std::snprintf(text, sizeof(text), "%.2f mm", value);
    return text;
}

// Returns a sentence if the two images cannot belong to one volume; empty if they can.
std::string difference(const DicomSlice& a, const DicomSlice& b) {
    if (!b.has_place)
        return "An image of the series says nothing about its place in the patient, so the series "
               "cannot be shown as a volume.";
    if (differ(a.right, b.right, same_direction) || differ(a.down, b.down, same_direction))
        return "The images of the series have mixed orientations; export each orientation as a "
               "series of its own.";
    if (a.frame_uid != b.frame_uid)
        return "The images of the series have different frames of reference, so their places "
               "cannot be compared.";
    if (a.columns != b.columns || a.rows != b.rows ||
        std::abs(a.column_spacing_mm - b.column_spacing_mm) > same_spacing_mm ||
        std::abs(a.row_spacing_mm - b.row_spacing_mm) > same_spacing_mm)
        return "The images of the series have different sizes; export each size as a series of "
               "its own.";
    if (a.slope != b.slope || a.intercept != b.intercept || a.inverted != b.inverted)
        return "The images of the series have different scales of values, which is not supported.";
    return "";
}

BuiltSeries problem_of(std::string sentence) {
    BuiltSeries built;
    built.problem = std::move(sentence);
    return built;
}

// People copy folders into one another. Returns the number of images that are left out because
// another one has the same place and values.
std::size_t remove_repeated(std::vector<Sorted>& order, const std::vector<DicomSlice>& slices) {
    const auto is_same = [&](const Sorted& a, const Sorted& b) {
        return b.along_mm - a.along_mm < same_place_mm &&
               slices[a.index].samples == slices[b.index].samples;
    };
    const auto end = std::unique(order.begin(), order.end(), is_same);
    const auto count = std::size_t(order.end() - end);
    order.erase(end, order.end());
    return count;
}

// The distance of neighbours: that which most are apart, so that a few missing do not matter.
double usual_distance(const std::vector<Sorted>& order) {
    std::vector<double> distances;
    for (std::size_t i = 1; i < order.size(); ++i)
        distances.push_back(order[i].along_mm - order[i - 1].along_mm);
    std::nth_element(distances.begin(), distances.begin() + std::ptrdiff_t(distances.size() / 2),
                     distances.end());
    return distances[distances.size() / 2];
}

// Slice numbers by place; empty and a problem where they are uneven.
std::vector<int> number_slices(const std::vector<Sorted>& order, double step_mm,
                               std::string& problem) {
    std::vector<int> numbers{0};
    for (std::size_t i = 1; i < order.size(); ++i) {
        const double distance = order[i].along_mm - order[i - 1].along_mm;
        const double steps = std::round(distance / step_mm);
        if (steps < 1 || std::abs(distance - steps * step_mm) > uneven_share * step_mm) {
            problem = "The images of the series lie unevenly: most are " + in_mm(step_mm) +
                      " apart, two are " + in_mm(distance) + ".";
            return {};
        }
        if (steps > max_missing_in_a_row + 1) {
            problem = "The series lacks " + std::to_string(int(std::min(steps, 1e6)) - 1) +
                      " slices in a row; import only the part that belongs together.";
            return {};
        }
        numbers.push_back(numbers.back() + int(steps));
    }
    return numbers;
}

medical::Window usual_window(const std::vector<DicomSlice>& slices, const Volume& volume) {
    for (const DicomSlice& slice : slices)
        if (slice.has_window)
            return slice.window;
    const auto [low, high] = std::minmax_element(volume.samples.begin(), volume.samples.end());
    const double a = volume.slope * *low + volume.intercept;
    const double b = volume.slope * *high + volume.intercept;
    return {(a + b) / 2, std::max(1.0, std::abs(b - a))};
}

// All samples in one way: lowered where one image has to be.
void bring_to_one_scale(std::vector<DicomSlice>& slices, Volume& volume) {
    const bool lowered = std::any_of(slices.begin(), slices.end(),
                                     [](const DicomSlice& slice) { return slice.lowered; });
    if (!lowered)
        return;
    for (DicomSlice& slice : slices)
        if (!slice.lowered)
            for (std::int16_t& sample : slice.samples)
                sample = std::int16_t(sample - 32768);
    volume.intercept += 32768 * volume.slope;
}

}  // namespace

BuiltSeries build_series(std::vector<DicomSlice>& slices) {
    if (slices.empty())
        return problem_of("The series holds no images.");
    const DicomSlice& first = slices.front();
    for (const DicomSlice& slice : slices)
        if (std::string problem = difference(first, slice); !problem.empty())
            return problem_of(std::move(problem));

    const Vec3 normal = cross(first.right, first.down);
    std::vector<Sorted> order;
    for (std::size_t i = 0; i < slices.size(); ++i)
        order.push_back({dot(slices[i].position_mm, normal), i});
    std::sort(order.begin(), order.end(),
              [](const Sorted& a, const Sorted& b) { return a.along_mm < b.along_mm; });
    BuiltSeries built;
    built.repeated = remove_repeated(order, slices);
    for (std::size_t i = 1; i < order.size(); ++i)
        if (order[i].along_mm - order[i - 1].along_mm < same_place_mm) {
            built.problem =
                "Two images of the series lie at the same place; export each phase or "
                "reconstruction as a series of its own.";
            return built;
        }

    double step_mm = order.size() > 1 ? usual_distance(order) : 1;
    const std::vector<int> numbers = number_slices(order, step_mm, built.problem);
    if (!built.problem.empty())
        return built;
    const Vec3 begin = slices[order.front().index].position_mm;
    Vec3 step = normal * step_mm;
    if (order.size() > 1)
        step = (slices[order.back().index].position_mm - begin) * (1.0 / numbers.back());
    for (std::size_t i = 0; i < order.size(); ++i)
        if (differ(slices[order[i].index].position_mm, begin + step * numbers[i],
                   uneven_share * step_mm + sideways_mm)) {
            built.problem = "The images of the series do not lie in one line.";
            return built;
        }

    Volume& volume = built.volume;
    volume.grid = {first.columns,
                   first.rows,
                   numbers.back() + 1,
                   begin,
                   first.right * first.column_spacing_mm,
                   first.down * first.row_spacing_mm,
                   step};
    if (!medical::is_valid(volume.grid)) {
        built.problem = "The series is larger than what can be shown.";
        return built;
    }
    volume.slope = first.slope;
    volume.intercept = first.intercept;
    volume.inverted = first.inverted;
    bring_to_one_scale(slices, volume);

    std::int16_t lowest = 32767;
    for (const DicomSlice& slice : slices)
        lowest = std::min(lowest, *std::min_element(slice.samples.begin(), slice.samples.end()));
    volume.samples.assign(volume.grid.size(), lowest);
    std::vector<bool> there(std::size_t(volume.grid.slices));
    for (std::size_t i = 0; i < order.size(); ++i) {
        std::vector<std::int16_t>& samples = slices[order[i].index].samples;
        std::copy(samples.begin(), samples.end(),
                  volume.samples.begin() + std::ptrdiff_t(volume.grid.index(0, 0, numbers[i])));
        samples = {};
        there[std::size_t(numbers[i])] = true;
    }
    for (int k = 0; k < volume.grid.slices; ++k)
        if (!there[std::size_t(k)])
            built.missing_slices.push_back(k);
    volume.window = usual_window(slices, volume);
    return built;
}

}  // namespace theatron::cases
