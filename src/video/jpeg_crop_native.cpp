// SPDX-License-Identifier: Apache-2.0
#include "video/jpeg_crop_native.h"

#include <turbojpeg.h>

#include <cassert>

#include "base/error.h"
#include "video/jpeg_header.h"

namespace theatron::video {

struct JpegCropper::Library {
    tjhandle handle = tjInitTransform();
    ~Library() { tjDestroy(handle); }
};

JpegCropper::JpegCropper() : library_(std::make_unique<Library>()) {
    if (!library_->handle)
        throw Error("libjpeg-turbo gives no transformer; is memory exhausted?");
}

JpegCropper::~JpegCropper() = default;

Result<ByteView> JpegCropper::crop(ByteView jpeg, int x, int y, Size size) & {
    const Result<Size> whole = read_jpeg_size(jpeg);
    if (!whole)
        return whole.error();
    if (x < 0 || y < 0 || x % block != 0 || y % block != 0 || !is_valid(size) ||
        x + size.width > whole->width || y + size.height > whole->height)
        return Status::size_mismatch;
    const auto* from = reinterpret_cast<const unsigned char*>(jpeg.data());
    const auto count = static_cast<unsigned long>(jpeg.size());
    int width = 0, height = 0, subsampling = 0, colors = 0;
    if (tjDecompressHeader3(library_->handle, from, count, &width, &height, &subsampling, &colors))
        return Status::malformed;
    if (subsampling < 0 || subsampling >= TJ_NUMSAMP || block % tjMCUWidth[subsampling] != 0 ||
        block % tjMCUHeight[subsampling] != 0)
        return Status::unsupported;

    tjtransform how{};
    how.r = {x, y, size.width, size.height};
    how.op = TJXOP_NONE;
    how.options = TJXOPT_CROP | TJXOPT_COPYNONE;
    // A hostile picture may hold more bits than any encoder would give it.
    const std::size_t enough = tjBufSize(size.width, size.height, TJSAMP_444) + jpeg.size();
    if (bytes_.size() < enough)
        bytes_.resize(enough);
    auto* to = reinterpret_cast<unsigned char*>(bytes_.data());
    auto used = static_cast<unsigned long>(bytes_.size());
    // Damage that the library only warns of shows when the picture is decoded.
    if (tjTransform(library_->handle, from, count, 1, &to, &used, &how, TJFLAG_NOREALLOC) &&
        tjGetErrorCode(library_->handle) != TJERR_WARNING)
        return Status::malformed;
    return ByteView(bytes_).first(used);
}

}  // namespace theatron::video
