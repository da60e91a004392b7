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
#include "files/photo_orientation.h"
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
    const int orientation = files::exif_orientation(file);
    out = files::upright(medical::reduced(std::move(out), medical::max_picture_side), orientation);
    return Answer::content;
}

}  // namespace

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
