// SPDX-License-Identifier: Apache-2.0
// libpng reports errors by longjmp, which skips destructors. Functions that call it are
// marked "Jumps": they have no objects with destructors, and report errors by value.
#include "files/png_file.h"

#include <png.h>

#include <csetjmp>
#include <cstring>
#include <vector>

#include "base/error.h"
#include "files/file_bytes.h"

namespace theatron::files {
namespace {

// Ten times faster than the best compression, for files a few percent larger.
constexpr int compression_level = 3;
constexpr std::size_t max_chunk_bytes = std::size_t(1) << 24;

constexpr const char* damaged = "is a damaged PNG picture";

void fail(png_structp png, png_const_charp) {
    png_longjmp(png, 1);
}

void ignore(png_structp, png_const_charp) {}

class Reader {
public:
    explicit Reader(ByteView bytes)
        : rest_(bytes), png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, fail, ignore)) {
        if (png_)
            info_ = png_create_info_struct(png_);
    }
    Reader(const Reader&) = delete;
    ~Reader() { png_destroy_read_struct(&png_, &info_, nullptr); }

    // Reads up to the first pixel. Jumps.
    bool read_header() {
        if (!info_ || setjmp(png_jmpbuf(png_)))
            return false;
        png_set_read_fn(png_, this, [](png_structp png, png_bytep to, std::size_t count) {
            auto& rest = static_cast<Reader*>(png_get_io_ptr(png))->rest_;
            if (rest.size() < count)
                png_error(png, "truncated");
            std::memcpy(to, rest.data(), count);
            rest = rest.subspan(count);
        });
        png_set_user_limits(png_, max_side, max_side);
        png_set_chunk_malloc_max(png_, max_chunk_bytes);
        png_read_info(png_, info_);
        return true;
    }

    Size size() const {
        return {int(png_get_image_width(png_, info_)), int(png_get_image_height(png_, info_))};
    }
    int bits() const { return png_get_bit_depth(png_, info_); }
    bool is_grey() const { return png_get_color_type(png_, info_) == PNG_COLOR_TYPE_GRAY; }

    // 16-bit values in the order of this machine. Jumps.
    bool read_depth(png_bytepp rows) {
        if (setjmp(png_jmpbuf(png_)))
            return false;
        const std::uint16_t probe = 1;
        if (*reinterpret_cast<const unsigned char*>(&probe) == 1)
            png_set_swap(png_);
        return read_rows(rows, sizeof(std::uint16_t));
    }

    // Jumps.
    bool read_color(png_bytepp rows) {
        if (setjmp(png_jmpbuf(png_)))
            return false;
        png_set_expand(png_);
        png_set_strip_16(png_);
        png_set_strip_alpha(png_);
        png_set_gray_to_rgb(png_);
        return read_rows(rows, sizeof(Rgb));
    }

private:
    bool read_rows(png_bytepp rows, std::size_t pixel_bytes) {
        png_set_interlace_handling(png_);
        png_read_update_info(png_, info_);
        if (png_get_rowbytes(png_, info_) != std::size_t(size().width) * pixel_bytes)
            return false;
        png_read_image(png_, rows);
        png_read_end(png_, nullptr);
        return true;
    }

    ByteView rest_;
    png_structp png_;
    png_infop info_ = nullptr;
};

template <class T>
std::vector<png_bytep> row_pointers(View<T> image) {
    std::vector<png_bytep> rows(std::size_t(image.size.height));
    for (int y = 0; y < image.size.height; ++y)
        rows[std::size_t(y)] =
            reinterpret_cast<png_bytep>(const_cast<std::remove_const_t<T>*>(image.row(y)));
    return rows;
}

class Writer {
public:
    explicit Writer(Bytes& out)
        : out_(out), png_(png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, fail, ignore)) {
        if (png_)
            info_ = png_create_info_struct(png_);
    }
    Writer(const Writer&) = delete;
    ~Writer() { png_destroy_write_struct(&png_, &info_); }

    // Jumps.
    bool write(Size size, int bits, int color_type, png_bytepp rows) {
        if (!info_ || setjmp(png_jmpbuf(png_)))
            return false;
        png_set_write_fn(
            png_, &out_,
            [](png_structp png, png_bytep from, std::size_t count) {
                auto& out = *static_cast<Bytes*>(png_get_io_ptr(png));
                const auto* first = reinterpret_cast<const std::byte*>(from);
                out.insert(out.end(), first, first + count);
            },
            nullptr);
        png_set_compression_level(png_, compression_level);
        png_set_IHDR(png_, info_, png_uint_32(size.width), png_uint_32(size.height), bits,
                     color_type, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                     PNG_FILTER_TYPE_DEFAULT);
        png_write_info(png_, info_);
        const std::uint16_t probe = 1;
        if (bits == 16 && *reinterpret_cast<const unsigned char*>(&probe) == 1)
            png_set_swap(png_);
        png_write_image(png_, rows);
        png_write_end(png_, nullptr);
        return true;
    }

private:
    Bytes& out_;
    png_structp png_;
    png_infop info_ = nullptr;
};

bool has_signature(ByteView png) {
    return png.size() >= 8 && png_sig_cmp(reinterpret_cast<png_const_bytep>(png.data()), 0, 8) == 0;
}

template <class Image>
Image read_png(const std::filesystem::path& path) {
    Image image;
    if (const std::string problem = decode_png(read_file(path), image); !problem.empty())
        throw Error("'" + path.string() + "' " + problem + ".");
    return image;
}

template <class T>
Bytes encode(View<T> image, int bits, int color_type) {
    Bytes bytes;
    std::vector<png_bytep> rows = row_pointers(image);
    if (!Writer(bytes).write(image.size, bits, color_type, rows.data()))
        throw Error("The PNG library could not encode a picture.");
    return bytes;
}

}  // namespace

std::string decode_png(ByteView png, DepthImage& out) {
    if (!has_signature(png))
        return "is not a PNG picture";
    Reader reader(png);
    if (!reader.read_header() || !is_valid(reader.size()))
        return damaged;
    if (reader.bits() != 16 || !reader.is_grey())
        return "is a PNG picture of " + std::to_string(reader.bits()) + " bits" +
               (reader.is_grey() ? " grey" : " in colour") + ", but depth needs 16 bits grey";
    out.resize(reader.size());
    std::vector<png_bytep> rows = row_pointers(out.view());
    return reader.read_depth(rows.data()) ? "" : damaged;
}

std::string decode_png(ByteView png, ColorImage& out) {
    if (!has_signature(png))
        return "is not a PNG picture";
    Reader reader(png);
    if (!reader.read_header() || !is_valid(reader.size()))
        return damaged;
    out.resize(reader.size());
    std::vector<png_bytep> rows = row_pointers(out.view());
    return reader.read_color(rows.data()) ? "" : damaged;
}

DepthImage read_depth_png(const std::filesystem::path& path) {
    return read_png<DepthImage>(path);
}

ColorImage read_color_png(const std::filesystem::path& path) {
    return read_png<ColorImage>(path);
}

Bytes encode_png(DepthView image) {
    return encode(image, 16, PNG_COLOR_TYPE_GRAY);
}

Bytes encode_png(ColorView image) {
    return encode(image, 8, PNG_COLOR_TYPE_RGB);
}

void write_png(const std::filesystem::path& path, DepthView image) {
    require_own_kind(path, png_beginning, "a PNG picture");
    write_file(path, encode_png(image));
}

void write_png(const std::filesystem::path& path, ColorView image) {
    require_own_kind(path, png_beginning, "a PNG picture");
    write_file(path, encode_png(image));
}

}  // namespace theatron::files
