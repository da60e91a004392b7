// SPDX-License-Identifier: Apache-2.0
// Reads PNG with libpng and JPEG with libjpeg-turbo. Runs in a sandbox.
#include "cases/picture_reader.h"

#include <png.h>
#include <turbojpeg.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <new>

#include "cases/foreign_files.h"
#include "cases/foreign_input.h"
#include "medical/picture.h"

namespace theatron::cases {
namespace {

bool is_taken(std::size_t width, std::size_t height) {
    constexpr std::size_t longest_side = 65'535;
    return width > 0 && height > 0 && width <= longest_side && height <= longest_side &&
           width * height <= max_picture_pixels;
}

const unsigned char* data_of(ByteView bytes) {
    return reinterpret_cast<const unsigned char*>(bytes.data());
}

Answer read_png(ByteView file, ColorImage& out) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    if (!png_image_begin_read_from_memory(&image, file.data(), file.size()))
        return Answer::unreadable;
    const std::unique_ptr<png_image, void (*)(png_image*)> freed(&image, png_image_free);
    if (!is_taken(image.width, image.height))
        return Answer::too_large;
    image.format = PNG_FORMAT_RGB;
    image.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;
    out.resize({int(image.width), int(image.height)});
    const png_color white{255, 255, 255};
    if (!png_image_finish_read(&image, &white, out.pixels.data(), 0, nullptr))
        return std::strstr(image.message, "emory") ? throw std::bad_alloc() : Answer::unreadable;
    return Answer::content;
}

Answer read_jpeg(ByteView file, ColorImage& out) {
    const std::unique_ptr<void, int (*)(tjhandle)> decoder(tjInitDecompress(), tjDestroy);
    if (!decoder)
        throw std::bad_alloc();
    const auto size = static_cast<unsigned long>(file.size());
    int width = 0, height = 0, sampling = 0, space = 0;
    if (tjDecompressHeader3(decoder.get(), data_of(file), size, &width, &height, &sampling,
                            &space) != 0)
        return Answer::unreadable;
    // Bytes without a picture's head give no size.
    if (width <= 0 || height <= 0)
        return Answer::unreadable;
    if (!is_taken(std::size_t(width), std::size_t(height)))
        return Answer::too_large;
    if (space == TJCS_CMYK || space == TJCS_YCCK)
        return Answer::compression;
    out.resize({width, height});
    // Very many scans take very long.
    if (tjDecompress2(decoder.get(), data_of(file), size,
                      reinterpret_cast<unsigned char*>(out.pixels.data()), width, 0, height,
                      TJPF_RGB, TJFLAG_LIMITSCANS | TJFLAG_ACCURATEDCT) != 0) {
        const std::string_view text = tjGetErrorStr2(decoder.get());
        if (text.find("Premature end") != std::string_view::npos)
            return Answer::cut_off;
        // A warning is on bytes that are too many between two parts, as some programs write them.
        if (tjGetErrorCode(decoder.get()) != TJERR_WARNING)
            return Answer::unreadable;
    }
    const int orientation = exif_orientation(file);
    out = upright(medical::reduced(std::move(out), medical::max_picture_side), orientation);
    return Answer::content;
}

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

Answer read_picture(ByteView file, ColorImage& out) {
    constexpr unsigned char png[] = {0x89, 'P', 'N', 'G'}, jpeg[] = {0xff, 0xd8, 0xff};
    const auto begins = [&](const auto& with) {
        return file.size() > sizeof(with) && std::memcmp(file.data(), with, sizeof(with)) == 0;
    };
    if (begins(jpeg))
        return read_jpeg(file, out);
    if (!begins(png))
        return Answer::no_picture;
    const Answer read = read_png(file, out);
    if (read == Answer::content)
        out = medical::reduced(std::move(out), medical::max_picture_side);
    return read;
}

void serve_pictures(sandbox::Inside& inside) {
    if (!inside.receive())
        return;
    const Bytes file = bytes_of(inside, max_picture_file_bytes);
    ColorImage picture;
    const Answer read = read_picture(file, picture);
    if (read == Answer::content)
        answer(inside, medical::encode_picture(picture.view()));
    else
        answer(inside, read);
    while (inside.receive()) {
    }
}

}  // namespace theatron::cases
