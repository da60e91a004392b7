// SPDX-License-Identifier: Apache-2.0
#include "files/photo_orientation.h"

#include <cstring>
#include <string_view>

namespace theatron::files {
namespace {

// Numbers of EXIF data, in the order of bytes that it names.
class TiffBytes {
public:
    explicit TiffBytes(ByteView bytes) : bytes_(bytes) {
        const bool little = bytes.size() >= 2 && bytes[0] == std::byte('I');
        big_ = bytes.size() >= 2 && bytes[0] == std::byte('M');
        known_ = (little || big_) && bytes[1] == bytes[0] && number(2, 2) == 42;
    }
    bool known() const { return known_; }
    // 0 beyond the end.
    std::uint32_t number(std::size_t at, std::size_t size) const {
        if (at > bytes_.size() || bytes_.size() - at < size)
            return 0;
        std::uint32_t value = 0;
        for (std::size_t i = 0; i < size; ++i)
            value |= std::uint32_t(bytes_[at + i]) << (8 * (big_ ? size - 1 - i : i));
        return value;
    }

private:
    ByteView bytes_;
    bool big_ = false, known_ = false;
};

int orientation_in(ByteView tiff) {
    constexpr std::uint32_t orientation_tag = 0x0112, short_type = 3;
    constexpr std::size_t entry_bytes = 12;
    const TiffBytes bytes(tiff);
    if (!bytes.known())
        return 1;
    const std::size_t folder = bytes.number(4, 4);
    const std::size_t entries = bytes.number(folder, 2);
    for (std::size_t i = 0; i < entries; ++i) {
        const std::size_t at = folder + 2 + i * entry_bytes;
        if (bytes.number(at, 2) != orientation_tag || bytes.number(at + 2, 2) != short_type)
            continue;
        const std::uint32_t value = bytes.number(at + 8, 2);
        return value >= 1 && value <= 8 ? int(value) : 1;
    }
    return 1;
}

}  // namespace

int exif_orientation(ByteView jpeg) {
    constexpr std::string_view name("Exif\0\0", 6);
    std::size_t at = 2;
    // Segments before the pixels: 0xff, kind, length, which counts itself.
    while (jpeg.size() > 4 && at < jpeg.size() - 4 && jpeg[at] == std::byte(0xff)) {
        const auto kind = std::uint8_t(jpeg[at + 1]);
        const std::size_t length = std::size_t(jpeg[at + 2]) << 8 | std::size_t(jpeg[at + 3]);
        constexpr std::uint8_t exif = 0xe1, first_scan = 0xda;
        if (kind == first_scan || length < 2 || length > jpeg.size() - at - 2)
            return 1;
        const ByteView content = jpeg.subspan(at + 4, length - 2);
        if (kind == exif && content.size() > name.size() &&
            std::memcmp(content.data(), name.data(), name.size()) == 0)
            return orientation_in(content.subspan(name.size()));
        at += 2 + length;
    }
    return 1;
}

ColorImage upright(ColorImage picture, int orientation) {
    if (orientation <= 1 || orientation > 8)
        return picture;
    const auto [width, height] = picture.size;
    const bool lies = orientation >= 5;
    const bool mirrors_x =
        orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8;
    const bool mirrors_y =
        orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
    ColorImage out(lies ? Size{height, width} : picture.size);
    for (int y = 0; y < out.size.height; ++y)
        for (int x = 0; x < out.size.width; ++x) {
            const int column = lies ? y : x, row = lies ? x : y;
            out.view().row(y)[x] = picture.view().row(
                mirrors_y ? height - 1 - row : row)[mirrors_x ? width - 1 - column : column];
        }
    return out;
}

}  // namespace theatron::files
