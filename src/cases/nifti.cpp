// SPDX-License-Identifier: Apache-2.0
// NIfTI-1: https://nifti.nimh.nih.gov/pub/dist/src/niftilib/nifti1.h describes the header.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "cases/label_map.h"
#include "cases/sample_stream.h"

namespace theatron::cases {
namespace {

constexpr std::size_t header_size = 348;

// Fields of the header at their places, in either order of bytes.
class Header {
public:
    explicit Header(ByteView bytes) : bytes_(bytes) {
        big_endian_ = get<std::int16_t>(40) < 1 || get<std::int16_t>(40) > 7;
    }
    bool big_endian() const { return big_endian_; }
    bool is_nifti() const {
        const char* magic = reinterpret_cast<const char*>(bytes_.data()) + 344;
        return get<std::int32_t>(0) == 348 && std::memcmp(magic, "n+1", 4) == 0;
    }
    int dim(int i) const { return get<std::int16_t>(40 + 2 * std::size_t(i)); }
    float pixdim(int i) const { return real(76 + 4 * std::size_t(i)); }
    int integer(std::size_t at) const { return get<std::int16_t>(at); }
    int octet(std::size_t at) const { return std::to_integer<int>(bytes_[at]); }
    float real(std::size_t at) const {
        const auto bits = get<std::uint32_t>(at);
        float value;
        std::memcpy(&value, &bits, sizeof(value));
        return value;
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

    ByteView bytes_;
    bool big_endian_ = false;
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
void place_by_quaternion(const Header& header, Vec3 (&columns)[3], Vec3& origin) {
    const double b = header.real(256), c = header.real(260), d = header.real(264);
    const double a = std::sqrt(std::max(0.0, 1 - (b * b + c * c + d * d)));
    const double turn = header.pixdim(0) < 0 ? -1 : 1;
    columns[0] = Vec3{a * a + b * b - c * c - d * d, 2 * (b * c + a * d), 2 * (b * d - a * c)} *
                 header.pixdim(1);
    columns[1] = Vec3{2 * (b * c - a * d), a * a + c * c - b * b - d * d, 2 * (c * d + a * b)} *
                 header.pixdim(2);
    columns[2] = Vec3{2 * (b * d + a * c), 2 * (c * d - a * b), a * a + d * d - b * b - c * c} *
                 (header.pixdim(3) * turn);
    origin = {header.real(268), header.real(272), header.real(276)};
}

void place_by_matrix(const Header& header, Vec3 (&columns)[3], Vec3& origin) {
    const auto column = [&](std::size_t i) {
        return Vec3{header.real(280 + 4 * i), header.real(296 + 4 * i), header.real(312 + 4 * i)};
    };
    for (std::size_t i = 0; i < 3; ++i)
        columns[i] = column(i);
    origin = column(3);
}

Vec3 lps_from_ras(Vec3 v) {
    return {-v.x, -v.y, v.z};
}

std::string read_grid(const Header& header, medical::VolumeGrid& grid) {
    const int dimensions = header.dim(0);
    int sides[3] = {1, 1, 1};
    for (int i = 1; i <= dimensions; ++i) {
        const int side = header.dim(i);
        if (side < 1)
            return "is damaged: one of its sides has no samples";
        if (i > 3 && side != 1)
            return "is no label map: it has more than three dimensions";
        if (i <= 3)
            sides[i - 1] = side;
    }
    grid.columns = sides[0];
    grid.rows = sides[1];
    grid.slices = sides[2];
    Vec3 columns[3];
    if (header.integer(254) > 0)
        place_by_matrix(header, columns, grid.origin_mm);
    else if (header.integer(252) > 0)
        place_by_quaternion(header, columns, grid.origin_mm);
    else
        return "does not say where in the patient it lies (neither sform nor qform)";
    double mm = 1;
    if (const int unit = header.octet(123) & 7; unit == 1 || unit == 3)
        mm = unit == 1 ? 1000 : 0.001;
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

}  // namespace

ParsedLabels parse_nifti(ByteView file) {
    const bool packed = file.size() > 2 && file[0] == std::byte(0x1f) && file[1] == std::byte(0x8b);
    Bytes head(header_size);
    if (packed) {
        std::size_t done = 0;
        const bool whole = unpack_gzip(file, header_size, [&](ByteView piece) {
            std::copy(piece.begin(), piece.end(), head.begin() + std::ptrdiff_t(done));
            done += piece.size();
            return true;
        });
        if (!whole)
            return {{}, "is no NIfTI file, or cut off"};
    } else if (file.size() < header_size) {
        return {{}, "is no NIfTI file, or cut off"};
    } else {
        std::copy_n(file.begin(), header_size, head.begin());
    }
    const Header header(head);
    if (!header.is_nifti())
        return {{}, "is no NIfTI file of version 1 in one piece"};
    SampleType type;
    if (!sample_type(header.integer(70), type))
        return {{}, "has samples of a type that is no label's"};
    const float slope = header.real(112), intercept = header.real(116);
    if ((slope != 0 && slope != 1) || (slope != 0 && intercept != 0))
        return {{}, "scales its samples, as no label map does"};
    ParsedLabels parsed;
    parsed.problem = read_grid(header, parsed.value.grid);
    if (!parsed.problem.empty())
        return parsed;
    const double offset = header.real(108);
    if (!(offset >= double(header_size) && offset <= 1 << 20))
        return {{}, "begins its samples at an impossible place"};

    // Unpacking begins again at the header and skips all bytes before the samples.
    const auto skipped = std::size_t(offset);
    std::vector<std::uint16_t>& labels = parsed.value.labels;
    const std::size_t count = parsed.value.grid.size();
    if (!packed) {
        parsed.problem = file.size() < skipped ? "is cut off"
                                               : read_labels(file.subspan(skipped), false, count,
                                                             type, header.big_endian(), labels);
        return parsed;
    }
    const std::size_t wanted = skipped + count * size_of(type);
    if (wanted > file.size() * gzip_most_ratio)
        return {{}, "holds less than its header announces"};
    labels.reserve(count);
    LabelCollector collector(type, header.big_endian(), labels);
    std::size_t passed = 0;
    const bool whole = unpack_gzip(file, wanted, [&](ByteView piece) {
        const std::size_t skip = std::min(piece.size(), skipped - std::min(passed, skipped));
        passed += piece.size();
        return collector.take(piece.subspan(skip));
    });
    if (!collector.good())
        parsed.problem = "holds values that are no labels: images are read as DICOM";
    else if (!whole)
        parsed.problem = "is damaged or cut off";
    return parsed;
}

}  // namespace theatron::cases
