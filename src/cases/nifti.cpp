// SPDX-License-Identifier: Apache-2.0
// NIfTI: https://nifti.nimh.nih.gov/pub/dist/src/niftilib/nifti1.h and .../nifti2.h describe the
// headers.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>

#include "base/outside_text.h"
#include "cases/label_map.h"
#include "cases/sample_stream.h"

namespace theatron::cases {
namespace {

constexpr std::size_t header_size = 348, header_size_2 = 540, max_offset = 1 << 20;
constexpr double rounding = 1e-3;  // of numbers with seven digits, and of programs that keep fewer

// Fields of the header of either version, in either order of bytes.
class Header {
public:
    // At least header_size_2 bytes, zeros where the file has fewer.
    explicit Header(ByteView bytes) : bytes_(bytes) {
        for (const bool big_endian : {false, true}) {
            big_endian_ = big_endian;
            for (const bool apart : {false, true}) {
                is_apart_ = apart;
                version_ = get<std::int32_t>(0) == 348 && has_magic(344, apart ? "ni1" : "n+1") ? 1
                           : get<std::int32_t>(0) == 540 && has_magic(4, apart ? "ni2" : "n+2") ? 2
                                                                                                : 0;
                if (version_ != 0)
                    return;
            }
        }
    }
    bool big_endian() const { return big_endian_; }
    int version() const { return version_; }  // 0: no NIfTI
    // The samples lie in a file of their own.
    bool is_apart() const { return is_apart_; }
    std::size_t size() const { return version_ == 1 ? header_size : header_size_2; }
    double dim(std::size_t i) const {
        return version_ == 1 ? double(get<std::int16_t>(40 + 2 * i))
                             : double(get<std::int64_t>(16 + 8 * i));
    }
    double pixdim(std::size_t i) const { return real(76 + 4 * i, 104 + 8 * i); }
    int type() const { return get<std::int16_t>(version_ == 1 ? 70 : 12); }
    double offset() const {
        return version_ == 1 ? double(get_float(108)) : double(get<std::int64_t>(168));
    }
    double slope() const { return real(112, 176); }
    double intercept() const { return real(116, 184); }
    int unit() const {
        return (version_ == 1 ? std::to_integer<int>(bytes_[123]) : get<std::int32_t>(500)) & 7;
    }
    bool has_quaternion() const {
        return (version_ == 1 ? get<std::int16_t>(252) : get<std::int32_t>(344)) > 0;
    }
    bool has_matrix() const {
        return (version_ == 1 ? get<std::int16_t>(254) : get<std::int32_t>(348)) > 0;
    }
    double quaternion(std::size_t i) const { return real(256 + 4 * i, 352 + 8 * i); }
    double quaternion_origin(std::size_t i) const { return real(268 + 4 * i, 376 + 8 * i); }
    Vec3 matrix_column(std::size_t i) const {
        return {real(280 + 4 * i, 400 + 8 * i), real(296 + 4 * i, 432 + 8 * i),
                real(312 + 4 * i, 464 + 8 * i)};
    }

private:
    template <class T>
    T get(std::size_t at) const {
        std::byte bytes[sizeof(T)];
        std::copy_n(bytes_.data() + at, sizeof(T), bytes);
        if (big_endian_)
            std::reverse(bytes, bytes + sizeof(T));
        return load_le<T>(bytes);
    }
    template <class T, class Bits>
    T get_real(std::size_t at) const {
        const auto bits = get<Bits>(at);
        T value;
        std::memcpy(&value, &bits, sizeof(value));
        return value;
    }
    float get_float(std::size_t at) const { return get_real<float, std::uint32_t>(at); }
    // Version 1 has numbers of 32 bits, version 2 of 64.
    double real(std::size_t at, std::size_t at_2) const {
        return version_ == 1 ? double(get_float(at)) : get_real<double, std::uint64_t>(at_2);
    }
    bool has_magic(std::size_t at, const char* magic) const {
        return std::memcmp(bytes_.data() + at, magic, 4) == 0;
    }

    ByteView bytes_;
    bool big_endian_ = false, is_apart_ = false;
    int version_ = 0;
};

bool sample_type(int code, SampleType& type) {
    switch (code) {
        case 2:
            type = SampleType::u8;
            return true;
        case 4:
            type = SampleType::i16;
            return true;
        case 8:
            type = SampleType::i32;
            return true;
        case 16:
            type = SampleType::f32;
            return true;
        case 64:
            type = SampleType::f64;
            return true;
        case 256:
            type = SampleType::i8;
            return true;
        case 512:
            type = SampleType::u16;
            return true;
        case 768:
            type = SampleType::u32;
            return true;
        case 1024:
            type = SampleType::i64;
            return true;
        case 1280:
            type = SampleType::u64;
            return true;
    }
    return false;
}

// "Method 2" of the header's description: a quaternion, an offset and the size of a sample.
// Returns the problem as the end of a sentence, or nothing.
std::string place_by_quaternion(const Header& header, Vec3 (&columns)[3], Vec3& origin) {
    const double b = header.quaternion(0), c = header.quaternion(1), d = header.quaternion(2);
    const double size = b * b + c * c + d * d;
    if (!(size <= 1 + rounding))
        return "has a quaternion (quatern_b, quatern_c, quatern_d) that is no rotation; export it "
               "again";
    for (std::size_t i = 1; i <= 3; ++i)
        if (header.pixdim(i) < 0)
            return "has a step below 0 (pixdim), of which its qform leaves open what it means; "
                   "export it again";
    const double a = std::sqrt(std::max(0.0, 1 - size));
    const double turn = header.pixdim(0) < 0 ? -1 : 1;
    columns[0] = Vec3{a * a + b * b - c * c - d * d, 2 * (b * c + a * d), 2 * (b * d - a * c)} *
                 header.pixdim(1);
    columns[1] = Vec3{2 * (b * c - a * d), a * a + c * c - b * b - d * d, 2 * (c * d + a * b)} *
                 header.pixdim(2);
    columns[2] = Vec3{2 * (b * d + a * c), 2 * (c * d - a * b), a * a + d * d - b * b - c * c} *
                 (header.pixdim(3) * turn);
    origin = {header.quaternion_origin(0), header.quaternion_origin(1),
              header.quaternion_origin(2)};
    return "";
}

// False where the matrix spans no space: some programs set its code and leave it empty.
bool place_by_matrix(const Header& header, Vec3 (&columns)[3], Vec3& origin) {
    double product = 1;
    for (std::size_t i = 0; i < 3; ++i) {
        columns[i] = header.matrix_column(i);
        product *= length(columns[i]);
    }
    origin = header.matrix_column(3);
    constexpr double least_share = 0.01;
    return std::abs(dot(columns[0], cross(columns[1], columns[2]))) > least_share * product;
}

Vec3 lps_from_ras(Vec3 v) {
    return {-v.x, -v.y, v.z};
}

std::string read_grid(const Header& header, medical::VolumeGrid& grid) {
    const double dimensions = header.dim(0);
    if (!(dimensions >= 1 && dimensions <= 7))
        return "is damaged: it has less than one dimension, or more than seven";
    int sides[3] = {1, 1, 1};
    for (std::size_t i = 1; i <= std::size_t(dimensions); ++i) {
        // Some programs leave 0 where a dimension behind the three is not used.
        const double side = i > 3 && header.dim(i) == 0 ? 1 : header.dim(i);
        if (side < 1)
            return "is damaged: one of its sides has no samples";
        if (i > 3 && side != 1)
            return "is no label map: it has more than three dimensions";
        if (side > medical::max_volume_side)
            return "has a side of more than " + std::to_string(medical::max_volume_side) +
                   " samples";
        if (i <= 3)
            sides[i - 1] = int(side);
    }
    grid.columns = sides[0];
    grid.rows = sides[1];
    grid.slices = sides[2];
    Vec3 columns[3];
    const bool by_matrix = header.has_matrix() && place_by_matrix(header, columns, grid.origin_mm);
    if (!by_matrix && !header.has_quaternion())
        return "does not say where in the patient it lies (neither sform nor qform)";
    if (!by_matrix)
        if (std::string problem = place_by_quaternion(header, columns, grid.origin_mm);
            !problem.empty())
            return problem;
    const int unit = header.unit();
    if (unit > 3)
        return "has the unit " + std::to_string(unit) +
               " (xyzt_units), and millimetres, metres and micrometres are read; save it in "
               "millimetres";
    const double mm = unit == 1 ? 1000 : unit == 3 ? 0.001 : 1;
    grid.origin_mm = lps_from_ras(grid.origin_mm) * mm;
    grid.column_step_mm = lps_from_ras(columns[0]) * mm;
    grid.row_step_mm = lps_from_ras(columns[1]) * mm;
    grid.slice_step_mm = lps_from_ras(columns[2]) * mm;
    if (grid.size() > max_label_samples)
        return "has more samples than are read";
    return medical::is_valid(grid)
               ? ""
               : "describes a volume with impossible sides, steps or place; export it again";
}

// The value of an attribute, as in Key="1".
std::string_view attribute(std::string_view tag, std::string_view name) {
    const std::size_t at = tag.find(std::string(name) + "=\"");
    if (at == std::string_view::npos)
        return {};
    const std::size_t begin = at + name.size() + 2;
    return tag.substr(begin, tag.find('"', begin) - begin);
}

// A text of XML with the characters that its entities stand for.
std::string without_entities(std::string_view text) {
    constexpr std::pair<std::string_view, char> known[] = {
        {"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}};
    std::string out;
    while (!text.empty()) {
        const auto* entity = std::find_if(std::begin(known), std::end(known), [&](const auto& one) {
            return text.starts_with(one.first);
        });
        const bool is_known = entity != std::end(known);
        out += is_known ? entity->second : text.front();
        text.remove_prefix(is_known ? entity->first.size() : 1);
    }
    return out;
}

// Names that TotalSegmentator and Connectome Workbench write behind the header:
// <Label Key="1" ...><![CDATA[liver]]></Label>.
std::vector<LabelName> names_in(ByteView behind_header) {
    std::string_view text(reinterpret_cast<const char*>(behind_header.data()),
                          behind_header.size());
    std::vector<LabelName> names;
    std::size_t at = 0;
    while (names.size() < max_labels && (at = text.find("<Label ", at)) != std::string_view::npos) {
        const std::size_t open = text.find('>', at), close = text.find("</Label>", at);
        if (open == std::string_view::npos || close == std::string_view::npos || close < open)
            break;
        const std::string_view key = attribute(text.substr(at, open - at), "Key");
        std::string name(text.substr(open + 1, close - open - 1));
        constexpr std::string_view quote = "<![CDATA[";
        if (name.starts_with(quote) && name.ends_with("]]>"))
            name = name.substr(quote.size(), name.size() - quote.size() - 3);
        else
            name = without_entities(name);
        int value = 0;
        std::from_chars(key.data(), key.data() + key.size(), value);
        if (value >= 1 && value <= 65'535 && !name.empty())
            names.push_back({value, clean_text(name, 64)});
        at = close;
    }
    return names;
}

// Packed files are known by their first bytes, whatever their names say.
std::optional<Packing> packing_of(ByteView file) {
    const auto begins = [&](std::string_view bytes, std::size_t at = 0) {
        return file.size() >= at + bytes.size() &&
               std::memcmp(file.data() + at, bytes.data(), bytes.size()) == 0;
    };
    if (begins("\x1f\x8b"))
        return Packing::gzip;
    // Behind its digit is the first block.
    if (begins("BZh") && begins("\x31\x41\x59\x26", 4))
        return Packing::bzip2;
    return std::nullopt;
}

// The first `size` bytes of the content; fewer where it has fewer.
Bytes first_bytes(ByteView file, std::size_t size) {
    const std::optional<Packing> packing = packing_of(file);
    if (!packing) {
        const ByteView head = file.first(std::min(size, file.size()));
        return {head.begin(), head.end()};
    }
    Bytes head;
    bool damaged = false;
    unpack(
        file, *packing, size,
        [&](ByteView piece) {
            head.insert(head.end(), piece.begin(), piece.end());
            return true;
        },
        damaged);
    return head;
}

// The bytes of the longer of both headers, zeros where the file has fewer; empty if it is too short
// for either.
Bytes head_of(ByteView file) {
    Bytes head = first_bytes(file, header_size_2);
    head.resize(head.size() < header_size ? 0 : header_size_2);
    return head;
}

}  // namespace

bool is_nifti_head(ByteView file) {
    const Bytes head = head_of(file);
    if (head.empty())
        return false;
    const Header header(head);
    return header.version() != 0 && header.is_apart();
}

ParsedLabels parse_nifti(ByteView file, ByteView samples) {
    const Bytes head = head_of(file);
    if (head.empty())
        return {{}, "is no NIfTI file, or cut off"};
    const Header header(head);
    if (header.version() == 0)
        return {{}, "is no NIfTI file of version 1 or 2", true};
    ParsedLabels parsed;
    parsed.is_other_content = true;
    SampleLayout layout;
    if (!sample_type(header.type(), layout.type)) {
        parsed.problem = "has samples of a type that is no label's";
        return parsed;
    }
    parsed.problem = read_grid(header, parsed.value.grid);
    if (!parsed.problem.empty())
        return parsed;
    parsed.is_other_content = false;
    const bool apart = header.is_apart();
    // Some programs leave 0, and let the samples follow the header and its four bytes behind.
    const double offset =
        header.offset() == 0 && !apart ? double(header.size() + 4) : header.offset();
    if (!(offset >= (apart ? 0 : double(header.size())) && offset <= double(max_offset)) ||
        offset != std::floor(offset)) {
        parsed.problem = "begins its samples at an impossible place (vox_offset)";
        return parsed;
    }
    // 0 and no number both stand for no scale.
    const double slope = header.slope(), intercept = header.intercept();
    if (std::isinf(slope) || std::isinf(intercept)) {
        parsed.problem = "has an infinite scale of its values (scl_slope, scl_inter)";
        return parsed;
    }
    if (std::isfinite(slope) && slope != 0 && std::isfinite(intercept)) {
        layout.slope = slope;
        layout.intercept = intercept;
    }
    layout.big_endian = header.big_endian();
    layout.count = parsed.value.grid.size();
    layout.skipped_bytes = std::size_t(offset);
    const Bytes before = first_bytes(file, apart ? max_offset : layout.skipped_bytes);
    parsed.value.names = names_in(ByteView(before).subspan(std::min(header.size(), before.size())));
    const ByteView content = apart ? samples : file;
    ReadSamples read = read_labels(content, packing_of(content), layout, parsed.value.labels);
    parsed.problem = std::move(read.problem);
    parsed.is_other_content = read.is_other_content;
    return parsed;
}

}  // namespace theatron::cases
