// SPDX-License-Identifier: Apache-2.0
#include "video/jpeg_native.h"

#include <turbojpeg.h>

#include <string_view>

#include "base/error.h"
#include "video/jpeg_header.h"

namespace theatron::video {
namespace {

// Cameras pad their pictures; the decoder mentions it and loses nothing.
bool is_harmless(std::string_view warning) {
    return warning.find("extraneous bytes before marker") != std::string_view::npos;
}

}  // namespace

struct JpegDecompressor::Library {
    tjhandle handle = tjInitDecompress();
    ~Library() { tjDestroy(handle); }
};

JpegDecompressor::JpegDecompressor() : library_(std::make_unique<Library>()) {
    if (!library_->handle)
        throw Error("libjpeg-turbo gives no decoder; is memory exhausted?");
}

JpegDecompressor::~JpegDecompressor() = default;

Status JpegDecompressor::decompress(ByteView jpeg, ColorImage& out) {
    const Result<Size> size = read_jpeg_size(jpeg);
    if (!size)
        return size.error();
    out.resize(*size);
    // The library reads the header again: were its size another, it would fail
    // or scale, but never write beyond the size given here.
    const int failed =
        tjDecompress2(library_->handle, reinterpret_cast<const unsigned char*>(jpeg.data()),
                      static_cast<unsigned long>(jpeg.size()),
                      reinterpret_cast<unsigned char*>(out.pixels.data()), size->width,
                      size->width * int(sizeof(Rgb)), size->height, TJPF_RGB, TJFLAG_ACCURATEDCT);
    if (failed && !(tjGetErrorCode(library_->handle) == TJERR_WARNING &&
                    is_harmless(tjGetErrorStr2(library_->handle))))
        return Status::malformed;
    return Status::ok;
}

struct JpegCompressor::Library {
    tjhandle handle = tjInitCompress();
    ~Library() { tjDestroy(handle); }
};

JpegCompressor::JpegCompressor(int quality, bool halve_chroma)
    : library_(std::make_unique<Library>()), quality_(quality), halve_chroma_(halve_chroma) {
    if (!library_->handle)
        throw Error("libjpeg-turbo gives no encoder; is memory exhausted?");
}

JpegCompressor::~JpegCompressor() = default;

ByteView JpegCompressor::compress(ColorView image) & {
    const int subsampling = halve_chroma_ ? TJSAMP_420 : TJSAMP_444;
    const auto [width, height] = image.size;
    const std::size_t enough = tjBufSize(width, height, subsampling);
    if (bytes_.size() < enough)
        bytes_.resize(enough);
    auto* to = reinterpret_cast<unsigned char*>(bytes_.data());
    unsigned long used = static_cast<unsigned long>(bytes_.size());
    const int failed =
        tjCompress2(library_->handle, reinterpret_cast<const unsigned char*>(image.pixels), width,
                    int(image.stride) * int(sizeof(Rgb)), height, TJPF_RGB, &to, &used, subsampling,
                    quality_, TJFLAG_NOREALLOC | TJFLAG_ACCURATEDCT);
    // Valid pixels and a buffer of tjBufSize leave nothing that could fail.
    assert(!failed);
    return ByteView(bytes_).first(failed ? 0 : used);
}

}  // namespace theatron::video
