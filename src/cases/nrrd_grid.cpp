// SPDX-License-Identifier: Apache-2.0
#include "cases/nrrd_grid.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "base/outside_text.h"
#include "base/small_letters.h"
#include "base/trimmed.h"
#include "cases/label_map.h"
#include "cases/text_words.h"

namespace theatron::cases::nrrd {
namespace {

// All three numbers of a vector without its brackets, as in "1,0,-2.5".
std::optional<Vec3> vector_of(std::string_view text) {
    double numbers[3];
    for (int i = 0; i < 3; ++i) {
        const std::size_t end = i < 2 ? text.find(',') : text.size();
        if (end == std::string_view::npos || text.substr(0, end).find(',') != text.npos ||
            !to_number(trimmed(text.substr(0, end)), numbers[i]))
            return std::nullopt;
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return Vec3{numbers[0], numbers[1], numbers[2]};
}

// Parted by blanks.
std::optional<std::vector<double>> sizes_of(const std::string& text) {
    std::vector<double> sizes;
    TextWords words(as_bytes(text));
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
        const std::optional<long> size = whole_number(word);
        if (!size)
            return std::nullopt;
        sizes.push_back(double(*size));
    }
    return sizes;
}

// Signs that take the file's axes to LPS.
std::optional<Vec3> lps_signs(const std::string& written) {
    const std::string space = in_small_letters(written);
    if (space == "left-posterior-superior" || space == "lps")
        return Vec3{1, 1, 1};
    if (space == "right-anterior-superior" || space == "ras")
        return Vec3{-1, -1, 1};
    if (space == "left-anterior-superior" || space == "las")
        return Vec3{1, -1, 1};
    return std::nullopt;
}

// Millimetres of the units along the three axes of space.
std::optional<Vec3> millimetres(const std::string& units) {
    if (units.empty())
        return Vec3{1, 1, 1};
    std::vector<double> found;
    std::size_t at = 0;
    while ((at = units.find('"', at)) != std::string::npos) {
        const std::size_t end = units.find('"', at + 1);
        if (end == std::string::npos)
            return std::nullopt;
        const std::string unit = in_small_letters(units.substr(at + 1, end - at - 1));
        at = end + 1;
        if (unit == "mm" || unit == "millimeter" || unit == "millimeters" || unit.empty())
            found.push_back(1);
        else if (unit == "cm" || unit == "centimeter" || unit == "centimeters")
            found.push_back(10);
        else if (unit == "m" || unit == "meter" || unit == "meters")
            found.push_back(1000);
        else if (unit == "um" || unit == "\xc2\xb5m" || unit == "micrometer")
            found.push_back(0.001);
        else if (unit == "in" || unit == "inch" || unit == "inches")
            found.push_back(25.4);
        else
            return std::nullopt;
    }
    if (found.size() != 3)
        return std::nullopt;
    return Vec3{found[0], found[1], found[2]};
}

// The directions of the axes; nothing for one that is none of space (a list of layers). Nothing at
// all where the text is anything else than vectors.
using Directions = std::vector<std::optional<Vec3>>;
std::optional<Directions> directions_of(const std::string& text) {
    Directions axes;
    std::size_t at = 0;
    while (at < text.size()) {
        if (text[at] == '(') {
            const std::size_t end = text.find(')', at);
            if (end == std::string::npos)
                return std::nullopt;
            axes.push_back(vector_of(std::string_view(text).substr(at + 1, end - at - 1)));
            if (!axes.back())
                return std::nullopt;
            at = end + 1;
        } else if (in_small_letters(text.substr(at, 4)) == "none") {
            axes.emplace_back();
            at += 4;
        } else if (text[at] == ' ' || text[at] == '\t') {
            ++at;
        } else {
            return std::nullopt;
        }
    }
    return axes;
}

// True for the kind of an axis whose samples make one value together: a colour, a vector, a matrix.
bool is_of_parts(const std::string& kind) {
    for (const char* part :
         {"vector", "color", "complex", "matrix", "gradient", "normal", "point", "quaternion"})
        if (kind.find(part) != std::string::npos)
            return true;
    return false;
}

}  // namespace

std::string read_axes(const Fields& fields, Axes& axes) {
    const std::string dimension = field(fields, "dimension");
    if (dimension != "3" && dimension != "4")
        return "is no label map: it has not three dimensions";
    const std::optional<std::vector<double>> found_sizes = sizes_of(field(fields, "sizes"));
    if (!found_sizes || found_sizes->size() != std::size_t(dimension[0] - '0'))
        return bad_field(fields, "sizes", "list of a whole number for each dimension");
    const std::optional<Directions> found = directions_of(field(fields, "space directions"));
    if (!found)
        return bad_field(fields, "space directions", "list of vectors of three numbers");
    const std::vector<double>& sizes = *found_sizes;
    const Directions& directions = *found;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        if (!(sizes[i] >= 1 && sizes[i] <= medical::max_volume_side))
            return "has a side of no samples, or of more than " +
                   std::to_string(medical::max_volume_side);
        if (i >= directions.size())
            continue;
        if (directions[i]) {
            axes.sizes.push_back(std::size_t(sizes[i]));
            axes.directions.push_back(*directions[i]);
        } else {
            axes.layers = std::size_t(sizes[i]);
            axes.layers_come_last = i == 3;
            for (std::size_t k = 0; k < i; ++k)
                axes.before_layers *= std::size_t(sizes[k]);
        }
    }
    std::istringstream kinds(in_small_letters(field(fields, "kinds")));
    for (std::string kind; axes.layers > 1 && kinds >> kind;)
        if (is_of_parts(kind) && field(fields, "Segment0_Name").empty())
            return "has the kind '" + clean_text(kind, 40) +
                   "' (kinds), so its samples are no labels";
    if (axes.layers > max_label_layers)
        return "has more than " + std::to_string(max_label_layers) + " layers, so it is an image";
    return "";
}

std::string read_grid(const Fields& fields, const Axes& axes, medical::VolumeGrid& grid) {
    const std::optional<Vec3> signs = lps_signs(field(fields, "space"));
    const std::string where = field(fields, "space origin");
    if (!signs || axes.directions.size() != 3 || where.empty())
        return "does not say where in the patient it lies (space, space directions, space origin)";
    const bool has_brackets = where.starts_with('(') && where.ends_with(')');
    const std::optional<Vec3> origin =
        has_brackets ? vector_of(std::string_view(where).substr(1, where.size() - 2))
                     : std::nullopt;
    if (!origin)
        return bad_field(fields, "space origin", "vector of three numbers");
    const std::string units = field(fields, "space units");
    const std::optional<Vec3> mm = millimetres(units);
    if (!mm)
        return "has the unit " + clean_text(units, 40) +
               " (space units), and mm, cm, m, um and inch are read; save it in millimetres";
    if (axes.sizes[0] * axes.sizes[1] * axes.sizes[2] > max_label_samples / axes.layers)
        return "has more samples than are read";
    const auto placed = [&](Vec3 v) {
        return Vec3{v.x * signs->x * mm->x, v.y * signs->y * mm->y, v.z * signs->z * mm->z};
    };
    grid = {int(axes.sizes[0]),        int(axes.sizes[1]),         int(axes.sizes[2]),
            placed(*origin),           placed(axes.directions[0]), placed(axes.directions[1]),
            placed(axes.directions[2])};
    return medical::is_valid(grid)
               ? ""
               : "describes a volume with impossible sides, steps or place; export it again";
}

}  // namespace theatron::cases::nrrd
