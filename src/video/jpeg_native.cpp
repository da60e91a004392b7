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
    if (const Status status = own_.decode(jpeg, out); status != Status::unsupported)
        return status;
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

}  // namespace theatron::video
