// SPDX-License-Identifier: Apache-2.0
// NRRD: https://teem.sourceforge.net/nrrd/format.html; segments as 3D Slicer writes them in
// .seg.nrrd files.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <string_view>

#include "base/outside_text.h"
#include "cases/label_map.h"
#include "cases/sample_stream.h"

namespace theatron::cases {
namespace {

constexpr std::size_t max_header_bytes = 1 << 20;
constexpr std::size_t max_fields = 8192;

using Fields = std::map<std::string, std::string, std::less<>>;

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && (text.back() == ' ' || text.back() == '\r' || text.back() == '\t'))
        text.remove_suffix(1);
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t'))
        text.remove_prefix(1);
    return text;
}

// The header's fields and where the content begins. Nothing: no header.
std::optional<std::size_t> read_header(ByteView file, Fields& fields) {
    const std::string_view text(reinterpret_cast<const char*>(file.data()),
                                std::min(file.size(), max_header_bytes));
    if (!text.starts_with("NRRD000"))
        return std::nullopt;
    std::size_t at = text.find('\n');
    while (at != std::string_view::npos && fields.size() < max_fields) {
        const std::size_t begin = at + 1, end = text.find('\n', begin);
        if (end == std::string_view::npos)
            return std::nullopt;
        const std::string_view line = trimmed(text.substr(begin, end - begin));
        at = end;
        if (line.empty())
            return end + 1;
        if (line[0] == '#')
            continue;
        const std::size_t colon = line.find(':');
        if (colon == std::string_view::npos || colon + 1 == line.size())
            continue;
        const std::size_t value = colon + (line[colon + 1] == '=' ? 2 : 1);
        fields.emplace(trimmed(line.substr(0, colon)), trimmed(line.substr(value)));
    }
    return std::nullopt;
}

std::string field(const Fields& fields, std::string_view name) {
    const auto found = fields.find(name);
    return found == fields.end() ? "" : found->second;
}

// Numbers parted by anything else, such as "(1,0,0) (0,1,0)".
std::vector<double> numbers_of(const std::string& text, std::size_t most) {
    std::vector<double> numbers;
    const char* at = text.c_str();
    while (*at && numbers.size() < most) {
        char* end = nullptr;
        const double value = std::strtod(at, &end);
        if (end == at) {
            ++at;
            continue;
        }
        numbers.push_back(value);
        at = end;
    }
    return numbers;
}

bool sample_type(const std::string& name, SampleType& type) {
    static const std::map<std::string_view, SampleType> types{
        {"signed char", SampleType::i8},   {"int8", SampleType::i8},
        {"int8_t", SampleType::i8},        {"uchar", SampleType::u8},
        {"unsigned char", SampleType::u8}, {"uint8", SampleType::u8},
        {"uint8_t", SampleType::u8},       {"short", SampleType::i16},
        {"short int", SampleType::i16},    {"signed short", SampleType::i16},
        {"int16", SampleType::i16},        {"int16_t", SampleType::i16},
        {"ushort", SampleType::u16},       {"unsigned short", SampleType::u16},
        {"uint16", SampleType::u16},       {"uint16_t", SampleType::u16},
        {"int", SampleType::i32},          {"signed int", SampleType::i32},
        {"int32", SampleType::i32},        {"int32_t", SampleType::i32},
        {"uint", SampleType::u32},         {"unsigned int", SampleType::u32},
        {"uint32", SampleType::u32},       {"uint32_t", SampleType::u32},
        {"longlong", SampleType::i64},     {"int64", SampleType::i64},
        {"int64_t", SampleType::i64},      {"ulonglong", SampleType::u64},
        {"uint64", SampleType::u64},       {"uint64_t", SampleType::u64},
        {"float", SampleType::f32},        {"double", SampleType::f64}};
    const auto found = types.find(name);
    if (found == types.end())
        return false;
    type = found->second;
    return true;
}

// Signs that take the file's axes to LPS.
std::optional<Vec3> lps_signs(const std::string& space) {
    if (space == "left-posterior-superior" || space == "LPS")
        return Vec3{1, 1, 1};
    if (space == "right-anterior-superior" || space == "RAS")
        return Vec3{-1, -1, 1};
    if (space == "left-anterior-superior" || space == "LAS")
        return Vec3{1, -1, 1};
    return std::nullopt;
}

std::string read_grid(const Fields& fields, medical::VolumeGrid& grid) {
    const std::string dimension = field(fields, "dimension");
    if (dimension == "4")
        return "holds overlapping segments in several layers; export them as one label map";
    const std::vector<double> sizes = numbers_of(field(fields, "sizes"), 4);
    if (dimension != "3" || sizes.size() != 3)
        return "is no label map: it has not three dimensions";
    std::size_t samples = 1;
    for (const double side : sizes) {
        if (!(side >= 1 && side <= medical::max_volume_side) || side != std::floor(side))
            return "has a side of no samples, or of more than " +
                   std::to_string(medical::max_volume_side);
        samples *= std::size_t(side);
    }
    if (samples > max_label_samples)
        return "has more samples than are read";
    const std::optional<Vec3> signs = lps_signs(field(fields, "space"));
    const std::vector<double> directions = numbers_of(field(fields, "space directions"), 10);
    const std::vector<double> origin = numbers_of(field(fields, "space origin"), 4);
    if (!signs || directions.size() != 9 || origin.size() != 3)
        return "does not say where in the patient it lies (space, space directions, space origin)";
    const auto vec = [&](const std::vector<double>& v, std::size_t i) {
        return Vec3{v[i] * signs->x, v[i + 1] * signs->y, v[i + 2] * signs->z};
    };
    grid = {int(sizes[0]),      int(sizes[1]),      int(sizes[2]),     vec(origin, 0),
            vec(directions, 0), vec(directions, 3), vec(directions, 6)};
    return medical::is_valid(grid)
               ? ""
               : "describes a volume with impossible sides, steps or place; export it again";
}

std::vector<LabelName> read_names(const Fields& fields) {
    std::vector<LabelName> names;
    for (std::size_t i = 0; i < max_labels; ++i) {
        const std::string segment = "Segment" + std::to_string(i) + "_";
        const std::string name = field(fields, segment + "Name");
        const std::vector<double> value = numbers_of(field(fields, segment + "LabelValue"), 1);
        if (name.empty() || value.empty())
            continue;
        if (value[0] >= 1 && value[0] <= 65535)
            names.push_back({int(value[0]), clean_text(name, 64)});
    }
    return names;
}

}  // namespace

ParsedLabels parse_nrrd(ByteView file) {
    Fields fields;
    const std::optional<std::size_t> content = read_header(file, fields);
    if (!content)
        return {{}, "is no NRRD file, or cut off"};
    if (fields.contains("data file") || fields.contains("datafile"))
        return {{}, "keeps its samples in another file; save it in one piece (.nrrd)"};
    for (const char* skip : {"line skip", "lineskip", "byte skip", "byteskip"})
        if (const std::string value = field(fields, skip); !value.empty() && value != "0")
            return {{}, "passes over bytes before its samples, which is not supported"};
    ParsedLabels parsed;
    parsed.problem = read_grid(fields, parsed.value.grid);
    if (!parsed.problem.empty())
        return parsed;
    SampleType type;
    if (!sample_type(field(fields, "type"), type))
        return {{}, "has samples of a type that is no label's"};
    const std::string encoding = field(fields, "encoding");
    const bool packed = encoding == "gzip" || encoding == "gz";
    if (!packed && encoding != "raw")
        return {{},
                "is encoded as '" + clean_text(encoding, 20) +
                    "', which is not read; save it raw or with gzip"};
    parsed.value.names = read_names(fields);
    parsed.problem = read_labels(file.subspan(*content), packed, parsed.value.grid.size(), type,
                                 field(fields, "endian") == "big", parsed.value.labels);
    return parsed;
}

}  // namespace theatron::cases
