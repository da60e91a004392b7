// SPDX-License-Identifier: Apache-2.0
#include "cases/series_builder.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cases/series_values.h"

namespace theatron::cases {
namespace {

using medical::Volume;

// Directions that differ move no pixel further than this, and turn the picture no more.
constexpr double same_pixel_mm = 0.5, most_turn = 0.02;
constexpr double same_spacing_mm = 1e-3;
// Positions are written with one to three digits, and tables do not move evenly.
constexpr double uneven_share = 0.1, rounded_share = 0.25, rounded_mm = 0.5;
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

bool is_turned(const DicomSlice& a, const DicomSlice& b) {
    const double across = length(a.right - b.right), along = length(a.down - b.down);
    return std::max(across, along) > most_turn ||
           across * a.columns * a.column_spacing_mm + along * a.rows * a.row_spacing_mm >
               same_pixel_mm;
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
    // The smaller one of two: a slice is missing rather than added.
    const std::size_t middle = (distances.size() - 1) / 2;
    std::nth_element(distances.begin(), distances.begin() + std::ptrdiff_t(middle),
                     distances.end());
    return distances[middle];
}

// Two distances in one series, a thin and a thick one: several gaps of one size follow one another,
// which missing slices do not do. `steps`: from each slice to the next.
bool has_two_distances(const std::vector<int>& steps) {
    std::size_t run = 0;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        run = steps[i] > 1 && i > 0 && steps[i] == steps[i - 1] ? run + 1 : steps[i] > 1;
        const bool at_an_end = i + 1 == steps.size() || run == i + 1;
        if (run >= 3 || (run == 2 && at_an_end))
            return true;
    }
    return false;
}

struct Line {
    double begin_mm, step_mm;
};

// The places as begin + number * step, with the least squares.
Line line_through(const std::vector<Sorted>& order, const std::vector<int>& numbers) {
    double n = 0, sum_k = 0, sum_p = 0, sum_kk = 0, sum_kp = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        const double k = numbers[i], p = order[i].along_mm - order[0].along_mm;
        n += 1, sum_k += k, sum_p += p, sum_kk += k * k, sum_kp += k * p;
    }
    const double step = (n * sum_kp - sum_k * sum_p) / (n * sum_kk - sum_k * sum_k);
    return {order[0].along_mm + (sum_p - step * sum_k) / n, step};
}

// Slice numbers by place; empty and a problem where they are uneven.
std::vector<int> number_slices(const std::vector<Sorted>& order, double step_mm,
                               std::string& problem) {
    std::vector<int> numbers{0}, all_steps;
    for (std::size_t i = 1; i < order.size(); ++i) {
        const double steps = std::round((order[i].along_mm - order[i - 1].along_mm) / step_mm);
        if (steps > max_missing_in_a_row + 1) {
            problem = "The series lacks " + std::to_string(int(std::min(steps, 1e6)) - 1) +
                      " slices in a row; import only the part that belongs together.";
            return {};
        }
        all_steps.push_back(std::max(1, int(steps)));
        numbers.push_back(numbers.back() + all_steps.back());
    }
    if (order.size() < 2)
        return numbers;
    if (has_two_distances(all_steps)) {
        const int other = *std::max_element(all_steps.begin(), all_steps.end());
        problem = "The images of the series lie unevenly: some are " + in_mm(step_mm) +
                  " apart, others " + in_mm(other * step_mm) +
                  "; export each distance as a series of its own.";
        return {};
    }
    // Places are compared with the line that all of them make, so that rounded ones count once.
    const Line line = line_through(order, numbers);
    const double limit =
        std::max(uneven_share * line.step_mm, std::min(rounded_mm, rounded_share * line.step_mm));
    for (std::size_t i = 0; i < order.size(); ++i)
        if (std::abs(order[i].along_mm - line.begin_mm - numbers[i] * line.step_mm) > limit) {
            const std::size_t a = i > 0 ? i - 1 : 0;
            problem = "The images of the series lie unevenly: most are " + in_mm(step_mm) +
                      " apart, two are " + in_mm(order[a + 1].along_mm - order[a].along_mm) +
                      "; copy the series again, or export it with equal distances.";
            return {};
        }
    return numbers;
}

}  // namespace

std::string place_difference(const DicomSlice& a, const DicomSlice& b) {
    if (!b.has_place)
        return "An image of the series says nothing about its place in the patient, so the series "
               "cannot be shown as a volume; export it with all data, or save its images as PNG.";
    if (a.columns != b.columns || a.rows != b.rows ||
        std::abs(a.column_spacing_mm - b.column_spacing_mm) > same_spacing_mm ||
        std::abs(a.row_spacing_mm - b.row_spacing_mm) > same_spacing_mm)
        return "The images of the series have different sizes; export each size as a series of "
               "its own.";
    if (is_turned(a, b))
        return "The images of the series have mixed orientations; export each orientation as a "
               "series of its own.";
    if (!a.frame_uid.empty() && !b.frame_uid.empty() && a.frame_uid != b.frame_uid)
        return "The images of the series have different frames of reference, so their places "
               "cannot be compared.";
    if (a.inverted != b.inverted)
        return "Some images of the series show high values bright, others dark; export each kind "
               "as a series of its own.";
    return "";
}

BuiltSeries build_series(std::vector<DicomSlice>& slices) {
    if (slices.empty())
        return problem_of("The series holds no images.");
    const DicomSlice& first = slices.front();
    for (const DicomSlice& slice : slices)
        if (std::string problem = place_difference(first, slice); !problem.empty())
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
    volume.inverted = first.inverted;
    const ValueScale scale = common_scale(slices);
    volume.slope = scale.slope;
    volume.intercept = scale.intercept;

    SampleCounts counts;
    std::vector<bool> there(std::size_t(volume.grid.slices));
    volume.samples.resize(volume.grid.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        DicomSlice& slice = slices[order[i].index];
        bring_to_scale(slice, scale, counts);
        std::copy(slice.samples.begin(), slice.samples.end(),
                  volume.samples.begin() + std::ptrdiff_t(volume.grid.index(0, 0, numbers[i])));
        slice.samples = {};
        there[std::size_t(numbers[i])] = true;
    }
    const std::size_t in_slice = volume.grid.index(0, 0, 1);
    for (int k = 0; k < volume.grid.slices; ++k)
        if (!there[std::size_t(k)]) {
            built.missing_slices.push_back(k);
            std::fill_n(volume.samples.begin() + std::ptrdiff_t(volume.grid.index(0, 0, k)),
                        in_slice, counts.lowest());
        }
    volume.window = window_of(slices, counts, scale);
    return built;
}

}  // namespace theatron::cases
