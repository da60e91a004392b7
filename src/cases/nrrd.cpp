// SPDX-License-Identifier: Apache-2.0
// NRRD: https://teem.sourceforge.net/nrrd/format.html; segments as 3D Slicer writes them in
// .seg.nrrd files.
#include <algorithm>
#include <map>
#include <optional>
#include <string_view>

#include "base/outside_text.h"
#include "base/small_letters.h"
#include "cases/label_map.h"
#include "cases/nrrd_grid.h"
#include "cases/nrrd_header.h"
#include "cases/sample_stream.h"

namespace theatron::cases {
namespace {

using nrrd::bad_field, nrrd::field, nrrd::Fields, nrrd::whole_number;

std::optional<SampleType> sample_type(std::string name) {
    name = in_small_letters(name);
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
    const std::optional<nrrd::Header> header = nrrd::read_header(file);
    return header ? nrrd::field(header->fields, "data file") : "";
}

ParsedLabels parse_nrrd(ByteView file, std::size_t layer, ByteView data) {
    const std::optional<nrrd::Header> header = nrrd::read_header(file);
    if (!header)
        return {{}, "is no NRRD file, or cut off"};
    const Fields& fields = header->fields;
    if (!header->repeated.empty())
        return other_content("has the field '" + clean_text(header->repeated, 40) +
                             "' twice, with two values; export it again");
    nrrd::Axes axes;
    ParsedLabels parsed;
    parsed.is_other_content = true;
    parsed.problem = nrrd::read_axes(fields, axes);
    if (parsed.problem.empty())
        parsed.problem = nrrd::read_grid(fields, axes, parsed.value.grid);
    if (!parsed.problem.empty())
        return parsed;
    parsed.layers = axes.layers;
    const std::optional<SampleType> type = sample_type(field(fields, "type"));
    if (!type)
        return other_content("has samples of the type '" + clean_text(field(fields, "type"), 30) +
                             "', which is no label's");
    const std::string encoding = in_small_letters(field(fields, "encoding"));
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
    const std::string order = in_small_letters(field(fields, "endian"));
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
    ByteView content = data.empty() ? file.subspan(header->content) : data;
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
