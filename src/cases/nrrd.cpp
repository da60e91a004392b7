// SPDX-License-Identifier: Apache-2.0
// NRRD: https://teem.sourceforge.net/nrrd/format.html; segments as 3D Slicer writes them in
// .seg.nrrd files.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <sstream>
#include <string_view>

#include "base/outside_text.h"
#include "base/trimmed.h"
#include "cases/label_map.h"
#include "cases/sample_stream.h"
#include "cases/text_words.h"

namespace theatron::cases {
namespace {

constexpr std::size_t max_header_bytes = 1 << 20;
constexpr std::size_t max_fields = 8192;

// Names of fields are in small letters; those of keys (":=") as they are.
using Fields = std::map<std::string, std::string, std::less<>>;

std::string lower(std::string_view text) {
    std::string small(text);
    for (char& c : small)
        c = c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
    return small;
}

// The header's fields and where the content begins, which may be the file's end. Nothing: no
// header.
std::optional<std::size_t> read_header(ByteView file, Fields& fields) {
    const std::string_view text(reinterpret_cast<const char*>(file.data()),
                                std::min(file.size(), max_header_bytes));
    if (!text.starts_with("NRRD000"))
        return std::nullopt;
    std::size_t at = text.find('\n');
    while (at != std::string_view::npos && fields.size() < max_fields) {
        const std::size_t begin = at + 1, end = std::min(text.find('\n', begin), text.size());
        if (begin >= text.size()) {
            // A header with its samples in another file needs no empty line at its end.
            const bool is_whole = fields.contains("data file") && text.size() < max_header_bytes;
            return is_whole ? std::optional(text.size()) : std::nullopt;
        }
        const std::string_view line = trimmed(text.substr(begin, end - begin));
        at = end;
        if (line.empty())
            return std::min(end + 1, text.size());
        if (line[0] == '#')
            continue;
        const std::size_t colon = line.find(':');
        if (colon == std::string_view::npos || colon + 1 == line.size())
            continue;
        const bool is_key = line[colon + 1] == '=';
        const std::string_view name = trimmed(line.substr(0, colon)),
                               value = trimmed(line.substr(colon + (is_key ? 2 : 1)));
        std::string known = is_key ? std::string(name) : lower(name);
        if (known == "datafile")
            known = "data file";
        if (known == "lineskip" || known == "byteskip")
            known.insert(4, " ");
        fields.emplace(std::move(known), value);
    }
    return std::nullopt;
}

std::string field(const Fields& fields, std::string_view name) {
    const auto found = fields.find(name);
    return found == fields.end() ? "" : found->second;
}

// A whole number and nothing else.
std::optional<long> whole_number(std::string_view text) {
    long number = 0;
    return to_number(trimmed(text), number) ? std::optional(number) : std::nullopt;
}

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

std::string bad_field(const Fields& fields, const std::string& name, const char* wanted) {
    return "has the field '" + name + "' with '" + clean_text(field(fields, name), 60) +
           "', which is no " + wanted + "; export it again";
}

std::optional<SampleType> sample_type(std::string name) {
    name = lower(name);
    static const std::map<std::string_view, SampleType> types{
        {"char", SampleType::i8},       {"int8", SampleType::i8},    {"int8_t", SampleType::i8},
        {"uchar", SampleType::u8},      {"uint8", SampleType::u8},   {"uint8_t", SampleType::u8},
        {"short", SampleType::i16},     {"int16", SampleType::i16},  {"int16_t", SampleType::i16},
        {"ushort", SampleType::u16},    {"uint16", SampleType::u16}, {"uint16_t", SampleType::u16},
        {"int", SampleType::i32},       {"int32", SampleType::i32},  {"int32_t", SampleType::i32},
        {"uint", SampleType::u32},      {"uint32", SampleType::u32}, {"uint32_t", SampleType::u32},
        {"longlong", SampleType::i64},  {"int64", SampleType::i64},  {"int64_t", SampleType::i64},
        {"ulonglong", SampleType::u64}, {"uint64", SampleType::u64}, {"uint64_t", SampleType::u64},
        {"float", SampleType::f32},     {"double", SampleType::f64}};
    // C's names have several words: "signed short int" is a short.
    const bool is_unsigned = name.starts_with("unsigned ");
    if (is_unsigned || name.starts_with("signed "))
        name = name.substr(name.find(' ') + 1);
    if (name.ends_with(" int"))
        name.resize(name.size() - 4);
    if (name == "long long")
        name = "longlong";
    const auto found = types.find(is_unsigned ? "u" + name : name);
    return found == types.end() ? std::nullopt : std::optional(found->second);
}

// Signs that take the file's axes to LPS.
std::optional<Vec3> lps_signs(const std::string& written) {
    const std::string space = lower(written);
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
        const std::string unit = lower(units.substr(at + 1, end - at - 1));
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
        } else if (lower(text.substr(at, 4)) == "none") {
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

struct Axes {
    std::vector<std::size_t> sizes;  // of space
    std::vector<Vec3> directions;
    std::size_t layers = 1;
    std::size_t before_layers = 1;  // samples of one layer that follow one another
    bool layers_come_last = false;  // one whole layer after another
};

// Returns the problem as the end of a sentence, or nothing.
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
    std::istringstream kinds(lower(field(fields, "kinds")));
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

std::vector<LabelName> read_names(const Fields& fields, std::size_t layer) {
    std::vector<LabelName> names;
    for (std::size_t i = 0; i < max_labels; ++i) {
        const std::string segment = "Segment" + std::to_string(i) + "_";
        const std::string name = field(fields, segment + "Name");
        const std::optional<long> value = whole_number(field(fields, segment + "LabelValue"));
        const long of_layer = whole_number(field(fields, segment + "Layer")).value_or(0);
        if (name.empty() || !value || of_layer != long(layer))
            continue;
        if (*value >= 1 && *value <= 65535)
            names.push_back({int(*value), clean_text(name, 64)});
    }
    return names;
}

// The number of lines or bytes that the header skips; at least `least`, or the problem is set.
long skipped(const Fields& fields, const std::string& name, long least, std::string& problem) {
    const std::string text = field(fields, name);
    const std::optional<long> number = text.empty() ? 0 : whole_number(text);
    if (!number || *number < least)
        problem = bad_field(fields, name, least < 0 ? "whole number of bytes" : "number of lines");
    return number.value_or(0);
}

// Moves `content` behind `lines` and `bytes`. False: there are fewer.
bool skip(long lines, long bytes, bool is_packed, ByteView& content, SampleLayout& layout) {
    for (long i = 0; i < lines; ++i) {
        const auto end = std::find(content.begin(), content.end(), std::byte('\n'));
        if (end == content.end())
            return false;
        content = content.subspan(std::size_t(end - content.begin()) + 1);
    }
    if (bytes == -1 && !is_packed) {
        // The samples are the last bytes.
        if (layout.bytes() > content.size())
            return false;
        content = content.last(layout.bytes());
        return true;
    }
    constexpr long most = 1 << 30;
    if (bytes < 0 || bytes > most)
        return false;
    layout.skipped_bytes = std::size_t(bytes);
    return true;
}

ParsedLabels other_content(std::string problem) {
    return {{}, std::move(problem), true};
}

}  // namespace

std::string detached_data_of(ByteView file) {
    Fields fields;
    return read_header(file, fields) ? field(fields, "data file") : "";
}

ParsedLabels parse_nrrd(ByteView file, std::size_t layer, ByteView data) {
    Fields fields;
    const std::optional<std::size_t> begin = read_header(file, fields);
    if (!begin)
        return {{}, "is no NRRD file, or cut off"};
    Axes axes;
    ParsedLabels parsed;
    parsed.is_other_content = true;
    parsed.problem = read_axes(fields, axes);
    if (parsed.problem.empty())
        parsed.problem = read_grid(fields, axes, parsed.value.grid);
    if (!parsed.problem.empty())
        return parsed;
    parsed.layers = axes.layers;
    const std::optional<SampleType> type = sample_type(field(fields, "type"));
    if (!type)
        return other_content("has samples of the type '" + clean_text(field(fields, "type"), 30) +
                             "', which is no label's");
    const std::string encoding = lower(field(fields, "encoding"));
    std::optional<Packing> packing;
    if (encoding == "gzip" || encoding == "gz")
        packing = Packing::gzip;
    else if (encoding == "bzip2" || encoding == "bz2")
        packing = Packing::bzip2;
    const bool is_text = encoding == "txt" || encoding == "text" || encoding == "ascii";
    if (!packing && !is_text && encoding != "raw")
        return other_content("is encoded as '" + clean_text(encoding, 20) +
                             "', which is not read; save it raw or with gzip");
    SampleLayout layout;
    layout.type = *type;
    const std::string order = lower(field(fields, "endian"));
    if (!order.empty() && order != "little" && order != "big")
        return other_content(bad_field(fields, "endian", "order of bytes (little, big)"));
    layout.big_endian = order == "big";
    layout.count = parsed.value.grid.size();
    if (axes.layers_come_last) {
        layout.skipped = layer * layout.count;
    } else {
        layout.step = axes.layers;
        layout.first = layer;
        layout.run = axes.before_layers;
    }
    ByteView content = data.empty() ? file.subspan(*begin) : data;
    const long lines = skipped(fields, "line skip", 0, parsed.problem);
    const long bytes = skipped(fields, "byte skip", -1, parsed.problem);
    if (!parsed.problem.empty())
        return parsed;
    parsed.is_other_content = false;
    if (!skip(lines, bytes, packing.has_value() || is_text, content, layout)) {
        parsed.problem = "holds less than its header announces: it is cut off or damaged";
        return parsed;
    }
    parsed.value.names = read_names(fields, layer);
    ReadSamples read = is_text ? read_label_text(content, layout, parsed.value.labels)
                               : read_labels(content, packing, layout, parsed.value.labels);
    parsed.problem = std::move(read.problem);
    parsed.is_other_content = read.is_other_content;
    return parsed;
}

}  // namespace theatron::cases
